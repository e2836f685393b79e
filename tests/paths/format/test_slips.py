"""Slips in writing TOML are told with the line that was meant."""

import tomllib

import pytest

import optipath as op

MEANT = [
    ("optional = True", "write optional = true"),
    ("optional = False # no", "write optional = false"),
    ("tap = yes", "write tap = true"),
    ("kind = interface", 'write kind = "interface"'),
    ("index = 0.17+3.15j", 'write index = "0.17+3.15j"'),
    ("angle = 30 deg", 'write angle = "30 deg"'),
    ("angle = $theta", 'write angle = "$theta"'),
    ("index = 1,5", "write index = 1.5"),
    ("share = .5", "write share = 0.5"),
    ("share = 5.", "write share = 5.0"),
    ('kind = "interface', 'write kind = "interface"'),
    ("kind: interface", 'write kind = "interface"'),
    ('kind: "interface"', 'write kind = "interface"'),
]


def told(folder, text):
    file = folder / "slip.toml"
    file.write_text("format = 1\n" + text + "\n")
    with pytest.raises(op.PresetError) as error:
        op.load_preset(file)
    return str(error.value)


@pytest.mark.parametrize(("line", "cure"), MEANT)
def test_the_line_that_was_meant_is_told_and_is_toml(tmp_path, line, cure):
    assert told(tmp_path, line).endswith(f"; {cure}")
    tomllib.loads(cure.removeprefix("write "))


@pytest.mark.parametrize(
    ("text", "cure"),
    [
        ('[links]\nfrom = "a"\n[links]\nfrom = "b"', "write [[links]], in double brackets"),
        ("[elements.a]\n[elements.a]", "elements.a is there already: give this one another name"),
        ("loops = 'sum'\nloops = 'sum'", "loops is there already: leave one of them out"),
        ("indices = [1, 1.5", "close what is open: a quote or a bracket"),
        ("matrix = [1, two]", "look at 'matrix = [1, two]'"),
        ("angle = None", "leave angle out"),
        ("angle = np.pi/4", "look at 'angle = np.pi/4'"),
        ('angle = "30" deg', "look at 'angle = \"30\" deg'"),
        (
            "intensity = 1,000",
            "a comma may be a point or part thousands: write intensity = 1.000 or 1000",
        ),
        ("just a line", "look at 'just a line'"),
    ],
)
def test_other_slips_are_told_by_what_to_do(tmp_path, text, cure):
    assert f"; {cure}" in told(tmp_path, text)
