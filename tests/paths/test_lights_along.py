import numpy as np
import pytest

import optipath as op
from optipath.paths.lights_along import lights_along


def names(preset):
    return [each.name for each in lights_along(op.load_preset(preset))]


@pytest.mark.parametrize(
    ("preset", "before", "behind"),
    [
        ("npgr026", "X2.transmitted", "X1.reflected -> E.in"),
        ("sky-and-window", "tilt.out -> pane.in", "pane.reflected -> polarizer.in"),
        ("glass-slab", "front.transmitted -> down.in", "up.out -> front.back"),
        ("ellipsometer-pcsa", "S.transmitted", "A.out -> photometer.in"),
        (
            "faraday-isolator",
            "mirror.reflected -> analyzer-back.in",
            "polarizer-back.out -> returned.in",
        ),
    ],
)
def test_light_stands_in_the_order_of_travel(preset, before, behind):
    found = names(preset)
    assert found.index(before) < found.index(behind)


@pytest.mark.parametrize("preset", op.preset_names())
def test_no_link_stands_before_one_that_leads_to_it_unless_light_goes_round(preset):
    path = op.load_preset(preset)
    if path.compose().program.loops:
        pytest.skip("light goes round")
    met = set()
    for each in lights_along(path):
        arrives = {end for _, end in path.graph.in_edges(each.start)}
        assert not arrives or each.start in met
        met.add(each.end)


@pytest.mark.parametrize("preset", op.preset_names())
def test_there_is_all_light_that_is_kept_on_the_way(preset):
    path = op.load_preset(preset)
    kept = path.trace(keep="all")
    assert {*names(preset)} == {*kept} - {*path.graph}


def test_a_tap_stands_behind_the_link_beside_it():
    taps = [each for each in lights_along(op.load_preset("ellipsometer-pcsa")) if each.tap]
    assert [each.name for each in taps] == ["S.reflected -> state.in"]


def test_a_parameter_may_be_called_keep():
    path = op.Source(op.Parameter("keep", 2.0)) >> op.Detector()
    assert [each.light.intensity for each in lights_along(path, keep=3.0)] == [3.0]


def test_batches_are_kept():
    found = lights_along(op.load_preset("malus"), angle=np.linspace(0.0, 1.0, 5))
    assert found[-1].light.shape == (5,)
