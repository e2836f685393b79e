"""Whatever stands in a file, it is read, or refused by an error of the library."""

import copy
import json
import os
import random
import tomllib
from contextlib import suppress

import pytest

import optipath as op

# Every type of TOML, with the values of each that are at an end of it.
STRANGE = [
    *('""', '"a"', '"1 deg"', '"$delta"', '"$nothing"', '"-$delta"', '"L.out"', '"."', '"none"'),
    *('"1+1j"', '"1e5000 nm"', r'"\u001b[31m"', r'"\u0000"', "0", "-1", "3", "1.5", "-0.0"),
    *("1e999", "-1e999", "nan", "inf", "0x" + "f" * 900, "1" + "0" * 400, "true", "false"),
    *("1979-05-27", "1979-05-27T07:32:00Z", "07:32:00", "[]", "[1]", "[1,[2]]", "[[1,2],[3]]"),
    *("[[]]", '["a"]', '["1 deg",2]', "[true]", "[1979-05-27]", "[nan]", "[{}]", "[1,2,3,4]"),
    *('["none",[1]]', "[1,{re=1}]", "{}", "{n=1}", '{n="a"}', "{n=[1,[2]]}", "{n=[1,2,3],k=[1,2]}"),
    *("{n=1,k=true}", "{n=1,k=inf}", "{n={n=1}}", "{a={b={c=1}}}", "{re=inf,im=inf}"),
    *("{re=[1,2],im=[1,2,3]}", "{w=[1,[2]]}", "{w=1979-05-27}", "{w=nan}", "{none=1}", '{""=1}'),
    *(
        "{incidences=[1]}",
        '{incidences=["1 deg","2 deg"],turns=[1]}',
        "{incidences=[[1]],turns={}}",
    ),
    *("{in=1}", "{in={x=1,y=2,z=3}}", "{in={x=[1,[2]],y=[0,1,0],z=[0,0,1]}}"),
    "{in={x=[nan,0,0],y=[0,1,0],z=[0,0,1]}}",
]
# All of them take a minute; a part that differs from place to place will do otherwise.
PART = 1 if "OPTIPATH_STRANGE" in os.environ else 5

PLACES = {
    "npgr026": [
        ("choices",),
        ("choices", "place"),
        *(("choices", "place", key) for key in ("element", "behind", "help")),
        ("choices", "place", "behind", "eye"),
    ],
    "npgr026-3d": [
        ("format",),
        ("description",),
        ("loops",),
        ("parameters",),
        ("parameters", "filter"),
        *(("parameters", "filter", key) for key in ("default", "unit", "range", "help", "words")),
        *(("parameters", "filter", key) for key in ("optional", "bound")),
        ("parameters", "filter", "words", "horizontal"),
        ("parameters", "filter", "range", 0),
        ("parameters", "delta", "default"),
        ("elements",),
        ("elements", "P"),
        *(("elements", "X1", key) for key in ("kind", "index", "vertices", "place", "outside")),
        *(("elements", "X1", key) for key in ("reflections", "frames", "azimuth")),
        ("elements", "X2", "place"),
        ("elements", "X1", "index", "n"),
        ("elements", "X1", "vertices", "incidences"),
        ("elements", "X1", "vertices", "incidences", 0),
        ("elements", "P", "angle"),
        ("elements", "P", "frames"),
        *(("elements", "L", key) for key in ("intensity", "stokes")),
        ("elements", "E", "reads"),
        ("links",),
        ("links", 0),
        *(("links", 0, key) for key in ("from", "to", "azimuth", "tap")),
        ("cases",),
        ("cases", "1"),
        *(("cases", "1", key) for key in ("values", "published", "note")),
        ("cases", "1", "values", "delta"),
        ("cases", "1", "published", "E"),
    ],
}
ELEMENTS = {
    "layer-stack": {"indices": [1, 1.5], "incidence": "1 deg"},
    "mirror": {"r_s": 0.9, "r_p": 0.9},
    "mueller": {"matrix": [[1, 0, 0, 0]] * 4},
    "medium": {"length": "1 mm", "absorption": "1 1/mm"},
    "diattenuator": {"maximum": 1, "minimum": 0.5},
    "beam-splitter": {},
    "combiner": {},
    "retarder": {"retardance": "1 deg"},
    "rotator": {"angle": "1 deg"},
    "attenuator": {"transmittance": 0.5},
    "depolarizer": {},
    "faraday-rotator": {"verdet": "1 rad/(T m)", "field": "1 T", "length": "1 mm"},
    "circular-polarizer": {"handedness": "left"},
    "polarizing-beam-splitter": {"extinction_transmitted": 1000},
    "waveplate": {"thickness": "1 mm", "birefringence": 0.01, "wavelength": "589 nm"},
}


class InputKey(str):
    """What stands in a file as it is."""

    __slots__ = ()


def written(value):
    if isinstance(value, InputKey):
        return value
    if isinstance(value, dict):
        return "{" + ",".join(f"{json.dumps(k)}={written(v)}" for k, v in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ",".join(map(written, value)) + "]"
    return str(value) if isinstance(value, float) else json.dumps(value)


def load(document, file):
    file.write_text("".join(f"{key} = {written(v)}\n" for key, v in document.items()), "utf-8")
    return op.load_preset(file)


def put(document, place, value):
    changed = copy.deepcopy(document)
    inside = changed
    for key in place[:-1]:
        inside = inside[key]
    inside[place[-1]] = InputKey(value)
    return changed


def try_all(document, places, file):
    """Load with each strange value in each place; what loads has a plan, or faults of its own."""
    for number, place in enumerate(places):
        for value in STRANGE[number % PART :: PART]:
            with suppress(op.OptipathError):
                load(put(document, place, value), file).compose()


def document_of(name, tmp_path):
    file = tmp_path / "x.toml"
    file.write_text(op.load_preset(name).to_toml(), "utf-8")
    found = tomllib.loads(file.read_text("utf-8"))
    if "cases" in found:
        found["cases"] = {"1": found["cases"]["1"]} if "1" in found["cases"] else {}
    return found


@pytest.mark.parametrize("name", PLACES)
def test_every_value_of_every_key_is_read_or_refused(name, tmp_path):
    try_all(document_of(name, tmp_path), PLACES[name], tmp_path / "x.toml")


@pytest.mark.parametrize("kind", ELEMENTS)
def test_every_value_of_every_field_is_read_or_refused(kind, tmp_path):
    document = document_of("malus", tmp_path)
    document["elements"]["analyzer"] = {"kind": kind, **ELEMENTS[kind]}
    fields = ["azimuth", *ELEMENTS[kind]]
    try_all(document, [("elements", "analyzer", field) for field in fields], tmp_path / "x.toml")


def test_every_sequence_of_bytes_is_read_or_refused(tmp_path):
    dice = random.Random(1)  # noqa: S311
    file = tmp_path / "x.toml"
    texts = [op.load_preset(name).to_toml().encode() for name in ("malus", "glass-slab")]
    pieces = [b'"', b"'", b"[", b"]", b"{", b"}", b".", b"=", b"\n", b"\\", b"\0", b"\xff", b"#"]
    pieces += [
        b"\xef\xbb\xbf",
        b"\r",
        b'"""',
        b"9" * 50,
        b"1e9",
        b"nan",
        b"\xed\xa0\x80",
        b"$",
        b"-",
    ]
    for _ in range(200):
        text = bytearray(dice.choice(texts))
        for _ in range(dice.randint(1, 4)):
            start = dice.randrange(len(text))
            end = start + dice.choice([0, 0, 1, 5, 50])
            text[start:end] = dice.choice([*pieces, bytes(text[:: dice.randint(50, 99)])])
        file.write_bytes(bytes(text))
        with suppress(op.OptipathError):
            op.load_preset(file)


def test_places_and_words_that_are_lists_are_told_of(tmp_path):
    document = document_of("npgr026-3d", tmp_path)
    for place, value, message in (
        (("elements", "X2", "place"), "[1, 2]", "place must be a whole number"),
        (
            ("parameters", "filter", "words"),
            '{w = ["1 deg", ["2 deg"]]}',
            "word 'w' of parameter 'filter'",
        ),
    ):
        with pytest.raises(op.PathError, match=message):
            load(put(document, place, value), tmp_path / "x.toml")


def test_shapes_of_complex_parts_that_do_not_fit_are_named(tmp_path):
    document = document_of("malus", tmp_path)
    document["elements"]["analyzer"] = {"kind": "mirror", "r_p": 0.9}
    document["elements"]["analyzer"]["r_s"] = {"re": [0.1, 0.2], "im": [0.1, 0.2, 0.3]}
    with pytest.raises(op.OptipathError, match="the shapes of 're' and 'im' do not fit"):
        load(document, tmp_path / "x.toml")


def test_suggestions_are_made_for_the_first_faults_only(tmp_path):
    document = {"format": 1, "elements": {f"abc{n}": {"kind": "dump"} for n in range(1500)}}
    document["links"] = [{"from": f"abd{n}.out", "to": f"abd{n}.in"} for n in range(1500)]
    with pytest.raises(op.PathError) as error:
        load(document, tmp_path / "x.toml")
    assert len(error.value.faults) > 1500
    assert 1 <= sum("did you mean" in fault for fault in error.value.faults) <= 20
