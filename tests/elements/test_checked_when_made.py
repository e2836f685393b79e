"""Constant values are checked when an element is made, in words that name class and field."""

import copy
import dataclasses
import pickle

import numpy as np
import pytest

import optipath as op
from optipath.elements.vertex_chain import VerticesDomain
from paths import chain
from tables import rows
from wired import read, read_back

A, B = op.Parameter("a"), op.Parameter("b")


@rows(
    "make, sentence",
    [
        (lambda: op.Detector("S0"), "Detector reads is 'S0'; there are: stokes, linear, intensity"),
        (lambda: op.Polarizer("S0"), "Polarizer angle: axis 'S0' is unknown; there are: hor"),
        (lambda: op.Attenuator(1.5), "Attenuator transmittance is 1.5; give a real fraction with"),
        (lambda: op.Attenuator(50), "real fraction within 0 .. 1; did you mean 0.5?"),
        (lambda: op.Attenuator("50 %"), "transmittance: '50 %' is in per cent; give a fraction"),
        (lambda: op.Interface(1.5, 2.0), "incidence is 114.592 deg; give"),
        (lambda: op.Interface(1.5, 56), "within 0 deg .. 90 deg; plain numbers are in radians"),
        (lambda: op.Interface(1.5 - 2j, 0.1), "Interface index is .*: k > 0 absorbs"),
        (lambda: op.Interface([1.5, np.nan], 0.3), "index is nan at 1; give a finite index"),
        (lambda: op.Interface("gold", 0.1), r"numbers, such as Material\(0.18, 3.4"),
        (lambda: op.Source(-1.0), "Source intensity is -1; give a real number of 0 or more"),
        (lambda: op.Retarder(None), "Retarder retardance must be a real angle, not None"),
        (lambda: op.MuellerElement(np.eye(3)), "MuellerElement matrix must have shape"),
        (lambda: op.LayerStack([1.0, -1.5, 1], 0.1), r"LayerStack indices\[1\] is -1.5; give"),
        (lambda: op.Material("gold"), "Material n: 'gold' is no number; give n and k as numbers"),
        (lambda: op.Material(0.2 + 3.4j), "Material n is complex; give n and k apart, such as"),
        (lambda: op.Material(0.2, -3.4), "Material k is -3.4; give a real extinction coefficient"),
        (lambda: op.Attenuator(op.Parameter("t", 50)), r"'t' \(at Attenuator transm.*\) is 50"),
        (lambda: op.Attenuator(op.Parameter("t", unit="deg")), "'t' is in deg, but Attenuator tra"),
        (lambda: op.Source(stokes=[1, A, B, 0]), "side by side, such as parameter 'a', .* 'b'"),
        (lambda: op.Polarizer([A, 0.1]), "such as parameter 'a'; give one Parameter for"),
        (lambda: op.Interface(1.5, op.CosSin(0.6, 0.8)), "give a Parameter here and these where"),
        (lambda: op.CosSin("30 deg"), "takes a cosine and a sine, not '30 deg' alone; give an ang"),
    ],
)
def test_a_value_that_cannot_be_is_refused_where_it_is_written(make, sentence):
    with pytest.raises(op.OptipathError, match=sentence):
        make()


def test_all_faults_of_an_element_of_its_copies_and_of_a_file_are_told_at_once(tmp_path):
    with pytest.raises(op.errors.ValueFault) as error:
        op.Polarizer("up", transmittance=1.5, leakage=-1.0)
    fields = ("Polarizer angle", "Polarizer transmittance", "Polarizer leakage")
    assert [fault.startswith(f) for fault, f in zip(error.value.faults, fields, strict=True)]
    polarizer = op.Polarizer(0.3)
    with pytest.raises(op.errors.ValueFault, match="Polarizer leakage is 2"):
        dataclasses.replace(polarizer, leakage=2)
    assert copy.deepcopy(polarizer) == pickle.loads(pickle.dumps(polarizer)) == polarizer
    with pytest.raises(
        op.errors.ParameterError, match=r"^parameter 't' \(at e0.transmittance\) is 50"
    ):
        chain([op.Attenuator(op.Parameter("t"))]).bind(t=50)
    text = chain([op.Attenuator(0.5), op.Interface(op.Material(0.2, 3), "45 deg")]).to_toml()
    for good, bad in (("y = 1.0", "y = -1"), ("= 0.5", "= 50"), ("0.2", "-0.2"), ("45 d", "95 d")):
        text = text.replace(good, bad)
    with pytest.raises(op.errors.PathError) as error:
        read(text, tmp_path)
    found = [f.partition(" is ")[0].removeprefix("path.toml: ") for f in error.value.faults]
    assert found == ["lamp.intensity", "e0.transmittance", "e1.index.n", "e1.incidence"]
    assert "radians" not in str(error.value)


@rows(
    "make, sentence",
    [
        (lambda: op.Interface((0.2, 3.4), 0.1), r"write 0.2\+3.4j for one index, np.array"),
        (lambda: op.LayerStack([1.0, [0.2, 3.4]], 0.1), r"LayerStack indices\[1\] is \[0.2, 3.4\]"),
        (lambda: op.fresnel_reflection((0.2, 3.4), 0.6, 0.8), "write 0.2.3.4j for one index"),
    ],
)
def test_two_numbers_for_an_index_are_refused(make, sentence):
    with pytest.raises(op.errors.ValueFault, match=sentence):
        make()


def test_lists_of_numbers_are_of_several_paths():
    path = chain([op.Interface(op.Parameter("m", 1.5), 0.1)])
    for indices in ([1.5, 1.6], np.array([1.5, 1.6])):
        assert path.trace(m=indices).stokes.shape == (2, 4)
    for given in (path.trace(m=op.Material(0.2, 3.4)), path.bind(m=op.Material(0.2, 3.4)).trace()):
        np.testing.assert_array_equal(given.stokes, path.trace(m=0.2 + 3.4j).stokes)
    assert (op.Source([1, 0, 0, 0]) >> op.Detector()).trace().shape == (4,)
    assert op.Interface([1.5, 1.6, 1.7], 0.1).index.shape == (3,)
    assert op.Mirror([-0.9, 0.1]).r_s.shape == (2,)


def test_a_material_is_understood_wherever_an_index_is_and_stands_for_nothing_else():
    gold, n = op.Material(0.2, 3.4), 0.2 + 3.4j
    assert op.Interface(op.Parameter("n", gold), 0.1).index.default == n
    assert op.refraction_angle(gold, 0.3) == op.refraction_angle(n, 0.3)
    assert op.refraction_angle(1.5, 0.3, op.Material(1.2)) == op.refraction_angle(1.5, 0.3, 1.2)
    assert op.fresnel_reflection(gold, 0.6, 0.8) == op.fresnel_reflection(n, 0.6, 0.8)
    two = op.Material([1.5, 1.6], 0.1)
    path = chain([op.Interface(op.Parameter("n"), 0.1)])
    expected = path.trace(n=np.array([1.5 + 0.1j, 1.6 + 0.1j])).stokes
    np.testing.assert_array_equal(path.trace(n=two).stokes, expected)
    np.testing.assert_array_equal(path.with_defaults(n=two).trace().stokes, expected)
    with pytest.raises(
        op.errors.ParameterError, match=r"depends on k, .* write path.bind\(n=...\)"
    ):
        path.trace(n=op.Material(1.5, op.Parameter("k")))
    with pytest.raises(op.errors.ParameterError, match=r"'a' .* is Material.* give a real angle"):
        chain([op.Rotator(op.Parameter("a"))]).trace(a=op.Material(1.5))
    mirror = chain([op.Mirror(op.Parameter("r"), 0.5)])
    for give in (mirror.trace, mirror.bind, mirror.with_defaults, lambda r: op.Parameter("r", r)):
        with pytest.raises(op.OptipathError, match="a Material stands for an index of refraction"):
            op.Mirror(give(r=op.Material(0.5, 0.1)))


FOUR = np.array([4.0, 3.0, 2.0, 1.0])


@rows("intensity", [FOUR, op.Parameter("i", FOUR), op.Parameter("i")])
def test_four_intensities_go_to_a_file_and_back(tmp_path, intensity):
    path = op.Source(intensity) >> op.Detector()
    if isinstance(intensity, op.Parameter):
        path.cases["four"] = op.Case(values={"i": FOUR})
    assert read_back(path, tmp_path) == path
    case = {"case": "four"} if path.cases else {}
    np.testing.assert_array_equal(read(path.to_toml(), tmp_path, **case).trace().S0, FOUR)


def test_the_vertices_of_a_chain_are_looked_at_once(monkeypatch):
    seen = []
    check = VerticesDomain.check
    monkeypatch.setattr(
        VerticesDomain, "check", lambda *given: seen.append(given[1]) or check(*given)
    )
    points = np.cumsum(np.random.default_rng(1).normal(size=(5, 6, 3)), axis=1)
    op.path_from_vertices(points, [1.5] * 4)
    assert seen == ["vertex1.vertices"]
