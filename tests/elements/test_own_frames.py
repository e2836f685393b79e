"""Elements of one's own that stand in space by their own values, as vertices of a chain do."""

from typing import ClassVar

import numpy as np
import pytest

import optipath as op
from tables import rows

CHAIN = ((0, 0, 0), (0, 0, 3), (0, 2, 4), (1, 3, 5), (2, 0, 0))


class Foil(op.Element):
    """Reflects as glass does, at the second vertex of the chain."""

    outputs: ClassVar[tuple[str, ...]] = ("reflected",)
    natural: ClassVar[str] = "reflected"
    straight: ClassVar[bool] = False
    self_placed: ClassVar[bool] = True
    like: ClassVar[op.Element] = op.SpecularVertex(1.5, CHAIN, 2)
    vertices, place = like.vertices, like.place

    def couplings(self):
        return self.like.couplings()

    def own_frame(self, port):
        return self.like.own_frame(port)

    def turn_from(self, before):
        return self.like.turn_from(before)

    def fault_behind(self, before):
        return "" if getattr(before, "place", 0) == 1 else "must come from the first vertex"


class Mute(op.Element):
    """Has a frame, and does not say how it stands to others."""

    outputs: ClassVar[tuple[str, ...]] = ("reflected",)
    natural: ClassVar[str] = "reflected"
    straight: ClassVar[bool] = False
    self_placed: ClassVar[bool] = True

    def couplings(self):
        return Foil.like.couplings()

    def own_frame(self, port):
        return Foil.like.own_frame(port)


def path(*elements):
    """Light along elements, with a turned polariser behind them."""
    path = op.PathGraph()
    node = path.add("lamp", op.Source())
    for place, element in enumerate(elements):
        node = node >> path.add(f"e{place}", element)
    node >> path.add("foil", op.Polarizer(0.3, azimuth=0.2)) >> path.add("eye", op.Detector())
    return path


FIRST, SECOND, THIRD = (op.SpecularVertex(1.5, CHAIN, place) for place in (1, 2, 3))


@rows("model", ["auto", "full"])
def test_an_element_of_ones_own_is_placed_among_vertices_as_a_vertex_is(model):
    composer = op.Composer(model=model)
    wanted = composer.compose(path(FIRST, SECOND, THIRD)).run()
    found = composer.compose(path(FIRST, Foil(), THIRD)).run()
    np.testing.assert_array_equal(found.stokes, wanted.stokes)
    for axis in "xyz":
        np.testing.assert_array_equal(getattr(found.frame, axis), getattr(wanted.frame, axis))


def test_light_before_and_behind_it_is_in_its_frames():
    lights = path(Foil()).trace(keep="all")
    for link, port in (("lamp.out -> e0.in", "in"), ("e0.reflected -> foil.in", "reflected")):
        np.testing.assert_array_equal(lights[link].frame.z, Foil().own_frame(port).frame({}).z)


def test_it_says_what_light_must_not_come_from():
    with pytest.raises(op.PathError, match=r"'e0.reflected -> e1.in' must come from the first ver"):
        path(THIRD, Foil()).check()


def test_one_that_does_not_say_how_light_is_turned_is_refused():
    with pytest.raises(op.PathError, match=r"Mute does not say .* give it a method turn_from"):
        path(FIRST, Mute()).compose()


def test_elements_between_two_such_elements_are_refused():
    with pytest.raises(op.PathError, match="'e1' stands relatively between the vertices 'e0' and"):
        path(FIRST, op.Rotator(0.1), Foil()).check()
