"""Preset files, altered: loaded, checked, traced and written again, or refused."""

import re
import tempfile
from pathlib import Path

from tests.fuzz.attack import Attack, check_light
from tests.fuzz.odd_values import toml_value

import optipath as op

_CURVES = [
    'wavelengths = [400, 500, 700], unit = "nm", n = [1.5, 1.0, 0.3], k = [1.9, 1.8, 2.9]',
    'wavelengths = ["0.3 um", "2.4 eV"], n = [1.5, 1.4], extrapolate = "linear", name = "glass"',
    'wavelengths = [300, 900], unit = "nm", values = [0.1, 0.2], interpolation = "monotone"',
    'wavelengths = [300, 900], unit = "nm", values = ["1 deg", "2 deg"], scale = 2',
    "sellmeier = { b = [1.04, 0.23], c = [0.006, 0.02], offset = 1.1 }",
    "cauchy = { coefficients = [1.5, 0.004] }, k = 0.01",
    "drude_lorentz = { plasma = 9, damping = 0.02, oscillators = [[0.02, 0.4, 0.2]] }",
    "tauc_lorentz = { oscillators = [[122, 3.45, 2.54, 1.2]], background = 1.15 }",
    "difference = [{ cauchy = { coefficients = [1.5] } }, { cauchy = { coefficients = [1.4] } }]",
    'material = "gold"',
    'material = "silica", k = 0.1',
    'crystal = "quartz"',
]
_WHEN = [
    "",
    ', wavelength = "516 nm"',
    ', wavelength = "$n1"',
    ", wavelength = 5e-7",
    ', part = "k"',
]
"""Tables of what depends on the wavelength, and what else may stand in them."""


def _in_curves(text):
    """Return a preset in which an index follows from the wavelength."""
    return text.replace('{ n = "$n1", k = "$k1" }', f"{{ {_CURVES[0]} }}")


_TEXTS = [op.load_preset(name).to_toml() for name in op.preset_names()]
_TEXTS.append(_in_curves(next(text for text in _TEXTS if "$n1" in text)))
_TEXTS.append(
    (op.Source() >> op.Interface(op.Material.cauchy([1.5, 0.01]), 0.3) >> op.Detector())
    .bind(wavelength="516 nm")
    .to_toml()
)
_WORDS = sorted({word for text in [*_TEXTS, *_CURVES] for word in re.findall(r"[a-z_]{2,}", text)})


def make(rng):
    """Make one file; it holds a preset of which some is altered."""
    text = altered(rng, rng.choice(_TEXTS))
    return Attack(text, lambda: _used(text), seconds=4.0)


def altered(rng, text):
    """Alter a file in some places."""
    for _ in range(rng.randrange(1, 6)):
        text = rng.choice(_ALTERATIONS)(rng, text)
    return text


def _used(text):
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "own.toml"
        file.write_bytes(text.encode("utf-8", "surrogatepass"))
        path = op.load_preset(file)
        path.check()
        again = path.to_toml()
        file.write_text(again, encoding="utf-8")
        assert op.load_preset(file).to_toml() == again, "written again, it is another path"
    for light in path.compose().run_all().values():
        check_light(light)


def _a_value(rng, text):
    places = list(re.finditer(r"= (.*)$", text, re.MULTILINE))
    return _put(text, rng.choice(places).span(1), toml_value(rng)) if places else text


def _a_curve(rng, text):
    places = list(re.finditer(r"= (.*)$", text, re.MULTILINE))
    table = f"{{ {rng.choice(_CURVES)}{rng.choice(_WHEN)} }}"
    table = f"{{ n = {table}, k = 0.1 }}" if rng.random() < 0.2 else table
    return _put(text, rng.choice(places).span(1), table) if places else text


def _a_word(rng, text):
    places = list(re.finditer(r"[a-z_]{2,}", text))
    return _put(text, rng.choice(places).span(), rng.choice(_WORDS)) if places else text


def _a_letter(rng, text):
    place = rng.randrange(len(text) + 1)
    letter = rng.choice(
        ['"', "[", "]", "{", "}", ".", "=", "\n", "\x1b", "\x00", "\ud800", "é", "#", ""]
    )
    return _put(text, (place, min(place + rng.randrange(2), len(text))), letter)


def _a_line(rng, text):
    lines = text.splitlines(keepends=True) or [""]
    one, other = rng.randrange(len(lines)), rng.randrange(len(lines))
    match rng.randrange(3):
        case 0:
            del lines[one]
        case 1:
            lines.insert(other, lines[one])
        case 2:
            lines[one], lines[other] = lines[other], lines[one]
    return "".join(lines)


def _a_key(rng, text):
    heads = list(re.finditer(r"^\[.*\]$", text, re.MULTILINE))
    place = rng.choice(heads).end() if heads else 0
    return _put(text, (place, place), f"\n{rng.choice(_WORDS)} = {toml_value(rng)}")


def _a_flood(rng, text):
    count = int(10 ** rng.uniform(1, 4.3))
    flood = rng.choice(
        [
            "a." * count + "b = 1",
            "a = " + "[" * count + "]" * count,
            "a = " + "{a=" * count + "1" + "}" * count,
            "a = " + "9" * count,
            f'a = "{"1" * count}+{"1" * count}"',
            f'description = "{"x" * count}"',
            "\n".join(f"[elements.m{i}]\nkind = 'mirorr'" for i in range(count // 20)),
            "\n".join(f"[parameters.p{i}]\ndefalt = 1" for i in range(count // 20)),
            "\n".join(
                f"[[links]]\nfrom = 'lamp.out{i}'\nto = 'eye.in'" for i in range(count // 20)
            ),
            "[" + "x." * count + "y]",
            "\n".join("[a" + ".a" * i + "]" for i in range(min(count, 400))),
        ]
    )
    return f"{text}\n{flood}\n" if rng.random() < 0.7 else f"{flood}\n{text}"


def _put(text, span, new):
    return text[: span[0]] + new + text[span[1] :]


_ALTERATIONS = [
    _a_value,
    _a_value,
    _a_value,
    _a_curve,
    _a_curve,
    _a_word,
    _a_letter,
    _a_line,
    _a_key,
    _a_flood,
]
