"""How many times fewer photons a paired run needs than two separate ones.

    python examples/paired_photons.py

A photon that carries its Stokes vector and its weight without polarisation on one way tells their
difference with a far smaller error than two photons that go ways of their own.
"""

import numpy as np

import optipath as op

SAMPLES = [
    ("glass-on-glass", "50 deg", {}),
    ("glass-on-glass", "60 deg", {}),
    ("glass-on-gold", "60 deg", {"wavelengths": "550 nm"}),
    ("glass-rough", "60 deg", {}),
]


def saving(sample: str, incidence: str, photons: int = 1 << 20, **given) -> float:
    """Return the photons of two separate runs over those of one paired run, for one error.

    That of S0 - U in the pixels that `Hemisphere.adm` has brighter than 0.2 of the mean, squared
    and summed.
    """
    loaded, given = op.load_sample(sample), {"photons": photons, "sensor": 64, **given}
    paired = op.measure(loaded, incidence, seed=0, **given)
    polarised = op.measure(loaded, incidence, seed=1, polarized="polarized", **given)
    scalar = op.measure(loaded, incidence, seed=2, polarized="scalar", **given)
    counts = ~np.isnan(paired.relative_difference().values)
    together = paired.difference[1][0][counts]
    apart = polarised.mueller[1][0][..., 0, 0][counts], scalar.scalar[1][0][counts]
    # Two runs walk twice as many photons.
    return float(2.0 * np.square(apart).sum() / np.square(together).sum())


if __name__ == "__main__":
    for sample, incidence, given in SAMPLES:
        print(f"{sample:15} {incidence}  {saving(sample, incidence, **given):8,.0f}")
