"""A million chains of three reflections in space: from points to light, beside angles alone."""

import numpy as np
import pytest

import optipath as op
from subjects import ENGINES, finished

COUNT = 1_000_000
MATERIALS = (1.5, 1.12 + 2.16j, 0.608 + 2.12j)
GROUP = "a million chains of three reflections, {}"


def points(seed):
    """Return new vertices, (COUNT, 5, 3)."""
    middle = np.array([[0, 0, 0], [0, 0, 4], [4, 0, 0], [0, 4, 4], [4, 4, 0]])
    return np.random.default_rng(seed).normal(middle, size=(COUNT, 5, 3))


@pytest.mark.parametrize("engine", ENGINES)
def test_points_that_are_given_to_a_plan(benchmark, engine):
    benchmark.group = GROUP.format(engine)
    path = op.path_from_vertices(op.Parameter("points"), MATERIALS)
    plan, several = op.Composer(engine=engine).compose(path), [points(0), points(1)]
    finished(plan.run(points=several[0]).stokes)
    benchmark(lambda: finished(plan.run(points=several[1]).stokes))


@pytest.mark.skipif("numba" not in ENGINES, reason="needs Numba")
def test_a_path_of_its_own_for_new_points(benchmark):
    benchmark.group = GROUP.format("numba")
    several = [points(0), points(1)]
    finished(op.path_from_vertices(several[0], MATERIALS).trace().stokes)
    benchmark(lambda: finished(op.path_from_vertices(several[1], MATERIALS).trace().stokes))


@pytest.mark.parametrize("engine", ENGINES)
def test_points_and_the_world_frame_of_the_last_leg(benchmark, engine):
    benchmark.group = GROUP.format(engine)
    plan = op.Composer(engine=engine).compose(
        op.path_from_vertices(op.Parameter("points"), MATERIALS)
    )
    chains = points(0)
    finished(plan.run(points=chains).stokes)
    benchmark(lambda: plan.run(points=chains).frame.x)


@pytest.mark.parametrize("engine", ENGINES)
def test_the_same_reflections_by_angles_without_a_world(benchmark, engine):
    benchmark.group = GROUP.format(engine)
    path, rng = op.PathGraph(), np.random.default_rng(0)
    node, given = path.add("light", op.Source()), {}
    for number, index in enumerate(MATERIALS):
        angle, turn = op.Parameter(f"angle{number}"), op.Parameter(f"turn{number}")
        given |= {angle.name: rng.uniform(0.0, np.pi / 2, COUNT)}
        given |= {turn.name: rng.uniform(-np.pi, np.pi, COUNT)}
        node = node >> path.add(f"x{number}", op.Interface(index, angle, azimuth=turn))
    node >> path.add("eye", op.Detector())
    plan = op.Composer(engine=engine).compose(path)
    finished(plan.run(**given).stokes)
    benchmark(lambda: finished(plan.run(**given).stokes))


EVENTS = "RTRTRTRT"
MIXED = (0.2 + 3.4j, 1.5, 1.1, 1.0, 1.12 + 2.16j, 1.5, 1.1, 1.0)
MIXED_GROUP = "a million chains of four reflections and four refractions, {}"


def histories(seed):
    """Return new vertices that light is reflected and refracted at in turn, (COUNT, 10, 3)."""
    directions, across = [np.array([0.0, 0.0, 1.0])], np.array([1.0, 0.0, 0.0])
    for event in EVENTS:
        z = directions[-1]
        across = np.cross(z, across) + 0.5 * across
        across -= (across @ z) * z
        across /= np.linalg.norm(across)
        turned = np.radians(90.0 if event == "R" else 20.0)
        directions.append(np.cos(turned) * z + np.sin(turned) * across)
    middle = np.cumsum([np.zeros(3), *directions], axis=0)
    return np.random.default_rng(seed).normal(middle, 0.03, size=(COUNT, 10, 3))


@pytest.mark.parametrize("engine", ENGINES)
def test_points_of_mixed_chains_that_are_given_to_a_plan(benchmark, engine):
    benchmark.group = MIXED_GROUP.format(engine)
    path = op.path_from_vertices(op.Parameter("points"), MIXED, events=EVENTS)
    plan, several = op.Composer(engine=engine).compose(path), [histories(0), histories(1)]
    finished(plan.run(points=several[0]).stokes)
    benchmark(lambda: finished(plan.run(points=several[1]).stokes))


@pytest.mark.skipif("numba" not in ENGINES, reason="needs Numba")
def test_a_path_of_its_own_for_new_points_of_mixed_chains(benchmark):
    benchmark.group = MIXED_GROUP.format("numba")
    several = [histories(0), histories(1)]
    finished(op.path_from_vertices(several[0], MIXED, events=EVENTS).trace().stokes)
    benchmark(
        lambda: finished(op.path_from_vertices(several[1], MIXED, events=EVENTS).trace().stokes)
    )
