"""One thing wrong in a file is one fault: what follows from it is not told as well."""

import tomllib

import pytest

import optipath as op
from optipath.paths.presets.reader.document import read

DECLARED = """default = "30 deg"
unit = "deg"
range = ["0 deg", "90 deg"]"""

FILTER = """[elements.filter]
kind = "polarizer"
angle = "$theta"
"""

GOOD = f"""
format = 1
description = "a lamp, a filter, a mirror, an eye"

[parameters.theta]
{DECLARED}

[parameters.n]
default = 1.2
range = [0, inf]

[elements.lamp]
kind = "source"

{FILTER}
[elements.mirror]
kind = "interface"
index = {{ n = "$n", k = 7.0 }}
incidence = "$theta"

[elements.eye]
kind = "detector"

[[links]]
from = "lamp.out"
to = "filter.in"

[[links]]
from = "filter.out"
to = "mirror.in"

[[links]]
from = "mirror.reflected"
to = "eye.in"
azimuth = "10 deg"

[cases.steep]
values = {{ theta = "80 deg", n = 1.5 }}
published = {{ eye = [1, 0, 0, 0] }}
"""
INDEX = '{ n = "$n", k = 7.0 }'

OFFERED = """
[choices.place]
element = "filter"
behind = { light = "lamp.out", eye = "mirror.reflected" }
"""


def faults_of(text):
    with pytest.raises(op.OptipathError) as error:
        read(tomllib.loads(text))
    return error.value.faults


@pytest.mark.parametrize(
    ("old", "new", "cause"),
    [
        ('"30 deg"', "45", "parameters.theta.default: 45 has no unit"),
        ('"30 deg"', '"30 nm"', "'30 nm' is no angle"),
        ('"30 deg"', '"30 dge"', "did you mean 'deg'?"),
        ('"30 deg"', '"100 deg"', "outside its range"),
        ('"30 deg"', '"up"', "no word 'up'"),
        ('"30 deg"', "true", "true is not a number"),
        ('unit = "deg"\n', "", 'declares no unit, but its values have one; add unit = "deg"'),
        (DECLARED, "default = 45", 'add unit = "deg" or another, and write its values as in "1'),
        (DECLARED, "default = 45\nrange = [0, 90]", 'add unit = "deg"'),
        ('unit = "deg"', 'unit = "degg"', "did you mean 'deg'?"),
        ('unit = "deg"', 'unit = "nm"', "parameters.theta is in nm, but '30 deg' is an angle"),
        (
            DECLARED,
            'default = "3 nm"\nunit = "nm"',
            "is in nm, but filter.angle takes an angle",
        ),
        ('unit = "deg"', "unit = 3", "'unit' must be a text"),
        ('["0 deg", "90 deg"]', "[0, 90]", "parameters.theta.range: 0 has no unit"),
        ('["0 deg", "90 deg"]', '["0 deg"]', "two ends"),
        ('["0 deg", "90 deg"]', '["90 deg", "0 deg"]', "begin with the lower end"),
        ("range = [", "rnge = [", "did you mean 'range'?"),
        (
            "default = 1.2\nrange = [0, inf]",
            'default = "3 deg"\nunit = "deg"',
            "parameters.n is in",
        ),
        ("default = 1.2", 'default = "1.2 nm"', "parameters.n declares no unit"),
        ("[parameters.theta]", "[parameters.thta]", "filter.angle and elements.mirror.incidence"),
        ("[parameters.theta]", "[parameter.theta]", "did you mean 'parameters'?"),
        (f"[parameters.theta]\n{DECLARED}", "[parameters]\ntheta = 3", "theta must be a table"),
        ('"$theta"', '"$phi"', "'$phi' is not declared"),
        ('"$theta"', '"30 deg"', "'theta' is declared, but no element takes it"),
        ("[elements.", "[element.", "did you mean 'elements'?"),
        ('kind = "polarizer"', 'kind = "polariser"', "did you mean 'polarizer'?"),
        ('kind = "source"', 'kind = "sorce"', "did you mean 'source'?"),
        ('kind = "polarizer"', "", "kind is missing"),
        ('kind = "polarizer"', 'knd = "polarizer"', "did you mean 'kind'?"),
        (
            '[elements.filter]\nkind = "polarizer"\nangle = "$theta"\n',
            "",
            "'filter' does not exist",
        ),
        ("[elements.filter]", "[elements.polarizer]", "links[0] and links[1]: node 'filter'"),
        ("index =", "indx =", "did you mean 'index'?"),
        (f"index = {INDEX}\n", "", "'index' is missing"),
        (INDEX, '"gold"', "'gold'"),
        (INDEX, '{ n = "$nn", k = 7.0 }', "elements.mirror.index.n: parameter '$nn' is not"),
        (INDEX, '{ n = "$n", kk = 7.0 }', "key 'kk' is unknown"),
        ("filter.out", "filter.output", "did you mean 'filter.out'?"),
        ('to = "filter.in"', 'too = "filter.in"', "did you mean 'to'?"),
        ('to = "filter.in"\n', "", "'to' is missing"),
        ('"lamp.out"\nto = "filter.in"', '"filter.in"\nto = "lamp.out"', "swap 'from' and 'to'"),
        ('azimuth = "10 deg"', 'azimuth = "$rho"', "'$rho' is not declared"),
        ("values = {", "value = {", "did you mean 'values'?"),
        ("n = 1.5 }", "m = 1.5 }", "parameter 'm' is unknown"),
        (
            'incidence = "$theta"',
            'incidence = { paramter = "theta", scale = 2 }',
            "did you mean 'parameter'?",
        ),
        ("format = 1\n", "", "'format' is missing"),
    ],
)
def test_one_cause_is_one_fault(old, new, cause):
    assert old in GOOD
    (fault,) = faults_of(GOOD.replace(old, new))
    assert cause in fault


SLAB = """
format = 1
[parameters.theta]
default = "40 deg"
unit = "deg"
[elements.lamp]
kind = "source"
[elements.back]
kind = "interface"
index = 1.0
outside = "follows"
incidence = "follows"
[elements.front]
kind = "interface"
index = 1.5
outside = 1.0
incidence = { parameter = "theta", scale = 1 }
[elements.eye]
kind = "detector"
[[links]]
from = "lamp.out"
to = "front.in"
[[links]]
from = "front.transmitted"
to = "back.in"
[[links]]
from = "back.transmitted"
to = "eye.in"
"""


@pytest.mark.parametrize(
    ("old", "new", "cause"),
    [
        ("outside = 1.0", 'outside = "1.2-0.1j"', "front.outside is (1.2-0.1j)"),
        ("scale = 1", "scale = 3", "parameter 'theta' (at front.incidence, as 3 * theta) is 120"),
        ('unit = "deg"', 'unit = "deg"\noptional = true', "front.incidence cannot be left out"),
    ],
)
def test_what_a_boundary_takes_over_is_told_where_it_is_written(old, new, cause):
    assert SLAB.count(old) == 1
    (fault,) = faults_of(SLAB.replace(old, new))
    assert cause in fault


def test_each_cause_of_several_is_told():
    text = GOOD.replace('"30 deg"', "45").replace('"polarizer"', '"polariser"')
    text = text.replace("eye.in", "eye.inn").replace("n = 1.5", 'n = "x"')
    found = faults_of(text)
    assert len(found) == 4
    for cause, fault in zip(("45 has", "polariser", "eye.inn", "steep.n"), found, strict=True):
        assert cause in fault


def test_a_missing_link_is_told_where_it_is_missing_and_not_all_along_the_way():
    found = faults_of(GOOD.replace('[[links]]\nfrom = "filter.out"\nto = "mirror.in"\n', ""))
    assert len(found) == 2
    assert "node 'mirror' is reached by no source" in found[0]
    assert "node 'filter' reaches no detector" in found[1]


@pytest.mark.parametrize(
    ("old", "new", "causes"),
    [
        ("[cases", '[[links]]\nfrom = "lamp.out"\nto = "eye.in"\n\n[cases', ["'lamp.out' feeds"]),
        (
            '[[links]]\nfrom = "mirror.reflected"\nto = "eye.in"\nazimuth = "10 deg"\n',
            "",
            ["'eye' is reached by no source", "'mirror' reaches no detector"],
        ),
        ('element = "filter"', 'element = "mirror"', ["not go straight through 'mirror'"]),
        ('element = "filter"', 'element = "eye"', ["'eye' has no way out"]),
        ('light = "lamp.out"', 'light = "mirror.transmitted"', ["place 'light': 'mirror.trans"]),
        (
            'light = "lamp.out", eye = "mirror',
            'light = "lamp.outt", eye = "miror',
            ["did you mean 'lamp.out'?", "did you mean 'mirror'?"],
        ),
    ],
)
def test_a_choice_is_at_fault_only_where_the_path_is_not(old, new, causes):
    text = GOOD + OFFERED
    assert old in text
    found = faults_of(text.replace(old, new))
    assert len(found) == len(causes)
    for cause, fault in zip(causes, found, strict=True):
        assert cause in fault


def test_names_in_a_choice_are_told_with_other_faults():
    text = (GOOD + OFFERED).replace('element = "filter"', 'element = "filtr"')
    found = faults_of(text.replace("default = 1.2", "default = -1.2"))
    assert any("choices.place: node 'filtr' does not exist" in fault for fault in found)
    assert len(found) == 2


def test_a_link_that_closes_a_cycle_is_told_by_the_cycle_alone():
    """And not by the media that light meets there, or by the ends that it does not reach."""
    text = GOOD.replace("k = 7.0", "k = 0.0").replace('"eye.in"', '"mirror.back"')
    (fault,) = faults_of(text.replace('azimuth = "10 deg"\n', ""))
    assert "light goes round in a cycle: mirror -> mirror" in fault


def test_an_empty_file_has_no_format_and_no_elements():
    assert len(faults_of("")) == 2
