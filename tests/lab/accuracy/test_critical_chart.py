import json

import numpy as np
import pytest

import optipath as op
from optipath.cli.chart_options import NEAR
from optipath.lab.accuracy import critical_chart as module
from optipath.lab.accuracy.chart_file import chart_text, read_chart
from optipath.lab.accuracy.critical_chart import critical_chart
from optipath.lab.accuracy.critical_places import PLACES
from optipath.lab.accuracy.interface_errors import interface_errors


def test_the_command_line_has_the_places_of_the_lab():
    assert tuple(PLACES) == NEAR


@pytest.mark.parametrize("distance", [1e-1, 1e-6])
@pytest.mark.parametrize("name", PLACES)
def test_samples_stand_at_the_distance_from_their_angle(name, distance):
    samples = PLACES[name].region(distance).samples(8)
    # cos of the refracted angle is 0 there, the reflection of p, or the angle itself.
    angle = {
        "brewster": np.arctan(samples.n),
        "critical": np.arcsin(np.minimum(samples.n, 1.0)),
        "grazing": np.pi / 2,
        "normal": 0.0,
    }[name]
    assert np.abs(samples.incidence - angle) == pytest.approx(np.full(8, distance), rel=1e-6)


def test_media_are_the_same_at_every_distance():
    far, near = (PLACES["grazing"].region(distance).samples(4) for distance in (1e-1, 1e-9))
    assert far.n.tolist() == near.n.tolist()


def test_amplitudes_lose_a_digit_a_decade_near_the_normal_and_stable_none():
    errors = [
        interface_errors("amplitude", PLACES["normal"].region(distance), count=8)
        for distance in (1e-2, 1e-4, 1e-6)
    ]
    worst = [float(off.componentwise[:, 1].max()) for off in errors]
    # B follows the square of the angle, and the amplitudes keep their absolute error.
    assert 1e2 < worst[1] / worst[0] < 1e6
    assert 1e2 < worst[2] / worst[1] < 1e6
    stable = interface_errors("stable", PLACES["normal"].region(1e-6), count=8)
    assert stable.componentwise.max() <= 20


@pytest.fixture
def _few(monkeypatch):
    monkeypatch.setattr(module, "DISTANCES", (1e-8, 1e-2))


@pytest.mark.usefixtures("_few")
def test_a_path_and_an_interface_have_all_methods_at_all_distances():
    path = op.load_preset("npgr026", case="8")
    for measured in (path, None):
        kept = []
        found = critical_chart(measured, "x", ["normal", "grazing"], 2, keep=kept.append)
        assert [place["name"] for place in found["places"]] == ["normal", "grazing"]
        for place in found["places"]:
            assert place["distances"] == [1e-2, 1e-8]
            assert set(place["errors"]) == {"stable", "compensated", "amplitude", "textbook"}
            assert max(place["errors"]["stable"]["componentwise"]) <= 100
        assert kept[-1]["regions"] == {"measured": 4, "of": 4}
        assert json.loads(chart_text(read_chart(chart_text(found), "x"))) == json.loads(
            chart_text(found)
        )


@pytest.mark.usefixtures("_few")
def test_what_is_measured_so_far_can_be_read():
    kept = []
    critical_chart(None, "x", ["critical"], 1, keep=lambda found: kept.append(chart_text(found)))
    first = read_chart(kept[0], "x.json")
    assert first["places"][0]["distances"] == [1e-2]
    assert first["regions"] == {"measured": 1, "of": 2}


def test_unknown_places_and_paths_without_interfaces_are_refused():
    with pytest.raises(op.OptipathError, match="place 'nirmal' is unknown; did you mean 'normal'"):
        critical_chart(None, "x", ["nirmal"])
    with pytest.raises(op.OptipathError, match="'malus' has no interface"):
        critical_chart(op.load_preset("malus"), "malus", ["normal"])
