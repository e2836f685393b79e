import numpy as np
import pytest

import optipath as op
from chains import by_engine
from paths import chain
from tables import rows
from wired import read, read_back


@rows("count", [1, 2, 3, 4, 5])
def test_points_have_the_angles_that_they_were_made_of(count):
    rng = np.random.default_rng(count)
    incidences = rng.uniform(0.1, 1.5, (count, 20))
    turns = rng.uniform(-3.0, 3.0, (count - 1, 20))
    points = op.vertices_from_angles(list(incidences), list(turns))
    assert points.shape == (20, count + 2, 3)
    legs, frame = np.diff(points, axis=-2), None
    np.testing.assert_allclose(np.linalg.norm(legs, axis=-1), 1.0, rtol=1e-15)
    for vertex in range(count):
        before, behind = legs[:, vertex], legs[:, vertex + 1]
        meets = op.plane_of_incidence(before, behind - before)
        np.testing.assert_allclose(meets.incidence, incidences[vertex], rtol=1e-13)
        if frame is not None:
            expected = frame.turned(turns[vertex - 1])
            np.testing.assert_allclose(meets.arriving.x, expected.x, rtol=0, atol=1e-13)
        frame = meets.reflected


def test_angles_broadcast_are_bound_and_go_to_files(tmp_path):
    # The middle leg lies along the world's z.
    points = op.vertices_from_angles([0.3, 0.4, 0.5], [1.0, 2.0])
    np.testing.assert_array_equal(points[1:3], [[0, 0, 0], [0, 0, 1]])
    points = op.vertices_from_angles([np.zeros((4, 1)), np.ones(3)], [0.5])
    assert points.shape == (4, 3, 4, 3)
    by_angles = op.VerticesByAngles((op.Parameter("phi"), 0.4), (op.Parameter("turn"),))
    path = op.path_from_vertices(by_angles, [1.5, 1.5])
    assert path.parameters["phi"].unit == "deg"
    light, expected = path.bind(phi=0.3, turn=1.0).trace(), path.trace(phi=0.3, turn=1.0)
    np.testing.assert_allclose(light.stokes, expected.stokes, rtol=1e-15, atol=1e-16)
    assert light.frame == expected.frame
    angles = (op.Parameter("phi", 0.5), 0.25), (-op.Parameter("rho", 0.125),)
    path = op.path_from_vertices(op.VerticesByAngles(*angles), [1.5, 1.12 + 2.16j])
    assert read_back(path, tmp_path) == path
    assert 'turns = ["-$rho"]' in path.to_toml()


@by_engine
def test_a_chain_by_angles_is_the_chain_of_its_points(engine):
    rng = np.random.default_rng(1)
    phi, delta, rho = rng.uniform(0.05, 1.5, (3, 2000))
    names = [op.Parameter(name) for name in ("phi", "delta", "rho")]
    by_angles = op.VerticesByAngles((names[0], names[1]), (-names[2],))
    path = op.path_from_vertices(by_angles, [1.5, 1.12 + 2.16j])
    light = op.Composer(engine=engine).compose(path).run(phi=phi, delta=delta, rho=rho)
    points = op.vertices_from_angles([phi, delta], [-rho])
    expected = op.path_from_vertices(points, [1.5, 1.12 + 2.16j]).trace()
    np.testing.assert_allclose(light.stokes, expected.stokes, rtol=1e-11, atol=1e-15)
    np.testing.assert_allclose(light.frame.x, expected.frame.x, rtol=0, atol=1e-13)


@rows(
    "arguments, message",
    [
        (((),), "need an incidence for each reflection"),
        (((0.1, 0.2),), "2 incidences and 0 turns make no chain; give 1 turn,"),
        (((0.1,), (0.2,)), "1 incidence and 1 turn make no chain; give 0 turns"),
        ((0.1,), "incidences must be a sequence of angles, not 0.1"),
        ((np.array(0.3),), "incidences must be a sequence of angles"),
        (("0.1",), "incidences must be a sequence of angles"),
    ],
)
def test_angles_that_make_no_chain_are_refused(arguments, message):
    for make in (op.VerticesByAngles, op.vertices_from_angles):
        with pytest.raises(op.errors.PathError, match=message):
            make(*arguments)
    with pytest.raises(op.errors.ValueFault, match=r"vertices.incidences\[0\] is 114.592 deg"):
        op.vertices_from_angles([2.0])


def test_tables_of_angles_with_faults_are_told_by_key(tmp_path):
    text = op.path_from_vertices(op.VerticesByAngles((0.25,)), [1.5]).to_toml()
    (line,) = (line for line in text.splitlines() if line.startswith("vertices = "))
    for table, told in (
        ('{ incidence = ["1 deg"] }', "(?s)key 'incidence' is unknown.*did you mean 'incidences'"),
        ("{ incidences = [0.5], turns = 3 }", "'turns' must be a list, not 3"),
        ("{ turns = [] }", "need an incidence"),
    ):
        with pytest.raises(op.errors.PathError, match=told):
            read(text.replace(line, f"vertices = {table}"), tmp_path)


@rows("axis", ["none", "horizontal", "diagonal", 0.2])
@rows("metals", [{}, {"n1": 1.12, "k1": 2.16, "n2": 0.608, "k2": 2.12}])
def test_the_turn_counts_next_to_the_normal_and_to_grazing_incidence_too(axis, metals):
    rho = np.array([0.0, 0.5, -2.0])[:, np.newaxis, np.newaxis]
    edges = np.array([0.0, 1e-17, 1e-15, 1e-8, 1e-7, 0.3, np.pi / 2 - 1e-15, np.pi / 2])
    for angles in ({"delta": edges[:, np.newaxis], "phi": edges}, {"delta": 0.0, "phi": 1e-17}):
        given = {**angles, "rho": rho, "filter": axis, **metals}
        space, plane = (op.load_preset(name).trace(**given) for name in ("npgr026-3d", "npgr026"))
        np.testing.assert_allclose(space.stokes, plane.stokes, rtol=0, atol=1e-13)


def test_frames_at_vertices_without_a_plane_are_those_of_the_angles():
    space = op.load_preset("npgr026-3d")
    light = space.trace(delta=0.0, phi=0.7, rho=0.5)
    expected = [np.cos(0.5), -np.sin(0.5), 0.0]
    np.testing.assert_allclose(light.frame.x, expected, rtol=1e-15, atol=1e-16)
    near = space.trace(delta=1e-6, phi=0.7, rho=0.5)
    np.testing.assert_allclose(light.frame.x, near.frame.x, rtol=0, atol=1e-9)
    np.testing.assert_allclose(light.stokes, near.stokes, rtol=0, atol=1e-9)


@rows("small", [0.0, 1e-15, 1e-10])
def test_a_filter_before_a_long_chain_is_in_the_plane_that_the_angles_say(small):
    angles, turns = (small, 0.5, 0.6, 0.7), (0.4, 1.0, -0.7)
    by_angles, metal = op.VerticesByAngles(angles, turns), 0.2 + 3.4j
    space = [op.SpecularVertex(metal, by_angles, place) for place in (1, 2, 3, 4)]
    azimuths = zip(angles, (0.0, *turns), strict=True)
    plane = [op.Interface(metal, angle, azimuth=azimuth) for angle, azimuth in azimuths]
    found, wanted = (chain([op.Polarizer(0.3), *all_of]).trace() for all_of in (space, plane))
    np.testing.assert_allclose(found.stokes, wanted.stokes, rtol=0, atol=1e-8)
