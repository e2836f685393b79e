"""Where the power of the light of a path comes from and goes."""

import json

import numpy as np
import pytest

import optipath as op
from optipath.paths.energy_along import energy_along
from random_paths import Draw


def total(*powers):
    return sum(sum(each.values()) for each in powers)


def assert_conserved(path, **values):
    found = energy_along(path, **values)
    spent = total(found.taken, found.left, found.ended)
    np.testing.assert_allclose(spent, total(found.given), rtol=1e-11, atol=1e-300)
    return found


@pytest.mark.parametrize("name", op.preset_names())
def test_what_sources_give_is_taken_leaves_or_ends_in_every_case(name):
    path = op.load_preset(name)
    for case in (None, *path.cases):
        found = assert_conserved(op.load_preset(name, case=case))
        assert min(map(np.min, found.taken.values()), default=0.0) >= 0.0


@pytest.mark.parametrize("seed", range(20))
def test_light_of_paths_by_chance_is_neither_made_nor_lost(seed):
    draw = Draw(seed)
    path = draw.path(loops=seed % 2 == 0)
    assert_conserved(path, **draw.values)


def test_a_polariser_takes_half_of_light_without_polarisation():
    found = energy_along(op.load_preset("malus"), angle="60 deg", intensity=8.0)
    assert {name: float(p) for name, p in found.given.items()} == {"lamp": 8.0}
    assert {name: p.item() for name, p in found.taken.items()} == pytest.approx(
        {"polarizer": 4.0, "analyzer": 3.0}
    )
    assert found.ended["eye"] == pytest.approx(1.0)
    assert not found.left
    assert not found.notes


def test_a_tap_takes_nothing_and_what_it_reads_does_not_end():
    found = assert_conserved(op.load_preset("ellipsometer-pcsa"))
    assert [link.end for link in found.links if link.tap] == ["state"]
    assert [*found.ended] == ["photometer"]
    assert [*found.left] == ["S.transmitted"]


def test_light_behind_a_tap_is_read_however_far_it_goes():
    path = op.Source() >> op.Polarizer("0 deg") >> op.Detector()
    path.add("analyser", op.Polarizer("30 deg"))
    path.add("split", op.BeamSplitter())
    path.add("probe", op.Detector())
    path.connect("polarizer.out", "analyser.in", tap=True)
    path.connect("analyser.out", "split.in")
    path.connect("split.transmitted", "probe.in")
    found = assert_conserved(path)
    assert {name: p.item() for name, p in found.taken.items()} == pytest.approx({"polarizer": 0.5})
    assert [*found.ended] == ["detector"]
    assert not found.left
    read = {link.name for link in found.links if link.tap}
    assert read == {
        "polarizer.out -> analyser.in",
        "analyser.out -> split.in",
        "split.transmitted -> probe.in",
        "split.reflected",
    }


def test_light_of_several_sources_is_told_apart():
    found = assert_conserved(op.load_preset("sky-and-window"))
    assert {name: float(p) for name, p in found.given.items()} == {"heaven": 10.0, "lamp": 2.0}


def test_a_loop_is_told_and_its_links_have_all_rounds_together():
    # Of an unpolarised lamp upright on glass, R = 0.04: 0.96 / (1 - R^2) goes down in all.
    found = assert_conserved(op.load_preset("glass-slab"), theta=0.0, n=1.5)
    inner = {link.name: link.power for link in found.links if link.in_loop}
    assert inner["front.transmitted -> down.in"] == pytest.approx(0.96 / (1 - 0.04**2))
    assert len(inner) == 4
    assert len(found.notes) == 1
    assert found.notes[0].startswith("light goes round")


def test_a_way_there_and_back_through_one_element_is_no_loop():
    path = op.load_preset("double-pass-waveplate")
    assert not any(link.in_loop for link in energy_along(path).links)


def test_what_amplifies_takes_a_negative_power_and_is_told():
    gain = op.MuellerElement(2.0 * np.eye(4), physical=False)
    found = assert_conserved(op.Source() >> gain.named("laser") >> op.Detector())
    assert found.taken["laser"] == pytest.approx(-1.0)
    assert found.notes == ("'laser' gives more light than it gets: it takes a negative power",)


def test_rounding_is_not_taken_for_light():
    found = energy_along(op.load_preset("fresnel-rhomb"))
    assert found.taken["first"] == 0.0
    assert found.taken["second"] == 0.0


def test_what_is_left_of_crossed_polarisers_is_no_power():
    path = op.load_preset("senarmont")
    assert 0.0 < path.trace().intensity < 1e-15
    found = energy_along(path)
    assert found.ended["eye"] == 0.0
    assert found.links[-1].power == 0.0


def test_light_that_is_faint_since_it_was_dimmed_keeps_its_power():
    path = op.Source() >> op.Attenuator(1e-30) >> op.Attenuator(0.5) >> op.Detector()
    assert energy_along(path).ended["detector"] == pytest.approx(5e-31)


def test_many_values_give_powers_of_their_shape():
    found = assert_conserved(op.load_preset("malus"), angle=np.radians([[0.0], [90.0]]))
    assert {power.shape for power in found.taken.values()} == {(2, 1)}


def test_light_of_no_power_is_spent_on_nothing():
    found = assert_conserved(op.load_preset("malus"), intensity=0.0)
    assert total(found.taken, found.left, found.ended) == 0.0


def test_all_of_it_is_written_as_json():
    written = energy_along(op.load_preset("glass-slab")).as_json()
    read = json.loads(json.dumps(written))
    assert read == written
    assert read["links"][0]["name"] == "lamp.out -> front.in"
    assert read["ended"].keys() == {"reflected", "transmitted"}


def test_a_power_that_is_not_a_number_is_null():
    path = op.path_from_vertices([[0, -1, 1], [0, 0, 0], [0, 9, 1]], [1.5], events="T", bad="mask")
    written = json.dumps(energy_along(path).as_json(), allow_nan=False)
    assert None in [link["power"] for link in json.loads(written)["links"]]
