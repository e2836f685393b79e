"""Values of any kind, given to paths, to elements and to functions."""

from itertools import pairwise

from tests.fuzz.attack import Attack, check_light
from tests.fuzz.odd_values import given, taken

import optipath as op
from optipath.elements.registry import KINDS

_ELEMENTS = sorted(
    {made for made in KINDS.values() if made.__module__.startswith("optipath.")},
    key=lambda made: made.__name__,
)
_LEFT_OUT = ("RefractingVertex", "SpecularVertex", "Vertex")  # stand in chains alone


def make(rng):
    """Make values for a preset or an element."""
    return rng.choice([_of_a_preset, _of_an_element])(rng)


def _of_a_preset(rng):
    name = rng.choice(op.preset_names())
    path = op.load_preset(name)
    texts, values = given(rng, [p for p in path.parameters if rng.random() < 0.5])
    shown, run = rng.choice(
        [
            ("bind({}).trace_all()", lambda: path.bind(**values).trace_all()),
            ("compose().run_all({})", lambda: path.compose().run_all(**values)),
            ("trace(keep='all', {})", lambda: path.trace(keep="all", **values)),
        ]
    )

    def act():
        for light in run().values():
            check_light(light)

    return Attack(f"op.load_preset({name!r}).{shown.format(texts)}", act)


def _of_an_element(rng):
    made = rng.choice([made for made in _ELEMENTS if made.__name__ not in _LEFT_OUT])
    texts, values = given(rng, taken(rng, made, 0.7))

    def act():
        element = made(**values)
        inside = [] if isinstance(element, (op.Source, op.Detector, op.Dump)) else [element]
        lamp = element if isinstance(element, op.Source) else op.Source(stokes=[1.0, 0.3, 0.4, 0.5])
        eye = element if isinstance(element, op.Detector) else op.Detector()
        path = op.PathGraph()
        nodes = [path.add(str(n), e) for n, e in enumerate([lamp, *inside, eye])]
        for one, other in pairwise(nodes):
            _ = one >> other
        light = path.trace()
        if "response" in values or isinstance(element, op.Source):
            return  # Which may say what is read in any unit.
        if element.physical is True:
            check_light(light, emitted=1.0 + 1e-5)

    return Attack(f"op.{made.__name__}({texts})", act)
