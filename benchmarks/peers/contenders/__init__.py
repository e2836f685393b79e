"""One file for each who takes part; each has a tuple CONTENDERS."""

MODULES = (
    "optipath_engines",
    "numpy_by_hand",
    "numba_by_hand",
    "jax_by_hand",
    "math_by_hand",
    "drjit_by_hand",
    "mitsuba_mueller",
    "pypolar_amplitudes",
    "tmm_amplitudes",
    "katsu_matrices",
    "py_pol_objects",
)
