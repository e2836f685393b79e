"""Light on every link of a path, in the order of travel; where its power comes from and goes."""

import numpy as np
import pytest

import optipath as op
from optipath.paths.energy import energy_along, lights_along
from random_paths import Draw
from tables import rows, slow

PRESETS = op.preset_names()
# Ways out and loops stand in the order of travel, too.
ORDER = {
    "npgr026": ("X2.transmitted", "X1.reflected -> E.in"),
    "ellipsometer-pcsa": ("S.transmitted", "A.out -> photometer.in"),
    "glass-slab": ("front.transmitted -> down.in", "up.out -> front.back"),
}


def numbers(powers):
    return {name: np.asarray(power).item() for name, power in powers.items()}


def total(*powers):
    return sum(sum(each.values()) for each in powers)


def assert_conserved(path, **values):
    found = energy_along(path, **values)
    spent = total(found.taken, found.left, found.ended)
    np.testing.assert_allclose(spent, total(found.given), rtol=1e-11, atol=1e-300)
    return found


@pytest.mark.parametrize("most", [2, slow(99)])
@rows("name", PRESETS)
def test_what_sources_give_is_taken_leaves_or_ends_in_every_case(name, most):
    for case in (None, *[*op.load_preset(name).cases][:most]):
        found = assert_conserved(op.load_preset(name, case=case))
        assert min(map(np.min, found.taken.values()), default=0.0) >= 0.0


@rows("seed", range(20))
def test_light_of_paths_by_chance_is_neither_made_nor_lost(seed):
    draw = Draw(seed)
    assert_conserved(draw.path(loops=seed % 2 == 0), **draw.values)


def test_powers_are_told_of_sources_loops_and_what_amplifies_but_not_of_rounding():
    found = energy_along(op.load_preset("malus"), angle="60 deg", intensity=8.0)
    assert numbers(found.given) == {"lamp": 8.0}
    assert numbers(found.taken) == pytest.approx({"polarizer": 4.0, "analyzer": 3.0})
    assert numbers(found.ended) == pytest.approx({"eye": 1.0})
    assert not found.left
    assert not found.notes
    found = assert_conserved(op.load_preset("malus"), intensity=0.0)
    assert total(found.taken, found.left, found.ended) == 0.0
    found = assert_conserved(op.load_preset("sky-and-window"))
    assert numbers(found.given) == {"heaven": 10.0, "lamp": 2.0}
    # Of an unpolarised lamp upright on glass, R = 0.04: 0.96 / (1 - R^2) goes down in all.
    found = assert_conserved(op.load_preset("glass-slab"), theta=0.0, n=1.5)
    inner = {link.name: link.power for link in found.links if link.in_loop}
    assert inner["front.transmitted -> down.in"] == pytest.approx(0.96 / (1 - 0.04**2))
    assert len(inner) == 4
    (note,) = found.notes
    assert note.startswith("light goes round")
    # A way there and back through one element is none.
    path = op.load_preset("double-pass-waveplate")
    assert not any(link.in_loop for link in energy_along(path).links)
    gain = op.MuellerElement(2.0 * np.eye(4), physical=False)
    found = assert_conserved(op.Source() >> gain.named("laser") >> op.Detector())
    assert found.taken["laser"] == pytest.approx(-1.0)
    assert found.notes == ("'laser' gives more light than it gets: it takes a negative power",)
    found = energy_along(op.load_preset("fresnel-rhomb"))
    assert (found.taken["first"], found.taken["second"]) == (0.0, 0.0)
    # What is left of crossed polarisers is no power.
    path = op.load_preset("senarmont")
    assert 0.0 < path.trace().intensity < 1e-15
    found = energy_along(path)
    assert (found.ended["eye"], found.links[-1].power) == (0.0, 0.0)
    path = op.Source() >> op.Attenuator(1e-30) >> op.Attenuator(0.5) >> op.Detector()
    assert energy_along(path).ended["detector"] == pytest.approx(5e-31)


def test_taps_take_nothing_however_far_their_light_goes():
    found = assert_conserved(op.load_preset("ellipsometer-pcsa"))
    ends = [link.end for link in found.links if link.tap], [*found.ended], [*found.left]
    assert ends == (["state"], ["photometer"], ["S.transmitted"])
    # It stands behind the link beside it.
    taps = [each for each in lights_along(op.load_preset("ellipsometer-pcsa")) if each.tap]
    assert [each.name for each in taps] == ["S.reflected -> state.in"]
    path = op.Source() >> op.Polarizer("0 deg") >> op.Detector()
    path.add("analyser", op.Polarizer("30 deg"))
    path.connect("polarizer.out", "analyser.in", tap=True)
    path["analyser"] >> path.add("split", op.BeamSplitter())
    path.connect("split.transmitted", path.add("probe", op.Detector()).name)
    found = assert_conserved(path)
    assert numbers(found.taken) == pytest.approx({"polarizer": 0.5})
    assert ([*found.ended], [*found.left]) == (["detector"], [])
    links = {"polarizer.out -> analyser.in", "analyser.out -> split.in", "split.reflected"}
    read = {link.name for link in found.links if link.tap}
    assert read == links | {"split.transmitted -> probe.in"}


def test_many_values_keep_their_shape():
    found = assert_conserved(op.load_preset("malus"), angle=np.radians([[0.0], [90.0]]))
    assert {power.shape for power in found.taken.values()} == {(2, 1)}
    lights = lights_along(op.load_preset("malus"), angle=np.linspace(0.0, 1.0, 5))
    assert lights[-1].light.shape == (5,)
    path = op.Source(op.Parameter("keep", 2.0)) >> op.Detector()
    assert [each.light.intensity for each in lights_along(path, keep=3.0)] == [3.0]


@rows("preset", PRESETS)
def test_all_light_on_the_way_stands_behind_what_leads_to_it_unless_light_goes_round(preset):
    path = op.load_preset(preset)
    met, found = set(), lights_along(path)
    for each in found:
        arrives = {end for _, end in path.graph.in_edges(each.start)}
        assert not arrives or each.start in met or path.compose().program.loops
        met.add(each.end)
    names = [each.name for each in found]
    assert {*names} == {*path.trace(keep="all")} - {*path.graph}
    if preset in ORDER:
        before, behind = ORDER[preset]
        assert names.index(before) < names.index(behind)
