"""What the text of M. Wang et al., Optics Express 25(19), 2017, says of its simulations in words.

Each is tested with its noise: by how much polarisation changes the light that goes to the grazing
side of the forward lobe, where the maps of the paper have their largest values.
"""

from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest

import optipath as op
from optipath.surfaces.reproduction import model_excess, model_of, model_off
from tables import rows, slow, slow_except

LIGHT = "420 nm", "540 nm", "660 nm"
SENSOR = op.surfaces.Sensor(32)
FORWARD = (np.degrees(SENSOR.theta) > 60.0) & (np.abs(np.degrees(SENSOR.phi)) < 20.0)


@pytest.fixture(autouse=True)
def _photons_can_walk():
    pytest.importorskip("numba")
    pytest.importorskip("xarray")


def sample_of(number):
    return op.load_sample(f"wang-2017-simulation-{number:02}")


@lru_cache(maxsize=8)
def hemisphere(number, incidence="60 deg", photons=40_000, metal=None):
    """A simulation, or the same on the metal of another one, on few surfaces."""
    sample = sample_of(number)
    if metal is not None:
        roughness = [layer.roughness for layer in sample.layers]
        layers = [(1.5, roughness[0]), (sample_of(metal).layers[-1].index, roughness[1])]
        sample = op.Sample(layers)
    wavelengths = LIGHT if isinstance(sample.layers[-1].index, op.Material) else None
    return op.measure(replace(sample, surfaces=4), incidence, photons, wavelengths, SENSOR)


def forward_change(seen):
    """(S0 - U) / U of what goes to the grazing side of the lobe, by wavelength, and its error."""

    def change(light):
        scalar = seen.intensities(light)[0][FORWARD].sum(axis=0)
        return seen.matrices(light)[0, ..., 0, 0][FORWARD].sum(axis=0) / scalar - 1.0

    return seen.own.estimate(change)


FAR = "80 deg", 400_000


@pytest.mark.parametrize(
    ("smaller", "larger"),
    [
        *(((2,), (1,)), *map(slow, [((8,), (7,)), ((9,), (7,)), ((15,), (16,))])),
        # Of aluminium, 11, instead of gold, 7, under a varnish, too; and instead of copper, 10.
        *map(slow, [((11,), (7,)), ((12, *FAR), (11, *FAR)), ((11,), (7, "60 deg", 40_000, 10))]),
    ],
)
def test_the_rougher_a_sample_is_the_smaller_is_what_polarisation_changes(smaller, larger):
    # The mean of |S0 - U| / U over wavelengths, and no less than its error.
    changes = [forward_change(hemisphere(*each)) for each in (smaller, larger)]
    small, large = (np.abs(value).mean() for value, _ in changes)
    errors = [np.sqrt(np.mean(error**2)) for _, error in changes]
    assert large - small > 4.0 * np.hypot(*errors)


@pytest.mark.parametrize("number", slow_except([7], [7, 10, 13, 14]))
def test_what_polarisation_changes_depends_on_the_wavelength(number):
    value, error = forward_change(hemisphere(number))
    blue, _, red = value
    assert abs(blue - red) > 8.0 * np.hypot(error[0], error[2])


@rows("number", [1, 7])
def test_without_polarisation_the_forward_edge_is_brighter(number):
    # Of gold in the blue, where it reflects as a glass of a high index does.
    value, error = forward_change(hemisphere(number))
    assert value[0] < -5.0 * error[0]
    if number == 1:  # And the lobe reaches farther there.
        value, error = hemisphere(1).own.estimate(farther)
        assert value > 5.0 * error


def farther(light):
    """How much farther from the normal what goes there is without polarisation."""
    seen, theta = hemisphere(1), SENSOR.theta[FORWARD]
    scalar = seen.intensities(light)[0, ..., 0][FORWARD]
    polarised = seen.matrices(light)[0, ..., 0, 0, 0][FORWARD]
    return np.asarray(np.average(theta, weights=scalar) - np.average(theta, weights=polarised))


def coplanar(n, m, incidence, exit_angle):
    """|S0 - U| / U of light refracted in, reflected by a facet that bisects, and refracted out."""

    def through(theta):
        refracted = np.arcsin(np.sin(theta) / n)
        return 1.0 - shares(np.cos(theta), n * np.cos(refracted), n), refracted

    def shares(cos, other, ratio):
        r = (cos - other) / (cos + other), (ratio**2 * cos - other) / (ratio**2 * cos + other)
        return np.abs(r) ** 2

    into, arriving = through(incidence)
    out, leaving = through(exit_angle)
    half = 0.5 * (arriving + leaving)
    reflected = shares(np.cos(half), np.sqrt((m / n) ** 2 - np.sin(half) ** 2 + 0j), m / n)
    each = into * reflected * out
    return 1.0 - each.mean() / (into.mean() * reflected.mean() * out.mean())


@pytest.mark.parametrize(
    ("angle", "known"), slow_except([(60, 18.0)], [(50, 14.6), (56, 16.5), (60, 18.0), (65, 19.9)])
)
def test_light_reflected_by_the_base_is_changed_as_by_smooth_faces(angle, known):
    # To within what faces of alpha 0.1 tilt it.
    exact = 100.0 * coplanar(1.5, 2.4, np.radians(angle), np.radians(80.0))
    assert exact == pytest.approx(known, abs=0.05)
    few = replace(sample_of(1), surfaces=4)
    seen = op.measure(few, f"{angle} deg", 50_000, sensor=45, events=3)
    theta, azimuth = np.degrees(seen.sensor.theta), np.abs(np.degrees(seen.sensor.phi))
    there = (theta > 77.0) & (theta < 83.0) & (azimuth < 10.0)

    def change(light):
        scalar = seen.intensities(light)[0, ..., 0][there].sum()
        return np.asarray(1.0 - seen.matrices(light)[0, ..., 0, 0, 0][there].sum() / scalar)

    value, error = seen.own.estimate(change)
    assert abs(100.0 * value - exact) < 0.8 + 400.0 * error
    assert error < 0.006


@pytest.mark.parametrize("number", [5, slow(6)])
def test_one_interface_has_none_at_10_deg_and_at_most_two_per_cent_elsewhere(number):
    value, error = forward_change(hemisphere(number, "10 deg"))
    assert np.all(np.abs(value) < 5.0 * error + 5e-4)
    largest = 0.0
    for incidence in ("40 deg", "60 deg", "80 deg"):
        value, error = forward_change(hemisphere(number, incidence))
        assert np.all(np.abs(value) < 0.02 + 3.0 * error)
        largest = max(largest, np.max(np.abs(value) - 3.0 * error))
    assert largest > 0.005


@rows("k", [0.45, 0.55, 0.65, 0.8, 1.0, 2.0, 4.0])
def test_a_base_of_n_over_k_2_polarises_by_80_per_cent_only_for_k_above_06_and_above_2_more(k):
    # By how much a base of n / k polarises where it does so most.
    theta, ratio = np.radians(np.linspace(0.5, 89.5, 179)), np.array([0.5, 1.0, 2.0, 3.0, 6.0])
    metals = op.Interface(ratio[:, np.newaxis] * k + 1j * k, theta).mueller("in", "reflected")
    most = metals.polarizance.max(axis=1)
    assert (most[2] > 0.8) == (k > 0.6)
    if k in (0.65, 1.0, 2.0, 4.0):
        assert np.all(np.diff(most) > 0.0)
        assert (most > 0.8).tolist() == [False, False, True, True, True]


SILVER = op.load_sample("wang-2017-figure-4")


@pytest.fixture(scope="module")
def silver():
    given = replace(SILVER, surfaces=4, cells=400), "40 deg", 200_000
    return {events: op.measure(*given, sensor=32, events=events) for events in (None, 1)}


@pytest.mark.slow
def test_the_model_reflects_the_light_of_one_event_and_slightly_less_than_all_without_s3(silver):
    value, error = model_excess(silver[1], 0)
    # Smith takes heights and slopes for independent; near grazing they are not.
    assert abs(value) < 5.0 * error + 5e-3
    for component in range(3):
        value, error = model_excess(silver[None], component)
        assert -0.1 < value < -3.0 * error
    # S3 of single scattering is exactly 0, and that of all light is not.
    assert not model_of(silver[1])[..., 3].any()
    once, several = (np.abs(silver[each].mueller[0][..., 3, 0]) for each in (1, None))
    assert once.max() < 1e-18
    assert several.max() > 1e-6


@pytest.mark.slow
def test_the_model_is_that_of_photons_after_one_event_beyond_30_deg_from_grazing():
    # Many surfaces: by how much they differ is most of the error.
    sample = replace(SILVER, surfaces=64)
    off, error = model_off(op.measure(sample, "40 deg", 16_000_000, sensor=64, events=1))
    assert off < 2e-3 + 2.0 * error < 0.011
