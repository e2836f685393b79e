"""Calls of what is public, with arguments that are nearly right or not right at all."""

import inspect

from tests.fuzz.attack import Attack
from tests.fuzz.odd_values import a_value, given, taken

import optipath as op

_PLAUSIBLE = [
    *(
        "'npgr026'",
        "'7'",
        "'stable'",
        "'numpy'",
        "'float32'",
        "'sp'",
        "'sum'",
        "'all'",
        "'intensity'",
    ),
    *("'E'", "'L'", "'X1'", "'X1.reflected'", "'X1.transmitted'", "'E.in'", "'X1.incident'"),
    *(
        "op.load_preset('malus')",
        "op.Polarizer(0.3)",
        "op.Mirror()",
        "op.Detector()",
        "op.Frame([1, 0, 0], [0, 1, 0])",
    ),
    *(
        "op.Parameter('delta')",
        "[1.0, 0.5, 0.0, 0.0]",
        "np.eye(4)",
        "np.eye(3)",
        "{'delta': 0.3}",
        "3",
    ),
]


_CLASSES = [op.Case, op.Composer, op.CosSin, op.Frame, op.Light, op.Material, op.Mueller]
_CLASSES += [op.Parameter, op.PathGraph, op.Source, op.VerticesByAngles]


def make(rng):
    """Make one call."""
    name = rng.choice(sorted(_made()))
    function = _made()[name]
    text, values = given(rng, taken(rng, function, 0.4), _an_argument)
    alone = [p.name for p in inspect.signature(function).parameters.values() if p.kind == 0]
    places = [values.pop(place) for place in alone if place in values]
    return Attack(f"{name}({text})", lambda: _called(function, places, values))


def _an_argument(rng):
    return rng.choice(_PLAUSIBLE) if rng.random() < 0.5 else a_value(rng)


def _called(function, places, values):
    found = function(*places, **values)
    if hasattr(found, "__next__"):
        next(found, None)
    repr(found)


def _made():
    """Return what can be called, on objects of its own, since some calls alter them."""
    path, matrix = op.load_preset("npgr026"), op.Polarizer(0.3).mueller()
    light, plan = path.trace(), path.compose()
    functions = [getattr(op, name) for name in op.__all__]
    found = {
        f"op.{function.__name__}": function
        for function in functions
        if inspect.isfunction(function) or function in _CLASSES
    }
    for label, thing in {"path": path, "plan": plan, "light": light, "matrix": matrix}.items():
        for name in dir(type(thing)):
            if name[0] != "_" and name != "of" and callable(getattr(type(thing), name)):
                found[f"{label}.{name}"] = getattr(thing, name)
    plate = op.Retarder(1.0, op.Parameter("angle"))
    return found | {"plate.port_back": plate.port_back, "there_and_back": _there_and_back}


def _there_and_back(first, last):
    return op.there_and_back(first, last)
