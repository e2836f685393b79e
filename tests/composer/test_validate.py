"""World frames: what follows from those that are given, and what does not fit together."""

import numpy as np
import pytest

import optipath as op
from optipath.composer.wiring import cycles, stretches
from optipath.values.use import checked_later
from paths import chain
from tables import rows
from wired import wired

LAMP, EYE = {"lamp": op.Source()}, {"eye": op.Detector()}


def faults_of(path):
    with pytest.raises(op.errors.PathError) as error:
        path.check()
    return error.value.faults


@rows(
    "make, message",
    [
        (lambda: op.Interface(1.5, -0.1), "e0.incidence is -5.72"),
        (lambda: op.Interface(1.5, 1.6), "within 0 deg .. 90 deg"),
        (lambda: op.Interface(op.Material(-1.0, 0.0), 0.1), "e0.index.n is -1"),
        (lambda: op.Interface(1.5, 0.1, outside=0.0), "e0.outside is 0"),
        (lambda: op.Interface(1.5, 0.1, outside=1j), "e0.outside is 1j; give an index"),
        (lambda: op.Interface(1.5, 0.1, outside=op.Material(0.0, 0.1)), "e0.outside.n is 0"),
        (lambda: op.Interface(1.5, 0.1, outside=1.5 - 1j), "k > 0 absorbs"),
        (lambda: op.Interface(1.5, None), "e0.incidence must be"),
        (lambda: op.Polarizer(np.inf), "e0.angle is inf"),
        (lambda: op.Polarizer(1j), "e0.angle is complex"),
        (lambda: op.Attenuator(-0.1), "e0.transmittance is -0.1"),
        (lambda: op.MuellerElement(np.eye(3)), "shape (..., 4, 4), not (3, 3)"),
        (lambda: op.Source(-1.0), "lamp.intensity is -1"),
        (lambda: op.Source(stokes=[1.0, 1.0, 0.1, 0.0]), "more than 100 %"),
        (lambda: op.Source(stokes=[-1.0, 0.0, 0.0, 0.0]), "negative intensity -1"),
        (lambda: op.Source(stokes=[1.0, 0.0, 0.0]), "shape (..., 4), not (3,)"),
        (lambda: op.Source(stokes=[np.nan, 0.0, 0.0, 0.0]), "nan"),
    ],
)
def test_a_value_out_of_its_domain_is_named_with_its_node_where_a_path_is_checked(make, message):
    with checked_later():
        made = make()
        lamp = made if isinstance(made, op.Source) else op.Source()
        nodes = {"lamp": lamp, "e0": op.Attenuator(1.0) if lamp is made else made} | EYE
    leaves = next(iter(nodes["e0"].outputs))
    (fault,) = faults_of(wired(nodes, f"lamp -> e0.in, e0.{leaves} -> eye"))
    assert message in fault


def test_fully_polarised_light_is_allowed_whatever_its_rounding():
    state = [1.0, *(np.array([0.6, 0.48, 0.64]) * (1 + 1e-15))]
    assert chain([], state).trace().dop == pytest.approx(1.0)


def test_all_faults_are_told_at_once():
    with checked_later():
        nodes = {"lamp": op.Source(-1.0), "glass": op.Interface(np.nan, 2.0)}
    faults = faults_of(wired(nodes | {"alone": op.Polarizer()}, "lamp -> glass.in"))
    for part in ("lamp.intensity", "glass.index", "glass.incidence", "no detector"):
        assert sum(part in fault for fault in faults) == 1


class Trap(op.Element):
    """Lets all light out by one of two ports."""

    outputs = ("out", "dark")

    def couplings(self):
        return (op.Coupling("in", "out", ()),)


LOST = {"glass": op.Interface(1.5, 0.3), "lost": op.Polarizer()}
SCREEN = {"trap": Trap(), "screen": op.Detector()}
CYCLE = {"a": op.Combiner(), "b": op.Polarizer(), "split": op.BeamSplitter()}
THROUGH = "lamp -> e0, e0 -> eye"


@rows(
    "nodes, links, parts",
    [
        (
            {"e0": op.Polarizer()},
            "lamp -> eye, e0 -> eye",
            ["node 'e0' is reached by no source; link one to 'e0.in'"],
        ),
        (
            LOST,
            "lamp -> glass, glass.reflected -> eye, glass.transmitted -> lost",
            ["'lost' reaches no detector", "'lost.out'"],
        ),
        (
            {"e0": op.Polarizer(), "lamp2": op.Source()},
            f"{THROUGH}, lamp2 -> e0",
            ["'e0.in'", "'lamp.out' and 'lamp2.out'", "Combiner"],
        ),
        (
            SCREEN,
            "lamp -> trap, trap.out -> eye, trap.dark -> screen",
            ["link 'trap.dark -> screen.in' carries no light", "gives none there; remove the link"],
        ),
        ({"trap": Trap()}, "lamp -> trap, trap.out -> eye, trap.dark -> eye", ["carries no light"]),
        (
            CYCLE,
            "lamp -> a, a -> b, b -> split, split.reflected -> a, split.transmitted -> eye",
            ["light goes round in a cycle: a -> b -> split -> a; open it", "with loops='sum'"],
        ),
    ],
)
def test_nodes_that_light_does_not_pass_and_links_that_cannot_be_are_explained(nodes, links, parts):
    (fault,) = faults_of(wired(LAMP | nodes | EYE, links))
    assert all(part in fault for part in parts)


def test_a_path_needs_a_source_and_a_detector_and_a_dump_ends_light_as_well():
    assert len(faults_of(op.PathGraph())) == 2
    (fault,) = faults_of(wired(LAMP | {"dump": op.Dump()}, "lamp -> dump"))
    assert "no detector" in fault
    nodes = LAMP | {"split": op.BeamSplitter(), "dump": op.Dump()} | EYE
    path = wired(nodes, "lamp -> split, split.reflected -> eye, split.transmitted -> dump")
    path.check()
    assert path.trace().intensity == 0.5


def test_a_parameter_is_one_kind_of_value_of_one_dimension():
    both = op.Parameter("both")
    (fault,) = faults_of(op.Source(both, stokes=both) >> op.Detector())
    assert "'both' at source.stokes has another shape" in fault
    one, other = op.Parameter("a", default=0.1), op.Parameter("a", default=0.2)
    (fault,) = faults_of(chain([op.Rotator(one), op.Rotator(other)]))
    assert "'a' at e1.angle (a real angle in deg) differs from that at e0.angle" in fault
    turn = op.Parameter("turn", default=0.3)
    found = chain([op.Polarizer(), op.Rotator(turn), op.Rotator(-turn)]).trace(turn=1.1).stokes
    np.testing.assert_allclose(found, [0.5, 0.5, 0, 0], rtol=1e-15, atol=1e-16)


def test_shapes_that_do_not_broadcast_are_named_with_their_owners():
    with checked_later():
        path = chain([op.Polarizer(np.zeros(2), transmittance=np.ones(3), leakage=3.0)])
    faults = " | ".join(faults_of(path))
    assert "e0.leakage is 3" in faults
    assert "e0.angle (2,), e0.transmittance (3,)" in faults
    path = chain([op.Polarizer(np.zeros(3)), op.Polarizer(np.zeros(4)), op.Polarizer(0.0)])
    (fault,) = faults_of(path)
    assert "e0.angle (3,), e1.angle (4,)" in fault
    path = chain([op.Polarizer(np.zeros(3)), op.Rotator(op.Parameter("turn"))])
    assert path.trace(turn=np.zeros((2, 1))).stokes.shape == (2, 3, 4)
    with pytest.raises(op.errors.ParameterError, match=r"e0\.angle \(3,\), turn \(2,\)"):
        path.trace(turn=np.zeros(2))


def test_an_optional_parameter_may_only_take_out_what_light_goes_straight_through():
    a, b = (op.Parameter(name, default=0.1, optional=True) for name in "ab")
    (fault,) = faults_of(chain([op.Interface(1.5, a)]))
    assert "cannot be left out" in fault
    chain([op.Rotator(a)]).check()
    (fault,) = faults_of(chain([op.Retarder(a, b)]))
    assert "several optional parameters (a, b)" in fault


def test_a_reading_that_does_not_exist_and_an_azimuth_in_two_places_are_refused():
    for reads in ("stoke", 3, None, op.Parameter("reads")):
        with pytest.raises(op.errors.ValueFault, match="Detector reads"):
            op.Detector(reads=reads)
    path = wired(LAMP | {"filter": op.Polarizer(azimuth=0.1)} | EYE, "filter -> eye")
    path.connect("lamp.out", "filter.in", azimuth=0.2)
    (fault,) = faults_of(path)
    assert "give it in one place" in fault


def ways(text):
    """The ports to which light goes on, by pairs of names of a letter."""
    found = {}
    for start, end in text.split():
        found.setdefault((start, "p"), []).append((end, "p"))
        found.setdefault((end, "p"), [])
    return found


def names(ports):
    return "".join(name for name, _ in ports)


def test_ports_come_in_the_order_of_travel_and_those_of_a_loop_together():
    found = stretches(ways("ca db ae be"))
    assert names(s.ports[0] for s in found) == "cadbe"
    found = stretches(ways("ib bc ca ab co"))
    assert [names(s.ports) for s in found] == ["i", "bca", "o"]
    assert names(found[1].junctions) == "b"
    assert [{*names(ports)} for ports in cycles(ways("ia ab ba bc cb co"))] == [{*"abc"}]
    assert [{*names(ports)} for ports in cycles(ways("ix xy yx yo oe"))] == [{*"xy"}]


SIDE = op.Frame.from_direction(z=(0, 1, 0), x=(1, 0, 0))
THETA = float(np.radians(40.0))
MEETS = op.plane_of_incidence((0.0, np.sin(THETA), -np.cos(THETA)), normal=(0.0, 0.0, 1.0))


def window(index=1.5, **more):
    """A pane hit at 40 degrees, light falling along -z in the y-z plane."""
    path = wired({"eye": op.Detector()}, "")
    path.add("lamp", op.Source(), frames={"out": MEETS.arriving})
    frames = {"in": MEETS.arriving, "reflected": MEETS.reflected, **more}
    path.add("pane", op.Interface(index, THETA), frames=frames)
    path.connect("lamp", "pane")
    path.connect("pane.reflected", "eye")
    return path


def test_refracted_light_travels_as_snell_has_it():
    frame = window().trace(keep="all")["pane.transmitted"].frame
    sine = np.sin(THETA) / 1.5
    np.testing.assert_allclose(frame.z, [0.0, sine, -np.sqrt(1 - sine**2)], rtol=0, atol=1e-15)
    np.testing.assert_allclose(np.abs(frame.x), [1.0, 0.0, 0.0], rtol=0, atol=1e-15)


def test_light_that_passes_a_beam_splitter_keeps_its_frame():
    path = wired({"straight": op.Detector(), "aside": op.Detector()}, "")
    path.add("lamp", op.Source(), frames={"out": op.Frame()})
    path.add("split", op.BeamSplitter(), frames={"in": op.Frame(), "reflected": SIDE})
    for leaves, enters in (("lamp", "split"), ("split.transmitted", "straight")):
        path.connect(leaves, enters)
    path.connect("split.reflected", "aside")
    lights = path.trace_all()
    assert (lights["straight"].frame, lights["aside"].frame) == (op.Frame(), SIDE)


def test_frames_that_break_snells_law_or_are_missing_are_told():
    path = window(transmitted=MEETS.arriving)
    with pytest.raises(
        op.errors.PathError, match=r"'pane\.transmitted' turn light by 0 deg, .* 14\.6"
    ):
        path.check()
    path = window(index=op.Parameter("n"))
    path.add("behind", op.Detector())
    path.connect("pane.transmitted", "behind")
    with pytest.raises(
        op.errors.PathError, match=r"'pane\.transmitted' has no world frame, though"
    ):
        path.check()


@rows("passed", [False, True])
@rows("placed", [{}, {"in": op.Frame()}])
def test_light_from_directions_that_differ_cannot_meet(placed, passed):
    path = op.PathGraph()
    path.add("eye", op.Detector(), frames=placed)
    for name, frame in (("a", op.Frame()), ("b", SIDE)):
        path.add(name, op.Source(), frames={"out": frame})
        if passed:
            other = op.Frame.from_direction(z=frame.y, x=frame.x)
            path.add(f"{name}s", op.BeamSplitter(), frames={"in": frame, "reflected": other})
            path.connect(name, f"{name}s.in")
        path.connect(f"{name}s.transmitted" if passed else name, "eye")
    told = r"travels along \(0, [01], [01]\) cannot be aligned"
    if passed and not placed:
        told = "from directions that differ cannot meet at 'eye'"
    with pytest.raises(op.errors.PathError, match=told):
        path.check()
