import tomllib

import numpy as np
import pytest

import optipath as op
from optipath.paths.presets.reader.document import read

GOOD = """
format = 1
description = "a lamp, a mirror, an eye"

[parameters.theta]
default = "30 deg"
unit = "deg"
range = ["0 deg", "90 deg"]

[elements.lamp]
kind = "source"

[elements.mirror]
kind = "interface"
index = { n = 1.2, k = 7.0 }
incidence = "$theta"

[elements.eye]
kind = "detector"

[[links]]
from = "lamp.out"
to = "mirror.in"

[[links]]
from = "mirror.reflected"
to = "eye.in"
azimuth = "10 deg"

[cases.steep]
values = { theta = "80 deg" }
"""


def faults_of(text):
    with pytest.raises(op.OptipathError) as error:
        read(tomllib.loads(text))
    return error.value.faults


def test_a_path_built_in_python_equals_the_one_read():
    path = op.PathGraph("a lamp, a mirror, an eye", {"steep": op.Case({"theta": np.radians(80.0)})})
    theta = op.Parameter("theta", np.radians(30.0), unit="deg", minimum=0.0, maximum=np.pi / 2)
    lamp = path.add("lamp", op.Source())
    lamp >> path.add("mirror", op.Interface(op.Material(1.2, 7.0), theta))
    path.add("eye", op.Detector())
    path.connect("mirror.reflected", "eye.in", azimuth=np.radians(10.0))
    assert read(tomllib.loads(GOOD)) == path
    assert read(tomllib.loads(GOOD)).compose() == path.compose()


def test_a_complex_index_and_a_material_give_equal_plans():
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source())
    mirror = path.add("mirror", op.Interface(1.2 + 7.0j, np.radians(30.0)))
    lamp >> mirror
    path.add("eye", op.Detector())
    path.connect("mirror.reflected", "eye.in", azimuth=np.radians(10.0))
    fixed = GOOD.replace('"$theta"', '"30 deg"').split("[cases")[0]
    fixed = fixed.split("[parameters")[0] + "[elements" + fixed.split("[elements", 1)[1]
    assert read(tomllib.loads(fixed)).compose() == path.compose()


@pytest.mark.parametrize(
    ("old", "new", "messages"),
    [
        ("description =", "desciption =", ["key 'desciption'", "did you mean 'description'"]),
        ("format = 1", "format = true", ["'format' must be a whole number"]),
        ('kind = "source"', 'kind = "sorce"', ["'sorce' is unknown", "did you mean 'source'"]),
        ('kind = "source"', "", ["elements.lamp: kind is missing"]),
        ('kind = "source"', "kind = 3", ["'kind' must be a text, not 3"]),
        ("index =", "indx =", ["key 'indx'", "did you mean 'index'"]),
        ("k = 7.0", "kk = 7.0", ["key 'kk' is unknown"]),
        ("k = 7.0", "k = -7.0", ["mirror.index.k is -7"]),
        ("k = 7.0", "k = nan", ["mirror.index.k is nan"]),
        ("n = 1.2", "n = '1.2 nm'", ["pure number"]),
        ('"$theta"', '"$thta"', ["'$thta' is not declared", "did you mean '$theta'"]),
        ('"$theta"', '"30 dge"', ["'dge' of '30 dge' is unknown", "did you mean 'deg'"]),
        ('"$theta"', "30", ["30 has no unit", "'30 deg'"]),
        ('"$theta"', "true", ["true is not a number"]),
        ('"$theta"', '"100 deg"', ["mirror.incidence is 100 deg"]),
        ('unit = "deg"', 'unit = "dge"', ["unit 'dge' is unknown"]),
        ('unit = "deg"', "", ["parameters.theta", "declares no unit"]),
        ('["0 deg", "90 deg"]', '["0 deg"]', ["two ends, not 1"]),
        ('["0 deg", "90 deg"]', '["90 deg", "0 deg"]', ["lower end"]),
        ('["0 deg", "90 deg"]', '["40 deg", "90 deg"]', ["outside its range"]),
        ("[parameters.theta]", "[parameters.the-ta]", ["parameter name 'the-ta'"]),
        ("mirror.reflected", "mirror.reflectd", ["did you mean 'mirror.reflected'"]),
        ("mirror.in", "miror.in", ["'miror' does not exist", "did you mean 'mirror'"]),
        ('from = "lamp.out"', 'form = "lamp.out"', ["key 'form'", "did you mean 'from'"]),
        ('to = "mirror.in"', "to = 3", ["'to' must be a text"]),
        ("[elements.eye]", "[elements.'e.y']", ["node name 'e.y'"]),
        ('"10 deg"', '"10 nm"', ["links[1]", "no angle"]),
        ('theta = "80 deg"', 'thta = "80 deg"', ["cases.steep", "did you mean 'theta'"]),
        ('theta = "80 deg"', 'theta = "100 deg"', ["cases.steep.theta", "outside its range"]),
        ("values = {", "valus = {", ["key 'valus'"]),
        ("[cases.steep]", "[cases.steep]\npublished = {ey = [1, 2, 3, 4]}", ["mean 'eye'"]),
        ("[cases.steep]", "[cases.steep]\npublished = {eye = [1, 2]}", ["four finite numbers"]),
        ("[elements.eye]", "[elements.extra]\nkind='dump'\n[elements.eye]", ["'extra' is reached"]),
    ],
)
def test_each_fault_is_named_with_its_place_and_cure(old, new, messages):
    assert old in GOOD
    faults = " | ".join(faults_of(GOOD.replace(old, new, 1)))
    for message in messages:
        assert message in faults


def test_all_faults_of_a_file_are_told_at_once():
    text = GOOD.replace('kind = "source"', 'kind = "sorce"').replace("k = 7.0", "k = -7.0")
    text = text.replace("mirror.reflected", "mirror.reflectd").replace("range", "rnge")
    text = text.replace("10 deg", "10 dge").replace('theta = "80 deg"', 'thta = "80 deg"')
    faults = faults_of(text)
    for part in ("sorce", "mirror.index.k", "reflectd", "rnge", "dge", "thta"):
        assert sum(part in fault for fault in faults) == 1, part


def test_a_node_that_could_not_be_read_is_not_called_missing_as_well():
    faults = faults_of(GOOD.replace('kind = "source"', 'kind = "sorce"'))
    assert len(faults) == 1


def test_a_bad_port_hides_no_node_that_hangs_elsewhere():
    text = GOOD.replace("lamp.out", "lamp.uot").replace(
        "[elements.eye]", '[elements.alone]\nkind = "polarizer"\n\n[elements.eye]'
    )
    faults = faults_of(text)
    assert len(faults) == 2
    assert "did you mean 'lamp.out'" in faults[0]
    assert "'alone' is reached by no source" in faults[1]


def test_a_missing_source_is_told_beside_a_bad_port():
    text = GOOD.replace('kind = "source"', 'kind = "polarizer"').replace("lamp.out", "lamp.uot")
    faults = " | ".join(faults_of(text))
    for part in ("lamp.uot", "no source"):
        assert part in faults


def test_a_parameter_that_is_an_angle_declares_a_unit():
    text = GOOD.replace(
        'default = "30 deg"\nunit = "deg"\nrange = ["0 deg", "90 deg"]', "default = 1"
    )
    faults = faults_of(text.split("[cases")[0])
    assert len(faults) == 1
    assert 'theta is used where an angle is asked for; add unit = "deg" or another' in faults[0]


def test_a_parameter_without_unit_in_python_gets_one_where_it_is_an_angle():
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source())
    (
        lamp
        >> path.add("turn", op.Rotator(op.Parameter("theta", 0.5)))
        >> path.add("eye", op.Detector())
    )
    assert path.parameters["theta"].unit == "deg"
    assert read(tomllib.loads(path.to_toml())) == path


def test_a_case_for_an_unknown_parameter_is_not_written():
    path = read(tomllib.loads(GOOD))
    path.cases["odd"] = op.Case({"thta": 0.1})
    with pytest.raises(op.PathError, match=r"case 'odd'.*did you mean 'theta'"):
        path.to_toml()


def test_a_cycle_and_azimuths_are_told_beside_faults_of_reading():
    text = GOOD.replace('kind = "source"', 'kind = "sorce"').replace(
        "[cases.steep]", '[[links]]\nfrom = "mirror.reflected"\nto = "mirror.in"\n\n[cases.steep]'
    )
    text = text.replace('kind = "detector"', 'kind = "polarizer"\nazimuth = "3 deg"')
    faults = " | ".join(faults_of(text))
    for part in ("sorce", "cycle: mirror -> mirror", "give it in one place"):
        assert part in faults


@pytest.mark.parametrize(
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
    text = GOOD.replace("index = { n = 1.2, k = 7.0 }", new)
    assert faults_of(text)


def test_materials_numpy_numbers_and_complex_arrays_are_written_and_read_back():
    path = op.PathGraph("numbers", {"one": op.Case({"q": np.float64(0.1)})})
    q = op.Parameter(
        "q", np.float64(0.1), unit="deg", minimum=np.float64(0.0), words={"up": np.float64(0.3)}
    )
    m = op.Parameter("m", default=[1 + 2j, 2 + 1j])
    lamp = path.add("lamp", op.Source())
    mirror = path.add("mirror", op.Interface(m, q, outside=op.Material(1.2)))
    lamp >> mirror >> path.add("eye", op.Detector())
    assert "np." not in path.to_toml()
    assert read(tomllib.loads(path.to_toml())) == path


def test_frames_are_written_and_read_back():
    turned = op.Frame().turned(0.3)
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(), {"out": op.Frame()})
    lamp >> path.add("filter", op.Polarizer(), {"in": turned}) >> path.add("eye", op.Detector())
    copy = read(tomllib.loads(path.to_toml()))
    assert copy == path
    assert copy.trace().intensity == path.trace().intensity


@pytest.mark.parametrize(
    ("frames", "message"),
    [
        ("3", "must be tables"),
        ("{ in = { x = [1, 0, 0] } }", "axis 'y' is missing"),
        ("{ in = { x = [1, 0, 0], y = [0, 1, 0], z = [0, 0, 2] } }", "unit vectors"),
        ("{ inn = { x = [1, 0, 0], y = [0, 1, 0], z = [0, 0, 1] } }", "'eye.inn' does not exist"),
    ],
)
def test_faulty_frames_are_named(frames, message):
    text = GOOD.replace('kind = "detector"', f'kind = "detector"\nframes = {frames}')
    assert any(message in fault for fault in faults_of(text))


def test_arrays_parameters_and_words_are_written_and_read_back():
    path = op.PathGraph("all sorts", {"one": op.Case({"a": "up"}, note='a "note"\n')})
    word = op.Parameter("a", [0.1, "up"], unit="rad", words={"up": 0.5}, help="é")
    index = op.Parameter("m", 1.5 + 0.2j)
    lamp = path.add("lamp", op.Source(stokes=[[1.0, 0, 0, 1.0], [1.0, 0, 0, 0]]))
    node = lamp >> path.add("turn", op.Rotator(-word))
    node >> path.add("glass", op.Interface(index, [0.1, 0.2], outside=1.1))
    path["glass"] >> path.add("metal", op.Interface([1 + 1j, 2 + 1j], 0.3, 1.1, azimuth=word))
    (
        path["metal"]
        >> path.add("any", op.MuellerElement(np.eye(4)))
        >> path.add("eye", op.Detector(reads="linear"))
    )
    copy = read(tomllib.loads(path.to_toml()))
    assert copy == path
    assert copy.compose() == path.compose()
    np.testing.assert_array_equal(copy.trace().stokes, path.trace().stokes)


def test_a_case_may_give_the_axis_of_a_polariser_by_its_name():
    crossed = op.Source(100, [1, 1, 0, 0]) >> op.Polarizer(op.Parameter("a", 0.3)) >> op.Detector()
    text = crossed.to_toml() + '[cases.x]\nvalues = { a = ["vertical", "45 deg", "horizontal"] }\n'
    path = read(tomllib.loads(text))
    # Malus, at 90, 45 and 0 degrees.
    shares = path.with_defaults(**path.cases["x"].values).trace().intensity / 100.0
    np.testing.assert_allclose(shares, [0.0, 0.5, 1.0], atol=1e-15)
    (told,) = faults_of(text.replace("vertical", "upright"))
    assert told.endswith("diagonal, antidiagonal, or give an angle such as '45 deg'")
