"""Where light goes from boundary to boundary, media and Snell's law agree on both sides."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import optipath as op
from chains import ENGINES
from tables import rows
from wired import wired

THETA = np.radians(40.0)
INSIDE = np.arcsin(np.sin(THETA) / 1.5)
GLASS = op.Interface(1.5, THETA)
FOLLOWING = op.Interface(1.0, op.FOLLOWS, outside=op.FOLLOWS)


class Window(op.Element):
    """An element of one's own that light goes straight through."""

    loss: op.Fraction = 0.1

    @staticmethod
    def mueller_rows(xp, loss):
        del xp
        t = 1.0 - loss
        return (t, 0, 0, 0), (0, t, 0, 0), (0, 0, t, 0), (0, 0, 0, t)


def faces(*chain, back="in"):
    """A lamp, boundaries and what stands between, each lit by what passes the one before."""
    path, light = op.PathGraph(loops="sum"), "lamp.out"
    path.add("lamp", op.Source())
    for number, element in enumerate(chain):
        name = ("front", *["between"] * (len(chain) - 2), "back")[number]
        path.add(name, element)
        path.connect(light, f"{name}.{back if name == 'back' else 'in'}")
        ways = [out for out in ("out", "transmitted", "reflected") if out in element.outputs]
        light = f"{name}.{ways[0]}"
    path.add("T", op.Detector())
    path.connect(light, "T.in")
    return path


def faults_of(path, **parameters):
    with pytest.raises(op.PathError) as error:
        path.trace(**parameters)
    return error.value.faults


def test_a_second_face_that_forgets_its_medium_or_where_its_angle_is_measured_is_refused():
    (fault,) = faults_of(faces(GLASS, op.Interface(1.0, THETA, incidence_in=1.0)))
    assert fault == (
        "'back.in' is lit from n = 1.5 behind 'front' (by 'front.transmitted'), but its outside "
        "is 1; give outside = 1.5, or op.FOLLOWS for outside"
    )
    (fault,) = faults_of(faces(GLASS, op.Interface(1.0, THETA, outside=1.5)))
    for part in (
        "'front.transmitted' enters 'back.in'",
        "n sin(incidence) is 0.6427876097 at 'front' and 0.9641814145 at 'back'",
        f"incidence of {np.degrees(INSIDE):.10g} deg in n = 1.5, or",
        "40 deg with incidence_in = 1, or op.FOLLOWS",
        "parallel=False",
    ):
        assert part in fault


@rows(
    "back",
    [
        op.Interface(1.0, THETA, outside=1.5, incidence_in=1.0),
        op.Interface(1.0, INSIDE, outside=1.5),
        FOLLOWING,
        op.Interface(1.0, op.FOLLOWS, outside=op.Material(1.5)),
        op.LayerStack([1.5, 1.5, 1.0], THETA, incidence_in=1.0),
        op.LayerStack([op.FOLLOWS, 1.5, 1.0], op.FOLLOWS),
    ],
)
def test_a_slab_lets_through_0_912_however_its_second_face_is_written_rightly(back):
    # T_s and T_p of the two faces by Fresnel's printed formulas.
    sines = [
        (np.sin(2 * THETA) * np.sin(2 * INSIDE) / np.sin(THETA + INSIDE) ** 2 / c) ** 2
        for c in (1.0, np.cos(THETA - INSIDE) ** 2)
    ]
    light = faces(GLASS, back).trace()
    assert light.intensity == pytest.approx(np.mean(sines), rel=1e-14)
    assert f"{light.intensity:.3f}" == "0.912"


STRAIGHT = [op.Medium(0.1, 1.0), op.Polarizer(0.3), op.Attenuator(0.5), op.Rotator(0.2)]
STRAIGHT += [op.Retarder(0.3), op.Depolarizer(0.1), op.BeamSplitter(0.3), op.Combiner()]
STRAIGHT += [op.MuellerElement(np.eye(4)), Window()]


@rows("between", STRAIGHT)
def test_what_light_goes_straight_through_stands_in_the_same_medium(between):
    (fault,) = faults_of(faces(GLASS, between, op.Interface(1.0, THETA, incidence_in=1.0)))
    assert "outside is 1; give outside = 1.5" in fault
    (fault,) = faults_of(faces(GLASS, between, op.Interface(1.0, THETA, outside=1.5)))
    assert "n sin(incidence)" in fault
    faces(GLASS, between, FOLLOWING).check()
    # A mirror turns light but keeps it in its medium.
    (fault,) = faults_of(faces(GLASS, op.Mirror(), op.Interface(1.0, 0.7)))
    assert "outside is 1; give outside = 1.5" in fault
    faces(GLASS, op.Mirror(), op.Interface(1.0, 0.7, outside=1.5)).check()


def test_what_light_meets_next_is_in_the_medium_it_is_in():
    path = op.Source() >> op.Interface(1.5, 0.3).named("first")
    path = path >> op.Interface(1.5, 0.9, outside=1.33).named("second") >> op.Detector()
    (fault,) = faults_of(path)
    assert "'second.in' is lit from n = 1 in front of 'first' (by 'first.reflected')" in fault
    (fault,) = faults_of(faces(GLASS, op.Interface(1.6, THETA, incidence_in=1.0), back="back"))
    assert "'back.back' is lit from n = 1.5 behind 'front'" in fault
    assert "its index is 1.6; give index = 1.5" in fault
    back = op.LayerStack([0.6, 1.0, 1.2], 0.1, parallel=False)
    for index in (0.6 + 2j, op.Material(0.6, 2.0)):
        (fault,) = faults_of(faces(op.Interface(index, THETA), back))
        assert "'back.in' is lit from a medium that absorbs, with k = 2 behind 'front'" in fault
    metal = op.Interface(op.Material(0.6, op.Parameter("k")), THETA)
    with pytest.raises(op.ParameterError, match=r"k = 2 \(parameter 'k'\)"):
        faces(metal, back).trace(k=2.0)

    def unfolded(index, incidence, **about):
        path = faces(GLASS, FOLLOWING)
        path.add("again", op.Interface(index, incidence, **about))
        path.add("R", op.Dump())
        path.connect("back.reflected", "again.back")
        path.connect("again.reflected", "R.in")
        return path

    unfolded(1.5, THETA).check()
    unfolded(1.5, 0.1, parallel=False).check()
    assert "its index is 1.6" in faults_of(unfolded(1.6, THETA))[0]
    assert "'back.reflected' enters 'again.back'" in faults_of(unfolded(1.5, 0.1))[0]
    # Two faces of one gap are parallel, whichever side they turn to it.
    ends = {"a": op.Interface(1.5, 0.3), "b": op.Interface(1.5, 0.4)}
    path = wired(
        {"lamp": op.Source(), **ends, "eye": op.Detector()},
        "lamp -> a.back, a.reflected -> b, b.reflected -> a, b.transmitted -> eye",
        loops="sum",
    )
    (fault,) = faults_of(path)
    assert "n sin(incidence)" in fault


def test_faces_at_an_angle_say_so_by_a_flag_or_by_their_frames():
    def prism(**about):
        base = op.Interface(1.0, np.pi / 4, outside=op.FOLLOWS, **about)
        ends = op.Interface(1.5, 0.0), op.Interface(1.0, 0.0, outside=op.FOLLOWS)
        elements = {"lamp": op.Source(), "entry": ends[0], "base": base, "exit": ends[1]}
        links = "lamp -> entry, entry.transmitted -> base, base -> exit, exit.transmitted -> eye"
        return wired({**elements, "eye": op.Detector()}, links)

    # Total reflection at the base, and 4 % lost at either face.
    light = prism(parallel=False).trace()
    assert light.intensity == pytest.approx(0.96**2, rel=1e-14)
    assert prism(parallel=False) != prism()
    assert "'entry.transmitted' enters 'base.in'" in faults_of(prism())[0]
    # A prism: the second face is not parallel, and its frames say so.
    along = op.Frame.from_direction(z=(0, 0, 1), x=(1, 0, 0))
    mirrored = op.Frame.from_direction(z=(0, 1, 0), x=(1, 0, 0))
    path = op.PathGraph()
    path.add("lamp", op.Source(), {"out": along})
    path.add("front", op.Interface(1.5, 0.0), {"in": along, "transmitted": along})
    base = op.Interface(1.0, np.pi / 4, outside=op.FOLLOWS)
    path.add("base", base, {"in": along, "reflected": mirrored})
    path.add("eye", op.Detector(), {"in": mirrored})
    for link in (("lamp", "front"), ("front.transmitted", "base"), ("base.reflected", "eye")):
        path.connect(*link)
    assert path.trace().intensity == pytest.approx(0.96, rel=1e-14)


@rows("turn, is_parallel", [(0.0, True), (np.pi, True), (-np.pi, True), (0.5, False)])
def test_a_face_turned_about_the_light_has_another_plane_of_incidence(turn, is_parallel):
    path = faces(GLASS, op.Interface(1.0, THETA, outside=1.5, azimuth=turn))
    if is_parallel:
        assert "n sin(incidence)" in faults_of(path)[0]
    else:
        path.check()
    # The turn may be given when the path runs, and turns add up along the way.
    turned = op.Interface(1.0, THETA, outside=1.5, azimuth=op.Parameter("turn"))
    for late in (faces(GLASS, turned), faces(GLASS, op.Polarizer(0, azimuth=0.5), turned)):
        extra = -0.5 if "between" in late.graph else 0.0
        if is_parallel:
            with pytest.raises(op.ParameterError, match=r"n sin\(incidence\)"):
                late.trace(turn=turn + extra)
        else:
            late.trace(turn=turn + extra)


OPEN = (
    op.Interface(op.Parameter("n"), op.Parameter("theta")),
    op.Interface(1.0, op.Parameter("phi"), outside=op.Parameter("m")),
)


def test_values_are_looked_at_whenever_they_are_given_and_give_nan_where_jax_traces():
    path = faces(*OPEN)
    path.check()
    good = {"n": 1.5, "m": 1.5, "theta": THETA, "phi": INSIDE}
    for _ in range(8):  # Long enough for functions and recipes to be made.
        path.trace(**good)
        path.trace(**{name: np.full(5, value) for name, value in good.items()})
    with pytest.raises(op.ParameterError) as error:
        path.trace(**good | {"m": 1.6})
    # An angle in a medium that is wrong itself says nothing.
    (media,) = error.value.faults
    assert "n = 1.5 (parameter 'n')" in media
    assert "outside is 1.6 (parameter 'm'); give m = 1.5" in media
    for wrong, told in (
        ({"phi": 0.1}, r"\(parameter 'phi'\)"),
        ({"n": np.full(5, 1.5), "m": [1.5, 1.5, 1.5, 1.6, 1.5]}, "but its outside is"),
        ({"n": np.nan}, "parameter 'n' is nan"),
    ):
        with pytest.raises(op.ParameterError, match=told):
            path.trace(**good | wrong)
    jax = pytest.importorskip("jax")
    plan = op.Composer(dtype="float32").compose(faces(*OPEN))

    @jax.jit
    def intensity(n, m, phi):
        return plan.run(n=n, m=m, theta=THETA, phi=phi).intensity

    assert float(intensity(1.5, 1.5, INSIDE)) == pytest.approx(0.9116117533, rel=1e-6)
    assert np.isnan(float(intensity(1.5, 1.6, INSIDE)))
    assert np.isnan(float(intensity(1.5, 1.5, THETA)))


@pytest.mark.parametrize("engine", ENGINES)
def test_every_engine_refuses_media_that_do_not_meet(engine):
    plan = op.Composer(engine=engine).compose(faces(*OPEN))
    n = np.linspace(1.2, 1.8, 50)
    theta = np.linspace(0.0, 1.5, 50)
    phi = np.arcsin(np.sin(theta) / n)
    assert plan.run(n=n, m=n, theta=theta, phi=phi).stokes.shape == (50, 4)
    with pytest.raises(op.ParameterError, match="is lit from n"):
        plan.run(n=n, m=n[::-1], theta=theta, phi=phi)
    for question in (plan.run_all, plan.mueller, plan.paths):
        with pytest.raises(op.ParameterError, match="n sin"):
            question(n=1.5, m=1.5, theta=0.3, phi=0.3)


def test_angles_may_be_rounded_and_one_parameter_on_both_sides_is_not_looked_at():
    single = np.float32
    n, theta = single(1.33), np.linspace(0.0, 1.5, 7, dtype=single)
    faces(*OPEN).trace(n=n, m=1.33, theta=theta, phi=np.arcsin(np.sin(theta) / n))
    faces(GLASS, op.Interface(1.0, single(INSIDE), outside=single(1.5))).check()
    for digits in (3, 5, 7):
        short = round(INSIDE, digits)
        assert faults_of(faces(GLASS, op.Interface(1.0, short, outside=1.5)))
    # Next to grazing incidence, where a sine hardly changes.
    grazing = np.radians(89.999)
    fault = faults_of(faces(op.Interface(1.0, grazing), op.Interface(1.0, np.pi / 2)))[0]
    assert "n sin(incidence)" in fault
    # Of layers that may absorb one asks how much, and of dichroism whether light is lost.
    for preset in {*op.preset_names()} - {"absorbing-pile", "dichroic-sheet"}:
        assert op.load_preset(preset).compose().inputs.agreements == ()
    n, minus = op.Parameter("n"), -op.Parameter("theta")
    back = op.Interface(1.0, minus, outside=n, incidence_in=1.0)
    assert faces(op.Interface(n, minus), back).compose().inputs.agreements == ()
    other = op.Interface(1.0, op.Parameter("theta"), outside=n, incidence_in=1.0)
    # The other sign is another angle.
    assert len(faces(op.Interface(n, minus), other).compose().inputs.agreements) == 1


LOSSLESS = [op.Medium(0.1), op.Attenuator(1.0), op.Rotator(0.0), op.Combiner(), op.Retarder(0.0)]


class Hand:
    """A stack of random media, whose faces are written in one of several right ways."""

    def __init__(self, seed):
        self.rng = rng = np.random.default_rng(seed)
        self.indices = [1.0, *rng.uniform(1.0, 2.0, rng.integers(1, 5)), 1.0]
        self.theta = float(rng.uniform(0.0, 1.4))
        self.values = {}
        self.faces = []
        for before, behind in zip(self.indices, self.indices[1:], strict=False):
            own = float(np.arcsin(np.sin(self.theta) / before))
            ways = [
                op.Interface(behind, self.theta, outside=before, incidence_in=1.0),
                op.Interface(behind, own, outside=before),
                op.Interface(op.Material(behind), self.given(own), outside=self.given(before)),
            ]
            if self.faces:
                ways.append(op.Interface(behind, op.FOLLOWS, outside=op.FOLLOWS))
            self.faces.append(ways[rng.integers(len(ways))])

    def given(self, value):
        """A constant, an array, or a parameter that is given it."""
        way = self.rng.integers(3)
        if way < 2:
            return (value, np.full(2, value))[way]
        name = f"p{len(self.values)}"
        self.values[name] = value
        return op.Parameter(name)

    def traced(self):
        rng, path = self.rng, op.PathGraph(loops="sum")
        path.add("lamp", op.Source())
        light, back = "lamp.out", ""
        for number, face in enumerate(self.faces):
            for place in range(rng.integers(3) if number else 0):
                between = f"between {number}{place}"
                path.add(between, LOSSLESS[rng.integers(len(LOSSLESS))])
                path.connect(light, f"{between}.in")
                light = f"{between}.out"
            path.add(f"face {number}", face)
            path.connect(light, f"face {number}.in")
            if number:
                path.connect(f"face {number}.reflected", back)
            light, back = f"face {number}.transmitted", f"face {number}.back"
        path.add("T", op.Detector())
        path.connect(light, "T.in")
        # A face may be written in another way than the one that they were drawn for.
        return path.trace(**{name: self.values[name] for name in path.parameters})


SEEDS = st.integers(0, 10**6)


@settings(max_examples=25)
@given(seed=SEEDS)
def test_faces_written_rightly_by_hand_are_the_stack(seed):
    hand = Hand(seed)
    whole = op.LayerStack(hand.indices, hand.theta).mueller("in", "transmitted").matrix[:, 0]
    light = hand.traced()
    expected = np.broadcast_to(whole, light.stokes.shape)
    np.testing.assert_allclose(light.stokes, expected, rtol=0, atol=2e-14)


@settings(max_examples=50)
@given(seed=SEEDS, wrong=st.sampled_from(["outside", "index", "incidence"]))
def test_one_wrong_medium_or_angle_of_a_stack_by_hand_is_refused(seed, wrong):
    hand = Hand(seed)
    # A face that follows another has nothing of its own that could be wrong but its index.
    own = [n for n, face in enumerate(hand.faces) if n and face.outside is not op.FOLLOWS]
    number = hand.rng.choice(own) if own and wrong != "index" else 0
    assume(number or wrong == "index")
    face = hand.faces[number]
    change = 1.0 + 10.0 ** hand.rng.uniform(-6, -1)
    if wrong == "incidence":
        angle = (
            hand.theta
            if face.incidence_in is not None
            else np.arcsin(np.sin(hand.theta) / hand.indices[number])
        )
        hand.faces[number] = replace(face, incidence=float(angle / change))
    elif wrong == "outside":
        hand.faces[number] = replace(face, outside=hand.indices[number] * change)
    else:
        hand.faces[0] = replace(face, index=hand.indices[1] * change)
        if len(hand.faces) > 1 and hand.faces[1].outside is op.FOLLOWS:
            hand.faces[1] = replace(hand.faces[1], outside=hand.indices[1])
    with pytest.raises(op.OptipathError, match=r"is lit from n|n sin\(incidence\)"):
        hand.traced()
