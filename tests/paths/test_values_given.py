"""Values given without a name, by a wrong one, as a word or as None, and what is told."""

import numpy as np
import pytest

import optipath as op
from paths import chain
from tables import rows
from wired import wired

D = op.Parameter("d")
BOTH = "a real number of 0 or more at source.intensity, and a real angle at polarizer.angle; use"
K_IS_KNOWN = op.Interface(op.Material(op.Parameter("n", 1.5, minimum=0.0), 0.5), 0.3)


def npgr026(**values):
    return op.load_preset("npgr026", **values)


def malus(**values):
    return op.load_preset("malus", **values)


def fault(action, *given, **values):
    with pytest.raises(op.OptipathError) as error:
        action(*given, **values)
    return str(error.value)


@rows(
    "call, written",
    [
        (lambda path: path.trace(0.3), "trace(angle=0.3)"),
        (lambda path: path.trace([0.1, 0.2]), "trace(angle=[0.1, 0.2])"),
        (lambda path: path.trace({"angle": 0.3}), "trace(**{'angle': 0.3})"),
        (lambda path: path.trace_all(0.3), "trace_all(angle=0.3)"),
        (lambda path: path.mueller(0.3), "mueller(angle=0.3)"),
        (lambda path: path.mueller("lamp", "eye", 0.3), "mueller(angle=0.3)"),
        (lambda path: path.bind(0.3), "bind(angle=0.3)"),
        (lambda path: path.paths({"angle": 0.3}), "paths(**{'angle': 0.3})"),
        (lambda path: path.compose().run(0.3), "run(angle=0.3)"),
        (lambda path: path.compose().run_all(0.3), "run_all(angle=0.3)"),
        (lambda path: path.compose().certificate(0.3), "certificate(angle=0.3)"),
        (lambda path: next(path.compose().stream(9, 0.3)), "stream(angle=0.3)"),
    ],
)
def test_a_value_without_a_name_is_shown_with_one(call, written):
    with pytest.raises(op.ParameterError) as told:
        call(malus())
    assert f"given by name: {written}; there are: angle" in str(told.value)


@rows(
    "call, sentence",
    [
        (lambda: malus(angle=0.1, intensity=1.0).trace(0.3), "no parameter is open"),
        (lambda: malus().trace("all"), "trace(keep='all')"),
        (lambda: op.load_preset("npgr026", 8), "load_preset('npgr026', case=8)"),
        (lambda: op.load_preset("npgr026", "8"), "load_preset('npgr026', case='8')"),
        (lambda: op.load_preset("npgr026", 0.3), "load_preset('npgr026', delta=0.3)"),
        (lambda: op.load_preset("npgr026", {"n1": 2}), "load_preset('npgr026', **{'n1': 2})"),
        # The other part of a complex index is told by its name.
        *(
            (lambda act=act, index=index: act(n1=index), "give k by k1")
            for act, index in ((npgr026().trace, 1.2 + 2j), (npgr026().bind, "1.2+2j"))
        ),
        (lambda: npgr026().trace(n1=op.Material(1.2, 2.0)), "give k by k1"),
        # An option of a composer, and a case, are told where they belong.
        *(
            (lambda a=act: a(method="x"), "write Composer(method=...).compose(path)")
            for act in (npgr026().trace, npgr026().bind, npgr026)
        ),
        (lambda: npgr026().trace(case=8), "no parameter of the path; write load_preset(..., case="),
        # None is no value, but a word may leave an element out.
        (lambda: npgr026(filter=None), "filter='none' leaves its element out"),
        (lambda: npgr026(delta=None), "parameter 'delta' is None, which is no value; give one"),
    ],
)
def test_what_is_given_by_a_wrong_name_or_none_is_told_where_it_belongs(call, sentence):
    with pytest.raises(op.ParameterError) as told:
        call()
    assert sentence in str(told.value)
    if sentence.endswith(("k1", "case=...)", "give one")):
        assert str(told.value).endswith(sentence)


def test_detectors_nodes_and_places_are_told_by_their_names():
    ends = {"lamp": op.Source(op.Parameter("power", 2.0)), "plate": op.BeamSplitter()}
    links = "lamp -> plate, plate.reflected -> r, plate.transmitted -> t"
    path = wired({**ends, "r": op.Detector(), "t": op.Detector()}, links)
    for call, other in ((path.trace, "trace_all"), (path.compose().run, "run_all")):
        for values in ({}, {"power": 3.0}):
            with pytest.raises(op.ParameterError, match=rf"2 detectors .*; use {other}\(\)$"):
                call(**values)
    assert {*path.trace_all()} == {"r", "t"}
    path = npgr026()
    assert ("X1" in path, "polarizer" in path) == (True, False)
    assert (" ".join(path), len(path), len(op.PathGraph())) == ("L P X2 X1 E", 5, 0)
    path.add("camera", op.Detector())
    path.connect("P", "camera", tap=True)
    told = fault(path.bind, place="eye")
    assert told.startswith("'P' cannot be moved to place='eye': several links meet at 'P'")
    path = chain([op.Interface(1.5, D)])
    assert "bounds=" not in fault(path.trace, d="100 deg")
    assert "bounds=" in fault(path.trace, d=-0.1)


def test_words_of_axes_are_taken_and_none_for_another_direction_is_offered():
    path = chain([op.Polarizer(op.Parameter("d"))], [1.0, 1.0, 0.0, 0.0])
    assert path.trace(d="horizontal").intensity == 1.0
    # Malus, at 0, 90 and 45 degrees.
    found = path.trace(d=["horizontal", "vertical", "45 deg"]).intensity
    np.testing.assert_allclose(found, [1.0, 0.0, 0.5], atol=1e-15)
    assert path.bind(d="diagonal").trace().intensity == pytest.approx(0.5)
    own = chain([op.Polarizer(op.Parameter("d", words={"vertical": 0.0}))], [1.0, 1.0, 0.0, 0.0])
    assert own.trace(d="vertical").intensity == 1.0
    for words in ("off", ["off", "none"]):
        told = fault(npgr026().trace, filter=words)
        assert told.endswith("none, antidiagonal, or give an angle such as '45 deg'")
    assert fault(op.Polarizer, "pi/4").endswith("antidiagonal, or give an angle such as '45 deg'")
    turned = chain([op.Rotator(op.Parameter("d"))])
    assert "knows no word 'vertical'" in fault(turned.trace, d="vertical")
    told = fault(op.Parameter, "d", "antidiagonl", "deg", words={"diagonal": "45 deg"})
    assert told.endswith("; write '-45 deg' for the axis 'antidiagonal'")
    assert fault(op.Parameter, "d", "half", "deg").endswith("give an angle such as '45 deg'")
    two_faces = wired({"X1": op.Interface(1.5, 0.3), "E": op.Detector()}, "")
    told = fault(two_faces.connect, "X1.refracted", "E")
    assert told.endswith("does not exist; there are: X1.reflected, X1.transmitted")


@rows(
    "call, sentence",
    [
        (lambda: chain([K_IS_KNOWN]).bind(n=1.2 + 2j), "k is 0.5 where the path is built"),
        (lambda: npgr026(case=True), "case must be a name or a number, not True"),
        ((op.Source(D) >> op.Polarizer(D) >> op.Detector()).check, BOTH),
        # A negative is told as one, in few digits.
        (lambda: chain([op.Interface(1.5, -D)]).trace(d=0.3), ".incidence, as -d) is -17.1887 deg"),
        # Digits that tell a number from its limit are kept.
        (lambda: op.Attenuator(1.0000000000002), "is 1.0000000000002; give"),
        (lambda: op.Attenuator(1.12345678901234), "is 1.12346; give"),
        (lambda: op.Parameter("p", minimum="90 deg", maximum="0 deg"), "range 90 deg .. 0 deg;"),
        (lambda: wired({"eye": op.Detector()}, "").trace(), "add one, such as Source()"),
    ],
)
def test_numbers_and_places_are_told_as_they_stand(call, sentence):
    assert sentence in fault(call)
