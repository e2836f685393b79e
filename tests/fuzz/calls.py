"""Calls of what is public, with arguments that are nearly right or not right at all."""

import inspect

import numpy as np
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
    *("'516 nm'", "'2.4 eV'", "5e-7", "[4e-7, 5e-7, 6e-7]", "['400 nm', '500 nm']", "'nm'"),
    *("'gold'", "'D65'", "'linear'", "'nearest'", "'deg/mm'", "[1.0, 0.5, 0.2]"),
    *("op.Wavelength()", "op.Spectrum.black_body(3000.0)", "op.Material.cauchy([1.5, 0.004])"),
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
    for made in (op.Material, op.Spectrum, op.Crystal, op.Waveplate):
        for name, member in vars(made).items():
            if name[0] != "_" and isinstance(member, classmethod):
                found[f"op.{made.__name__}.{name}"] = getattr(made, name)
    spectrum = op.Spectrum.histogram([4e-7, 5e-7, 6e-7], [1.0, 2.0])
    glass = op.Material.cauchy([1.5, 0.004])
    spectral = _spectral_light()
    methods = [glass.at, spectrum.at, spectrum.power, spectrum.rebin, spectrum.resample]
    methods += [spectral.integrate, spectral.at_wavelengths, spectral.to_xyz, spectral.to_srgb]
    found |= {f"the {method.__qualname__}": method for method in methods}
    plate = op.Retarder(1.0, op.Parameter("angle"))
    found |= {"plate.port_back": plate.port_back, "there_and_back": _there_and_back}
    return found | {"path.propagate of values": _propagated}


def _spectral_light():
    path = op.PathGraph()
    path.add("lamp", op.Source(spectrum=op.Spectrum.black_body(3000.0)))
    path.add("eye", op.Detector())
    path.connect("lamp", "eye")
    return path.trace(wavelength=np.linspace(4e-7, 7e-7, 5))


def _propagated(delta, sigma, method="differences", samples=None, seed=None, correlation=None):
    pair = delta, sigma
    options = {"samples": samples, "seed": seed, "correlation": correlation}
    return op.load_preset("npgr026").propagate(delta=pair, n1=(1.5, 0.1), method=method, **options)


def _there_and_back(first, last):
    return op.there_and_back(first, last)
