"""Light that goes round: a slab beside its closed series, and graphs of many loops composed."""

import numpy as np
import pytest

import optipath as op
from subjects import ENGINES, finished, long

COUNT = 1_000_000
THETA = np.linspace(0.0, 1.5, COUNT)


@pytest.mark.parametrize("engine", ENGINES)
def test_a_slab_solved_for(benchmark, engine):
    benchmark.group = f"a million slabs, {engine}"
    path = op.load_preset("glass-slab").reading("intensity")
    plan = op.Composer(engine=engine).compose(path)
    finished(plan.run(theta=THETA).intensity)
    benchmark(lambda: finished(plan.run(theta=THETA).intensity))


@pytest.mark.parametrize("engine", ENGINES)
def test_a_slab_as_a_stack_of_layers(benchmark, engine):
    benchmark.group = f"a million slabs, {engine}"
    path = op.PathGraph()
    path.add("lamp", op.Source())
    path.add("slab", op.LayerStack([1.0, 1.5, 1.0], op.Parameter("theta")))
    path.add("eye", op.Detector("intensity"))
    path.connect("lamp.out", "slab.in")
    path.connect("slab.transmitted", "eye.in")
    plan = op.Composer(engine=engine).compose(path)
    finished(plan.run(theta=THETA).intensity)
    benchmark(lambda: finished(plan.run(theta=THETA).intensity))


def test_one_reflection_and_the_closed_series_by_numpy(benchmark):
    benchmark.group = "a million slabs, numpy"

    def series():
        c, s = np.cos(THETA), np.sin(THETA)
        g = np.sqrt(1.5**2 - s * s)
        F, G = ((c - g) / (c + g)) ** 2, ((2.25 * c - g) / (2.25 * c + g)) ** 2
        return 0.5 * ((1 - F) / (1 + F) + (1 - G) / (1 + G))

    benchmark(series)


def loops(count):
    """Return a chain of so many slabs, with a polariser, a rotator and a wave plate behind each."""
    path, before = op.PathGraph(loops="sum"), "lamp.out"
    path.add("lamp", op.Source())
    for i in range(count):
        path.add(f"front{i}", op.Interface(1.5, 0.7))
        path.add(f"down{i}", op.Medium(1e-3, 0.1))
        path.add(f"back{i}", op.Interface(1.0, 0.7, outside=1.5, incidence_in=1.0))
        path.add(f"up{i}", op.Medium(1e-3, 0.1))
        path.add(f"aside{i}", op.Dump())
        links = [(before, f"front{i}.in"), (f"front{i}.transmitted", f"down{i}.in")]
        links += [(f"down{i}.out", f"back{i}.in"), (f"back{i}.reflected", f"up{i}.in")]
        links += [(f"up{i}.out", f"front{i}.back"), (f"front{i}.reflected", f"aside{i}.in")]
        before = f"back{i}.transmitted"
        several = (op.Polarizer(0.3, leakage=0.9), op.Rotator(0.1), op.Retarder(0.2, 0.3))
        for j, element in enumerate((*several, op.Attenuator(0.999), op.Attenuator(0.999))):
            path.add(f"e{i}-{j}", element)
            links.append((before, f"e{i}-{j}.in"))
            before = f"e{i}-{j}.out"
        for start, end in links:
            path.connect(start, end)
    path.add("eye", op.Detector())
    path.connect(before, "eye.in")
    return path


@pytest.mark.parametrize("count", [100, 1_000, *long(10_000)])
def test_composing_ten_nodes_a_loop(benchmark, count):
    benchmark.group = "graphs of ten nodes a loop, composed"
    path = loops(count)
    benchmark.pedantic(op.Composer().compose, (path,), rounds=1 if count > 1000 else 3)


@pytest.mark.parametrize("count", [100, *long(1_000)])
def test_running_ten_nodes_a_loop(benchmark, count):
    benchmark.group = "graphs of ten nodes a loop, run"
    plan = loops(count).compose()
    benchmark(plan.run)
