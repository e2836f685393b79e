"""JSON over the wire: what is no JSON, or more than it, is a sentence."""

import pytest

from optipath.errors import OptipathError
from optipath.explorer.strict_json import read_json
from tables import rows


def test_what_is_json_is_read():
    assert read_json(b'{"a": ["[[[[[[[[[[", 1.5, null, true, "\\""]}') == {
        "a": ["[[[[[[[[[[", 1.5, None, True, '"']
    }


@rows(
    "given, told",
    [
        (b"", "no JSON at character 0"),
        (b"{", "no JSON"),
        (b'{"a": 1} {"b": 2}', "no JSON at character 9"),
        (b"\xff\xfe", "no UTF-8 from byte 0"),
        (b'{"a": NaN}', "has NaN, which JSON does not know"),
        (b'{"a": -Infinity}', "has -Infinity"),
        (b'{"a": 1e999}', "no finite number"),
        (b'{"a": ' + b"9" * 5000 + b"}", "too many digits"),
        (b'{"a": "\\ud800"}', "half a character"),
        (b'{"a": 1, "a": 2}', "the name 'a' twice"),
        (b"[" * 30000, "brackets more than 8 levels deep"),
        (b'{"a":' * 9 + b"1" + b"}" * 9, "brackets more than 8 levels deep"),
        (b'{"a": "\x00"}', "no JSON"),
    ],
)
def test_what_is_not_is_refused_in_a_sentence(given, told):
    with pytest.raises(OptipathError, match="the request ") as refused:
        read_json(given)
    assert told in str(refused.value)
    assert str(refused.value).count("\n") == 0
