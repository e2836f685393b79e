"""Figures of colour-science: pip install colour-science.

Spectra are linear between their samples, dark or as at the last one beyond, laid out at every
nanometre and summed up by its method "Integration".
"""

import warnings

import colour
import numpy as np
import setups

OBSERVER = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
GRIDS = {
    "every nm": np.arange(360.0, 831.0),
    "5 nm": np.arange(380.0, 781.0, 5.0),
    "40 nm": np.arange(380.0, 781.0, 40.0),
    "uneven": np.array([350.0, 361, 390, 400, 417, 450, 501, 555, 600, 609, 700, 780, 900]),
    "halves": np.arange(700.0, 1681.0) / 2.0,
}


def spectrum(nanometres):
    """A smooth one, which tests write in the same way."""
    return 1.0 + np.sin(nanometres / 37.0) + 3.0 * np.exp(-(((nanometres - 560.0) / 40.0) ** 2))


def summed(grid, outside):
    nearest = outside == "nearest"
    every = OBSERVER.wavelengths
    values = np.interp(every, grid, spectrum(grid), *([] if nearest else [0.0, 0.0]))
    laid_out = colour.SpectralDistribution(values, every)
    return colour.sd_to_XYZ(laid_out, OBSERVER, method="Integration", k=1.0)


def asked():
    for name, grid in GRIDS.items():
        for outside in ("dark", "nearest"):
            xyz = summed(grid, outside)
            yield {"name": name, "outside": outside, "nm": grid.tolist(), "xyz": xyz.tolist()}


def displayed():
    white = np.array([1.09846607, 1.0, 0.35582280])  # Illuminant A.
    for xyz in ([0.2, 0.18, 0.15], [0.6, 0.55, 0.1], [0.02, 0.03, 0.01], [0.9, 0.95, 1.0]):
        space = colour.RGB_COLOURSPACES["sRGB"]
        srgb = colour.models.eotf_inverse_sRGB(space.matrix_XYZ_to_RGB @ np.array(xyz))
        target = colour.xy_to_XYZ(space.whitepoint)
        adapted = colour.chromatic_adaptation(np.array(xyz), white, target, transform="Bradford")
        found = {"white": white.tolist(), "srgb": srgb.tolist(), "adapted": adapted.tolist()}
        yield {"name": str(xyz), "xyz": xyz, **found}


with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    found = {"xyz": list(asked()), "displayed": list(displayed())}
    setups.write_file("colour/colour_science", "colour-science", __file__, precision=1e-6, **found)
