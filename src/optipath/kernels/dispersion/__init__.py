"""How the index of refraction depends on the wavelength: published formulas, each text once.

They are functions of ``numpy`` or ``jax.numpy``, elementwise and without checks: where a formula
has no number, theirs is NaN.
"""
