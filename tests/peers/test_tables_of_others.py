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


def turned(matrix, frames_in, frames_out):
    """Numbers between frames, from those between others of the same directions."""
    before, behind = (
        op.Mueller(np.eye(4), *frames) @ op.Mueller(np.eye(4), frames[0], frames[0])
        for frames in ((frames_in[1], frames_in[1]), (frames_out[1], frames_out[1]))
    )
    return (behind @ op.Mueller(matrix, frames_in[0], frames_out[0]) @ before).matrix


def test_mitsuba_reads_from_the_table_what_was_written(tmp_path):
    table, file = FIGURES["table"], tmp_path / "metal.pbsdf"
    write = op.surfaces.write_measured_polarized
    write(file, brdf(), wavelengths=table["tabulated"], shape=tuple(table["shape"]))
    arrays = measured_tables.read(file)
    for each in FIGURES["evaluated"]:
        light, eye = np.array(each["light"]), np.array(each["eye"])
        ours = measured_tables.look_up(arrays, light, eye, each["wavelength"])
        x = np.cross(light, eye)
        frames = [
            [op.Frame.from_direction(z, x), op.Frame.from_direction(z, np.array(each[basis]))]
            for z, basis in ((-light, "basis_in"), (eye, "basis_out"))
        ]
        ours = FLIPPED @ turned(FLIPPED @ ours @ FLIPPED, *frames) @ FLIPPED * light[2]
        np.testing.assert_allclose(ours, each["mueller"], rtol=0.0, atol=FIGURES["precision"])


def test_what_mitsuba_reads_is_the_brdf_but_for_the_steps_of_a_coarse_table():
    brightest = max(each["mueller"][0][0] for each in FIGURES["evaluated"])
    for each in FIGURES["evaluated"]:
        light, eye = np.array(each["light"]), np.array(each["eye"])
        found = brdf()(-light, eye, wavelength=each["wavelength"] * 1e-9)
        frames = [
            op.Frame.from_direction(z, np.array(each[basis]))
            for z, basis in ((-light, "basis_in"), (eye, "basis_out"))
        ]
        into, out_of = (op.Mueller(np.eye(4), frame, frame) for frame in frames)
        ours = (out_of @ found @ into).to("mitsuba") * light[2]
        assert np.abs(ours - each["mueller"]).max() < 0.05 * brightest
