"""Shares of energy, their errors, and runs that go on.

Statistical tests have fixed seeds, and would fail by chance once in a million of other seeds.
"""

import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import optipath as op
from optipath import surfaces
from optipath.surfaces import HeightField
from optipath.surfaces.energy_shares import Energy, EnergyRun, mean_and_error
from optipath.surfaces.walk.beam import TURN, beam_of
from rough_samples import fresnel
from tables import rows, slow

pytest.importorskip("numba")
GLASS = op.Sample([(1.5, 0.5)])
HEIGHTS = np.random.default_rng(1).normal(size=(8, 8))


@pytest.mark.parametrize("photons", [20_000, slow(100_000)])
def test_the_same_seed_gives_the_same_bits_by_any_number_of_threads_and_another_others(photons):
    first, *others = [
        surfaces.energy(GLASS, "50 deg", photons=photons, seed=7, threads=threads)
        for threads in (1, 2, 5)
    ]
    for name in ("R_s", "R_m", "T_s", "T_m", "R_se", "reflected", "transmitted_se"):
        assert all(np.array_equal(getattr(first, name), getattr(one, name)) for one in others), name
    assert surfaces.energy(GLASS, "50 deg", photons=photons, seed=8).R != first.R


def test_blocks_that_begin_at_the_same_time_have_the_bits_of_a_block_by_itself():
    sample = op.Sample([(1.5, 0.5), (0.5 + 2.1j, 0.3)], surfaces=1)
    alone = beam_of(sample, "60 deg").block(1, 64, keeps=True).ends
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        with ThreadPoolExecutor(8) as threads:
            for _ in range(50):
                block = beam_of(sample, "60 deg").block
                begun = [threads.submit(block, 1, 64, keeps=True) for _ in range(8)]
                assert all(np.array_equal(each.result().ends, alone) for each in begun)
    finally:
        sys.setswitchinterval(interval)


@pytest.mark.parametrize("photons", [10_000, slow(100_000)])
@rows(
    "layers, incidence",
    [
        ([(1.5, 0.5), (2.4, 0.3)], "60 deg"),
        ([(1.5, 0.7), (2.4, 0.7)], "70 deg"),  # Without a warning, too.
        ([(1j, 1.0)], 1.4),
        ([(0.5 + 2.1j, 0.3)], "40 deg"),
    ],
)
def test_all_light_goes_somewhere_after_some_number_of_events(layers, incidence, photons):
    found = surfaces.energy(op.Sample(layers, surfaces=4), incidence, photons=photons)
    assert found.reflected[0] == pytest.approx(float(found.R_s), rel=1e-14)
    sums = found.reflected[1:].sum(), found.transmitted.sum(), found.R_s + found.R_m
    np.testing.assert_allclose(sums, [found.R_m, found.T, found.R], rtol=1e-12)
    if np.imag(layers[-1][0]) == 0.0:
        total = found.scalar.R + found.scalar.T + found.scalar.lost
        assert abs(found.absorbed) < 6 * found.absorbed_se
    else:
        total = found.R + found.absorbed
        assert found.T == 0.0
    assert float(total) == pytest.approx(1.0, abs=1e-12)
    if layers[0][0] == 1j:
        assert float(found.R) == pytest.approx(1.0, abs=1e-12)
        assert found.stuck == found.sideways == 0


def test_wavelengths_ride_on_the_same_photons():
    gold = op.Sample([(op.Material.named("gold"), 0.3)])
    colours = [450e-9, 550e-9, 650e-9]
    found = surfaces.energy(gold, "40 deg", photons=20_000, wavelength=colours)
    assert found.R.shape == (3,)
    alone = [surfaces.energy(gold, "40 deg", photons=20_000, wavelength=each) for each in colours]
    assert np.allclose(found.R, [each.R for each in alone], rtol=1e-13)
    assert np.allclose(found.scalar.R_m, [each.scalar.R_m for each in alone], rtol=1e-13)


@pytest.mark.parametrize("photons", [100_000, slow(200_000)])
def test_s_polarised_light_is_reflected_by_fresnels_share_however_bright_it_is(photons):
    found, brighter = (
        surfaces.energy(op.Sample([(1.5, 0)]), 1.0, photons=photons, stokes=(size, size, 0.0, 0.0))
        for size in (1.0, 4.0)
    )
    assert float(found.R) == pytest.approx(fresnel(1.0, 1.5, 1.0)[0], abs=6 * float(found.R_se))
    assert (found.R, found.T_se) == (brighter.R, brighter.T_se)


@pytest.mark.parametrize(("tolerance", "least"), [(1e-3, 50_000), slow((5e-4, 100_000))])
def test_photons_are_walked_until_the_error_is_small_enough(tolerance, least):
    found = surfaces.energy(GLASS, "40 deg", tolerance=tolerance)
    assert found.R_se <= tolerance
    assert found.photons > least


def test_an_error_that_stays_larger_is_told_and_so_is_progress():
    with pytest.warns(
        op.errors.PhotonWarning, match="after 20000 photons, more than the tolerance"
    ):
        found = surfaces.energy(GLASS, "40 deg", photons=20_000, tolerance=1e-6)
    assert found.photons == 20_000
    assert np.isnan(surfaces.energy(GLASS, "40 deg", photons=1).R_se)
    with pytest.warns(
        op.errors.PhotonWarning, match="the standard error of R is nan after 1 photons"
    ):
        surfaces.energy(GLASS, "40 deg", photons=1, tolerance=0.01)
    told = []
    surfaces.energy(GLASS, "40 deg", photons=40_000, progress=lambda *how: told.append(how))
    assert told == [(16384, 40_000), (32768, 40_000), (40_000, 40_000)]


PEAK = HeightField(np.eye(3)[1] * np.eye(3), 1e-3)
MISSED = {"sample": op.Sample([(1.5, PEAK)]), "incidence": "89.9999 deg", "photons": 100}
COUNT = "must be a whole number of 1 or more, not 0"


@rows(
    "wrong, sentence",
    [
        *(({name: 0}, f"{name} {COUNT}") for name in ("photons", "threads", "most_events")),
        ({"seed": -1}, "seed must be a whole number of 0 or more, not -1"),
        ({"tolerance": 0.0}, "tolerance is 0.0; give a standard error within 0 .. 1"),
        ({"incidence": "90 deg"}, "incidence is 90 deg, along the sample"),
        *(({"incidence": each}, "within 0 deg .. 90 deg") for each in (2.0, -0.1)),
        ({"incidence": [0.1, 0.2]}, r"incidence has the shape \(2,\)"),
        ({"incidence": np.nan}, "incidence is nan"),
        ({"stokes": (0.0, 0.0, 0.0, 0.0)}, "give S0 > 0 and"),
        ({"sample": "glass"}, "sample is 'glass'; give an op.Sample"),
        ({"azimuth": "north"}, "azimuth"),
        (MISSED, "photons meet nothing of the sample"),
        ({"incidence": "95 deg", "photons": -1, "seed": "x", "tolerance": 2}, "4 faults"),
    ],
)
def test_what_cannot_be_is_told_and_all_of_it_at_once(wrong, sentence):
    with pytest.raises(op.errors.SurfaceError, match=sentence):
        surfaces.energy(**{"sample": GLASS, "incidence": "40 deg"} | wrong)


def test_many_photons_get_new_surfaces_so_that_the_error_goes_on_falling():
    sample = op.Sample([(1.5, 0.5)], surfaces=1)
    few, many = [surfaces.energy(sample, "40 deg", photons=TURN + more) for more in (0, 1)]
    assert (few.surfaces, many.surfaces) == (1, 2)
    assert sample.fields(1)[0] != sample.fields(0)[0]
    assert surfaces.energy(GLASS, "40 deg", photons=16 * 512).surfaces == 16, "spread over all"


def test_given_maps_of_one_size_stay_in_register():
    # A step of glass whose lower face has the same step, 4 to the side or above each other.
    heights = np.repeat([[0.0] * 4 + [4.0] * 4], 8, axis=0)
    upper, aside = (HeightField(np.roll(heights, by, axis=1), 8.0, periodic=True) for by in (0, 4))
    samples = (op.Sample([(1.5, upper), (1.0, under)]) for under in (upper, aside))
    one, other = (surfaces.energy(sample, "30 deg", photons=50_000) for sample in samples)
    assert abs(float(one.T - other.T)) > 10.0 * float(np.hypot(one.T_se, other.T_se))


def test_a_run_goes_on_where_it_was_and_what_is_done_stays_when_it_is_interrupted():
    run = EnergyRun(beam_of(GLASS, "40 deg"), threads=2)

    def interrupt(done, _):
        if done >= 3 * 16384:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run.walk(400_000, interrupt)
    assert run.photons == 3 * 16384
    assert run.energy.R == surfaces.energy(GLASS, "40 deg", photons=3 * 16384).R
    run.walk(60_000)
    whole = surfaces.energy(GLASS, "40 deg", photons=60_000)
    assert (run.photons, run.energy.R, run.energy.T_m_se) == (60_000, whole.R, whole.T_m_se)


def test_trapped_light_that_few_photons_carry_is_warned_of(monkeypatch):
    whole = Energy.of

    def of(beam, sums):
        # As if heavy photons had not been met.
        sums[:, 0, 2:, :, 1] *= 0.5
        return whole(beam, sums)

    monkeypatch.setattr(Energy, "of", of)
    with pytest.warns(op.errors.PhotonWarning, match="where nothing absorbs, off by"):
        found = surfaces.energy(op.Sample([(1.5, 0), (2.4, 0)]), "60 deg", photons=50_000)
    assert np.isclose(float(found.scalar.R + found.scalar.T), 1.0)


def sums(values):
    """The sums that a walk would give of values by surface."""
    found = [(float(len(each)), np.sum(each), np.sum(np.square(each))) for each in values]
    return tuple(np.transpose(found))


def test_the_error_is_that_of_the_mean_of_one_surface_or_of_the_means_of_several():
    values = np.random.default_rng(0).random(1000)
    mean, error = mean_and_error(*sums([values]))
    assert float(mean) == pytest.approx(values.mean(), rel=1e-12)
    assert float(error) == pytest.approx(values.std(ddof=1) / np.sqrt(1000), rel=1e-9)
    assert mean_and_error(*sums([values, np.zeros(0)])) == (mean, error), "of none, nothing"
    rng = np.random.default_rng(1)
    values = [level + 0.1 * rng.standard_normal(5000) for level in (0.0, 1.0, 2.0, 3.0)]
    _, error = mean_and_error(*sums(values))
    assert float(error) == pytest.approx(np.std(np.mean(values, axis=1), ddof=1) / 2.0, rel=1e-9)
    # Errors cover the truth as often as they say: of Student's t of 7 degrees of freedom, 500
    # times, the variance is 1.4 at most.
    rng, off = np.random.default_rng(3), []
    for level in 0.02 * rng.standard_normal((500, 8, 1)):
        mean, error = mean_and_error(*sums(level + rng.standard_normal((8, 200))))
        off.append(float(mean / error))
    assert 0.8 < np.var(off) < 1.9


@rows("layers", [[(1.5, 0), (2.4, 0)], [(1.5, HeightField(HEIGHTS, 8.0, periodic=True))]])
def test_results_of_other_seeds_differ_by_their_errors(layers):
    given = {"photons": 2000, "threads": 1}
    shares = [
        surfaces.energy(op.Sample(layers), "60 deg", seed=seed, **given) for seed in range(50)
    ]
    for part in ("", "scalar", "difference"):
        found = [getattr(each, part, each) for each in shares]
        values, errors = np.array([(each.R, each.R_se) for each in found], float).T
        # Chi-square of 49 degrees of freedom, but for once in a million, either way.
        assert 14.0 < np.sum((values - values.mean()) ** 2) / np.mean(errors**2) < 114.0, part


@pytest.mark.filterwarnings("ignore::optipath.errors.MeshWarning")
def test_random_surfaces_differ_by_no_more_than_the_error():
    samples = [op.Sample([(1.5, 1.0)], cells=64, surfaces=4, seed=seed) for seed in range(8)]
    shares = [
        surfaces.energy(sample, "60 deg", photons=4 * 16384, seed=sample.seed) for sample in samples
    ]
    values, errors = np.array([(each.R_m, each.R_m_se) for each in shares], float).T
    # F of 7 and 24 degrees of freedom is less, but for once in a million.
    assert values.var(ddof=1) < 14.0 * np.mean(errors**2)
