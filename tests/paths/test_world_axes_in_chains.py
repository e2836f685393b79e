"""Elements with axes in the world, put into chains of points."""

import numpy as np
import pytest

import optipath as op
from chains import ENGINES, random_chains
from histories import coherency, random_histories, stokes_in
from tables import rows, slow_except

MIRROR = [[0.0, 0.0, 2.0], [0.0, 0.0, 0.0], [0.0, 2.0, 0.0], [1.0, 2.0, 1.0]]
LEG = (0.0, 1.0, 0.0)


def put_in(path, axes, legs, name="P"):
    """Put a polarizer on each of some legs, its axis as it is seen across the light."""
    for leg, axis in axes.items():
        z = legs[..., leg, :]
        frame = op.Frame.from_direction(z, np.broadcast_to(axis, z.shape))
        behind = f"vertex{leg}" if leg else "light"
        path.insert(f"{name}{leg}", op.Polarizer(), behind=behind, frames={"in": frame})
    return path


@pytest.fixture(autouse=True)
def _double(request):
    if "jax" in ENGINES:
        request.getfixturevalue("jax")


@pytest.mark.parametrize("engine", slow_except(["numpy"], ENGINES))
@rows("opened", [False, True])
@rows("events", ["R", "T", "RT", "TRT", "RRR", "TRRT"])
def test_polarizers_in_space_do_what_projectors_of_the_field_do(events, opened, engine):
    rng = np.random.default_rng(100 + len(events))
    points, _, media = random_histories(3, events, 40)
    most = 2 ** (len(events) + 1)
    for taken in range(1, most) if engine == "numpy" else [most - 1]:
        legs = [leg for leg in range(len(events) + 1) if taken >> leg & 1]
        axes = {leg: rng.normal(size=3) for leg in legs}
        given = op.Parameter("points") if opened else points
        path = op.path_from_vertices(given, media, events=events)
        plan = op.Composer(engine=engine).compose(put_in(path, axes, np.diff(points, axis=-2)))
        light = plan.run(**({"points": points} if opened else {}))
        expected = stokes_in(coherency(points, events, media, axes=axes), light.frame)
        np.testing.assert_allclose(light.stokes, expected, rtol=0.0, atol=1e-13)


@rows("composing", ["stokes", "jones"])
def test_one_chain_is_run_alone_as_in_a_batch(composing):
    points = random_chains(4, 2, (3,))
    axes, legs = {0: (1.0, 2.0, 3.0), 1: (0.3, -1.0, 0.2)}, np.diff(points, axis=-2)
    composer = op.Composer(composing=composing)
    whole = composer.compose(put_in(op.path_from_vertices(points, [1.5, 2.0]), axes, legs)).run()
    for chain, each in enumerate(points):
        path = op.path_from_vertices(each, [1.5, 2.0], events="RR")
        one = composer.compose(put_in(path, axes, legs[chain])).run()
        np.testing.assert_allclose(one.stokes, whole.stokes[chain], rtol=1e-13, atol=1e-16)


def test_polarized_light_in_front_of_a_chain_keeps_its_frame():
    state = [1.0, 0.3, -0.5, 0.4]
    path = op.path_from_vertices(MIRROR, [1.5, 2.0], events="RR")
    path.replace("light", op.Source(stokes=state))
    frame = path.mueller().frame_in
    put_in(path, {0: (1.0, 2.0, 0.0)}, np.diff(MIRROR, axis=0))
    assert path.mueller().frame_in == frame
    passed = op.Polarizer().mueller(frame_in=path.graph.nodes["P0"]["frames"]["in"])
    arriving = op.Light(state, frame).in_frame(passed.frame_in)
    whole = op.path_from_vertices(MIRROR, [1.5, 2.0], events="RR").mueller()
    expected = whole.matrix @ (passed @ arriving).in_frame(frame).stokes
    np.testing.assert_allclose(path.trace().stokes, expected, rtol=0.0, atol=1e-15)


def test_by_angles_a_world_axis_stands_between_the_planes_of_incidence():
    turn = 0.7
    values = {"delta": 0.5, "phi": [0.6, 0.9], "rho": 0.4, "filter": "horizontal"}
    found = op.load_preset("npgr026-3d")
    # Of its middle leg, along world z, x is across the plane of incidence at its start.
    start = found.compose().run_all(**values)["E"]
    found.insert("W", op.Polarizer(), behind="X2", frames={"in": op.Frame().turned(turn)})
    plain = op.load_preset("npgr026")
    plain.insert("W", op.Polarizer(turn), behind="X2")
    for light in (found.trace(**values), op.Composer(engine="numba").compose(found).run(**values)):
        np.testing.assert_allclose(light.stokes, plain.trace(**values).stokes, rtol=1e-12)
        np.testing.assert_array_equal(light.frame.z, start.frame.z)
    with pytest.raises(
        op.errors.PathError, match=r"link 'X1.reflected -> V.in': light travels along"
    ):
        found.bind(**values).insert("V", op.Polarizer(), behind="X1", frames={"in": op.Frame()})


def test_ends_of_a_chain_may_have_world_frames_and_elements_behind_take_them():
    frame = op.Frame.from_direction((0.0, 0.0, -1.0), (1.0, 1.0, 0.0))
    last = op.Frame.from_direction((1.0, 0.0, 1.0), (0.0, 1.0, 0.0))
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(stokes=[1.0, 1.0, 0.0, 0.0]), {"out": frame})
    one, two = (op.SpecularVertex(1.5, MIRROR, place) for place in (1, 2))
    node = lamp >> path.add("a", one) >> path.add("b", two)
    node >> path.add("eye", op.Detector(), {"in": last})
    light = path.trace()
    whole = op.path_from_vertices(MIRROR, [1.5, 1.5], events="RR").mueller()
    arriving = op.Light([1.0, 1.0, 0.0, 0.0], frame).in_frame(whole.frame_in)
    expected = (whole @ arriving).in_frame(last)
    assert light.frame == last
    np.testing.assert_allclose(light.stokes, expected.stokes, rtol=0.0, atol=1e-15)
    path.insert("P", op.Polarizer(), behind="b", frames={"in": last})
    path.insert("plate", op.Retarder(0.5, 0.4), behind="P")
    assert path.graph.nodes["plate"]["frames"]["in"] is last
    passed = op.Retarder(0.5, 0.4).mueller().matrix @ op.Polarizer().mueller().matrix
    np.testing.assert_allclose(path.trace().stokes, passed @ expected.stokes, rtol=0, atol=1e-15)


def test_light_goes_back_through_world_axes_as_it_came():
    points = random_chains(6, 3, (20,))
    axes = {1: (1.0, 2.0, 3.0), 2: (0.3, -1.0, 0.2)}
    path = put_in(op.path_from_vertices(points, [1.5, 2.0, 1.3]), axes, np.diff(points, axis=-2))
    there, back = path.mueller().matrix, path.reversed().mueller().matrix
    flip = np.diag([1.0, 1.0, -1.0, 1.0])
    np.testing.assert_allclose(back, flip @ np.swapaxes(there, -1, -2) @ flip, rtol=0, atol=1e-15)


WRONG = r"light travels along \(0, 1, 0\), and the world frame along \(0, 0, 1\)"


@rows(
    "element, frames, sentence",
    [
        (op.Polarizer(), None, "stands relatively between .* or give it world frames"),
        (op.Polarizer(), {"in": op.Frame()}, f"^link 'vertex1.reflected -> P.in': {WRONG}; give"),
        (op.Polarizer(azimuth=0.2), {"in": LEG}, "by its world frames and by an azimuth"),
        (op.Polarizer(), {"inn": LEG}, "port 'P.inn' does not exist; did you mean 'P.in'"),
        (op.Polarizer(), LEG, "frames of 'P' must be a Frame for each port"),
        (op.BeamSplitter(), {"in": LEG}, "no one natural way out"),
    ],
)
def test_what_does_not_stand_in_the_light_is_refused_and_the_path_stays(element, frames, sentence):
    path = op.path_from_vertices(MIRROR, [1.5, 2.0], events="RR")
    before = path.to_toml()
    if isinstance(frames, dict):
        along = op.Frame.from_direction(LEG, (1.0, 0.0, 0.0))
        frames = {port: along if frame is LEG else frame for port, frame in frames.items()}
    with pytest.raises(op.errors.PathError, match=sentence) as told:
        path.insert("P", element, behind="vertex1", frames=frames)
    assert len(told.value.faults) == 1
    assert path.to_toml() == before


@rows("engine", ["numpy", "numba", "jax"])
def test_points_that_are_given_later_must_lead_along_the_world_frame(engine):
    if engine not in ENGINES:
        pytest.skip("no such engine")
    path = op.path_from_vertices(op.Parameter("points"), [1.5, 2.0])
    frame = op.Frame.from_direction(LEG, (1.0, 0.0, 1.0))
    path.insert("P", op.Polarizer(), behind="vertex1", frames={"in": frame})
    plan = op.Composer(engine=engine).compose(path)
    several = np.array([MIRROR] * 3)
    several[1] += [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 0.0]]
    with pytest.raises(
        op.errors.ParameterError, match=r"along \(-0.24.*\(at 1, of 3 paths\)$"
    ) as told:
        plan.run(points=several)
    assert len(told.value.faults) == 1
    assert plan.run(points=several[::2]).stokes.shape == (2, 4)


def test_where_chains_that_cannot_be_are_masked_those_off_a_world_frame_are():
    several = np.array([MIRROR, random_chains(3, 2)])
    path = op.path_from_vertices(several, [1.5, 2.0], events="RR", bad="mask")
    frame = op.Frame.from_direction(LEG, (1.0, 0.0, 1.0))
    path.insert("P", op.Polarizer(), behind="vertex1", frames={"in": frame})
    np.testing.assert_array_equal(np.isnan(path.trace().stokes).any(axis=-1), [False, True])
