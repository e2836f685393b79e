"""How far photons that rough surfaces have reflected once are from the analytic model.

    pip install "optipath[fast,sweep]"
    python examples/facet_model_beside_photons.py silver 90

Prints a row of the table of docs/virtual-ellipsometry.md: the largest differences of Stokes vectors
for an unpolarised source, over the largest S0, among the pixels that are further than 30 deg from
grazing, of 16 x 16 or, with a third argument, as many as it says. The number is how many times
half a million photons are walked over 16 new surfaces, some 3 seconds each.
"""

import sys

import numpy as np

import optipath as op

CASES = {
    "silver": (0.5 + 2.1j, 0.3, "40 deg", 960),
    "gold": (0.16 + 3.6j, 0.25, "60 deg", 640),
    "glass": (1.5, 0.2, "30 deg", 640),
}
"""Of each the index, alpha, the incidence, and the cells of a surface along each side."""

SURFACES, PHOTONS, FIRST_SEED = 16, 1 << 19, 1000


def measured(index, alpha, incidence, cells, times, pixels):
    """Return what all photons that have met one facet come to."""
    total = None
    for seed in range(FIRST_SEED, FIRST_SEED + times):
        sample = op.Sample([(index, alpha)], cells=cells, surfaces=SURFACES, seed=seed)
        found = op.measure(
            sample, incidence, PHOTONS, sensor=pixels, seed=seed, events=1, polarized="polarized"
        )
        if total is None:
            total = found
        else:
            total.parts.add(found.parts)
    return total


def row(found):
    """Yield the largest differences of S0 to S3, each with its standard error."""
    model = found.single_scattering().isel(side=0, wavelength=0).sel({"in": "S0"}).values
    light = found.stokes().isel(side=0, wavelength=0)
    far = found.sensor.theta < np.radians(60.0)
    apart, errors = np.abs(light.values - model)[far], light.se.values[far]
    largest, places = model[..., 0].max(), apart.argmax(axis=0)
    for component, place in enumerate(places):
        yield apart[place, component] / largest, errors[place, component] / largest


def main():
    """Print the row."""
    name, times = sys.argv[1], int(sys.argv[2])
    index, alpha, incidence, _ = CASES[name]
    found = measured(*CASES[name], times, int(sys.argv[3]) if len(sys.argv) > 3 else 16)
    begins = f"{name}, {index:.4g}", f"{alpha}", incidence, f"{found.photons / 1e6:.1f} million"
    cells = [f"{off:.5f} ± {error:.5f}" if off else "0" for off, error in row(found)]
    print(f"| {' | '.join([*begins, *cells])} |")


if __name__ == "__main__":
    main()
