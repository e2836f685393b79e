import tomllib
from contextlib import suppress

import pytest

import optipath as op
from optipath.paths.format.limits import DEEPEST, LONGEST_WORD, refuse_unwieldy

ENOUGH = 30_000

UNWIELDY = {
    "dotted key": "a" + ".a" * ENOUGH + " = 1",
    "dotted key with blanks": "a" + " . a" * ENOUGH + " = 1",
    "quoted dotted key": '"a"' + ".'a'" * ENOUGH + " = 1",
    "dotted header": "[" + "a." * ENOUGH + "a]",
    "dotted header of tables": "[[" + "a." * ENOUGH + "a]]",
    "dotted key in a table": "x = { " + "a." * ENOUGH + "a = 1 }",
    "dotted key in a list": "x = [\n1, {" + "a." * ENOUGH + "a = 1}]",
    "behind a text with a quote": 'x = ["""a"""", {' + "a." * ENOUGH + "a = 1}]",
    "behind a literal with quotes": "x = ['''a''''', {" + "a." * ENOUGH + "a = 1}]",
    "behind an escaped quote": 'x = ["\\"", {' + "a." * ENOUGH + "a = 1}]",
    "behind a comment": 'x = [ # "\n{' + "a." * ENOUGH + "a = 1}]",
    "lists": "x = " + "[" * ENOUGH,
    "closed lists": "x = " + "[" * 1500 + "]" * 1500,
    "tables": "x = " + "{a = " * ENOUGH,
    "both": "x = " + "[{a = " * ENOUGH,
    "decimal digits": "x = " + "1" * 4000,
    "hexadecimal digits": "x = 0x" + "f" * ENOUGH,
    "digits of a fraction": "x = 1." + "1" * ENOUGH,
    "bare key": "x" * ENOUGH + " = 1",
    "NUL": "\0" * ENOUGH,
}


@pytest.mark.parametrize("text", UNWIELDY.values(), ids=UNWIELDY)
def test_what_would_take_long_to_parse_is_refused_before(text, tmp_path):
    with pytest.raises(op.PresetError, match=r"line [123] (has a|opens)"):
        refuse_unwieldy(text)
    file = tmp_path / "x.toml"
    file.write_text(text, "utf-8")
    with pytest.raises(op.PresetError, match="is not TOML as presets use it: line") as error:
        op.load_preset(file)
    assert len(str(error.value)) < 300


HANDY = {
    "a sentence": 'x = "' + "one.two." * ENOUGH + '"',
    "a text of brackets": "x = '" + "[{" * ENOUGH + "'",
    "lines of brackets": "x = '''" + "[\n" * ENOUGH + "'''",
    "lines with quotes": 'x = """' + 'a""[\\"""' * ENOUGH + '"""',
    "a comment": "# " + "a." * ENOUGH + "[" * ENOUGH + '"""' + "\nx = 1",
    "a long list": "x = [" + "1.5," * ENOUGH + "]",
    "a list of lists": "x = [" + "[1.5, 2.5]," * ENOUGH + "]",
    "many headers": "".join(f"[a.x{number}]\n" for number in range(1000)),
    "the deepest list": "x = " + "[" * DEEPEST + "]" * DEEPEST,
    "the deepest key": ".".join("a" * DEEPEST) + " = 1",
    "the longest word": "x" * LONGEST_WORD + " = 1",
    "a windows file": "x = 1\r\ny = 2.5\r\n",
    "dates": "x = [" + "1979-05-27T07:32:00.999-07:00," * 1000 + "]",
}


@pytest.mark.parametrize("text", HANDY.values(), ids=HANDY)
def test_what_is_long_but_flat_is_not(text):
    refuse_unwieldy(text)
    tomllib.loads(text)


@pytest.mark.parametrize("name", op.preset_names())
def test_presets_are_far_from_the_limits(name):
    refuse_unwieldy(op.load_preset(name).to_toml())


# Each of these took time that grew with its square, or more, when it was looked at piece by piece.
PARTS = ['"', "'", '"\\', "\\", '"""a', "'''a", "a.", "a .", " ", "#", "[]", "]", "-", "\n", "é."]


@pytest.mark.parametrize("part", PARTS)
@pytest.mark.parametrize("start", ["x = ", 'x = "', "x = '''", 'x = """'])
def test_the_look_takes_time_that_grows_with_the_text(part, start):
    # It would take hours otherwise.
    with suppress(op.PresetError):
        refuse_unwieldy(start + part * (200_000 // len(part)))
