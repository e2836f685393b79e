"""Tables of measured polarised BRDFs, of functions and of hemispheres."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest

import measured_tables
import optipath as op
from measured_tables import GOLD, by_formula, directions
from optipath.surfaces import Hemisphere, single_scattering, write_measured_polarized
from optipath.surfaces.hemisphere.beam import STATES, PartSums, SensedBeam
from optipath.surfaces.hemisphere.sensor import Sensor
from optipath.surfaces.walk.beam import beam_of
from tables import rows

pytest.importorskip("numba")
pytest.importorskip("xarray")

AXES = "phi_d", "theta_d", "theta_h"
GLASS = partial(single_scattering, 1.5, 0.4)


@pytest.fixture
def table_of(tmp_path):
    """Write a BRDF into a table, and read that."""

    def table(brdf, **given):
        write_measured_polarized(tmp_path / "a.pbsdf", brdf, **given)
        return measured_tables.read(tmp_path / "a.pbsdf")

    return table


def looked_up(table, pairs):
    return np.array([measured_tables.look_up(table, *pair, 550.0) for pair in pairs])


def test_numbers_at_the_places_of_the_table_are_those_of_the_brdf(table_of):
    brdf = partial(single_scattering, GOLD, 0.4)
    table = table_of(brdf, shape=(9, 7, 8))
    for places in [(1, 2, 2), (4, 1, 5), (7, 3, 1), (0, 1, 4)]:
        angles = (float(table[name][0, at]) for name, at in zip(AXES, places, strict=True))
        expected = by_formula(brdf, *between(*angles))
        atol = 2e-6 * expected[0, 0]
        np.testing.assert_allclose(table["M"][*places, 0], expected, rtol=0.0, atol=atol)
    # What is looked up is the BRDF but for the steps of the table.
    found = looked_up(table_of(GLASS, shape=(25, 31, 31)), directions(20))
    expected = np.array([by_formula(GLASS, *pair) for pair in directions(20)])
    assert np.abs(found - expected).max() < 0.02 * expected[:, 0, 0].max()


def between(phi, d, h):
    """The directions to the light and to the eye of half and difference angles."""
    half = np.array([np.sin(h), 0.0, np.cos(h)])
    along = np.array([np.cos(phi) * np.cos(h), np.sin(phi), -np.cos(phi) * np.sin(h)])
    return np.cos(d) * half + np.sin(d) * along, np.cos(d) * half - np.sin(d) * along


def test_arrays_have_the_shapes_and_types_that_the_plugin_asks_for(table_of):
    metal = op.Material.tabulated(["400 nm", "700 nm"], [0.2, 1.5], [2.0, 3.0])
    asked = set()

    def brdf(incoming, outgoing, wavelength):
        asked.add(wavelength)
        assert np.all(incoming[:, 2] < 0.0)
        assert np.all(outgoing[:, 2] > 0.0)
        return single_scattering(metal, 0.4, incoming, outgoing, wavelength=wavelength)

    given = {"wavelengths": [4.5e-7, 6.5e-7], "description": "metal, 0.4 µm"}
    table = table_of(brdf, shape=(5, 4, 6), **given)
    assert asked == {*given["wavelengths"]}
    assert table["M"].shape == (5, 4, 6, 2, 4, 4)
    assert [table[n].shape for n in AXES] == [(1, 5), (1, 4), (1, 6)]
    assert (table["wvls"].tolist(), table["wvls"].dtype) == ([450, 650], np.uint16)
    assert {table[n].dtype.name for n in ("M", *AXES)} == {"float32"}
    assert table["phi_d"][0, [0, -1]] == pytest.approx([-np.pi, np.pi])
    assert table["theta_h"][0, -1] == pytest.approx(np.pi / 2)
    assert bytes(table["description"]).decode().startswith("metal, 0.4 µm\nwritten by optipath")
    assert "M00_se" not in table
    # Next to the horizon there are numbers on both sides; none where theta_h is 90 deg.
    assert np.isfinite(table["M"][:, :, :-1]).all()
    assert np.isnan(table["M"][0, :, -1]).all()


@rows(
    "change, sentence",
    [
        ({"path": "a.bsdf"}, r"'a.bsdf' is to be a .pbsdf file; give 'a.pbsdf'"),
        ({"path": "nowhere/a.pbsdf"}, r"cannot be written: No such file or directory"),
        ({"brdf": 3.0}, r"brdf is 3.0; give a function .* or a list of hemispheres"),
        ({"brdf": lambda *_: 1.0}, r"brdf returns 1.0; for \d+ directions .* shape \(\d+,\)"),
        ({"wavelengths": ["550.5 nm"]}, r"up to 5 whole nanometres"),
        ({"wavelengths": [6e-7, 5e-7]}, r"the shortest first"),
        ({"wavelengths": [f"{n} nm" for n in range(400, 460, 10)]}, r"the plugin reads up to 5 "),
        ({"shape": (5, 1, 5)}, r"shape is \(5, 1, 5\); give three whole numbers from 2 on"),
        ({"shape": 5}, r"shape is 5; give three"),
        ({"path": "a.txt", "brdf": 3.0, "shape": 5}, "3 faults"),
    ],
)
def test_what_cannot_be_written_is_told(change, sentence, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    given = {"path": "a.pbsdf", "brdf": GLASS, "shape": (3, 3, 3)} | change
    with pytest.raises(op.OptipathError, match=sentence):
        write_measured_polarized(given.pop("path"), given.pop("brdf"), **given)
    assert not [*tmp_path.iterdir()]


ALPHA, PARTS, FINE = 0.3, 4, 4
BRDF = partial(single_scattering, GOLD, ALPHA)


def without_noise(incidence, pixels=40, projection="equidistant"):
    """The hemisphere that no end of photons would give, where each meets one facet alone."""
    sample = op.Sample([(GOLD, ALPHA)])
    sensor = Sensor(pixels, projection, PARTS)
    beam = replace(beam_of(sample, np.radians(incidence)), states=STATES)
    z = np.cos(np.radians(incidence))
    incoming = np.array([np.sqrt(1.0 - z * z), 0.0, -z])
    # Each pixel by its parts, in the frames that they have.
    fine = Sensor(pixels * FINE, projection)
    above = ~np.isnan(fine.theta) & (np.cos(fine.theta) > 1e-6)
    light = np.zeros((*above.shape, 4, 4))
    share = (fine.solid_angle * np.cos(fine.theta))[above][:, np.newaxis, np.newaxis]
    light[above] = BRDF(incoming, fine.directions[above]).matrix * share
    # Into the frame of the plane of incidence, which the model's own is but at normal incidence.
    sums = light.reshape(pixels, FINE, pixels, FINE, 16).sum(axis=(1, 3))
    sums = np.repeat(sums[np.newaxis, np.newaxis, :, :, np.newaxis], PARTS, axis=0)
    counts = np.zeros((1, pixels, pixels), np.int64)
    parts = PartSums(sums, counts, np.ones(PARTS, np.int64))
    seen = SensedBeam(beam, sensor, "polarized", 1)
    return Hemisphere(seen, parts, np.array([np.nan]), symmetric=False)


@pytest.fixture(scope="module")
def hemispheres():
    return [without_noise(angle) for angle in range(0, 90, 15)]


def test_hemispheres_without_noise_give_the_brdf_of_any_directions(hemispheres, table_of):
    table, pairs = table_of(hemispheres, shape=(13, 25, 25)), directions(24, lowest=0.4)
    expected = np.array([by_formula(BRDF, *pair) for pair in pairs])
    apart = np.abs(looked_up(table, pairs) - expected).max(axis=(1, 2))
    assert apart.max() < 0.06 * expected[:, 0, 0].max()
    assert np.median(apart / expected[:, 0, 0]) < 0.04
    # The same in all parts of the light: without error.
    assert np.nanmax(table["M00_se"]) < 1e-6 * expected[:, 0, 0].max()
    # Light from the normal, seen from beside it, within the four pixels about the normal.
    pair = np.array([0.0, 0.0, 1.0]), np.array([0.02, 0.0, np.sqrt(1.0 - 0.02**2)])
    (found,) = looked_up(table_of(hemispheres, shape=(5, 25, 25)), [pair])
    np.testing.assert_allclose(found, by_formula(BRDF, *pair), rtol=0.0, atol=0.02)


def test_photons_give_the_same_within_their_noise(table_of):
    sample, angles = op.Sample([(GOLD, ALPHA)], cells=300, surfaces=4), (20, 40, 60)
    given = {"photons": 100_000, "sensor": 20, "events": 1}
    found = [op.measure(sample, f"{angle} deg", **given) for angle in angles]
    exact = [without_noise(angle, pixels=20) for angle in angles]
    table, expected = (table_of(several, shape=(5, 13, 13)) for several in (found, exact))
    # Away from grazing, and where there are enough photons to know their noise.
    near = (slice(None), slice(9), slice(6))
    apart = np.abs(table["M"] - expected["M"])[near][..., 0, 0]
    spread = table["M00_se"][near] + 0.01 * expected["M"][near][..., 0, 0]
    known = np.isfinite(spread)
    assert known.mean() > 0.9
    assert (apart < 5.0 * spread)[known].mean() > 0.99
    assert bytes(table["description"]).decode().startswith("Hemisphere of Sample([((0.2+3j), 0.3)]")


def test_hemispheres_that_do_not_belong_together_are_told(hemispheres, tmp_path):
    file, first = tmp_path / "a.pbsdf", hemispheres[0]
    beam = replace(first.seen.beam, sample=op.Sample([(GOLD, (ALPHA, 0.4))]))
    other = replace(first, seen=replace(first.seen, beam=beam))
    turned = replace(other, seen=replace(first.seen, beam=replace(beam, sin=0.1)))
    colours = replace(hemispheres[1], wavelengths=np.array([5e-7]))
    for given, sentence in [
        *((each, r"too few incidences, .* measure at") for each in ([], [first])),
        ([first, 3], r"3 is no hemisphere; give what op.measure returns"),
        ([first, first], r"or from one of them twice"),
        ([hemispheres[1], other], r"is of another sample or other wavelengths than"),
        ([first, colours], r"is of another sample or other wavelengths than"),
        ([other, turned], r"the table is of isotropic samples"),
    ]:
        with pytest.raises(op.errors.SurfaceError, match=sentence):
            write_measured_polarized(file, given)
    with pytest.raises(op.errors.SurfaceError, match=r"leave wavelengths= out"):
        write_measured_polarized(file, hemispheres, wavelengths=[5e-7])


def test_another_projection_gives_the_same_and_odd_sensors_have_light_about_the_normal(
    hemispheres, table_of
):
    areas = [without_noise(angle, projection="equal-area") for angle in range(0, 90, 15)]
    one, other = (
        table_of(several, shape=(5, 7, 9))["M"][:, :5, :5] for several in (hemispheres, areas)
    )
    assert np.abs(one - other).max() < 0.05 * np.abs(one).max()
    found = [without_noise(angle, pixels=21) for angle in range(0, 90, 15)]
    matrices = table_of(found, shape=(5, 13, 13))["M"]
    assert np.nanmax(np.abs(matrices)) < 1.01 * np.nanmax(matrices[..., 0, 0])
