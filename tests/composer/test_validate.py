import numpy as np
import pytest

import optipath as op
from optipath.values.made import checked_later
from tables import rows


def chain(*elements):
    """A path with a lamp in front of the elements and an eye behind them."""
    path = op.PathGraph()
    node = path.add("lamp", op.Source())
    for number, element in enumerate(elements):
        node = node >> path.add(f"e{number}", element)
    node >> path.add("eye", op.Detector())
    return path


def faults_of(path):
    with pytest.raises(op.PathError) as error:
        path.check()
    return error.value.faults


@rows(
    "make, message",
    [
        (lambda: op.Interface(1.5, -0.1), "e0.incidence is -5.72"),
        (lambda: op.Interface(1.5, 1.6), "within 0 deg .. 90 deg"),
        (lambda: op.Interface(-1.5, 0.1), "e0.index is"),
        (lambda: op.Interface(1.5 - 1j, 0.1), "k > 0 absorbs"),
        (lambda: op.Interface(np.nan, 0.1), "e0.index is nan"),
        (lambda: op.Interface(complex(1.5, np.inf), 0.1), "finite"),
        (lambda: op.Interface(op.Material(-1.0, 0.0), 0.1), "e0.index.n is -1"),
        (lambda: op.Interface(op.Material(1.0, -2.0), 0.1), "e0.index.k is -2"),
        (lambda: op.Interface(1.5, 0.1, outside=0.0), "e0.outside is 0"),
        (lambda: op.Interface(1.5, 0.1, outside=1j), "e0.outside is 1j; give an index"),
        (lambda: op.Interface(1.5, 0.1, outside=op.Material(0.0, 0.1)), "e0.outside.n is 0"),
        (lambda: op.Interface(1.5, 0.1, outside=1.5 - 1j), "k > 0 absorbs"),
        (lambda: op.Interface(1.5, None), "e0.incidence must be"),
        (lambda: op.Interface(1.5, [0.1, [0.2]]), "unequal"),
        (lambda: op.Polarizer(np.inf), "e0.angle is inf"),
        (lambda: op.Polarizer(transmittance=1.5), "e0.transmittance is 1.5"),
        (lambda: op.Polarizer(1j), "e0.angle is complex"),
        (lambda: op.Attenuator(-0.1), "e0.transmittance is -0.1"),
        (lambda: op.MuellerElement(np.eye(3)), "shape (..., 4, 4), not (3, 3)"),
    ],
)
def test_a_value_out_of_its_domain_is_named_with_its_node_where_a_path_is_checked(make, message):
    with checked_later():
        element = make()
    (fault,) = faults_of(chain(element))
    assert message in fault


@rows(
    "make, message",
    [
        (lambda: op.Source(-1.0), "lamp.intensity is -1"),
        (lambda: op.Source(stokes=[1.0, 1.0, 0.1, 0.0]), "more than 100 %"),
        (lambda: op.Source(stokes=[-1.0, 0.0, 0.0, 0.0]), "negative intensity -1"),
        (lambda: op.Source(stokes=[1.0, 0.0, 0.0]), "shape (..., 4), not (3,)"),
        (lambda: op.Source(stokes=[np.nan, 0.0, 0.0, 0.0]), "nan"),
    ],
)
def test_light_that_cannot_be_is_refused_where_a_path_is_checked(make, message):
    path = op.PathGraph()
    with checked_later():
        path.add("lamp", make()) >> path.add("eye", op.Detector())
    (fault,) = faults_of(path)
    assert message in fault


def test_fully_polarised_light_is_allowed_whatever_its_rounding():
    state = [1.0, *(np.array([0.6, 0.48, 0.64]) * (1 + 1e-15))]
    path = op.PathGraph()
    path.add("lamp", op.Source(stokes=state)) >> path.add("eye", op.Detector())
    assert path.trace().dop == pytest.approx(1.0)


def test_all_faults_are_told_at_once():
    path = op.PathGraph()
    with checked_later():
        path.add("lamp", op.Source(-1.0))
        path.add("glass", op.Interface(np.nan, 2.0))
    path.add("alone", op.Polarizer())
    path.connect("lamp.out", "glass.in")
    faults = faults_of(path)
    for part in ("lamp.intensity", "glass.index", "glass.incidence", "no detector"):
        assert sum(part in fault for fault in faults) == 1


def test_nodes_that_light_does_not_pass_are_named():
    path = chain()
    path.add("alone", op.Polarizer()) >> path["eye"]
    assert faults_of(path) == ("node 'alone' is reached by no source; link one to 'alone.in'",)
    path = chain(op.Interface(1.5, 0.3))
    path.add("lost", op.Polarizer())
    path.connect("e0.transmitted", "lost.in")
    (fault,) = faults_of(path)
    assert "'lost' reaches no detector" in fault
    assert "'lost.out'" in fault
    assert len(faults_of(op.PathGraph())) == 2
    path = op.PathGraph()
    path.add("lamp", op.Source()) >> path.add("dump", op.Dump())
    (fault,) = faults_of(path)
    assert "no detector" in fault


def test_a_dump_ends_light_as_well_as_a_detector():
    path = op.PathGraph()
    split = path.add("split", op.BeamSplitter())
    path.add("lamp", op.Source()) >> split
    path.add("eye", op.Detector())
    path.add("dump", op.Dump())
    path.connect("split.reflected", "eye.in")
    path.connect("split.transmitted", "dump.in")
    path.check()
    assert path.trace().intensity == 0.5


def test_links_that_cannot_be_are_explained():
    path = chain(op.Polarizer())
    path.add("lamp2", op.Source()) >> path["e0"]
    (fault,) = faults_of(path)
    for part in ("'e0.in'", "'lamp.out' and 'lamp2.out'", "Combiner"):
        assert part in fault
    path = chain(Trap())
    path.add("screen", op.Detector())
    path.connect("e0.dark", "screen.in")
    (fault,) = faults_of(path)
    assert "link 'e0.dark -> screen.in' carries no light" in fault
    assert "gives no light there; remove the link" in fault
    path = chain(Trap())
    path.connect("e0.dark", "eye.in")
    (fault,) = faults_of(path)
    assert "carries no light" in fault
    path = op.PathGraph()
    around = path.add("e0", op.Combiner()) >> path.add("e1", op.Polarizer())
    path.add("lamp", op.Source()) >> path["e0"]
    around >> path.add("split", op.BeamSplitter())
    path.connect("split.reflected", "e0.in")
    path.add("eye", op.Detector())
    path.connect("split.transmitted", "eye.in")
    faults = faults_of(path)
    assert " | ".join(faults) == (
        "light goes round in a cycle: e0 -> e1 -> split -> e0; "
        "open it by removing a link, or sum over all rounds with loops='sum'"
    )


class Trap(op.Element):
    """Lets all light out by one of two ports."""

    outputs = ("out", "dark")

    def couplings(self):
        return (op.Coupling("in", "out", ()),)


def test_a_parameter_is_one_kind_of_value_of_one_dimension():
    both = op.Parameter("both")
    path = op.PathGraph()
    path.add("lamp", op.Source(both, stokes=both)) >> path.add("eye", op.Detector())
    (fault,) = faults_of(path)
    assert "'both' at lamp.stokes has another shape" in fault
    one = op.Parameter("a", default=0.1)
    other = op.Parameter("a", default=0.2)
    (fault,) = faults_of(chain(op.Rotator(one), op.Rotator(other)))
    assert "'a' at e1.angle differs" in fault
    with pytest.raises(op.ValueFault, match="'t' is in deg, but Attenuator transmittance takes"):
        op.Attenuator(op.Parameter("t", unit="deg"))
    turn = op.Parameter("turn", default=0.3)
    path = chain(op.Polarizer(), op.Rotator(turn), op.Rotator(-turn))
    np.testing.assert_allclose(
        path.trace(turn=1.1).stokes, [0.5, 0.5, 0, 0], rtol=1e-15, atol=1e-16
    )


def test_shapes_that_do_not_broadcast_are_named_with_their_owners():
    with checked_later():
        path = chain(op.Polarizer(np.zeros(2), transmittance=np.ones(3), leakage=3.0))
    faults = " | ".join(faults_of(path))
    assert "e0.leakage is 3" in faults
    assert "e0.angle (2,), e0.transmittance (3,)" in faults
    path = chain(op.Polarizer(np.zeros(3)), op.Polarizer(np.zeros(4)), op.Polarizer(0.0))
    (fault,) = faults_of(path)
    assert "e0.angle (3,), e1.angle (4,)" in fault
    path = chain(op.Polarizer(np.zeros(3)), op.Rotator(op.Parameter("turn")))
    assert path.trace(turn=np.zeros((2, 1))).stokes.shape == (2, 3, 4)
    with pytest.raises(op.ParameterError, match=r"e0\.angle \(3,\), turn \(2,\)"):
        path.trace(turn=np.zeros(2))


def test_an_optional_parameter_may_only_take_out_what_light_goes_straight_through():
    optional = op.Parameter("a", default=0.1, optional=True)
    (fault,) = faults_of(chain(op.Interface(1.5, optional)))
    assert "cannot be left out" in fault
    chain(op.Rotator(optional)).check()
    one, other = (op.Parameter(name, default=0.1, optional=True) for name in "ab")
    (fault,) = faults_of(chain(op.Retarder(one, other)))
    assert "several optional parameters (a, b)" in fault


@rows("reads", ["stoke", 3, None, op.Parameter("reads")])
def test_a_reading_that_does_not_exist_is_refused(reads):
    with pytest.raises(op.ValueFault, match="Detector reads"):
        op.Detector(reads=reads)


def test_an_azimuth_is_given_in_one_place():
    path = op.PathGraph()
    path.add("lamp", op.Source())
    path.add("filter", op.Polarizer(azimuth=0.1)) >> path.add("eye", op.Detector())
    path.connect("lamp.out", "filter.in", azimuth=0.2)
    (fault,) = faults_of(path)
    assert "give it in one place" in fault
