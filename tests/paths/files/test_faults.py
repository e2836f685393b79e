"""Faults of files: one for each cause, with its place and a cure that does when it is followed."""

import tomllib

import pytest

import optipath as op
from optipath.paths.presets.reader.document import read
from tables import rows
from wired import read as loaded

DECLARED = """default = "30 deg"
unit = "deg"
range = ["0 deg", "90 deg"]"""
FILTER = """[elements.filter]
kind = "polarizer"
angle = "$theta"
"""
LAST = """[[links]]
from = "mirror.reflected"
to = "eye.in"
azimuth = "10 deg"
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

{LAST}
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


def test_a_path_without_a_fault_is_read_and_cycles_and_choices_are_told_beside_others():
    assert [*read(tomllib.loads(GOOD + OFFERED))] == ["lamp", "filter", "mirror", "eye"]
    text = GOOD.replace('"source"', '"sorce"').replace(
        "[cases.steep]", SECOND_LINK.format("mirror.reflected", "mirror.in")
    )
    text = text.replace('kind = "detector"', 'kind = "polarizer"\nazimuth = "3 deg"')
    faults = " | ".join(faults_of(text))
    for part in ("sorce", "cycle: mirror -> mirror", "give it in one place"):
        assert part in faults
    text = (GOOD + OFFERED).replace('element = "filter"', 'element = "filtr"')
    found = faults_of(text.replace("default = 1.2", "default = -1.2"))
    assert any("choices.place: node 'filtr' does not exist" in fault for fault in found)
    assert len(found) == 2


ROOT_CAUSES = [
    ('"30 deg"', "45", "parameters.theta.default: 45 has no unit"),
    ('"30 deg"', '"30 nm"', "'30 nm' is no angle"),
    ('"30 deg"', '"30 dge"', "did you mean 'deg'?"),
    ('"30 deg"', '"100 deg"', "outside its range"),
    ('"30 deg"', '"up"', "no word 'up'"),
    ('"30 deg"', "true", "true is not a number"),
    ('unit = "deg"\n', "", 'declares no unit, but its values have one; add unit = "deg"'),
    (DECLARED, "default = 45", 'add unit = "deg" or another, and write its values as in "1'),
    (DECLARED, "default = 45\nrange = [0, 90]", 'add unit = "deg"'),
    ('unit = "deg"', 'unit = "degg"', "unit 'degg' is unknown; did you mean 'deg'?"),
    ('unit = "deg"', 'unit = "nm"', "parameters.theta is in nm, but '30 deg' is an angle"),
    (DECLARED, 'default = "3 nm"\nunit = "nm"', "is in nm, but filter.angle takes an angle"),
    ('unit = "deg"', "unit = 3", "'unit' must be a text"),
    ('["0 deg", "90 deg"]', "[0, 90]", "parameters.theta.range: 0 has no unit"),
    ('["0 deg", "90 deg"]', '["0 deg"]', "two ends, not 1"),
    ('["0 deg", "90 deg"]', '["90 deg", "0 deg"]', "begin with the lower end"),
    ("[0, inf]", "[0, [1, 2]]", "the ends of 'range' must be single values"),
    ("range = [", "rnge = [", "did you mean 'range'?"),
    ("default = 1.2\nrange = [0, inf]", 'default = "3 deg"\nunit = "deg"', "parameters.n is in"),
    ("default = 1.2", 'default = "1.2 nm"', "parameters.n declares no unit"),
    ("[parameters.theta]", "[parameters.thta]", "filter.angle and elements.mirror.incidence"),
    ("[parameters.theta]", "[parameter.theta]", "did you mean 'parameters'?"),
    (f"[parameters.theta]\n{DECLARED}", "[parameters]\ntheta = 3", "theta must be a table"),
    ('"$theta"', '"$phi"', "'$phi' is not declared"),
    ('"$theta"', '"$thta"', "'$thta' is not declared; did you mean '$theta'"),
    ('"$theta"', '"30 deg"', "'theta' is declared, but no element takes it"),
    ("[elements.", "[element.", "did you mean 'elements'?"),
    ('kind = "polarizer"', 'kind = "polariser"', "did you mean 'polarizer'?"),
    ('kind = "source"', 'kind = "sorce"', "'sorce' is unknown; did you mean 'source'?"),
    ('kind = "polarizer"', "", "elements.filter: kind is missing"),
    ('kind = "polarizer"', 'knd = "polarizer"', "did you mean 'kind'?"),
    ('kind = "polarizer"', "kind = 3", "'kind' must be a text, not 3"),
    (FILTER, "", "'filter' does not exist"),
    ("[elements.filter]", "[elements.polarizer]", "links[0] and links[1]: node 'filter'"),
    ("index =", "indx =", "key 'indx' is unknown; did you mean 'index'?"),
    (f"index = {INDEX}\n", "", "'index' is missing"),
    (INDEX, '"gold"', "'gold'"),
    (INDEX, '{ n = "$nn", k = 7.0 }', "elements.mirror.index.n: parameter '$nn' is not"),
    (INDEX, '{ n = "$n", kk = 7.0 }', "key 'kk' is unknown"),
    ("k = 7.0", "k = -7.0", "mirror.index.k is -7"),
    ("k = 7.0", "k = nan", "mirror.index.k is nan"),
    ("filter.out", "filter.output", "did you mean 'filter.out'?"),
    ("mirror.in", "miror.in", "node 'miror' does not exist; did you mean 'mirror'"),
    ('to = "filter.in"', 'too = "filter.in"', "did you mean 'to'?"),
    ('to = "filter.in"', "to = 3", "'to' must be a text"),
    ('to = "filter.in"\n', "", "'to' is missing"),
    ('"lamp.out"\nto = "filter.in"', '"filter.in"\nto = "lamp.out"', "swap 'from' and 'to'"),
    ('azimuth = "10 deg"', 'azimuth = "$rho"', "'$rho' is not declared"),
    ('azimuth = "10 deg"', 'azimuth = "10 nm"', "links[2].azimuth: '10 nm' is no angle"),
    ("values = {", "value = {", "key 'value' is unknown; did you mean 'values'?"),
    ("n = 1.5 }", "m = 1.5 }", "parameter 'm' is unknown"),
    ('theta = "80 deg"', 'thta = "80 deg"', "cases.steep: parameter 'thta' is unknown; did you"),
    ('theta = "80 deg"', 'theta = "100 deg"', "cases.steep.theta is 100 deg, outside its"),
    ("{ eye = [1, 0, 0, 0] }", "{ ey = [1, 2, 3, 4] }", "did you mean 'eye'"),
    ("{ eye = [1, 0, 0, 0] }", "{ eye = [1, 2] }", "four finite numbers"),
    (
        'incidence = "$theta"',
        'incidence = { paramter = "theta", scale = 2 }',
        "did you mean 'parameter'?",
    ),
    ("format = 1\n", "", "'format' is missing"),
    ("format = 1", "format = true", "'format' must be a whole number"),
    ("description =", "desciption =", "key 'desciption' is unknown; did you mean 'description'"),
    (FILTER, f"{FILTER}[elements.extra]\nkind = 'dump'\n", "'extra' is reached"),
]


@rows("old, new, cause", ROOT_CAUSES)
def test_one_cause_is_one_fault(old, new, cause):
    assert old in GOOD
    (fault,) = faults_of(GOOD.replace(old, new))
    assert cause in fault


@rows(
    "old, new, cause",
    [
        ("[elements.eye]", "[elements.'e.y']", "node name 'e.y'"),
        ("[parameters.theta]", "[parameters.the-ta]", "parameter name 'the-ta'"),
        ('incidence = "$theta"', 'incidence = "30 dge"', "'dge' of '30 dge' is unknown; did you"),
        ('incidence = "$theta"', "incidence = 30", "30 has no unit, but an angle is asked for"),
        ('incidence = "$theta"', "incidence = true", "true is not a number"),
        ('incidence = "$theta"', 'incidence = "100 deg"', "mirror.incidence is 100 deg"),
        ('{ n = "$n", k = 7.0 }', "{ n = '1.2 nm', k = 7.0 }", "pure number"),
    ],
)
def test_each_fault_is_named_among_what_follows_from_it(old, new, cause):
    assert old in GOOD
    assert any(cause in fault for fault in faults_of(GOOD.replace(old, new)))


SLAB = """
format = 1
parameters.theta = { default = "40 deg", unit = "deg" }
links = [
    { from = "lamp.out", to = "front.in" },
    { from = "front.transmitted", to = "back.in" },
    { from = "back.transmitted", to = "eye.in" },
]
[elements]
lamp = { kind = "source" }
back = { kind = "interface", index = 1.0, outside = "follows", incidence = "follows" }
eye = { kind = "detector" }
[elements.front]
kind = "interface"
index = 1.5
outside = 1.0
incidence = { parameter = "theta", scale = 1 }
"""


@rows(
    "old, new, cause",
    [
        ("outside = 1.0", 'outside = "1.2-0.1j"', "front.outside is (1.2-0.1j)"),
        ("scale = 1", "scale = 3", "parameter 'theta' (at front.incidence, as 3 * theta) is 120"),
        ('unit = "deg"', 'unit = "deg", optional = true', "front.incidence cannot be left out"),
    ],
)
def test_what_a_boundary_takes_over_is_told_where_it_is_written(old, new, cause):
    assert SLAB.count(old) == 1
    (fault,) = faults_of(SLAB.replace(old, new))
    assert cause in fault


SECOND_LINK = '[[links]]\nfrom = "{}"\nto = "{}"\n\n[cases.steep]'


@rows(
    "changes, causes",
    [
        (
            {
                '"30 deg"': "45",
                '"polarizer"': '"polariser"',
                "eye.in": "eye.inn",
                "n = 1.5": 'n = "x"',
            },
            ["45 has", "polariser", "eye.inn", "steep.n"],
        ),
        (
            {'"source"': '"sorce"', "k = 7.0": "k = -7.0", "reflected": "reflectd"}
            | {
                "range = [0": "rnge = [0",
                "10 deg": "10 dge",
                'theta = "80 deg"': 'thta = "80 deg"',
            },
            ["rnge", "sorce", "mirror.index.k", "reflectd", "dge", "thta"],
        ),
        (  # A link that is missing is told where it is, and not all along the way.
            {'[[links]]\nfrom = "filter.out"\nto = "mirror.in"\n': ""},
            ["node 'mirror' is reached by no source", "node 'filter' reaches no detector"],
        ),
        (LAST, ["'eye' is reached by no source", "'mirror' reaches no detector"]),
        (
            {"lamp.out": "lamp.uot", FILTER: f'{FILTER}[elements.alone]\nkind = "polarizer"\n'},
            ["did you mean 'lamp.out'", "'alone' is reached by no source"],
        ),
        ({'kind = "source"': 'kind = "polarizer"', "lamp.out": "lamp.uot"}, ["lamp.uot", "no sou"]),
        # A cycle alone is told, not the media that light meets there, nor ends that it misses.
        (
            {"k = 7.0": "k = 0.0", '"eye.in"': '"mirror.back"', 'azimuth = "10 deg"\n': ""},
            ["light goes round in a cycle: mirror -> mirror"],
        ),
        ({GOOD: ""}, ["", ""]),
    ],
)
def test_causes_of_their_own_are_all_told_at_once_and_nothing_else(changes, causes):
    text = GOOD
    for old, new in (changes if isinstance(changes, dict) else {changes: ""}).items():
        assert old in text
        text = text.replace(old, new)
    found = faults_of(text)
    for cause in causes:
        assert cause == "" or sum(cause in fault for fault in found) == 1, cause
    assert len(found) == len(causes)


@rows(
    "old, new, causes",
    [
        ("[cases.steep]", SECOND_LINK.format("lamp.out", "eye.in"), ["'lamp.out' feeds"]),
        (LAST, "", ["'eye' is reached by no source", "'mirror' reaches no detector"]),
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


@rows(
    "new",
    [
        f"index = {10**400}",
        "index = { n = [1, 2], k = [3, 4, 5] }",
        "index = []",
        "outside = { n = 1.1, k = 2 }",
        f"azimuth = {10**20}",
        "frames = { xy = { x = [1, 0, 0], y = [0, 1, 0], z = [0, 0, 1] } }",
        "frames = { in = { xy = [1, 0, 0] } }",
    ],
)
def test_odd_values_are_faults_and_nothing_else(new):
    assert faults_of(GOOD.replace(f"index = {INDEX}", new))


@rows(
    "frames, message",
    [
        ("3", "must be tables"),
        ("{ in = { x = [1, 0, 0] } }", "axis 'y' is missing"),
        ("{ in = { x = ['a', 0, 0], y = [0, 1, 0], z = [0, 0, 1] } }", "must be numbers"),
        ("{ in = { x = [1, 0, 0], y = [0, 1, 0], z = [0, 0, 2] } }", "unit vectors"),
        ("{ inn = { x = [1, 0, 0], y = [0, 1, 0], z = [0, 0, 1] } }", "'eye.inn' does not exist"),
    ],
)
def test_faulty_frames_are_named(frames, message):
    text = GOOD.replace('kind = "detector"', f'kind = "detector"\nframes = {frames}')
    assert any(message in fault for fault in faults_of(text))


LIGHT = '[elements.L]\nkind = "source"\n'
EYE = '[elements.E]\nkind = "detector"\n'
LINKS = """
[[links]]
from = "L.out"
to = "{enters}"
[[links]]
from = "{leaves}"
to = "E.in"
"""


def fault_of(text, folder):
    with pytest.raises(op.OptipathError) as error:
        loaded("format = 1\n" + text, folder)
    return str(error.value)


def through(element, leaves="reflected"):
    links = LINKS.format(enters="X.in", leaves=f"X.{leaves}")
    return f"{LIGHT}{EYE}[elements.X]\n{element}\n{links}"


def slab(second):
    between = '[[links]]\nfrom = "X.transmitted"\nto = "Y.in"\n'
    first = '[elements.X]\nkind = "interface"\nindex = 1.5\nincidence = "40 deg"\n'
    links = LINKS.format(enters="X.in", leaves="Y.transmitted")
    return f'{LIGHT}{EYE}{first}[elements.Y]\nkind = "interface"\n{second}\n{links}{between}'


def boundary(index="1.5", outside="1.0", incidence='"40 deg"'):
    about = f"index = {index}\noutside = {outside}\nincidence = {incidence}"
    return through(f'kind = "interface"\n{about}')


@rows(
    "text, cure",
    [
        (
            LIGHT + "stokes = [1, 1, 1, 1]\n" + EYE + LINKS.format(enters="E.in", leaves="L.out"),
            "physical = false for what is measured",
        ),
        (
            through('kind = "mueller"\nmatrix = [[2,0,0,0],[0,2,0,0],[0,0,2,0],[0,0,0,2]]', "out"),
            "physical = false for what is measured",
        ),
        (slab('index = 1\nincidence = "25 deg"'), 'outside = 1.5, or "follows" for outside'),
        (
            slab('index = 1\noutside = "follows"\nincidence = "20 deg"'),
            'or "follows" (faces are taken as parallel behind one that refracts; if',
        ),
        (boundary(outside='"folows"'), "'folows' is no number; did you mean \"follows\"?"),
        (boundary(outside='"FOLLOWS"'), "'FOLLOWS' is no number; did you mean \"follows\"?"),
        (boundary(outside='"air"'), "'air' is no number; give n and k as numbers, such as { n ="),
        (boundary() + 'tap = "yes"\n', "'tap' must be true or false"),
        (boundary(incidence='"1 deg"\nparallel = 0'), "give true or false"),
        (boundary(index='"gold"'), "n and k as numbers, such as { n = 0.18, k = 3.4 }"),
        (LIGHT, 'no detector; add one, such as [elements.detector] with kind = "detector"'),
        (EYE, 'no source; add one, such as [elements.source] with kind = "source"'),
    ],
)
def test_a_cure_can_be_written_into_the_file(text, cure, tmp_path):
    fault = fault_of(text, tmp_path)
    assert cure in fault
    for python in ("op.FOLLOWS", "=False", "Material(", "Detector(", "Source("):
        assert python not in fault
    with pytest.raises(op.OptipathError, match=r"did you mean op.FOLLOWS\?"):
        op.Interface(1.5, 0.3, outside="follows")  # In Python it is written in Python.


THETA = '[parameters.theta]\ndefault = "40 deg"\nunit = "deg"\n[parameters.n]\ndefault = 1.5\n'
USED = boundary('"$n"', incidence='"$theta"')


@rows(
    "value, cure",
    [
        ('"theta"', "'theta' is no number; write \"$theta\" for the parameter"),
        ('"$thta"', "parameter '$thta' is not declared; did you mean '$theta'?"),
        ('"$theta/2"', 'write { parameter = "theta", scale = 0.5 }'),
        ('"2*$theta"', 'write { parameter = "theta", scale = 2 }'),
        ('"-2 $theta"', 'write { parameter = "theta", scale = -2 }'),
        ('"$theta + 10 deg"', 'write { parameter = "theta", offset = "10 deg" }'),
        ('"90 deg - $theta"', 'write { parameter = "theta", scale = -1, offset = "90 deg" }'),
        ('"sin($theta)"', "write { parameter = "),
        ('"$theta + $n"', "of several parameters, but a value takes one; declare a parameter"),
    ],
)
def test_how_a_parameter_is_written_is_told(value, cure, tmp_path):
    fault = fault_of(THETA + boundary('"$n"', incidence=value), tmp_path)
    assert cure in fault
    assert "faults" not in fault


@rows(
    "text, sentence",
    [
        (
            THETA.replace('unit = "deg"', 'unit = "foo"') + USED,
            "parameters.theta: unit 'foo' is unknown; there are: deg, rad, mrad, arcmin, arcsec",
        ),
        (
            THETA + USED + '[cases.steep]\ntheta = "80 deg"\n',
            (
                "cases.steep: the values of parameters stand in a table of their own; write "
                "values = { theta = ... }"
            ),
        ),
        *(
            (THETA + USED.replace('kind = "interface"\n', "").replace('"$n"', n), "kind is missing")
            for n in ("1.5", '"$n"')
        ),
    ],
)
def test_what_is_missing_or_unknown_in_a_table_is_told_by_its_place(text, sentence, tmp_path):
    told = fault_of(text, tmp_path).removeprefix("path.toml: ")
    assert (
        (sentence in told and 'write kind = "..."' in told)
        if "kind" in sentence
        else (told == sentence)
    )
    assert "must be a text" not in told


@rows("behind", ["{}", "{ eye = 3 }", '{ "" = "L.out" }'])
def test_how_places_are_written_is_told_as_a_file_has_it(behind, tmp_path):
    text = through('kind = "polarizer"\n', "out")
    text += f'[choices.place]\nelement = "X"\nbehind = {behind}\n'
    assert fault_of(text, tmp_path) == (
        "path.toml: choices.place: 'behind' must name a port for each word, such as behind = "
        f'{{ light = "L.out" }}, not {behind}'
    )
    loaded("format = 1\n" + text.replace(behind, '{ light = "L.out" }'), tmp_path)


@rows(
    "name, told",
    [
        ("all", "cases.all: 'all' stands for every case; give this one another name"),
        ('""', 'cases."" has no name; give it one'),
    ],
)
def test_a_case_that_nobody_could_ask_for_is_refused(name, told, tmp_path):
    text = through('kind = "polarizer"', "out") + f"[cases.{name}]\nvalues = {{}}\n"
    assert fault_of(text, tmp_path) == f"path.toml: {told}"
    path = loaded("format = 1\n" + text.replace(name, "steep"), tmp_path)
    path.cases[name.strip('"')] = path.cases["steep"]
    with pytest.raises(op.PathError, match=told.partition(";")[0]):
        path.to_toml()


def test_what_could_not_be_asked_for_is_neither_written_nor_asked_about(tmp_path):
    path = read(tomllib.loads(GOOD))
    path.cases["odd"] = op.Case({"thta": 0.1})
    with pytest.raises(op.PathError, match=r"case 'odd'.*did you mean 'theta'"):
        path.to_toml()
    text = "[parameters.n]\ndefault = [1.5, -1]\n" + boundary('"$n"')
    assert fault_of(text, tmp_path).endswith(
        "is -1.0 at 1; give an index of refraction n + ik with n and k not negative"
    )
    wrong = '[parameters.theta]\ndefault = "40 deg"\n' + boundary(incidence='"$theta"')
    assert 'add unit = "deg", or give pure numbers if it is one' in fault_of(wrong, tmp_path)
    right = wrong.replace("default", 'unit = "deg"\ndefault')
    loaded("format = 1\n" + right, tmp_path).trace()
    pure = GOOD.partition("[cases")[0].replace(DECLARED, "default = 1")
    (fault,) = faults_of(pure)
    assert 'theta is used where an angle is asked for; add unit = "deg" or another' in fault
