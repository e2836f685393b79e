"""What Mitsuba 3 reads out of a table of a polarised BRDF, against what was written into it.

The script `computing/mitsuba_table_figures.py` has made the file in `figures/tables/`.
"""

import json
from functools import partial
from pathlib import Path

import numpy as np

import measured_tables
import optipath as op

FIGURES = json.loads((Path(__file__).parent / "figures/tables/mitsuba.json").read_text("utf-8"))
FLIPPED = measured_tables.FLIPPED


def brdf():
    table = FIGURES["table"]
    metal = op.Material.tabulated(table["wavelengths"], table["n"], table["k"])
    return partial(op.surfaces.single_scattering, metal, table["alpha"])


def evaluated():
    """What was read: it, the directions of light and eye, and Mitsuba's frames of them."""
    for each in FIGURES["evaluated"]:
        light, eye = np.array(each["light"]), np.array(each["eye"])
        towards = zip((-light, eye), ("basis_in", "basis_out"), strict=True)
        yield each, light, eye, [op.Frame.from_direction(z, np.array(each[x])) for z, x in towards]


def within(frame):
    return op.Mueller(np.eye(4), frame, frame)


def test_mitsuba_reads_from_the_table_what_was_written(tmp_path):
    table, file = FIGURES["table"], tmp_path / "metal.pbsdf"
    write = op.surfaces.write_measured_polarized
    write(file, brdf(), wavelengths=table["tabulated"], shape=tuple(table["shape"]))
    arrays = measured_tables.read(file)
    for each, light, eye, theirs in evaluated():
        ours = measured_tables.look_up(arrays, light, eye, each["wavelength"])
        x = np.cross(light, eye)
        own = [op.Frame.from_direction(z, x) for z in (-light, eye)]
        table = op.Mueller(FLIPPED @ ours @ FLIPPED, *own)
        turned = within(theirs[1]) @ table @ within(theirs[0])
        ours = FLIPPED @ turned.matrix @ FLIPPED * light[2]
        np.testing.assert_allclose(ours, each["mueller"], rtol=0.0, atol=FIGURES["precision"])


def test_what_mitsuba_reads_is_the_brdf_but_for_the_steps_of_a_coarse_table():
    brightest = max(each["mueller"][0][0] for each in FIGURES["evaluated"])
    for each, light, eye, frames in evaluated():
        found = brdf()(-light, eye, wavelength=each["wavelength"] * 1e-9)
        ours = (within(frames[1]) @ found @ within(frames[0])).to("mitsuba") * light[2]
        assert np.abs(ours - each["mueller"]).max() < 0.05 * brightest
