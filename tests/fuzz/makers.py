"""What nobody means to give: values, arguments and command lines; and every way to compose."""

import contextlib
import inspect
import io
from itertools import pairwise

import numpy as np
from tests.fuzz.attack import Attack, check_light
from tests.fuzz.odd_values import TEXTS, a_number, a_value, given, parted, taken
from tests.random_paths import Draw

import optipath as op
from optipath.cli import main
from optipath.elements.coupling import KINDS

_ELEMENTS = sorted(
    {made for made in KINDS.values() if made.__module__.startswith("optipath.")},
    key=lambda made: made.__name__,
)
_LEFT_OUT = ("RefractingVertex", "SpecularVertex", "Vertex")  # stand in chains alone


def values(rng):
    """Make values for a preset or an element."""
    return rng.choice([_of_a_preset, _of_an_element])(rng)


def _of_a_preset(rng):
    name = rng.choice(op.preset_names())
    path = op.load_preset(name)
    texts, named = given(rng, [p for p in path.parameters if rng.random() < 0.5])
    shown, run = rng.choice(
        [
            ("bind({}).trace_all()", lambda: path.bind(**named).trace_all()),
            ("compose().run_all({})", lambda: path.compose().run_all(**named)),
            ("trace(keep='all', {})", lambda: path.trace(keep="all", **named)),
        ]
    )

    def act():
        for light in run().values():
            check_light(light)

    return Attack(f"op.load_preset({name!r}).{shown.format(texts)}", act)


def _of_an_element(rng):
    made = rng.choice([made for made in _ELEMENTS if made.__name__ not in _LEFT_OUT])
    texts, named = given(rng, taken(rng, made, 0.7))

    def act():
        element = made(**named)
        inside = [] if isinstance(element, (op.Source, op.Detector, op.Dump)) else [element]
        lamp = element if isinstance(element, op.Source) else op.Source(stokes=[1.0, 0.3, 0.4, 0.5])
        eye = element if isinstance(element, op.Detector) else op.Detector()
        path = op.PathGraph()
        nodes = [path.add(str(n), e) for n, e in enumerate([lamp, *inside, eye])]
        for one, other in pairwise(nodes):
            _ = one >> other
        light = path.trace()
        if "response" in named or isinstance(element, op.Source):
            return  # Which may say what is read in any unit.
        if element.physical is True:
            check_light(light, emitted=1.0 + 1e-5)

    return Attack(f"op.{made.__name__}({texts})", act)


# Calls of what is public, with arguments that are nearly right or not right at all.

_PLAUSIBLE = parted("'npgr026' | '7' | 'stable' | 'numpy' | 'float32' | 'sp' | 'sum' | 'all' | 3")
_PLAUSIBLE += parted(
    "'E' | 'L' | 'X1' | 'X1.reflected' | 'X1.transmitted' | 'E.in' | 'gold' | 'nm'"
)
_PLAUSIBLE += parted("op.load_preset('malus') | op.Polarizer(0.3) | op.Mirror() | op.Detector()")
_PLAUSIBLE += parted("op.Frame([1, 0, 0], [0, 1, 0]) | op.Parameter('delta') | {'delta': 0.3}")
_PLAUSIBLE += parted("[1.0, 0.5, 0.0, 0.0] | [1.0, 0.5, 0.2] | np.eye(4) | np.eye(3) | 'intensity'")
_PLAUSIBLE += parted("'516 nm' | '2.4 eV' | 5e-7 | [4e-7, 5e-7, 6e-7] | ['400 nm', '500 nm']")
_PLAUSIBLE += parted("'D65' | 'linear' | 'nearest' | 'deg/mm' | 'X1.incident' | op.Wavelength()")
_PLAUSIBLE += parted("op.Spectrum.black_body(3000.0) | op.Material.cauchy([1.5, 0.004])")

_CLASSES = [op.Case, op.Composer, op.CosSin, op.Frame, op.Light, op.Material, op.Mueller]
_CLASSES += [op.Parameter, op.PathGraph, op.Source, op.VerticesByAngles]


def a_call(rng):
    """Make one call."""
    name = rng.choice(sorted(_made()))
    function = _made()[name]
    names = taken(rng, function, 0.4)
    text, named = given(
        rng, names, lambda rng: rng.choice(_PLAUSIBLE) if rng.random() < 0.5 else a_value(rng)
    )
    alone = [p.name for p in inspect.signature(function).parameters.values() if p.kind == 0]
    places = [named.pop(place) for place in alone if place in named]
    return Attack(f"{name}({text})", lambda: _called(function, places, named))


def _called(function, places, named):
    found = function(*places, **named)
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
    lamp = op.Source(spectrum=op.Spectrum.black_body(3000.0))
    spectral = (lamp >> op.Detector()).trace(wavelength=np.linspace(4e-7, 7e-7, 5))
    methods = [glass.at, spectrum.at, spectrum.power, spectrum.rebin, spectrum.resample]
    methods += [spectral.integrate, spectral.at_wavelengths, spectral.to_xyz, spectral.to_srgb]
    found |= {f"the {method.__qualname__}": method for method in methods}
    plate = op.Retarder(1.0, op.Parameter("angle"))
    found |= {"plate.port_back": plate.port_back, "there_and_back": op.there_and_back}
    return found | {"path.propagate of values": _propagated}


def _propagated(delta, sigma, method="differences", samples=None, seed=None, correlation=None):
    pair = delta, sigma
    options = {"samples": samples, "seed": seed, "correlation": correlation}
    return op.load_preset("npgr026").propagate(delta=pair, n1=(1.5, 0.1), method=method, **options)


# Command lines: they end with status 0, or with status 2 and a line that says why.

_COMMANDS = parted("run | show | explain | polarization | presets")
_OPTIONS = parted("--json | --case | --method | --model | --reads | --tolerance | --help | --plot")
_OPTIONS += parted("--engine | --svg | --version | -- | - | -x")
_WORDS = parted("7 | stable | textbook | scalar | full | intensity | 0.01 | horizontal | 45 | 1.5")


def a_command_line(rng):
    """Make one command line."""
    line = [rng.choice([*_COMMANDS, *_COMMANDS, rng.choice(TEXTS)])]
    preset = rng.choice(op.preset_names())
    line.append(rng.choice([preset, preset, preset, "./none.toml", rng.choice(TEXTS)]))
    names = [f"--{name.replace('_', '-')}" for name in op.load_preset(preset).parameters]
    for _ in range(rng.randrange(5)):
        line.append(rng.choice([*names, *names, rng.choice(_OPTIONS)]))
        if rng.random() < 0.8:
            line.append(rng.choice([a_number(rng), rng.choice(TEXTS), rng.choice(_WORDS)]))
    # No file is written.
    line = ["--json" if word.startswith(("--svg", "--out")) else word for word in line]
    return Attack(f"optipath {' '.join(map(repr, line))}", lambda: _run(line))


def _run(line):
    output, errors = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors):
        status = main(line)
    assert status in (0, 2), f"status {status}"
    told = errors.getvalue()
    assert (status == 2) <= (told.count("optipath: ") >= 1), f"{status} without a word"
    plain = [text for text in told.splitlines() if not text.startswith("- ")]
    assert len(plain) <= 4, f"many lines: {told}"
    for text in (output.getvalue(), told):
        shown = text.replace("\n", "")
        assert shown.isprintable(), f"a terminal obeys {shown!r}"


# Random paths, composed in every way: whatever is chosen, the light is the same.

# Compiling takes seconds.
_ENGINES = ["auto"] * 9 + ["numpy"] * 10 + ["numba"]


def options(rng):
    """Make one path and one way to compose and run it."""
    seed, loops = rng.randrange(2**32), rng.random() < 0.4
    chosen = {"engine": rng.choice(_ENGINES)}
    for name, choices in {
        "model": ["auto", "full"],
        "composing": ["stokes", "jones"],
        "keep": ["ends", "all"],
        "method": ["stable", "compensated", "amplitude"],
    }.items():
        if rng.random() < 0.3:
            chosen[name] = rng.choice(choices)
    times = rng.choice([1, 5])
    shown = f"Draw({seed}).path(loops={loops}), {chosen}, {times} times"
    return Attack(shown, lambda: _compared(seed, loops=loops, chosen=chosen, times=times), 60.0)


def _compared(seed, *, loops, chosen, times):
    draw = Draw(seed)
    path = draw.path(loops=loops)
    expected = op.Composer(model="full", engine="numpy").compose(path).run_all(**draw.values)
    plan = op.Composer(**chosen).compose(path)
    emitted = sum(
        float(np.max(path.element(name).intensity)) for name in path.graph if name.startswith("s")
    )
    for _ in range(times):
        found = plan.run_all(**draw.values)
        for name, light in expected.items():
            check_light(found[name])
            read = ~np.isnan(found[name].stokes)
            error = np.abs(found[name].stokes - light.stokes)[read]
            assert (error <= 1e-11 * emitted).all(), f"{name} is off by {error.max():g}"
