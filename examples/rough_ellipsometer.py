"""A virtual ellipsometer looks at rough gold: DoLP and AoP over the angle of reflection.

    pip install "optipath[fast,sweep,chart]"
    python examples/rough_ellipsometer.py docs/rough-ellipsometer.json docs/rough-ellipsometer.png

The set-up of figures 7 to 9 of M. Wang et al., Optics Express 25(19), 2017: gold at 670 nm, lit at
30, 45 and 60 deg by light of six states, and seen in the plane of incidence, up to 15 deg from
where a smooth surface would mirror it. Some minutes of two processors.
"""

import functools
import io
import json
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import optipath as op
from optipath.surfaces import Sensor
from optipath.values.files import write_file

SAMPLE, WAVELENGTH = "wang-2017-figures-7-9", "670 nm"
PHOTONS = 1 << 24
SENSOR = Sensor(181)  # pixels of 1 deg, one row of them along the plane of incidence
ALONG = np.degrees(SENSOR.theta[90, 90:])  # where their centres are
INCIDENCES, APART = (30, 45, 60), 15.5
NAMES = "DoLP", "AoP"
ANALYZER = np.radians([0.0, 45.0, 90.0, 135.0])[:, np.newaxis]

CASES = op.load_preset("ellipsometer-rough").cases
STATES = {
    name: np.reshape([case.values[name] for case in CASES.values()], (-1, 1, 1))
    for name in ("polarizer", "compensator")
}


def polarization(path, **values):
    """Return DoLP and AoP of six states, from four intensities by an analyser that turns."""
    plan = path.compose()
    seen = plan.run_all(analyzer=ANALYZER, **STATES, **values)["photometer"].intensity
    i0, i45, i90, i135 = np.moveaxis(seen, 1, 0)
    s0, s1, s2 = i0 + i90, i0 - i90, i45 - i135
    return np.stack([np.hypot(s1, s2) / s0, np.degrees(0.5 * np.arctan2(s2, s1))])


def of_matrix(matrix):
    """Return the same of what has been measured, one Mueller matrix for each direction."""
    path = op.load_preset("ellipsometer-rough")
    path.replace("S", op.MuellerElement(matrix, straight=False))
    return polarization(path)


def turned_from(whole, matrix):
    """Return by how much they differ, in the AoP by 90 deg at most."""
    degree, angle = of_matrix(matrix) - whole
    return np.stack([degree, np.remainder(angle + 90.0, 180.0) - 90.0])


def measured(incidence, angles):
    """Return DoLP and AoP over the angle of reflection, and their standard errors."""
    sample, towards = op.load_sample(SAMPLE), [f"{angle} deg" for angle in angles]
    hemisphere = op.measure(sample, f"{incidence} deg", PHOTONS, WAVELENGTH, sensor=SENSOR)
    found = of_matrix(hemisphere.toward(towards).matrix)
    _, error = hemisphere.estimate_toward(functools.partial(turned_from, found), towards)
    return found, error


def of_smooth_facets(incidence, angles):
    """Return the same of facets that mirror light into each direction: at half the angle."""
    gold = complex(op.load_sample(SAMPLE).indices(WAVELENGTH).base)
    half = np.radians(0.5 * (incidence + angles))
    smooth = op.load_preset("ellipsometer-pcsa")
    return polarization(smooth, n=gold.real, k=gold.imag, theta=half)


def curves():
    """Measure all curves, as JSON has them."""
    rows = []
    for incidence in INCIDENCES:
        angles = ALONG[np.abs(ALONG - incidence) < APART]
        values, errors = measured(incidence, angles)
        smooth = of_smooth_facets(incidence, angles)
        for place, state in enumerate(CASES):
            row = {"incidence": incidence, "state": state, "reflection": angles.round(4).tolist()}
            for which, name in enumerate(NAMES):
                digits = 5 - which
                row[name] = values[which, place].round(digits).tolist()
                row[f"{name}_se"] = errors[which, place].round(digits + 1).tolist()
                row[f"{name}_facet"] = smooth[which, place].round(digits).tolist()
            rows.append(row)
    told = {"sample": SAMPLE, "wavelength": WAVELENGTH, "photons": PHOTONS}
    return told | {"pixels": SENSOR.pixels, "curves": rows}


def rows_of(row):
    """Yield what a state's curve is in each row of the picture: value, error, that of facets."""
    degree, angle = (np.array([row[f"{n}{e}"] for e in ("", "_se", "_facet")]) for n in NAMES)
    yield degree
    yield angle
    if np.abs(angle[2]).min() > 1.0 and np.abs(angle[2]).max() < 89.0:
        # As the paper has it, 1/2 arctan |S2 / S1|.
        yield np.stack([folded(angle[0]), angle[1], folded(angle[2])])


def folded(angle):
    """Return angles of polarisation from 0 to 45 deg."""
    return 45.0 - np.abs(45.0 - np.abs(angle))


def draw(found, file):
    """Draw DoLP and AoP with bands of two standard errors; dashed, smooth facets."""
    figure, axes = plt.subplots(3, 3, sharex="col", figsize=(12.0, 9.0), layout="constrained")
    figure.suptitle(
        "Rough gold (alpha 0.25) at 670 nm by an ellipsometer; bands: two standard errors; "
        "dashed: single smooth facets"
    )
    for row in found["curves"]:
        column = INCIDENCES.index(row["incidence"])
        angles = row["reflection"]
        place = [*CASES].index(row["state"])
        style = {"color": f"C{place}", "marker": "ox"[place % 2], "markersize": 3 + place % 2}
        for axis, (value, error, facet) in zip(axes[:, column], rows_of(row), strict=False):
            axis.plot(angles, value, label=row["state"], **style)
            band = value - 2.0 * error, value + 2.0 * error
            axis.fill_between(angles, *band, color=style["color"], alpha=0.3)
            axis.plot(angles, facet, "--", color=style["color"], linewidth=0.8)
        axes[0, column].set_title(f"incidence {row['incidence']} deg")
        axes[2, column].set_xlabel("angle of reflection (deg)")
    labels = "DoLP", "AoP (deg, from p towards s)", "AoP, folded into 0 .. 45 deg"
    for axis, label in zip(axes[:, 0], labels, strict=True):
        axis.set_ylabel(label)
    axes[0, 0].legend(fontsize="small")
    for axis in axes.flat:
        axis.grid(visible=True, alpha=0.3)
    drawn = io.BytesIO()
    figure.savefig(drawn, dpi=90, format="png")
    write_file(file, drawn.getvalue())


def table(found):
    """Print what is seen where a smooth surface would mirror the light."""
    print("| incidence | state | DoLP | AoP (deg) | DoLP of a facet | AoP of a facet (deg) |")
    print("| --- | --- | --- | --- | --- | --- |")
    for row in found["curves"]:
        middle = np.argmin(np.abs(np.array(row["reflection"]) - row["incidence"]))
        degree, angle = (
            f"{row[name][middle]:.{digits}f} ± {row[f'{name}_se'][middle]:.{digits}f}"
            for name, digits in (("DoLP", 4), ("AoP", 2))
        )
        smooth = f"{row['DoLP_facet'][middle]:.4f} | {row['AoP_facet'][middle]:.2f}"
        print(f"| {row['incidence']} deg | {row['state']} | {degree} | {angle} | {smooth} |")


if __name__ == "__main__":
    kept, picture = map(Path, sys.argv[1:])
    if not kept.exists():
        text = json.dumps(curves(), indent=1)
        write_file(kept, f"{text}\n".encode())
    known = json.loads(kept.read_text("utf-8"))
    table(known)
    draw(known, picture)
