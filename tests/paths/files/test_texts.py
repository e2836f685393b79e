"""The texts of files before they are paths: names, limits, slips, and whatever stands in them."""

import copy
import json
import random
import tomllib
from contextlib import suppress

import pytest

import optipath as op
from optipath.paths.files.schema import (
    file_of,
    files_in,
    presets_folder,
    text_of,
)
from tables import rows, slow


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "more").mkdir()
    for name in ("thick.toml", "thin.toml", "other.txt", "more/hidden.toml"):
        (tmp_path / name).write_text("", "utf-8")
    return tmp_path


def test_names_are_files_of_the_folder_whose_texts_have_no_mark_of_their_bytes(folder):
    files = files_in(folder)
    assert [*files] == ["thick", "thin"]
    assert files_in(folder / "nowhere") == {}
    assert "glass-rough" not in files_in(presets_folder())
    assert file_of("thin", "film", files, "a look") == folder / "thin.toml"
    own = folder / "more" / "own.toml"
    assert file_of(own, "film", files, "a look") == file_of(str(own), "film", files, "") == own
    (folder / "thin.toml").write_bytes(b"\xef\xbb\xbfa = 1")
    assert text_of(folder / "thin.toml", "film") == "a = 1"
    with pytest.raises(op.errors.PresetError, match="cannot be read: it is no file"):
        text_of(folder / "more", "film")
    for given, sentence in (
        ("thinn", "film 'thinn' is unknown; did you mean 'thin'?"),
        ("hidden", "film 'hidden' is unknown; there are: thick, thin"),
        ("../thin", "'../thin' is neither the name of a film (a-z, 0-9 and -) nor the path "),
        (None, "a film is a name or the path of a file, not None"),
    ):
        with pytest.raises(op.errors.PresetError) as error:
            file_of(given, "film", files, "a look")
        assert str(error.value).startswith(sentence)


DEEP = "slip.toml' is nested more than 16 deep; write it flatter$"
SLIPS = [
    ("angle = 30 deg", r"line 2, column \d+\): 'angle = 30 deg'"),
    ('kind = "interface', r"line 2, column \d+\): 'kind = .*interface'"),
    ("optional = True # no", "line 2, column 12"),
    ("[elements.a]\n[elements.a]", r"twice .*: '\[elements.a\]'"),
    ("indices = [1, 1.5", "Unclosed array"),
    *(("x = " + way * 100_000, DEEP) for way in ("[", "{a = ")),
    *(("x = " + "[" * count + "]" * count, DEEP) for count in (17, 100, 400)),
    # For which Python's reader takes 40 GB.
    *((start + "a" + ".a" * 100_000, DEEP) for start in ("", "[[", "x = [1, {", "x = {y = 1, ")),
    ('"a\\""\t. \'a\' . b-1' + ".a" * 14 + " = 1", DEEP),
    ("x = " + "9" * 5000, "digits"),
]


@rows("text, message", SLIPS)
def test_a_slip_is_told_with_its_line(tmp_path, text, message):
    file = tmp_path / "slip.toml"
    file.write_text("format = 1\n" + text + "\n")
    with pytest.raises(op.errors.PresetError, match=message):
        op.load_preset(file)


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
    *("{incidences=[1]}", '{incidences=["1 deg","2 deg"],turns=[1]}'),
    *("{incidences=[[1]],turns={}}", "{in=1}", "{in={x=1,y=2,z=3}}"),
    *("{in={x=[1,[2]],y=[0,1,0],z=[0,0,1]}}", "{in={x=[nan,0,0],y=[0,1,0],z=[0,0,1]}}"),
]
# All of them take a minute; a part that differs from place to place will do otherwise.
SHARES = [20, slow(1)]
IN_X1 = "index index.n vertices vertices.incidences vertices.incidences.0 place outside"
PLACES = [
    ("npgr026", "choices", "place place.element place.behind place.help place.behind.eye"),
    ("npgr026-3d", "parameters", "filter delta.default"),
    ("npgr026-3d", "parameters.filter", "default unit range range.0 words words.horizontal"),
    ("npgr026-3d", "parameters.filter", "help optional bound"),
    ("npgr026-3d", "elements.X1", f"{IN_X1} reflections frames azimuth kind"),
    ("npgr026-3d", "elements", "P P.angle P.frames X2.place L.intensity L.stokes E.reads"),
    ("npgr026-3d", "links", "0 0.from 0.to 0.azimuth 0.tap"),
    ("npgr026-3d", "cases", "1 1.values 1.published 1.note 1.values.delta 1.published.E"),
]
ELEMENTS = {
    "layer-stack": {"indices": [1, 1.5], "incidence": "1 deg"},
    "mueller": {"matrix": [[1, 0, 0, 0]] * 4},
    "faraday-rotator": {"verdet": "1 rad/(T m)", "field": "1 T", "length": "1 mm"},
    "waveplate": {"thickness": "1 mm", "birefringence": 0.01, "wavelength": "589 nm"},
}
ELEMENTS |= {"mirror": {"r_s": 0.9, "r_p": 0.9}, "diattenuator": {"maximum": 1, "minimum": 0.5}}
ELEMENTS |= {"medium": {"length": "1 mm", "absorption": "1 1/mm"}, "beam-splitter": {}}
ELEMENTS |= {"combiner": {}, "retarder": {"retardance": "1 deg"}, "rotator": {"angle": "1 deg"}}
ELEMENTS |= {"attenuator": {"transmittance": 0.5}, "depolarizer": {}}
ELEMENTS |= {"circular-polarizer": {"handedness": "left"}}
ELEMENTS |= {"polarizing-beam-splitter": {"extinction_transmitted": 1000}}


def written(value):
    if isinstance(value, bytes):  # What stands in a file as it is.
        return value.decode()
    if isinstance(value, dict):
        return "{" + ",".join(f"{json.dumps(k)}={written(v)}" for k, v in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ",".join(map(written, value)) + "]"
    return str(value) if isinstance(value, float) else json.dumps(value)


def load(document, folder):
    file = folder / "x.toml"
    file.write_text("".join(f"{key} = {written(v)}\n" for key, v in document.items()), "utf-8")
    return op.load_preset(file)


def put(document, place, value):
    changed = copy.deepcopy(document)
    *way, last = place.split(".")
    inside = changed
    for key in way:
        inside = inside[int(key) if isinstance(inside, list) else key]
    inside[int(last) if isinstance(inside, list) else last] = value.encode()
    return changed


def try_all(document, places, folder, share):
    """Load with strange values in each place; what loads has a plan, or faults of its own."""
    for number, place in enumerate(places):
        for value in STRANGE[number % share :: share]:
            with suppress(op.OptipathError):
                load(put(document, place, value), folder).compose()


def document_of(name):
    found = tomllib.loads(op.load_preset(name).to_toml())
    if "cases" in found:
        found["cases"] = {"1": found["cases"]["1"]} if "1" in found["cases"] else {}
    return found


@pytest.mark.parametrize("share", SHARES)
def test_every_value_of_every_key_and_field_is_read_or_refused(share, tmp_path):
    for name, table, keys in PLACES:
        places = [table, *(f"{table}.{key}" for key in keys.split())]
        try_all(document_of(name), places, tmp_path, share)
    try_all(document_of("npgr026-3d"), ["format", "description", "loops"], tmp_path, share)
    document = document_of("malus")
    for kind, fields in ELEMENTS.items():
        document["elements"]["analyzer"] = {"kind": kind, **fields}
        places = [f"elements.analyzer.{field}" for field in ("azimuth", *fields)]
        try_all(document, places, tmp_path, share)


PIECES = [b'"', b"'", b"[", b"]", b"{", b"}", b".", b"=", b"\n", b"\\", b"\0", b"\xff", b"#", b"$"]
PIECES += [b"\xef\xbb\xbf", b"\r", b'"""', b"9" * 50, b"1e9", b"nan", b"\xed\xa0\x80", b"-"]


def test_every_sequence_of_bytes_is_read_or_refused_soon(tmp_path):
    dice = random.Random(1)  # noqa: S311
    file = tmp_path / "x.toml"
    texts = [op.load_preset(name).to_toml().encode() for name in ("malus", "glass-slab")]
    for _ in range(80):
        text = bytearray(dice.choice(texts))
        for _ in range(dice.randint(1, 4)):
            start = dice.randrange(len(text))
            end = start + dice.choice([0, 0, 1, 5, 50])
            text[start:end] = dice.choice([*PIECES, bytes(text[:: dice.randint(50, 99)])])
        file.write_bytes(bytes(text))
        with suppress(op.OptipathError):
            op.load_preset(file)
    document = {"format": 1, "elements": {f"abc{n}": {"kind": "dump"} for n in range(1500)}}
    document["links"] = [{"from": f"abd{n}.out", "to": f"abd{n}.in"} for n in range(1500)]
    with pytest.raises(op.errors.PathError) as error:
        load(document, tmp_path)
    assert 20 < len(error.value.faults) < 200


UNEQUAL = '{kind="mirror", r_s={re=[1,2],im=[1,2,3]}, r_p=0.9}'


@rows(
    "name, place, value, message",
    [
        ("npgr026-3d", "elements.X1.outside", "[1, [2]]", "has rows of unequal lengths"),
        ("npgr026-3d", "elements.X2.place", "[1, 2]", "place must be a whole number"),
        ("npgr026-3d", "parameters.filter.words", '{w = ["1 deg", ["2 deg"]]}', "word 'w' of para"),
        ("malus", "elements.analyzer", UNEQUAL, "the shapes of 're' and 'im' do not fit"),
    ],
)
def test_lists_that_do_not_fit_are_told_of(name, place, value, message, tmp_path):
    with pytest.raises(op.OptipathError, match=message):
        load(put(document_of(name), place, value), tmp_path)
