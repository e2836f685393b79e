"""Constant values are checked when an element is made, in words that name class and field."""

import copy
import dataclasses
import pickle

import numpy as np
import pytest

import optipath as op
from optipath.elements.vertices.vertex_domain import VerticesDomain
from tables import rows

A, B = op.Parameter("a"), op.Parameter("b")


@rows(
    "make, sentence",
    [
        (lambda: op.Detector("S0"), "Detector reads is 'S0'; there are: stokes, linear, intensity"),
        (lambda: op.Polarizer("S0"), "Polarizer angle: axis 'S0' is unknown; there are: hor"),
        (lambda: op.Attenuator(1.5), "Attenuator transmittance is 1.5; give a real fraction with"),
        (lambda: op.Attenuator(50), "real fraction within 0 .. 1; did you mean 0.5?"),
        (lambda: op.Attenuator("50 %"), "transmittance: '50 %' is in per cent; give a fraction"),
        (lambda: op.BeamSplitter(30), "BeamSplitter reflectance is 30; .* did you mean 0.3?"),
        (lambda: op.Depolarizer(-0.1), "Depolarizer depolarization is -0.1; give"),
        (
            lambda: op.Interface(1.5, 2.0),
            "Interface incidence is 2 rad, which is 114.592 deg; give",
        ),
        (lambda: op.Interface(1.5, 56), "within 0 deg .. 90 deg; did you mean '56 deg' or np.rad"),
        (lambda: op.Interface(1.5 - 2j, 0.1), "Interface index is .*: k > 0 absorbs"),
        (lambda: op.Interface(np.nan, 0.1), "Interface index is nan; give a finite index"),
        (lambda: op.Interface([1.5, np.nan], 0.3), "index is nan at 1; give a finite"),
        (
            lambda: op.Interface("gold", 0.1),
            "give n and k as numbers, such as Material\\(0.18, 3.4",
        ),
        (lambda: op.Source(-1.0), "Source intensity is -1; give a real number of 0 or more"),
        (lambda: op.Source(stokes=[1, 1, 1, 0]), "Source stokes is .* by more than 100 %"),
        (lambda: op.Retarder(None), "Retarder retardance must be a real angle, not None"),
        (lambda: op.MuellerElement(np.eye(3)), "MuellerElement matrix must have shape"),
        (lambda: op.Medium(-1.0), "Medium length is -1000 mm; give a real length of 0 mm or more"),
        (lambda: op.LayerStack([1.5], 0.1), "LayerStack indices is .* give a list of two"),
        (lambda: op.LayerStack([1.0, -1.5, 1], 0.1), "LayerStack indices\\[1\\] is -1.5; give"),
        (lambda: op.Material("gold"), "Material n: 'gold' is no number; give n and k as numbers"),
        (lambda: op.Material(0.2 + 3.4j), "Material n is complex; give n and k apart, such as"),
        (lambda: op.Material(0.2, -3.4), "Material k is -3.4; give a real extinction coefficient"),
        (
            lambda: op.Attenuator(op.Parameter("t", 50)),
            "'t' \\(at Attenuator transmittance\\) is 50",
        ),
        (lambda: op.Attenuator(op.Parameter("t", unit="deg")), "'t' is in deg, but Attenuator tra"),
    ],
)
def test_a_value_that_cannot_be_is_refused_where_it_is_written(make, sentence):
    with pytest.raises(op.ValueFault, match=sentence):
        make()


def test_all_faults_of_an_element_and_of_its_copies_are_told_at_once():
    with pytest.raises(op.ValueFault) as error:
        op.Polarizer("up", transmittance=1.5, leakage=-1.0)
    fields = ("Polarizer angle", "Polarizer transmittance", "Polarizer leakage")
    assert [fault.startswith(f) for fault, f in zip(error.value.faults, fields, strict=True)]
    polarizer = op.Polarizer(0.3)
    with pytest.raises(op.ValueFault, match="Polarizer leakage is 2"):
        dataclasses.replace(polarizer, leakage=2)
    assert copy.deepcopy(polarizer) == pickle.loads(pickle.dumps(polarizer)) == polarizer
    path = op.PathGraph()
    path.add("lamp", op.Source()) >> path.add("grey", op.Attenuator(op.Parameter("t")))
    path["grey"] >> path.add("eye", op.Detector())
    with pytest.raises(op.ParameterError, match=r"^parameter 't' \(at grey.transmittance\) is 50"):
        path.bind(t=50)


def test_an_element_of_ones_own_is_checked_by_its_class_name():
    class Foil(op.Element):
        share: op.Fraction

        @staticmethod
        def mueller_rows(xp, share):
            del xp
            return [[share * (row == column) for column in range(4)] for row in range(4)]

    with pytest.raises(op.ValueFault, match=r"^Foil share is 30; .* did you mean 0\.3"):
        Foil(30)
    assert Foil("0.3") == Foil(0.3)


def test_a_file_tells_all_faults_at_once_by_the_names_of_its_nodes(tmp_path):
    file = tmp_path / "faulty.toml"
    file.write_text(
        """
        format = 1
        [elements.lamp]
        kind = "source"
        intensity = -1
        [elements.grey]
        kind = "attenuator"
        transmittance = 50
        [elements.gold]
        kind = "interface"
        index = { n = -0.2, k = 3 }
        incidence = "95 deg"
        [elements.eye]
        kind = "detector"
        [[links]]
        from = "lamp.out"
        to = "grey.in"
        [[links]]
        from = "grey.out"
        to = "gold.in"
        [[links]]
        from = "gold.reflected"
        to = "eye.in"
        """
    )
    with pytest.raises(op.PathError) as error:
        op.load_preset(file)
    places = ("lamp.intensity", "grey.transmittance", "gold.index.n", "gold.incidence")
    found = [
        fault.partition(" is ")[0].removeprefix("faulty.toml: ") for fault in error.value.faults
    ]
    assert found == [*places]
    assert "radians" not in str(error.value)


@rows(
    "make, sentence",
    [
        (lambda: op.Interface((0.2, 3.4), 0.1), r"Material\(0.2, 3.4\) or 0.2\+3.4j .* np.array"),
        (lambda: op.Interface([0.2, 3.4], 0.1), r"Material\(0.2, 3.4\) or 0.2\+3.4j .* np.array"),
        (lambda: op.LayerStack([1.0, [0.2, 3.4]], 0.1), r"LayerStack indices\[1\] is \[0.2, 3.4\]"),
        (lambda: op.Mirror([-0.9, 0.1]), r"write complex\(-0.9, 0.1\) for the one"),
        (lambda: op.LayerStack([1.0, (0.2, 3.4)], 0.1), r"LayerStack indices\[1\] is \(0.2, 3.4\)"),
        (lambda: op.Mirror((-0.9, 0.1)), r"write complex\(-0.9, 0.1\) for the one"),
        (lambda: op.fresnel_reflection((0.2, 3.4), 0.6, 0.8), "index is .* may be n and k"),
        (lambda: op.Source((1, 0, 0, 0)), r"Source intensity .* give stokes=\(1, 0, 0, 0\)"),
        (lambda: op.Source([1, 0.6, 0, 0.3]), r"give stokes=\[1, 0.6, 0, 0.3\]"),
        (lambda: op.Interface(op.Parameter("n", (1.5, 2)), 0.3), r"'n' \(at Interface index\) is"),
        (lambda: op.Mirror(op.Parameter("m", (-0.9, 0.1))), r"complex\(-0.9, 0.1\) for the one"),
        (lambda: op.Source(op.Parameter("I", [1, 1, 0, 0])), r"'I' .* give stokes=\[1, 1, 0, 0\]"),
        (lambda: op.LayerStack(1.5, 0.1), r"indices is 1.5; give a list of two .* \[1, 1.5, 1.33"),
    ],
)
def test_what_may_mean_two_things_is_asked(make, sentence):
    with pytest.raises(op.ValueFault, match=sentence):
        make()


def test_pairs_and_intensities_that_may_be_something_else_are_asked_about():
    path = op.load_preset("npgr026")
    slab = op.Interface(op.Parameter("m", 1.5), 0.1)
    one = op.PathGraph()
    one.add("lamp", op.Source()) >> one.add("slab", slab) >> one.add("eye", op.Detector())
    for give in (one.trace, one.bind):
        for pair in ((0.2, 3.4), [0.2, 3.4]):
            with pytest.raises(op.ParameterError, match=r"'m' \(at slab.index\) is .0.2, 3.4."):
                give(m=pair)
    assert one.trace(m=np.array([1.5, 1.6])).stokes.shape == (2, 4)
    # A Material, as the sentence has it, is one.
    for given in (one.trace(m=op.Material(0.2, 3.4)), one.bind(m=op.Material(0.2, 3.4)).trace()):
        np.testing.assert_array_equal(given.stokes, one.trace(m=0.2 + 3.4j).stokes)
    # Beside a k of its own, n is but one number.
    assert path.trace(n1=(1.5, 1.6)).stokes.shape == path.trace(n1=[1.5, 1.6]).stokes.shape
    path = op.Source(op.Parameter("i", 1.0)) >> op.Detector()
    polarised = op.Source(op.Parameter("i", 1.0), stokes=[1, 1, 0, 0]) >> op.Detector()
    for give in (path.trace, path.bind, path.with_defaults):
        with pytest.raises(op.ParameterError, match=r"four paths; give stokes=.1, 1, 0, 0") as told:
            give(i=(1, 1, 0, 0))
        assert len(told.value.faults) == 1
    with pytest.raises(op.ParameterError, match="may be a state"):
        op.load_preset("npgr026", case=8).trace(intensity=[1, 1, 0, 0])
    for given in (path.trace(i=np.array([1, 1, 0, 0])), path.trace(i=[1, 2, 3, 4])):
        assert given.shape == (4,)
    # Beside a state, they are none.
    assert polarised.trace(i=[1, 1, 0, 0]).shape == (4,)
    assert op.Interface([1.5, 1.6, 1.7], 0.1).index.shape == (3,)
    assert op.Interface(np.array([0.2, 3.4]), 0.1).index.shape == (2,)
    assert op.Source([1.0, 2.0, 3.0, 4.0]).intensity.shape == (4,)
    assert op.Source(np.array([1.0, 0.0, 0.0, 0.0])).intensity.shape == (4,)


def test_a_material_is_understood_wherever_an_index_is():
    gold, n = op.Material(0.2, 3.4), 0.2 + 3.4j
    assert op.Interface(op.Parameter("n", gold), 0.1).index.default == n
    assert op.refraction_angle(gold, 0.3) == op.refraction_angle(n, 0.3)
    assert op.refraction_angle(1.5, 0.3, op.Material(1.2)) == op.refraction_angle(1.5, 0.3, 1.2)
    assert op.fresnel_reflection(gold, 0.6, 0.8) == op.fresnel_reflection(n, 0.6, 0.8)
    two = op.Material([1.5, 1.6], 0.1)
    path = op.Source() >> op.Interface(op.Parameter("n"), 0.1) >> op.Detector()
    expected = path.trace(n=np.array([1.5 + 0.1j, 1.6 + 0.1j])).stokes
    np.testing.assert_array_equal(path.trace(n=two).stokes, expected)
    np.testing.assert_array_equal(path.with_defaults(n=two).trace().stokes, expected)
    with pytest.raises(op.ParameterError, match=r"depends on k, .* write path.bind\(n=...\)"):
        path.trace(n=op.Material(1.5, op.Parameter("k")))
    with pytest.raises(op.ParameterError, match=r"'a' .* is Material.* give a real angle"):
        (op.Source() >> op.Rotator(op.Parameter("a")) >> op.Detector()).trace(a=op.Material(1.5))


@rows(
    "make, sentence",
    [
        (
            lambda: op.Source(stokes=[1, A, B, 0]),
            "side by side, such as parameter 'a', parameter 'b'; give",
        ),
        (
            lambda: op.Polarizer([A, 0.1]),
            "Polarizer angle .* such as parameter 'a'; give one Parameter for",
        ),
        (lambda: op.Interface(1.5, op.CosSin(0.6, 0.8)), "give a Parameter here and these where"),
        (lambda: op.CosSin("30 deg"), "takes a cosine and a sine, not '30 deg' alone; give an ang"),
    ],
)
def test_what_cannot_stand_in_an_element_is_told_where_it_can(make, sentence):
    with pytest.raises(op.OptipathError, match=sentence):
        make()


LAMP_AND_MIRROR = """
format = 1
[parameters.i]
default = {default}
[elements.lamp]
kind = "source"
intensity = {intensity}
[elements.mirror]
kind = "mirror"
r_s = {r_s}
[elements.eye]
kind = "detector"
[[links]]
from = "lamp.out"
to = "mirror.in"
[[links]]
from = "mirror.reflected"
to = "eye.in"
"""


@pytest.mark.parametrize(
    ("default", "intensity", "r_s", "sentence"),
    [
        ("1", "1", "[-0.9, 0.1]", r"elements.mirror.r_s: .* write { re = -0.9, im = 0.1 }"),
        ("[-0.9, 0.1]", "1", '"$i"', r"parameters.i.default: .* write { re = -0.9, im = 0.1 }"),
    ],
)
def test_a_file_asks_once_and_in_its_own_words(tmp_path, default, intensity, r_s, sentence):
    file = tmp_path / "asked.toml"
    file.write_text(LAMP_AND_MIRROR.format(default=default, intensity=intensity, r_s=r_s))
    with pytest.raises(op.PathError, match=sentence) as error:
        op.load_preset(file)
    assert len(error.value.faults) == 1


@rows("give", ["trace", "bind", "with_defaults"])
def test_a_material_stands_for_an_index_alone(give):
    told, material = "a Material stands for an index of refraction", op.Material(0.5, 0.1)
    path = op.Source() >> op.Mirror(op.Parameter("r"), 0.5) >> op.Detector()
    with pytest.raises(op.OptipathError, match=told):
        getattr(path, give)(r=material)
    with pytest.raises(op.ValueFault, match=told):
        op.Mirror(op.Parameter("r", material))


FOUR = np.array([4.0, 3.0, 2.0, 1.0])


@pytest.mark.parametrize("intensity", [FOUR, op.Parameter("i", FOUR), op.Parameter("i")])
def test_four_intensities_go_to_a_file_and_back(tmp_path, intensity):
    path, file = op.Source(intensity) >> op.Detector(), tmp_path / "four.toml"
    if isinstance(intensity, op.Parameter):
        path.cases["four"] = op.Case(values={"i": FOUR})
    file.write_text(path.to_toml())
    assert op.load_preset(file) == path
    case = {"case": "four"} if path.cases else {}
    np.testing.assert_array_equal(op.load_preset(file, **case).trace().S0, FOUR)


def test_the_vertices_of_a_chain_are_looked_at_once(monkeypatch):
    seen = []
    check = VerticesDomain.check
    monkeypatch.setattr(
        VerticesDomain, "check", lambda *given: seen.append(given[1]) or check(*given)
    )
    points = np.cumsum(np.random.default_rng(1).normal(size=(5, 6, 3)), axis=1)
    op.path_from_vertices(points, [1.5] * 4)
    assert seen == ["vertex1.vertices"]
