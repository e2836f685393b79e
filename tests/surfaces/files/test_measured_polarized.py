from functools import partial

import numpy as np
import pytest

import measured_tables
import optipath as op
from measured_tables import GOLD, by_formula, directions
from optipath.surfaces import single_scattering, write_measured_polarized

AXES = "phi_d", "theta_d", "theta_h"
GLASS = partial(single_scattering, 1.5, 0.4)


def test_numbers_at_the_places_of_the_table_are_those_of_the_brdf(tmp_path):
    brdf = partial(single_scattering, GOLD, 0.4)
    write_measured_polarized(tmp_path / "a.pbsdf", brdf, shape=(9, 7, 8))
    table = measured_tables.read(tmp_path / "a.pbsdf")
    for phi, d, h in [(1, 2, 2), (4, 1, 5), (7, 3, 1), (0, 1, 4)]:
        angles = (float(table[name][0, at]) for name, at in zip(AXES, (phi, d, h), strict=True))
        found = table["M"][phi, d, h, 0]
        expected = by_formula(brdf, *between(*angles))
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=2e-6 * expected[0, 0])


def between(phi, d, h):
    """The directions to the light and to the eye of half and difference angles."""
    half = np.array([np.sin(h), 0.0, np.cos(h)])
    along = np.array([np.cos(phi) * np.cos(h), np.sin(phi), -np.cos(phi) * np.sin(h)])
    return np.cos(d) * half + np.sin(d) * along, np.cos(d) * half - np.sin(d) * along


def test_what_is_looked_up_is_the_brdf_but_for_the_steps_of_the_table(tmp_path):
    write_measured_polarized(tmp_path / "a.pbsdf", GLASS, shape=(25, 31, 31))
    table = measured_tables.read(tmp_path / "a.pbsdf")
    expected = [by_formula(GLASS, *pair) for pair in directions(20)]
    found = [measured_tables.look_up(table, *pair, 550.0) for pair in directions(20)]
    brightest = max(each[0, 0] for each in expected)
    assert np.abs(np.array(found) - expected).max() < 0.02 * brightest


def test_arrays_have_the_shapes_and_types_that_the_plugin_asks_for(tmp_path):
    metal = op.Material.tabulated(["400 nm", "700 nm"], [0.2, 1.5], [2.0, 3.0])
    brdf = partial(single_scattering, metal, 0.4)
    write_measured_polarized(
        tmp_path / "a.pbsdf",
        brdf,
        wavelengths=["450 nm", "650 nm"],
        shape=(5, 4, 6),
        description="metal, 0.4 µm",
    )
    table = measured_tables.read(tmp_path / "a.pbsdf")
    assert table["M"].shape == (5, 4, 6, 2, 4, 4)
    assert [table[n].shape for n in AXES] == [(1, 5), (1, 4), (1, 6)]
    assert table["wvls"].tolist() == [450, 650]
    assert table["wvls"].dtype == np.uint16
    assert {table[n].dtype.name for n in ("M", *AXES)} == {"float32"}
    assert table["phi_d"][0, [0, -1]] == pytest.approx([-np.pi, np.pi])
    assert table["theta_h"][0, -1] == pytest.approx(np.pi / 2)
    assert bytes(table["description"]).decode().startswith("metal, 0.4 µm\nwritten by optipath")
    assert "M00_se" not in table
    # Next to the horizon there are numbers on both sides; none where theta_h is 90 deg.
    assert np.isfinite(table["M"][:, :, :-1]).all()
    assert np.isnan(table["M"][0, :, -1]).all()


def test_each_wavelength_is_asked_for_in_metres(tmp_path):
    asked = []

    def brdf(incoming, outgoing, wavelength):
        asked.append(wavelength)
        assert np.all(incoming[:, 2] < 0.0)
        assert np.all(outgoing[:, 2] > 0.0)
        return single_scattering(1.5, 0.3, incoming, outgoing)

    write_measured_polarized(tmp_path / "a.pbsdf", brdf, wavelengths=[5e-7, 6e-7], shape=(2, 2, 2))
    assert asked == [5e-7, 6e-7] * 2


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"path": "a.bsdf"}, r"'a.bsdf' is to be a .pbsdf file; give 'a.pbsdf'"),
        ({"path": "nowhere/a.pbsdf"}, r"cannot be written: No such file or directory"),
        ({"brdf": 3.0}, r"brdf is 3.0; give a function .* or a list of hemispheres"),
        ({"brdf": lambda *_: 1.0}, r"brdf returns 1.0; for \d+ directions .* shape \(\d+,\)"),
        ({"wavelengths": ["550.5 nm"]}, r"whole nanometres"),
        ({"wavelengths": [6e-7, 5e-7]}, r"up to 5 that differ, the shortest first"),
        ({"wavelengths": [f"{n} nm" for n in range(400, 460, 10)]}, r"the plugin reads up to 5 "),
        ({"shape": (5, 1, 5)}, r"shape is \(5, 1, 5\); give three whole numbers from 2 on"),
        ({"shape": 5}, r"shape is 5; give three"),
        ({"description": 5}, r"description must be a text"),
    ],
)
def test_what_cannot_be_written_is_told(change, sentence, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    given = {"path": "a.pbsdf", "brdf": GLASS, "shape": (3, 3, 3)} | change
    with pytest.raises(op.OptipathError, match=sentence):
        write_measured_polarized(given.pop("path"), given.pop("brdf"), **given)
    assert not [*tmp_path.iterdir()]


def test_all_faults_are_told_at_once():
    with pytest.raises(op.SurfaceError, match=r"3 faults"):
        write_measured_polarized("a.txt", 3.0, shape=5)
