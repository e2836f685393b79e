"""A million chains in space: from points to light, beside angles alone."""

import numpy as np
import pytest

import optipath as op
from subjects import COMPILED, ENGINES, finished, long, needs_numba, traced

COUNT = 1_000_000
METALS = (1.5, 1.12 + 2.16j, 0.608 + 2.12j)
MIXED = (0.2 + 3.4j, 1.5, 1.1, 1.0, 1.12 + 2.16j, 1.5, 1.1, 1.0)
KINDS = {
    "three reflections": (METALS, "RRR"),
    "four reflections and four refractions": (MIXED, "RTRTRTRT"),
}


@pytest.fixture(scope="session", params=[*KINDS][:1] + long(*[*KINDS][1:]))
def chains(request):
    """Two arrays of vertices, 100,000 different chains each, materials, and events."""
    materials, events = KINDS[request.param]
    count = COUNT // 10, 1
    refracted = np.tile(np.array([*events]) == "T", count)
    several = [traced(refracted, np.tile(np.real(materials), count), seed) for seed in (0, 1)]
    return request.param, [np.concatenate([each] * 10) for each in several], materials, events


@pytest.mark.parametrize("engine", ENGINES)
def test_points_that_are_given_to_a_plan(benchmark, chains, engine):
    kind, several, materials, events = chains
    benchmark.group = f"a million chains of {kind}, {engine}"
    path = op.path_from_vertices(op.Parameter("points"), materials, events=events)
    plan = op.Composer(engine=engine).compose(path)
    finished(plan.run(points=several[0]).stokes)
    benchmark(lambda: finished(plan.run(points=several[1]).stokes))


@needs_numba
def test_a_path_of_its_own_for_new_points(benchmark, chains):
    kind, several, materials, events = chains
    benchmark.group = f"a million chains of {kind}, numba"
    finished(op.path_from_vertices(several[0], materials, events=events).trace().stokes)
    benchmark(
        lambda: finished(op.path_from_vertices(several[1], materials, events=events).trace().stokes)
    )


@pytest.mark.parametrize("engine", [*COMPILED, *long("jax")])
@pytest.mark.parametrize("chains", ["three reflections"], indirect=True)
def test_points_and_the_world_frame_of_the_last_leg(benchmark, chains, engine):
    kind, several, materials, events = chains
    benchmark.group = f"a million chains of {kind}, {engine}"
    path = op.path_from_vertices(op.Parameter("points"), materials, events=events)
    plan = op.Composer(engine=engine).compose(path)
    finished(plan.run(points=several[0]).stokes)
    benchmark(lambda: plan.run(points=several[0]).frame.x)


@pytest.mark.parametrize("engine", ENGINES)
def test_the_same_reflections_by_angles_without_a_world(benchmark, engine):
    benchmark.group = f"a million chains of three reflections, {engine}"
    path, rng = op.PathGraph(), np.random.default_rng(0)
    node, given = path.add("light", op.Source()), {}
    for number, index in enumerate(METALS):
        angle, turn = op.Parameter(f"angle{number}"), op.Parameter(f"turn{number}")
        given |= {angle.name: rng.uniform(0.0, np.pi / 2, COUNT)}
        given |= {turn.name: rng.uniform(-np.pi, np.pi, COUNT)}
        node = node >> path.add(f"x{number}", op.Interface(index, angle, azimuth=turn))
    node >> path.add("eye", op.Detector())
    plan = op.Composer(engine=engine).compose(path)
    finished(plan.run(**given).stokes)
    benchmark(lambda: finished(plan.run(**given).stokes))
