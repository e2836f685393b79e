"""Files of presets, samples and experiments, altered: loaded and written again, or refused."""

import re
import tempfile
from pathlib import Path

import numpy as np
from tests.fuzz.attack import Attack, check_light
from tests.fuzz.odd_values import toml_value

import optipath as op
from optipath.surfaces.reproduction import load_experiment

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


_TEXTS = [op.load_preset(name).to_toml() for name in op.preset_names()]
# One in which an index follows from the wavelength.
_OF_N1 = next(text for text in _TEXTS if "$n1" in text)
_TEXTS.append(_OF_N1.replace('{ n = "$n1", k = "$k1" }', f"{{ {_CURVES[0]} }}"))
_GLASS = op.Interface(op.Material.cauchy([1.5, 0.01]), 0.3)
_TEXTS.append((op.Source() >> _GLASS >> op.Detector()).bind(wavelength="516 nm").to_toml())
_WORDS = sorted({word for text in [*_TEXTS, *_CURVES] for word in re.findall(r"[a-z_]{2,}", text)})


def maker(texts, use):
    """Return what makes an attack by a file, one of some texts of which a part is altered."""

    def make(rng):
        text = _altered(rng, rng.choice(texts))

        def act():
            with tempfile.TemporaryDirectory() as folder:
                file = Path(folder) / "own.toml"
                file.write_bytes(text.encode("utf-8", "surrogatepass"))
                use(file)

        return Attack(text, act, seconds=4.0)

    return make


def _altered(rng, text):
    for _ in range(rng.randrange(1, 6)):
        text = rng.choice(_ALTERATIONS)(rng, text)
    return text


def _of_preset(file):
    path = op.load_preset(file)
    path.check()
    again = path.to_toml()
    file.write_text(again, encoding="utf-8")
    assert op.load_preset(file).to_toml() == again, "written again, it is another path"
    for light in path.compose().run_all().values():
        check_light(light)


a_preset = maker(_TEXTS, _of_preset)


def _somewhere(rng, text, pattern, new):
    """Put something new in one of the places that a pattern has."""
    places = list(re.finditer(pattern, text, re.MULTILINE))
    return _put(text, rng.choice(places).span(1), new) if places else text


def _a_value(rng, text):
    return _somewhere(rng, text, r"= (.*)$", toml_value(rng))


def _a_curve(rng, text):
    table = f"{{ {rng.choice(_CURVES)}{rng.choice(_WHEN)} }}"
    table = f"{{ n = {table}, k = 0.1 }}" if rng.random() < 0.2 else table
    return _somewhere(rng, text, r"= (.*)$", table)


def _a_word(rng, text):
    return _somewhere(rng, text, r"([a-z_]{2,})", rng.choice(_WORDS))


def _a_letter(rng, text):
    place = rng.randrange(len(text) + 1)
    letter = rng.choice([*'"[]{}.=\n\x1b\x00\ud800é#', ""])
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
            "a = " + "[" * count + "]" * count,
            "a = " + "9" * count,
            f'a = "{"1" * count}+{"1" * count}"',
            f'description = "{"x" * count}"',
            "".join(f"[elements.m{i}]\nkind = 'mirorr'\n" for i in range(count // 20)),
            "".join(f"[[links]]\nfrom = 'l.out{i}'\nto = 'eye.in'\n" for i in range(count // 20)),
            "".join("[a" + ".a" * i + "]\n" for i in range(min(count, 400))),
        ]
    )
    return f"{text}\n{flood}\n" if rng.random() < 0.7 else f"{flood}\n{text}"


def _put(text, span, new):
    return text[: span[0]] + new + text[span[1] :]


_ALTERATIONS = [*[_a_value] * 3, *[_a_curve] * 2, _a_word, _a_letter, _a_line, _a_key, _a_flood]


# Samples and experiments.

_HEIGHTS = """format = 1
description = "measured heights on glass"
outside = 1.33
cells = [64, 32]
surfaces = 2
seed = 3
periodic = true

[[layers]]
index = { sellmeier = { b = [1.04, 0.23], c = [0.006, 0.02] } }
heights = "own.npy"
size = [10.0, 20.0]
periodic = true

[[layers]]
index = { n = 0.5, k = 2.1 }
alpha = [0.1, 0.2]
"""
_SAMPLES = [_HEIGHTS, *(op.load_sample(name).to_toml() for name in op.sample_names())]
_OWN = """format = 1
description = "a varnish on brass"
source = "measured"
sample = "brass.toml"
photons = 1_000
sensor = 64

[[measurements]]
measure = "adm"
incidence = ["50 deg", "1 rad"]
text = "a tenth"
published = [0.1, [0.08, 0.1]]
within = 0.01
brighter_than = 0.2
noise = 0.2
azimuth = 20
cells = 100

[[measurements]]
measure = "dolp"
incidence = ["50 deg"]
text = "a half"
stokes = [1.0, 0.0, 0.5, 0.0]
"""
_SAMPLE = op.Sample([(1.5, 0.1), (2.4, 0.2)]).to_toml()


def _of_sample(file):
    np.save(file.parent / "own.npy", np.eye(9))
    again = (sample := op.load_sample(file)).to_toml()
    file.write_text(again, encoding="utf-8", newline="")
    assert op.load_sample(file) == sample, "written again, it is another sample"
    found = sample.indices(None if "wavelength" not in repr(sample) else "500 nm")
    assert np.isfinite([found.outside, *found.inner, found.n, found.k]).all()
    assert min(found.outside, *found.inner, found.n + found.k) > 0.0


def _of_experiment(file):
    (file.parent / "brass.toml").write_text(_SAMPLE, "utf-8")
    found = load_experiment(file)
    assert found.measurements
    assert all(one.agrees(0.1, 0.0) in {None, False, True} for one in found.measurements)


a_sample, an_experiment = maker(_SAMPLES, _of_sample), maker([_OWN], _of_experiment)
