"""Cures of faults of files are written as files write them, and do when they are followed."""

import pytest

import optipath as op

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


def fault_of(folder, text):
    file = folder / "wrong.toml"
    file.write_text("format = 1\n" + text)
    with pytest.raises(op.OptipathError) as error:
        op.load_preset(file)
    return str(error.value)


def _written(folder, text):
    file = folder / "right.toml"
    file.write_text("format = 1\n" + text)
    return file


def through(element, leaves):
    links = LINKS.format(enters="X.in", leaves=f"X.{leaves}")
    return f"{LIGHT}{EYE}[elements.X]\n{element}\n{links}"


def slab(second):
    between = '[[links]]\nfrom = "X.transmitted"\nto = "Y.in"\n'
    first = '[elements.X]\nkind = "interface"\nindex = 1.5\nincidence = "40 deg"\n'
    links = LINKS.format(enters="X.in", leaves="Y.transmitted")
    return f'{LIGHT}{EYE}{first}[elements.Y]\nkind = "interface"\n{second}\n{links}{between}'


def boundary(index="1.5", outside="1.0"):
    about = f'kind = "interface"\nindex = {index}\noutside = {outside}\nincidence = "40 deg"'
    return through(about, "reflected")


@pytest.mark.parametrize(
    ("text", "cure"),
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
        (
            through(
                'kind = "interface"\nindex = 1.5\nincidence = "1 deg"\nparallel = 0', "reflected"
            ),
            "give true or false",
        ),
        (boundary(index='"gold"'), "n and k as numbers, such as { n = 0.18, k = 3.4 }"),
        (LIGHT, 'no detector; add one, such as [elements.detector] with kind = "detector"'),
        (EYE, 'no source; add one, such as [elements.source] with kind = "source"'),
    ],
)
def test_a_cure_can_be_written_into_the_file(tmp_path, text, cure):
    fault = fault_of(tmp_path, text)
    assert cure in fault
    for python in ("op.FOLLOWS", "=False", "Material(", "Detector(", "Source("):
        assert python not in fault


def test_a_cure_in_python_is_written_in_python():
    with pytest.raises(op.OptipathError, match=r"did you mean op.FOLLOWS\?"):
        op.Interface(1.5, 0.3, outside="follows")


THETA = '[parameters.theta]\ndefault = "40 deg"\nunit = "deg"\n[parameters.n]\ndefault = 1.5\n'


@pytest.mark.parametrize(
    ("value", "cure"),
    [
        ('"theta"', "'theta' is no number; write \"$theta\" for the parameter"),
        ('"$thta"', "parameter '$thta' is not declared; did you mean '$theta'?"),
        ('"$theta/2"', 'write { parameter = "theta", scale = 0.5 }'),
        ('"2*$theta"', 'write { parameter = "theta", scale = 2 }'),
        ('"-2 $theta"', 'write { parameter = "theta", scale = -2 }'),
        ('"$theta + 10 deg"', 'write { parameter = "theta", offset = "10 deg" }'),
        (
            '"90 deg - $theta"',
            'write { parameter = "theta", scale = -1, offset = "90 deg" }',
        ),
        ('"sin($theta)"', "write { parameter = "),
        ('"$theta + $n"', "of several parameters, but a value takes one; declare a parameter"),
    ],
)
def test_how_a_parameter_is_written_is_told(tmp_path, value, cure):
    about = f'kind = "interface"\nindex = "$n"\nincidence = {value}'
    fault = fault_of(tmp_path, THETA + through(about, "reflected"))
    assert cure in fault
    assert "faults" not in fault


def test_a_parameter_without_a_unit_is_told_to_have_one(tmp_path):
    about = 'kind = "interface"\nindex = 1.5\nincidence = "$theta"'
    wrong = '[parameters.theta]\ndefault = "40 deg"\n' + through(about, "reflected")
    assert 'add unit = "deg", or give pure numbers if it is one' in fault_of(tmp_path, wrong)
    (tmp_path / "right.toml").write_text(
        "format = 1\n" + wrong.replace("default", 'unit = "deg"\ndefault')
    )
    op.load_preset(tmp_path / "right.toml").trace()


@pytest.mark.parametrize("behind", ["{}", "{ eye = 3 }", '{ "" = "L.out" }'])
def test_how_places_are_written_is_told_as_a_file_has_it(tmp_path, behind):
    about = 'kind = "polarizer"\n'
    text = through(about, "out") + f'[choices.place]\nelement = "X"\nbehind = {behind}\n'
    assert fault_of(tmp_path, text) == (
        "wrong.toml: choices.place: 'behind' must name a port for each word, such as behind = "
        f'{{ light = "L.out" }}, not {behind}'
    )
    op.load_preset(_written(tmp_path, text.replace(behind, '{ light = "L.out" }')))


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("all", "cases.all: 'all' stands for every case; give this one another name"),
        ('""', 'cases."" has no name; give it one'),
    ],
)
def test_a_case_that_nobody_could_ask_for_is_refused(tmp_path, name, told):
    text = through('kind = "polarizer"', "out") + f"[cases.{name}]\nvalues = {{}}\n"
    assert fault_of(tmp_path, text) == f"wrong.toml: {told}"
    path = op.load_preset(_written(tmp_path, text.replace(name, "steep")))
    path.cases[name.strip('"')] = path.cases["steep"]
    with pytest.raises(op.PathError, match=told.partition(";")[0]):
        path.to_toml()


@pytest.mark.parametrize("field", ["index = 1.5", 'index = "$n"'])
def test_a_kind_that_is_missing_is_not_read_from_another_key(tmp_path, field):
    text = THETA + through(f'{field}\nincidence = "$theta"', "reflected")
    fault = fault_of(tmp_path, text)
    assert 'elements.X: kind is missing; write kind = "..."' in fault
    assert "must be a text" not in fault


def test_of_an_unknown_unit_those_of_the_values_are_listed(tmp_path):
    about = 'kind = "interface"\nindex = "$n"\nincidence = "$theta"'
    text = THETA.replace('unit = "deg"', 'unit = "foo"') + through(about, "reflected")
    assert fault_of(tmp_path, text) == (
        "wrong.toml: parameters.theta: unit 'foo' is unknown; there are: deg, rad, mrad, arcmin, "
        "arcsec"
    )


def test_values_of_a_case_outside_their_table_are_told_where_they_stand(tmp_path):
    about = 'kind = "interface"\nindex = "$n"\nincidence = "$theta"'
    text = THETA + through(about, "reflected") + '[cases.steep]\ntheta = "80 deg"\n'
    assert fault_of(tmp_path, text) == (
        "wrong.toml: cases.steep: the values of parameters stand in a table of their own; write "
        "values = { theta = ... }"
    )


def test_a_pair_that_cannot_be_one_number_is_not_asked_about(tmp_path):
    glass = through('kind = "interface"\nindex = "$n"\nincidence = "40 deg"', "reflected")
    told = fault_of(tmp_path, f"[parameters.n]\ndefault = [1.5, -1]\n{glass}")
    assert told.endswith(
        "is -1.0 at 1; give an index of refraction n + ik with n and k not negative"
    )
