"""Faults of files: one for each cause, with its place and a cure that does when it is followed."""

import tomllib

import pytest

import optipath as op
from optipath.paths.files.reader import read
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
INDEX = '{ n = "$n", k = 7.0 }'
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
index = {INDEX}
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
[choices.place]
element = "filter"
behind = {{ light = "lamp.out", eye = "mirror.reflected" }}
"""
SECOND_LINK = '[[links]]\nfrom = "{}"\nto = "{}"\n[cases.steep]'
OF_EYE = 'kind = "detector"'
FRAME = OF_EYE + "\nframes = {{ in = {{ x = {}, y = [0, 1, 0], z = [0, 0, {}] }} }}"
BEHIND = 'behind = { light = "lamp.out", eye = "mirror.reflected" }'
NO_PLACES = "{}", "{ eye = 3 }", '{ "" = "lamp.out" }'
INCIDENCE = 'incidence = "$theta"'


def faults_of(text):
    with pytest.raises(op.OptipathError) as error:
        read(tomllib.loads(text))
    return error.value.faults


ROOT_CAUSES = [
    ('"30 deg"', "45", "parameters.theta.default: 45 has no unit"),
    ('"30 deg"', '"30 nm"', "'30 nm' is no angle"),
    ('"30 deg"', '"30 dge"', "did you mean 'deg'?"),
    *(('"30 deg"', '"100 deg"', "outside its range"), ('"30 deg"', '"up"', "no word 'up'")),
    ('"30 deg"', "true", "true is not a number"),
    ('unit = "deg"\n', "", "'theta' has values in deg, but no unit; write unit = \"deg\""),
    (
        DECLARED,
        "default = 45",
        'in no unit, but mirror.incidence takes an angle; write unit = "deg"',
    ),
    ('unit = "deg"', 'unit = "degg"', "unit 'degg' is unknown; did you mean 'deg'?"),
    (
        'unit = "deg"',
        'unit = "nm"',
        "minimum of parameter 'theta': '0 deg' is no length | maximum of",
    ),
    (DECLARED, 'default = "3 nm"\nunit = "nm"', "is in nm, but mirror.incidence takes an angle"),
    ('unit = "deg"', "unit = 3", "'unit' must be a text"),
    ('["0 deg", "90 deg"]', "[0, 90]", "parameters.theta.range: 0 has no unit"),
    ('["0 deg", "90 deg"]', '["0 deg"]', "two ends, not 1"),
    ('["0 deg", "90 deg"]', '["90 deg", "0 deg"]', "begin with the lower end"),
    ("[0, inf]", "[0, [1, 2]]", "the maximum of parameter 'n' must be a number, not [1, 2]"),
    ("range = [", "rnge = [", "did you mean 'range'?"),
    (
        "default = 1.2\nrange = [0, inf]",
        'default = "3 deg"\nunit = "deg"',
        "mirror.index.n takes a pure number",
    ),
    (
        "default = 1.2",
        'default = "1.2 nm"',
        "parameters.n: parameter 'n' has values in nm, but no unit",
    ),
    ("[parameters.theta]", "[parameters.thta]", "filter.angle and elements.mirror.incidence"),
    (
        "[parameters.theta]",
        "[parameters.the-ta]",
        "parameter name 'the-ta' | '$theta' is",
    ),
    ("[parameters.theta]", "[parameter.theta]", "did you mean 'parameters'?"),
    (f"[parameters.theta]\n{DECLARED}", "[parameters]\ntheta = 3", "theta: 3 must be a table"),
    ('"$theta"', '"$thta"', "'$thta' is not declared; did you mean '$theta'"),
    ('"$theta"', '"30 deg"', "'theta' is declared, but no element takes it"),
    ('kind = "polarizer"', 'kind = "polariser"', "did you mean 'polarizer'?"),
    ('kind = "source"', 'kind = "sorce"', "'sorce' is unknown; did you mean 'source'?"),
    ('kind = "polarizer"', "", "elements.filter: its kind is missing"),
    (FILTER, "", "'filter' does not exist"),
    ("[elements.filter]", "[elements.polarizer]", "links[0] and links[1]: node"),
    ("[elements.eye]", "[elements.'e.y']", "'e.y' must be a text | 'eye' does not"),
    (FILTER, f"{FILTER}[elements.extra]\nkind = 'dump'\n", "'extra' is reached"),
    ("index =", "indx =", "key 'indx' is unknown; did you mean 'index'?"),
    *((f"index = {INDEX}\n", "", "'index' is missing"), (INDEX, '"gold"', "'gold'")),
    *((INDEX, "[]", "an empty list is no value"), (INDEX, f"{10**400}", "too large a number")),
    (INDEX, "{ n = [1, 2], k = [3, 4, 5] }", "mirror.index.n"),
    (INDEX, '{ n = "$nn", k = 7.0 }', "elements.mirror.index.n: parameter '$nn' is not"),
    (INDEX, '{ n = "$n", kk = 7.0 }', "key 'kk' is unknown"),
    ("k = 7.0", "k = -7.0", "mirror.index.k is -7"),
    ("k = 7.0", "k = nan", "mirror.index.k is nan"),
    ("k = 7.0", f"k = {10**400}", "mirror.index.k"),
    (INDEX, "{ n = '1.2 nm', k = 7.0 }", "pure number"),
    (INCIDENCE, 'incidence = "30 dge"', "'dge' of '30 dge' is unknown; did you"),
    (INCIDENCE, "incidence = 30", "30 has no unit, but an angle is asked for"),
    (INCIDENCE, "incidence = true", "true is not a number"),
    (INCIDENCE, 'incidence = "100 deg"', "mirror.incidence is 100 deg"),
    (INCIDENCE, 'incidence = { paramter = "theta", scale = 2 }', "did you mean 'parameter'?"),
    (INCIDENCE, f"{INCIDENCE}\nazimuth = {10**20}", f"azimuth: {10**20} has no unit"),
    (OF_EYE, f"{OF_EYE}\nframes = 3", "'frames' must be a table"),
    (OF_EYE, f"{OF_EYE}\nframes = {{ in = {{ x = [1, 0, 0] }} }}", "'y' is miss | 'z' is miss"),
    (OF_EYE, FRAME.format("['a', 0, 0]", 1), "must be numbers"),
    (OF_EYE, FRAME.format("[1, 0, 0]", 2), "unit vectors"),
    (OF_EYE, FRAME.format("[1, 0, 0]", 1).replace("in =", "inn ="), "'eye.inn' does not exist"),
    ("filter.out", "filter.output", "did you mean 'filter.out'?"),
    ("mirror.in", "miror.in", "node 'miror' does not exist; did you mean 'mirror'"),
    ('to = "filter.in"', 'too = "filter.in"', "did you mean 'to'?"),
    ('to = "filter.in"', "to = 3", "'to' must be a text"),
    ('to = "filter.in"\n', "", "'to' is missing"),
    (
        '"lamp.out"\nto = "filter.in"',
        '"filter.in"\nto = "lamp.out"',
        "'filter.in' lets | 'lamp.out' lets",
    ),
    ('azimuth = "10 deg"', 'azimuth = "$rho"', "'$rho' is not declared"),
    ('azimuth = "10 deg"', 'azimuth = "10 nm"', "links[2].azimuth: '10 nm' is no angle"),
    ("[cases.steep]", SECOND_LINK.format("lamp.out", "eye.in"), "'lamp.out' feeds"),
    (LAST, "", "'eye' is reached by no source | 'mirror' reaches no detector"),
    ("values = {", "value = {", "key 'value' is unknown; did you mean 'values'?"),
    ("n = 1.5 }", "m = 1.5 }", "parameter 'm' is unknown"),
    ('theta = "80 deg"', 'thta = "80 deg"', "cases.steep: parameter 'thta' is unknown; did you"),
    (
        'theta = "80 deg"',
        'theta = "100 deg"',
        "steep.theta: parameter 'theta' is 100 deg",
    ),
    ("{ eye = [1, 0, 0, 0] }", "{ ey = [1, 2, 3, 4] }", "did you mean 'eye'"),
    ("{ eye = [1, 0, 0, 0] }", "{ eye = [1, 2] }", "four finite numbers"),
    ("format = 1\n", "", "'format' is missing"),
    ("format = 1", "format = true", "'format' must be a whole number"),
    ("description =", "desciption =", "key 'desciption' is unknown; did you mean 'description'"),
    ("[cases.steep]", "[cases.all]", "'all' stands for every case; give this one another name"),
    ("[cases.steep]", '[cases.""]', 'cases."" has no name; give it one'),
    *((BEHIND, f"behind = {to}", "choices.place: a choice of places is") for to in NO_PLACES),
    ('element = "filter"', 'element = "filtr"', "choices.place: node 'filtr' does not exist"),
    ('element = "filter"', 'element = "mirror"', "not go straight through 'mirror'"),
    ('element = "filter"', 'element = "eye"', "'eye' has no way out"),
    ('light = "lamp.out"', 'light = "mirror.transmitted"', "place 'light': 'mirror.trans"),
    ('light = "lamp.out", eye = "m', 'light = "lamp.outt", eye = "', "lamp.out'? | 'mirror'?"),
]
SECOND = '[[links]]\nfrom = "filter.out"\nto = "mirror.in"\n'
LIT, UNLIT = '"lamp.out"\n', '"lamp.uot"\n'
ALONE = f'{FILTER}[elements.alone]\nkind = "polarizer"\n'
ROUND = '[[links]]\nfrom = "mirror.reflected"\nto = "mirror.back"\n'
SEVERAL = [
    (
        {'"30 deg"': "45", '"polarizer"': '"polariser"', "eye.in": "eye.inn", "n = 1.5": 'n = "x"'},
        "45 has | polariser | eye.inn",
    ),
    (
        {'"source"': '"sorce"', "k = 7.0": "k = -7.0", "mirror.reflected": "mirror.reflectd"}
        | {"range = [0": "rnge = [0", "10 deg": "10 dge", 'theta = "80 deg"': 'thta = "80 deg"'},
        "rnge | sorce | reflectd | dge",
    ),
    # A link that is missing is told where it is, and not all along the way.
    ({SECOND: ""}, "node 'mirror' is reached by no source | node 'filter' reaches no detector"),
    ({LIT: UNLIT, FILTER: ALONE}, "did you mean 'lamp.out'"),
    ({'kind = "source"': 'kind = "polarizer"', LIT: UNLIT}, "lamp.uot"),
    # A cycle alone is told, not the media that light meets there, nor ends that it misses.
    ({"k = 7.0": "k = 0.0", LAST: ROUND}, "light goes round in a cycle: mirror -> mirror"),
    (
        {'"source"': '"sorce"', OF_EYE: 'kind = "polarizer"\nazimuth = "3 deg"'}
        | {"[cases.steep]": SECOND_LINK.format("mirror.reflected", "mirror.in")},
        "sorce",
    ),
    ({"default = 1.2": "default = -1.2", '"filter"': '"filtr"'}, "'n' is -1.2"),
]


@rows("changes, causes", [*(({old: new}, told) for old, new, told in ROOT_CAUSES), *SEVERAL])
def test_one_cause_is_one_fault_and_causes_of_their_own_are_all_told_at_once(changes, causes):
    assert [*read(tomllib.loads(GOOD))] == ["lamp", "filter", "mirror", "eye"]
    text = GOOD
    for old, new in changes.items():
        assert old in text
        text = text.replace(old, new)
    found = faults_of(text)
    for cause in causes.split(" | "):
        assert sum(cause in fault for fault in found) == 1, cause
    assert len(found) == causes.count(" | ") + 1
    assert len(faults_of("")) == 2


LIGHT = '[elements.L]\nkind = "source"\n'
EYE = '[elements.E]\nkind = "detector"\n'
LINKS = '[[links]]\nfrom = "L.out"\nto = "{}"\n[[links]]\nfrom = "{}"\nto = "E.in"\n'
THETA = '[parameters.theta]\ndefault = "40 deg"\nunit = "deg"\n[parameters.n]\ndefault = 1.5\n'


def fault_of(text, folder):
    with pytest.raises(op.OptipathError) as error:
        loaded("format = 1\n" + text, folder)
    return str(error.value)


def through(element, leaves="out"):
    return f"{LIGHT}{EYE}[elements.X]\n{element}\n{LINKS.format('X.in', f'X.{leaves}')}"


def face(index="1.5", outside="1.0", incidence='"40 deg"'):
    about = f"index = {index}\noutside = {outside}\nincidence = {incidence}"
    return f'kind = "interface"\n{about}'


def boundary(*index, **others):
    return through(face(*index, **others), "reflected")


def slab(second, **first):
    links = LINKS.format("X.in", "Y.transmitted")
    links += '[[links]]\nfrom = "X.transmitted"\nto = "Y.in"\n'
    return f"{LIGHT}{EYE}[elements.X]\n{face(**first)}\n[elements.Y]\n{second}\n{links}"


AIR, TAKING = 'kind = "interface"\nindex = 1\n', face("1", '"follows"', '"follows"')
OF_THETA = {"index": '"$n"', "incidence": '{ parameter = "theta", scale = 3 }'}
OPTIONAL = THETA.replace('"deg"', '"deg"\noptional = true')
IN_FEET = THETA.replace('unit = "deg"', 'unit = "foot"')
MATRIX = 'kind = "mueller"\nmatrix = [[2,0,0,0],[0,2,0,0],[0,0,2,0],[0,0,0,2]]'
TURNED = boundary('"$n"', incidence='"$theta"')
CROWDED = TURNED + '[cases.steep]\ntheta = "80 deg"\n'
OF_STATE = through("kind = 'polarizer'").replace(LIGHT, LIGHT + "stokes = [1, 1, 1, 1]\n")
NO_KIND = boundary('"$n"').replace('kind = "interface"\n', "")


# How a parameter is written.
PARAMETERS = [
    ('"theta"', "'theta' is no number; write \"$theta\" for the parameter"),
    ('"$thta"', "parameter '$thta' is not declared; did you mean '$theta'?"),
    *(
        (text, 'write a multiple as { parameter = "NAME", scale = 0.5')
        for text in ('"$theta/2"', '"90 deg - $theta"', '"sin($theta)"', '"$theta + $n"')
    ),
]


@rows(
    "text, cure",
    [
        *((text, "physical = false for ") for text in (OF_STATE, through(MATRIX))),
        (slab(AIR + 'incidence = "25 deg"'), 'outside = 1.5, or "follows" for outside'),
        (slab(face("1", '"follows"', '"20 deg"')), 'of "follows" (faces behind one that'),
        (boundary(outside='"folows"'), "'folows' is no number; did you mean \"follows\"?"),
        (boundary(outside='"FOLLOWS"'), "'FOLLOWS' is no number; did you mean \"follows\"?"),
        (boundary(outside='"air"'), "'air' is no number; give n and k as numbers, such as { n ="),
        (boundary() + 'tap = "yes"\n', "'tap' must be true or false"),
        (boundary(incidence='"1 deg"\nparallel = 0'), "give true or false"),
        (boundary(index='"gold"'), "n and k as numbers, such as { n = 0.18, k = 3.4 }"),
        (LIGHT, 'no detector; add one, such as [elements.detector] with kind = "detector"'),
        (EYE, 'no source; add one, such as [elements.source] with kind = "source"'),
        # What a boundary takes over is told where it is written.
        (slab(TAKING, outside='"1.2-0.1j"'), "X.outside is (1.2-0.1j)"),
        (THETA + slab(TAKING, **OF_THETA), "'theta' (at X.incidence, as 3 * theta) is 120"),
        (OPTIONAL + slab(TAKING, index='"$n"', incidence='"$theta"'), "cannot be left out"),
        (IN_FEET + TURNED, "parameters.theta: unit 'foot' is unknown; there are: deg, rad, mrad"),
        (THETA + CROWDED, "key 'theta' is unknown; there are: values, published, note"),
        *((text, 'kind is missing; write kind = "..."') for text in (NO_KIND, THETA + NO_KIND)),
        (THETA.replace('"40 deg"\nunit = "deg"\n', "0.7\n") + TURNED, 'write unit = "deg"'),
        ("[parameters.n]\ndefault = [1.5, -1]\n" + boundary('"$n"'), "is -1.0 at 1; give an index"),
        *((THETA + boundary('"$n"', incidence=value), cure) for value, cure in PARAMETERS),
    ],
)
def test_a_cure_can_be_written_into_the_file(text, cure, tmp_path):
    fault = fault_of(text, tmp_path)
    assert cure in fault
    assert "faults" not in fault
    for other in ("op.FOLLOWS", "=False", "Material(", "Detector(", "Source("):
        assert other not in fault
    with pytest.raises(op.OptipathError, match=r"did you mean op.FOLLOWS\?"):
        op.Interface(1.5, 0.3, outside="follows")  # In Python it is written in Python.


@rows("name, told", [("all", "'all' stands for every case"), ("", "has no name; give it one")])
def test_a_case_that_nobody_could_ask_for_is_not_written(name, told):
    path = read(tomllib.loads(GOOD))
    path.cases[name] = path.cases["steep"]
    with pytest.raises(op.errors.PathError, match=told):
        path.to_toml()
    path.cases = {"odd": op.Case({"thta": 0.1})}
    with pytest.raises(op.errors.PathError, match=r"case 'odd'.*did you mean 'theta'"):
        path.to_toml()
