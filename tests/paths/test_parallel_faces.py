"""Which faces are parallel: what they say, what turns the way between, and where light returns."""

import itertools

import numpy as np
import pytest

import optipath as op
from tables import rows
from wired import wired

THETA = np.radians(40.0)
INSIDE = np.arcsin(np.sin(THETA) / 1.5)
F = op.FOLLOWS


def slab(front, back, *, between=None, to="front.back", azimuth=None, before=None):
    """Two faces; light goes to and fro between them where it has a way back."""
    given = {"before": before, "front": front, "between": between, "back": back}
    row = {name: element for name, element in given.items() if element is not None}
    path = wired({"lamp": op.Source(), **row, "T": op.Detector()}, "", loops="sum")
    light = "lamp.out"
    for name in row:
        path.connect(light, f"{name}.in")
        light = f"{name}.{'out' if name == 'between' else 'transmitted'}"
    path.connect(light, "T.in")
    if to:
        path.connect("back.reflected", to, azimuth=azimuth)
    return path


def fault_of(path, **parameters):
    with pytest.raises(op.OptipathError) as error:
        path.trace(**parameters)
    (fault,) = error.value.faults
    return fault


GLASS = op.Interface(1.5, THETA)
WRONG = op.Interface(1.0, THETA, outside=1.5)
RIGHT = op.Interface(1.0, THETA, outside=1.5, incidence_in=1.0)
TAKING = op.Interface(1.0, F, outside=F)


def fresnel_slab():
    s = (np.sin(THETA - INSIDE) / np.sin(THETA + INSIDE)) ** 2
    p = (np.tan(THETA - INSIDE) / np.tan(THETA + INSIDE)) ** 2
    return sum((1 - r) / (1 + r) / 2 for r in (s, p))


@rows("before", [None, op.LayerStack([1, 1.5, 1], "10 deg")])
@rows("back", [RIGHT, TAKING])
def test_a_front_that_is_not_parallel_to_what_is_before_it_is_parallel_to_its_back(before, back):
    front = op.Interface(1.5, THETA, parallel=False)
    light = slab(front, back, before=before).trace()
    if before is None:
        assert light.intensity == pytest.approx(fresnel_slab(), rel=1e-12)
        assert f"{light.intensity:.6f}" == "0.914261"
    assert "n sin(incidence)" in fault_of(slab(front, WRONG, before=before))


@rows("azimuth", [0.3, 1e-6, np.pi / 2])
def test_no_azimuth_in_a_loop_switches_the_look_at_angles_off(azimuth):
    turned = op.Interface(1.0, THETA, outside=1.5, azimuth=azimuth)
    filtered = slab(GLASS, WRONG, between=op.Polarizer(0.0, azimuth=azimuth))
    for path in (slab(GLASS, WRONG, azimuth=azimuth), slab(GLASS, turned), filtered):
        with pytest.raises(op.PathError, match=r"n sin\(incidence\)"):
            path.trace()
    # A turn of a thousandth is none without a loop, too.
    turned = op.Interface(1.0, THETA, outside=1.5, azimuth=1e-4)
    assert "n sin(incidence)" in fault_of(slab(GLASS, turned, to=None))


def test_faces_between_which_light_goes_to_and_fro_have_one_plane_of_incidence():
    words = "light goes to and fro between 'back' and 'front', which are parallel then, but"
    assert words in fault_of(slab(GLASS, RIGHT, azimuth=0.3))
    assert "turns the plane of incidence by 17.18873385 deg" in fault_of(
        slab(GLASS, RIGHT, between=op.Polarizer(0.0, azimuth=0.3))
    )
    turned = op.Interface(1.0, THETA, outside=1.5, incidence_in=1.0, azimuth=op.Parameter("a"))
    path = slab(GLASS, turned)
    assert path.trace(a=0.0).intensity == pytest.approx(fresnel_slab(), rel=1e-12)
    assert path.trace(a=np.pi).intensity == pytest.approx(fresnel_slab(), rel=1e-12)
    assert "40.10704566 deg (parameter 'a')" in fault_of(path, a=0.7)
    # Turns add up along the way.
    undone = slab(GLASS, turned, between=op.Polarizer(0.0, azimuth=0.3))
    undone.trace(a=-0.3)
    assert "let the azimuths on the way add up to 0" in fault_of(undone, a=0.0)


def test_faces_at_normal_incidence_may_be_turned_and_others_that_take_over_may_not():
    constant = slab(GLASS, op.Interface(1.0, F, outside=F, azimuth=0.7), to=None)
    assert "'back' takes its incidence over (FOLLOWS), as a face parallel" in fault_of(constant)
    path = slab(GLASS, op.Interface(1.0, F, outside=F, azimuth=op.Parameter("a")), to=None)
    path.trace(a=0.0)
    for a in (0.7, [0.0, 0.7]):
        assert "by 40.10704566 deg (parameter 'a')" in fault_of(path, a=a)
    for azimuth in (0.7, op.Parameter("a", 0.7)):
        back = op.Interface(1.0, F, outside=F, azimuth=azimuth)
        for to in (None, "front.back"):
            light = slab(op.Interface(1.5, 0.0), back, to=to, azimuth=azimuth if to else None)
            loss = 2 * 1.5 / (1 + 1.5**2) if to else 0.96**2
            assert light.trace().intensity == pytest.approx(loss, rel=1e-12)


@rows("indices", [[1, 1.5, 1], [1, 1.5, 1.3, 1.7]])
def test_a_stack_that_is_turned_about_its_normal_does_the_same(indices):
    state, turn = np.array([1, 0.4, 0.3, 0.2]), 0.3
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source(stokes=state))
    light, incidence = "lamp.out", op.Parameter("t", 0.0)
    for number, index in enumerate(indices[1:]):
        azimuth = op.Parameter(f"a{number}", 0.0 if number == 0 else turn * (-2) ** number)
        face = op.Interface(index, F if number else incidence, F if number else 1, azimuth=azimuth)
        path.add(f"f{number}", face)
        path.connect(light, f"f{number}.in")
        if number:
            path.connect(f"f{number}.reflected", f"f{number - 1}.back", azimuth=azimuth)
        light = f"f{number}.transmitted"
    path.add("T", op.Detector())
    path.add("R", op.Detector())
    path.connect(light, "T.in")
    path.connect("f0.reflected", "R.in")
    # Of layers that lose nothing and do not interfere, (1 - T) / T adds up.
    pairs = np.array(list(itertools.pairwise(indices)))
    loss = np.sum((pairs[:, 0] - pairs[:, 1]) ** 2 / (4 * pairs[:, 0] * pairs[:, 1]))
    through, back = 1 / (1 + loss), loss / (1 + loss)
    both = 2 * sum(turn * (-2) ** number for number in range(1, len(indices) - 1))
    c, s = np.cos(both), np.sin(both)
    turned = [1, c * state[1] + s * state[2], c * state[2] - s * state[1], state[3]]
    found = path.trace_all()
    np.testing.assert_allclose(found["T"].stokes, through * np.array(turned), atol=1e-14)
    np.testing.assert_allclose(found["R"].stokes, back * state * [1, 1, -1, -1], atol=1e-14)


@rows("back", [None, -0.3, op.Parameter("b")])
def test_light_that_goes_to_and_fro_is_turned_alike_on_both_ways(back):
    turned = op.Interface(1.0, F, outside=F, azimuth=0.3)
    late = {"b": [0.3, -0.3]} if isinstance(back, op.Parameter) else {}
    fault = fault_of(slab(op.Interface(1.5, 0.0), turned, azimuth=back), **late)
    second = "0 deg" if back is None else "-17.18873385 deg"
    assert "by 17.18873385 deg on the way from 'front.transmitted' to 'back.in', and by" in fault
    assert f"and by {second}" in fault
    assert "let the azimuths on either way add up to the same" in fault
    several = op.Interface(1.0, F, outside=F, azimuth=np.array([0.0, np.pi, 0.3]))
    assert fault_of(slab(op.Interface(1.5, 0.0), several)).endswith("(at 2, of 3 paths)")
    # A half turn is none to polarised light.
    half = slab(op.Interface(1.5, 0.0), turned, azimuth=0.3 - np.pi)
    assert half.trace().intensity == pytest.approx(2 * 1.5 / (1 + 1.5**2), rel=1e-12)


def before_mirror(go, back, *, again=None):
    """A face with a mirror behind it, and another between that and the way back, or none."""
    ends = {"lamp": op.Source(stokes=[1, 0.4, 0.3, 0.2]), "f": op.Interface(1.5, 0.0)}
    ends |= {"m": op.Mirror(-0.9, azimuth=go), "plate": op.Retarder(0.0), "R": op.Detector()}
    path = wired(ends, "lamp -> f, f.transmitted -> m, m -> plate, f.reflected -> R", loops="sum")
    light = "plate"
    if again is not None:
        light = path.add("again", op.Mirror(azimuth=again)).name
        path.connect("plate", light)
    path.connect(light, "f.back", azimuth=back)
    return path


@rows("go", [0.3, op.Parameter("a"), np.array([0.0, 0.3])])
def test_light_that_a_mirror_sends_back_is_turned_alike_on_both_ways(go):
    late = {"a": 0.3} if isinstance(go, op.Parameter) else {}
    fault = fault_of(before_mirror(go, None), **late)
    assert "between 'f' and 'm', but is turned by 17.18873385 deg" in fault
    assert "from 'f.transmitted' to 'm.in', and by 0 deg from 'm.reflected' to 'f.back'" in fault
    # A mirror without axes may turn about its normal: it is 0.04 + 0.96^2 0.81 / (1 - 0.04 0.81).
    r = 0.04 + 0.96**2 * 0.81 / (1 - 0.04 * 0.81)
    light = before_mirror(go, go).trace(**late).stokes
    shape = np.broadcast_shapes(light.shape, (4,))
    expected = np.broadcast_to(r * np.array([1, 0.4, -0.3, -0.2]), shape)
    np.testing.assert_allclose(light, expected, rtol=1e-12, atol=1e-15)
    # What two mirrors send back may be turned.
    assert before_mirror(0.3, None, again=0.2).trace().S0 > 0.0


def test_a_ring_may_turn_its_light_and_a_face_at_an_angle_sends_none_back():
    turned = op.Interface(1.0, F, outside=F, azimuth=op.Parameter("turn"))
    ends = {"lamp": op.Source(stokes=[1, 1, 0, 0]), "both": op.Combiner(), "R": op.Detector()}
    path = wired(
        {**ends, "a": op.Interface(1.5, 0.0), "b": turned, "half": op.Attenuator(0.5)},
        "lamp -> both, both -> a, a.transmitted -> b, b.transmitted -> half, half -> both, a -> R",
        loops="sum",
    )
    turn = np.array([0.0, 0.3])
    # What goes round is turned by as much each time: a geometric series in exp(-2i turn).
    once = 0.5 * 0.96**2
    linear = 0.04 / (1 - once * np.exp(-2j * turn))
    light = path.trace(turn=turn)
    np.testing.assert_allclose(light.S0, 0.04 / (1 - once), rtol=1e-12)
    np.testing.assert_allclose(light.S1, linear.real, rtol=1e-12)
    np.testing.assert_allclose(light.S2, -linear.imag, rtol=0, atol=1e-15)
    front = op.Interface(1.5, "48.59 deg")
    back = op.Interface(1.0, "20 deg", outside=1.5, parallel=False)
    slab(front, back, to=None).check()
    fault = fault_of(slab(front, back))
    assert "between 'front' and 'back', which says parallel=False: what comes back" in fault


@rows("turned_first", [True, False])
def test_every_route_to_a_face_is_looked_at(turned_first):
    filters = op.Polarizer(0.0, azimuth=0.5), op.Polarizer(0.0)
    ends = dict(zip(["a", "b"] if turned_first else ["b", "a"], filters, strict=True))
    ends |= {"lamp": op.Source(), "front": GLASS, "half": op.BeamSplitter()}
    path = wired(
        {**ends, "both": op.Combiner(), "back": WRONG, "T": op.Detector()},
        "lamp -> front, front.transmitted -> half, half.transmitted -> a, a -> both, b -> both, "
        "both -> back, back.transmitted -> T",
    )
    path.connect("half.transmitted", "b.in", tap=True)
    with pytest.raises(op.PathError) as error:
        path.check()
    assert any("n sin(incidence)" in fault for fault in error.value.faults)


def test_beyond_the_critical_angle_the_one_behind_is_a_right_angle():
    t = np.radians(np.arange(90.0))
    u = op.refraction_angle(1.0, t, 1.5)
    gap = op.Interface(1.0, op.Parameter("t"), outside=1.5)
    beyond = op.Interface(1.5, op.Parameter("u"), outside=1.0)
    for to in (None, "front.back"):
        light = slab(gap, beyond, to=to).trace(t=t, u=u)
        assert np.all(light.intensity[np.sin(t) > 1 / 1.5] == pytest.approx(0.0, abs=1e-12))
        assert light.intensity[0] > 0.9
        # A right angle for light that does get there is wrong.
        with pytest.raises(op.ParameterError, match=r"n sin\(incidence\)"):
            slab(gap, beyond, to=to).trace(t=t, u=np.pi / 2)
    outside = op.Interface(1.0, np.pi / 2, outside=1.5, incidence_in=1.0)
    dense = op.Interface(1.5, "60 deg", outside=1.5)
    assert "n sin(incidence)" in fault_of(slab(dense, outside, to=None))


def test_multiples_absorptions_and_what_is_taken_for_granted_are_told():
    def plates(**about):
        plate = op.LayerStack([1, 1.5, 1], "30 deg")
        return slab(plate, op.LayerStack([1, 1.5, 1], "60 deg", **about), to=None)

    assert fault_of(plates()).endswith(
        "(60 deg in n = 1); give 'back' an incidence of 30 deg in n = 1, or op.FOLLOWS (faces are "
        "taken as parallel behind one that refracts; "
        "if 'back' stands at an angle to 'front', as those of a prism do, say parallel=False)"
    )
    plates(parallel=False).check()
    turning = plates(azimuth=op.Parameter("turn"))
    assert turning.trace(turn=[0.1, 0.5]).shape == (2,)
    where = "planes of incidence are one where azimuths come to 0 deg (parameter 'turn')"
    assert where in fault_of(turning, turn=[0.0, 0.1, 0.5])
    n, m = op.Parameter("n"), op.Parameter("m")
    twice = op.Interface(1.0, F, outside=2 * m)
    path = slab(op.Interface(1.5, THETA), twice, to=None)
    assert "but its outside is 2 * m = 1.6; give 2 * m = 1.5, or op.FOLLOWS" in fault_of(
        path, m=0.8
    )
    path.trace(m=0.75)
    # No value of a parameter makes it the same as its double.
    path = slab(op.Interface(n, THETA), op.Interface(1.0, F, outside=2 * n), to=None)
    fault = fault_of(path, n=1.5)
    assert "is lit from n = 1.5 (parameter 'n')" in fault
    assert fault.endswith("but its outside is 2 * n = 3; give op.FOLLOWS for outside")
    path = slab(op.Interface(2 * n, THETA), op.Interface(1.0, F, outside=1.5), to=None)
    assert "'back.in' is lit from 2 * n = 1.6 behind 'front'" in fault_of(path, n=0.8)
    front = op.Interface(op.Material(op.Parameter("n"), op.Parameter("k")), 0.3)
    path = slab(front, op.LayerStack([F, 1.2, 1.0], 0.1, parallel=False), to=None)
    path.trace(n=1.5, k=0.0)
    fault = fault_of(path, n=1.5, k=0.1)
    assert "with k = 0.1 (parameter 'k') behind 'front' (by 'front.transmitted')" in fault


@rows("late", [False, True])
def test_of_a_row_of_faults_only_the_first_is_told(late):
    path = op.PathGraph()
    path.add("lamp", op.Source())
    light = "lamp.out"
    indices = [1.0, 1.5, 1.4, 1.6, 1.3, 1.7, 1.0]
    for number, (outside, index) in enumerate(itertools.pairwise(indices)):
        given = op.Parameter("t", THETA) if late and number == 2 else THETA
        face = op.Interface(index, given, outside, incidence_in=None if number == 2 else 1.0)
        path.add(f"f{number}", face)
        path.connect(light, f"f{number}.in")
        light = f"f{number}.transmitted"
    path.add("T", op.Detector())
    path.connect(light, "T.in")
    assert "enters 'f2.in'" in fault_of(path)
