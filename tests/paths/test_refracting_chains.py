import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import optipath as op
from chains import COMPILED, ENGINES, random_rotation
from histories import (
    coherency,
    exact_coherency,
    exact_stokes_in,
    random_histories,
    random_history,
    stokes_in,
)
from optipath.lab.accuracy.path_reference import exact_lights

EVENTS = ["T", "RT", "TTR", "TRRT", "RTTRT", "TTTTTT", "TRTRRTT", "RTRTRTRT", "RRRRRRRR"]
RUNS = [("numpy", events) for events in EVENTS] + [(engine, "TRT") for engine in ENGINES[1:]]
INTO_GLASS = [[0.0, -1.0, 1.0], [0.0, 0.0, 0.0], [0.0, 1.0, -np.sqrt(3.5)]]  # 45 degrees, 1.5
TURNED = [[0.0, 0.0, 1.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0]]


@pytest.fixture(autouse=True)
def _double():
    if "jax" not in ENGINES:
        yield
        return
    jax = pytest.importorskip("jax")
    jax.config.update("jax_enable_x64", True)  # noqa: FBT003 - as JAX has it
    yield
    jax.config.update("jax_enable_x64", False)  # noqa: FBT003 - ditto


def element_of(path, name):
    return path.graph.nodes[name]["element"]


@pytest.mark.parametrize(("engine", "events"), RUNS)
def test_random_histories_are_those_of_a_reference_without_frames(engine, events):
    points, normals, materials = random_histories(len(events), events, 2000)
    path = op.path_from_vertices(points, materials, normals, events=events)
    light = op.Composer(engine=engine).compose(path).run()
    expected = stokes_in(coherency(points, events, materials), light.frame)
    off = np.abs(light.stokes - expected) / np.maximum(expected[:, :1], 0.01)
    assert np.max(off) <= 1e-13


@pytest.mark.parametrize("seed", range(24))
def test_a_history_is_that_of_50_digits(seed):
    points, materials, events = random_history(seed)
    path = op.path_from_vertices(points, materials, events=events)
    light = path.trace()
    exact = exact_stokes_in(exact_coherency(points, events, materials), light.frame)
    np.testing.assert_allclose(light.stokes, exact, rtol=0, atol=1e-13 * exact[0])
    known = [float(part) for part in exact_lights(path)["eye"].stokes]
    np.testing.assert_allclose(known, exact, rtol=0, atol=1e-13 * exact[0])


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10**6), st.text("RT", min_size=1, max_size=8))
def test_no_history_makes_light_brighter_or_more_than_polarised_and_none_knows_its_world(
    seed, events
):
    points, _, materials = random_histories(seed, events, 20)
    light = op.path_from_vertices(points, materials, events=events).trace()
    assert np.all(light.intensity <= 1.0 + 1e-14)
    assert np.all(light.dop[light.intensity > 1e-9] <= 1.0 + 1e-9)
    rotation = random_rotation(np.random.default_rng(seed))
    turned = op.path_from_vertices(points @ rotation.T, materials, events=events).trace()
    np.testing.assert_allclose(turned.intensity, light.intensity, rtol=1e-9, atol=1e-13)
    moved = turned.in_frame(light.frame.rotated(rotation))
    np.testing.assert_allclose(moved.stokes, light.stokes, rtol=0, atol=1e-10)


def test_the_frame_of_the_light_is_across_the_last_plane_of_incidence():
    points, normals, materials = random_histories(3, "RTT", 100)
    frame = op.path_from_vertices(points, materials, events="RTT").trace().frame
    legs = np.diff(points, axis=1)
    last = legs[:, -1] / np.linalg.norm(legs[:, -1], axis=-1, keepdims=True)
    np.testing.assert_allclose(frame.z, last, rtol=0, atol=1e-15)
    # x is along k_out cross k_in, for light into the denser medium as well as out of it.
    across = np.cross(legs[:, -1], legs[:, -2])
    turned = np.linalg.norm(across, axis=-1) > 1e-3
    assert 50 < np.sum(turned) < 100
    assert np.all(np.sum(frame.x * across, axis=-1)[turned] > 0.0)
    off = np.sum(frame.x * normals[:, -1], axis=-1)[turned]
    np.testing.assert_allclose(off, 0.0, rtol=0, atol=1e-12)


def test_one_refraction_is_that_of_an_interface_at_its_angle():
    light = op.path_from_vertices(INTO_GLASS, [1.5], events="T").trace()
    matrix = op.Interface(1.5, np.pi / 4).mueller("in", "transmitted").matrix
    np.testing.assert_allclose(light.stokes, matrix[:, 0], rtol=0, atol=1e-15)


def test_light_goes_back_through_a_surface_as_it_came():
    points, _, materials = random_histories(5, "TTT", 200)
    # Between equal media the frames of the two ways differ by choice.
    others = (materials[0] != 1.0) & np.all(np.diff(materials, axis=0), axis=0)
    points, materials = points[others], [n[others] for n in materials]
    there = op.path_from_vertices(points, materials, events="TTT")
    media = [*materials[:-1][::-1], 1.0]
    back = op.path_from_vertices(points[:, ::-1], media, events="TTT", outside=materials[-1])
    flip = np.diag([1.0, 1.0, -1.0, 1.0])
    expected = flip @ np.swapaxes(there.mueller().matrix, -1, -2) @ flip
    np.testing.assert_allclose(back.mueller().matrix, expected, rtol=0, atol=1e-13)


def test_the_media_follow_along_the_chain():
    down = [[0, 0, z] for z in (3, 2, 1, 2, 1, 0)]
    path = op.path_from_vertices(down, [1.5, 1.2, 1.2, 1.2], events="TRRT", outside=1.1)
    assert [element_of(path, f"vertex{n}").outside for n in (1, 2, 3, 4)] == [1.1, 1.5, 1.5, 1.5]
    into, echo = ((0.4 / 2.6) ** 2, (0.3 / 2.7) ** 2)
    expected = (1.0 - into) * echo * echo * (1.0 - echo)
    np.testing.assert_allclose(path.trace().intensity, expected, rtol=1e-14)


@pytest.mark.parametrize("engine", ENGINES)
def test_between_equal_media_light_goes_straight_on_and_nothing_changes(engine):
    points, _, materials = random_histories(7, "R", 50)
    straight = np.concatenate([points, 2.0 * points[:, 2:] - points[:, 1:2]], axis=1)
    composer = op.Composer(engine=engine)
    expected = composer.compose(op.path_from_vertices(points, materials, events="R")).run()
    path = op.path_from_vertices(straight, [*materials, 1.0], events="RT")
    light = composer.compose(path).run().in_frame(expected.frame)
    np.testing.assert_allclose(light.stokes, expected.stokes, rtol=0, atol=1e-15)
    line = [[0, 0, 3], [0, 0, 2], [0, 0, 1]]
    alone = op.path_from_vertices(line, [1.33], events="T", outside=1.33)
    np.testing.assert_array_equal(alone.mueller().matrix, np.eye(4))


@pytest.mark.parametrize("bent", [1e-15, 1e-12, 1e-9, 1e-7, 1e-4])
def test_light_that_is_hardly_turned_keeps_its_digits_beside_other_planes(bent):
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [1 + bent, 2, 0.7 * bent], [0.3, 2, 1]])
    materials = [0.2 + 3.4j, 1.2, 1.1 + 2j]
    light = op.path_from_vertices(points, materials, events="RTR").trace()
    exact = exact_stokes_in(exact_coherency(points, "RTR", materials), light.frame)
    np.testing.assert_allclose(light.stokes, exact, rtol=0, atol=1e-14)


@pytest.mark.parametrize("engine", COMPILED)
def test_a_batch_is_the_same_as_one_history_after_the_other(engine):
    points, _, materials = random_histories(9, "TR", 300)
    composer = op.Composer(engine=engine)
    light = composer.compose(op.path_from_vertices(points, materials, events="TR")).run()
    for at in (0, 77, 299):
        one = op.path_from_vertices(points[at], [m[at] for m in materials], events="TR").trace()
        np.testing.assert_allclose(light.stokes[at], one.stokes, rtol=0, atol=1e-15)


@pytest.mark.parametrize("engine", ENGINES)
def test_points_and_indices_may_be_given_when_the_path_runs(engine):
    points, _, materials = random_histories(11, "TR", 500)
    given = [materials[0], op.Parameter("n")]
    path = op.path_from_vertices(op.Parameter("points"), given, events="TR")
    plan = op.Composer(engine=engine).compose(path)
    known = [materials[0], 1.9]
    expected = op.path_from_vertices(points, known, events="TR").trace()
    found = plan.run(points=points, n=1.9)
    np.testing.assert_allclose(found.stokes, expected.stokes, rtol=0, atol=1e-13)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("count", [1, 7, 3000])
def test_points_that_no_surface_refracts_so_are_refused_when_they_are_given(engine, count):
    points = np.array([INTO_GLASS] * count)
    plan = op.Composer(engine=engine).compose(
        op.path_from_vertices(op.Parameter("points"), [op.Parameter("n")], events="T")
    )
    assert np.all(plan.run(points=points, n=1.5).intensity > 0.9)
    points[-1] = TURNED
    message = r"turned by 90 deg at 'vertex1', but a refraction from n = 1 into n = 1.5 \(par"
    with pytest.raises(op.ParameterError, match=message) as error:
        plan.run(points=points, n=1.5)
    assert count == 1 or f"of {count} paths" in str(error.value)
    with pytest.raises(op.ParameterError, match="lets it go straight on"):
        plan.run(points=points[0], n=1.0)


@pytest.mark.parametrize(
    ("points", "materials", "others", "message"),
    [
        (TURNED, [1.5], {}, "by 90 deg at 'vertex1', but .* turns it by 48.18968"),
        ([INTO_GLASS, TURNED], [1.5], {}, r"90 deg at 'vertex1'.*\(at 1, of 2 paths\)"),
        (INTO_GLASS, [1.0], {}, "from n = 1 into n = 1 lets it go straight on; move the points"),
        (INTO_GLASS, [1.0], {"outside": 1.01}, "turns it by 8.0693"),
        (INTO_GLASS, [1.5 + 0.1j], {}, "vertex1.index is complex; give a real index"),
        (
            INTO_GLASS,
            [op.Material(1.5, 0.1)],
            {},
            "vertex1.index.k is 0.1; give 0, since light goes on in there",
        ),
        (INTO_GLASS, [0.0], {}, "vertex1.index is 0"),
        (op.VerticesByAngles((0.3,)), [1.5], {}, "'?vertex1'?.vertices are angles, which say refl"),
        (INTO_GLASS, [1.5], {"events": "t"}, "events is 't'; give R .*: 'T'"),
        (INTO_GLASS, [1.5], {"events": " T"}, "events is ' T'; give R .*: 'T'"),
        (INTO_GLASS, [1.5], {"events": 1}, "events is 1; give R .*, such as 'RT'"),
        (INTO_GLASS, [1.5], {"events": "TT"}, "events has 2 letters for 1 material; give R or T"),
        (INTO_GLASS, [1.5], {"events": ""}, "events has 0 letters for 1 material"),
        (INTO_GLASS, [1.5], {"outside": 1j}, "outside is complex; give a real index"),
        (INTO_GLASS, [1.5], {"outside": -1.0}, "outside is -1"),
        (INTO_GLASS, [1.5], {"outside": op.FOLLOWS}, "outside .*FOLLOWS"),
        (INTO_GLASS, [op.Parameter("n")], {"normals": [[0, 0, 1]]}, "media that are known; leave"),
        (INTO_GLASS, [1.5], {"normals": [[0, 1, 1]]}, "vertex 1 is off the one that refracts"),
    ],
)
def test_what_is_wrong_is_told_in_words(points, materials, others, message):
    with pytest.raises(op.PathError, match=message) as error:
        op.path_from_vertices(points, materials, **{"events": "T", **others})
    assert len(error.value.faults) == 1


@pytest.mark.parametrize("medium", [1.5 + 1j, op.Material(1.5, 0.1), -1.0, np.inf, "glass"])
@pytest.mark.parametrize("events", ["TTR", "TRR", "TRT"])
def test_a_medium_that_light_cannot_go_on_in_is_told_once(events, medium):
    points = [*INTO_GLASS, [0.0, 2.0, -3.0], [0.0, 3.0, -3.0]]
    with pytest.raises(op.PathError, match=r"^vertex1\.index") as error:
        op.path_from_vertices(points, [medium, 1.2, 3.0], events=events)
    assert len(error.value.faults) == 1


def test_normals_of_both_kinds_are_checked_and_between_equal_media_any_will_do():
    points, normals, materials = random_histories(13, "TRTT", 500)
    materials[3] = materials[2]
    points[:, 5] = 2.0 * points[:, 4] - points[:, 3]
    normals[:, 3] = np.random.default_rng(0).normal(size=(500, 3))
    op.path_from_vertices(points, materials, -7.0 * normals, events="TRTT")
    for vertex, word in ((1, "the one that refracts"), (2, "the bisector")):
        wrong = normals.copy()
        wrong[321, vertex - 1] += 1e-5 * points[0, 0]
        with pytest.raises(op.PathError, match=rf"vertex {vertex} of chain 321 is off {word}"):
            op.path_from_vertices(points, materials, wrong, events="TRTT")


def test_points_that_may_be_those_of_a_refraction_are_asked_about():
    message = (
        r"turned by 16.8745 deg at vertex 1, which is a reflection at an incidence of 81.5628 deg, "
        r"or a refraction from n = 1 into n = 1.5 at 45 deg; say which, events='R' where it is "
        r"reflected, events='T' where it goes through"
    )
    with pytest.raises(op.PathError, match=message):
        op.path_from_vertices(INTO_GLASS, [1.5])
    assert op.path_from_vertices(INTO_GLASS, [1.5], events="R").trace().intensity < 0.5
    assert op.path_from_vertices(INTO_GLASS, [1.5], events="T").trace().intensity > 0.9


def test_the_cure_that_is_offered_is_for_the_whole_chain():
    slab = np.array([[0, -1, 1], [0, 0, 0], [0, 1, -np.sqrt(3.5)], [0, 2, -np.sqrt(3.5) - 1]])
    with pytest.raises(op.PathError, match=r"events='RR' where .* events='TT' where it goes"):
        op.path_from_vertices(slab, [1.5, 1.0])
    op.path_from_vertices(slab, [1.5, 1.0], events="TT")


@pytest.mark.parametrize(
    ("points", "materials", "others"),
    [
        (INTO_GLASS, [1.5 + 2j], {}),  # What absorbs lets nothing through.
        (INTO_GLASS, [1.0], {}),  # Equal media do not turn light.
        ([INTO_GLASS, TURNED], [1.5], {}),  # One chain can only be reflected.
        ([[0, 0, 0], [0, 0, 1], [0, 0, 2]], [1.5], {}),  # Straight on.
        (op.Parameter("points"), [1.5], {}),  # Not known yet.
        (INTO_GLASS, [op.Parameter("n")], {}),
        (INTO_GLASS, [np.array([])], {}),
        (op.VerticesByAngles((1.5,)), [1.5], {}),
        (INTO_GLASS, [1.5], {"normals": np.diff(np.diff(INTO_GLASS, axis=0), axis=0)}),
    ],
)
def test_nothing_is_asked_where_there_is_one_reading(points, materials, others):
    if "normals" in others:
        legs = np.diff(INTO_GLASS, axis=0)
        legs /= np.linalg.norm(legs, axis=-1, keepdims=True)
        others = {"normals": np.diff(legs, axis=0)}
    path = op.path_from_vertices(points, materials, **others)
    assert element_of(path, "vertex1").kind == "specular-vertex"


def test_defaults_of_parameters_are_known_enough_to_be_asked_about():
    points, n = op.Parameter("points", default=INTO_GLASS), op.Parameter("n", default=1.5)
    with pytest.raises(op.PathError, match="say which"):
        op.path_from_vertices(points, [n])


def test_a_chain_that_refracts_goes_to_toml_and_back(tmp_path):
    path = op.path_from_vertices(INTO_GLASS, [op.Parameter("n", default=1.5)], events="T")
    file = tmp_path / "glass.toml"
    file.write_text(path.to_toml(), "utf-8")
    assert 'kind = "refracting-vertex"' in file.read_text("utf-8")
    assert op.load_preset(file) == path
    assert op.load_preset(file).trace() == path.trace()


DOWN = [[0.0, 0, 3], [0, 0, 0], [0, 0, -1]]


@pytest.mark.parametrize("given", [{"outside": (1.0, 0.1)}, {"materials": [(1.5, 0.1)]}])
def test_two_numbers_for_a_medium_are_asked_about(given):
    with pytest.raises(op.PathError, match="may be n and k, or the indices of two paths"):
        op.path_from_vertices(DOWN, **{"materials": [1.5], "events": "T"} | given)


@pytest.mark.parametrize("media", [np.array([1.5, 0.2 + 3.4j, 1.0]), [1.5 + 0j, 0.2 + 3.4j, 1]])
def test_media_that_an_array_made_complex_are_the_real_ones_that_they_are(media):
    points = [[0.0, 0, 3], [0, 0, 2], [0, 0, 1], [0, 0, 2], [0, 0, 3]]
    expected = op.path_from_vertices(points, [1.5, 0.2 + 3.4j, 1.0], events="TRT").trace()
    assert op.path_from_vertices(points, media, events="TRT").trace() == expected


def test_events_are_not_counted_against_materials_that_are_none():
    with pytest.raises(op.PathError) as told:
        op.path_from_vertices(DOWN, 1.5, events="T")
    assert len(told.value.faults) == 1


@pytest.mark.parametrize("dtype", ["float32", "float64"])
def test_light_goes_straight_on_between_equal_media_in_any_precision(dtype):
    rng = np.random.default_rng(5)
    start, along = rng.normal(size=(2, 50, 3))
    points = np.stack([start, start + along, start + 2.3 * along], axis=1)
    path = op.path_from_vertices(points, [1.0], events="T")
    light = op.Composer(dtype=dtype).compose(path).run()
    np.testing.assert_array_equal(light.intensity, 1.0)


def test_in_singles_x_is_kept_between_equal_media_as_the_frame_has_it():
    rng = np.random.default_rng(3)
    source, start, along = rng.normal(size=(3, 50, 3))
    points = np.stack([source, start, start + along, start + 2.3 * along], axis=1)
    expected = op.path_from_vertices(points[:, :3], [1.5], events="R").trace()
    path = op.path_from_vertices(points, [1.5, 1.0], events="RT")
    light = op.Composer(dtype="float32").compose(path).run().in_frame(expected.frame)
    np.testing.assert_allclose(light.stokes, expected.stokes, rtol=0, atol=1e-6)
