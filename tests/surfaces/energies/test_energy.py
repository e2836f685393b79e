import math

import numpy as np
import pytest

import optipath as op
from optipath import surfaces
from optipath.surfaces.walk.photon_beam import TURN

pytest.importorskip("numba")

GLASS = op.Sample([(1.5, 0.5)])
SILVER = op.Sample([(0.5 + 2.1j, 0.3)])


def test_the_same_seed_gives_the_same_bits_by_any_number_of_threads():
    first, *others = [
        surfaces.energy(GLASS, "50 deg", photons=100_000, seed=7, threads=threads)
        for threads in (1, 2, 5)
    ]
    for other in others:
        assert all(
            np.array_equal(getattr(first, name), getattr(other, name))
            for name in ("R_s", "R_m", "T_s", "T_m", "R_se", "reflected", "transmitted_se")
        )


def test_another_seed_gives_other_photons():
    one, other = [surfaces.energy(GLASS, "50 deg", photons=1000, seed=seed) for seed in (0, 1)]
    assert one.R != other.R


def test_all_light_of_a_dielectric_goes_somewhere():
    found = surfaces.energy(op.Sample([(1.5, 0.5), (2.4, 0.3)]), "60 deg", photons=100_000)
    scalar = found.scalar
    assert float(scalar.R + scalar.T + scalar.lost) == pytest.approx(1.0, abs=1e-12)
    assert abs(found.absorbed) < 6 * found.absorbed_se


def test_a_perfect_reflector_keeps_everything():
    found = surfaces.energy(op.Sample([(1j, 1.0)]), 1.4, photons=50_000)
    assert float(found.R) == pytest.approx(1.0, abs=1e-12)
    assert found.stuck == found.sideways == 0


def test_shares_are_the_sums_of_those_by_number_of_events():
    found = surfaces.energy(GLASS, "70 deg", photons=50_000)
    assert found.reflected[0] == found.R_s
    assert found.reflected[1:].sum() == pytest.approx(float(found.R_m), rel=1e-12)
    assert found.transmitted.sum() == pytest.approx(float(found.T), rel=1e-12)
    assert float(found.R_s + found.R_m) == pytest.approx(float(found.R), rel=1e-12)


def test_what_metal_does_not_reflect_is_absorbed():
    found = surfaces.energy(SILVER, "40 deg", photons=50_000)
    assert float(found.R + found.absorbed) == pytest.approx(1.0, abs=1e-12)
    assert found.T == 0.0


def test_wavelengths_ride_on_the_same_photons():
    gold = op.Sample([(op.Material.named("gold"), 0.3)])
    colours = [450e-9, 550e-9, 650e-9]
    found = surfaces.energy(gold, "40 deg", photons=20_000, wavelength=colours)
    assert found.R.shape == (3,)
    alone = [surfaces.energy(gold, "40 deg", photons=20_000, wavelength=each) for each in colours]
    assert np.allclose(found.R, [each.R for each in alone], rtol=1e-13)
    assert np.allclose(found.scalar.R_m, [each.scalar.R_m for each in alone], rtol=1e-13)


def test_a_brighter_source_has_the_same_shares():
    found = [
        surfaces.energy(GLASS, "40 deg", photons=5000, stokes=(size, 0.3 * size, 0.0, 0.0))
        for size in (1.0, 4.0)
    ]
    assert found[0].R_m == found[1].R_m
    assert found[0].T_se == found[1].T_se


def test_s_polarised_light_is_reflected_by_fresnel_s_share_of_a_flat_sample():
    flat = op.Sample([(1.5, 0)])
    r_s = op.fresnel_reflection(1.5, math.cos(1.0), math.sin(1.0))
    found = surfaces.energy(flat, 1.0, photons=200_000, stokes=(1.0, 1.0, 0.0, 0.0))
    assert float(found.R) == pytest.approx(r_s[0] + r_s[1], abs=6 * float(found.R_se))


def test_photons_are_walked_until_the_error_is_small_enough():
    found = surfaces.energy(GLASS, "40 deg", tolerance=5e-4)
    assert found.R_se <= 5e-4
    assert found.photons > 100_000


def test_a_tolerance_that_is_not_reached_is_told():
    with pytest.warns(op.PhotonWarning, match="after 20000 photons, more than the tolerance"):
        found = surfaces.energy(GLASS, "40 deg", photons=20_000, tolerance=1e-6)
    assert found.photons == 20_000


def test_progress_is_told_to_the_end():
    told = []
    surfaces.energy(
        GLASS, "40 deg", photons=40_000, progress=lambda done, whole: told.append((done, whole))
    )
    assert told == [(16384, 40_000), (32768, 40_000), (40_000, 40_000)]


@pytest.mark.parametrize(
    ("wrong", "sentence"),
    [
        ({"photons": 0}, "photons must be a whole number of 1 or more, not 0"),
        ({"photons": 2.5}, "photons must be a whole number of 1 or more, not 2.5"),
        ({"threads": 0}, "threads must be a whole number of 1 or more, not 0"),
        ({"seed": -1}, "seed must be a whole number of 0 or more, not -1"),
        ({"tolerance": 0.0}, "tolerance is 0.0; give a standard error within 0 .. 1"),
        ({"incidence": "90 deg"}, "incidence is 90 deg, along the sample"),
        ({"incidence": 2.0}, "within 0 deg .. 90 deg"),
        ({"incidence": -0.1}, "within 0 deg .. 90 deg"),
        ({"incidence": [0.1, 0.2]}, r"incidence has the shape \(2,\)"),
        ({"incidence": math.nan}, "incidence is nan"),
        ({"stokes": (0.0, 0.0, 0.0, 0.0)}, "stokes has no intensity"),
        ({"stokes": (1.0, 1.0, 1.0, 0.0)}, "polarised by more than 100 %"),
        ({"wavelength": "550 nm"}, "no medium depends on it"),
        ({"sample": "glass"}, "sample is 'glass'; give an op.Sample"),
        ({"most_events": 0}, "most_events must be a whole number of 1 or more"),
        ({"azimuth": "north"}, "azimuth"),
    ],
)
def test_what_cannot_be_is_told(wrong, sentence):
    given = {"sample": GLASS, "incidence": "40 deg", **wrong}
    with pytest.raises(op.SurfaceError, match=sentence):
        surfaces.energy(**given)


def test_all_faults_are_told_at_once():
    with pytest.raises(op.SurfaceError) as told:
        surfaces.energy(GLASS, "95 deg", photons=-1, seed="x", tolerance=2)
    assert len(told.value.faults) == 4


def test_light_that_meets_nothing_of_a_finite_field_is_told():
    peak = np.outer([0.0, 1.0, 0.0], [0.0, 1.0, 0.0])
    field = surfaces.HeightField.from_heights(peak, size=1e-3, periodic=False)
    with pytest.raises(op.SurfaceError, match="photons meet nothing of the sample"):
        surfaces.energy(op.Sample([(1.5, field)]), "89.9999 deg", photons=100)


def test_many_photons_get_new_surfaces_so_that_the_error_goes_on_falling():
    sample = op.Sample([(1.5, 0.5)], surfaces=1)
    few, many = [surfaces.energy(sample, "40 deg", photons=TURN + more) for more in (0, 1)]
    assert (few.surfaces, many.surfaces) == (1, 2)
    assert sample.fields(1)[0] != sample.fields(0)[0]


def test_few_photons_are_spread_over_the_surfaces():
    assert surfaces.energy(GLASS, "40 deg", photons=16 * 512).surfaces == 16


def test_of_one_photon_no_error_is_known():
    assert np.isnan(surfaces.energy(GLASS, "40 deg", photons=1).R_se)
    with pytest.warns(op.PhotonWarning, match="the standard error of R is nan after 1 photons"):
        surfaces.energy(GLASS, "40 deg", photons=1, tolerance=0.01)


def test_given_maps_of_one_size_stay_in_register():
    # A step of glass whose lower face has the same step, 4 to the side or above each other.
    heights = np.repeat([[0.0] * 4 + [4.0] * 4], 8, axis=0)
    above, aside = [
        op.Sample(
            [
                (1.5, surfaces.HeightField.from_heights(heights, 8.0, periodic=True)),
                (1.0, surfaces.HeightField.from_heights(lower, 8.0, periodic=True)),
            ]
        )
        for lower in (heights, np.roll(heights, 4, axis=1))
    ]
    found = [surfaces.energy(each, "30 deg", photons=50_000) for each in (above, aside)]
    apart = abs(float(found[0].T - found[1].T))
    assert apart > 10.0 * float(np.hypot(found[0].T_se, found[1].T_se))
