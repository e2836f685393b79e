"""Throughput of composition, compared with a walk of the same graph by networkx and NumPy."""

from __future__ import annotations

import gc
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import networkx as nx
import numpy as np

from optipath.composer.composer import Composer
from optipath.elements.ends import Detector, Source
from optipath.elements.interface import Interface
from optipath.elements.polarizers import Polarizer
from optipath.elements.retarders import Rotator
from optipath.engines.choice import is_installed
from optipath.errors import OptipathError, ParameterError
from optipath.lab.bench import race, random_values
from optipath.paths.path_graph import PathGraph
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

    from optipath.plan.plan import Plan

    Array = np.ndarray[Any, np.dtype[np.float64]]
    Action = Callable[[], Any]


# By hand: what a user of networkx and NumPy would write.


def walked(graph: nx.DiGraph, values: Mapping[str, Any], start: Array) -> Array:
    """Return what becomes of light, or of a matrix, along a graph of formulas and angles."""
    result = start
    for name in nx.topological_sort(graph):
        formula, angle = graph.nodes[name]["formula"], graph.nodes[name]["angle"]
        result = formula(values[angle] if isinstance(angle, str) else angle) @ result
    return result


def _matrix(rows: list[list[Any]]) -> Array:
    if np.ndim(rows[1][1]) == 0:
        return np.array(rows)
    result = np.zeros((*np.shape(rows[1][1]), 4, 4))
    for row, column in np.ndindex(4, 4):
        result[..., row, column] = rows[row][column]
    return result


def _reflection(incidence: Any) -> Array:
    cos, sin = np.cos(incidence), np.sin(incidence)
    g = np.sqrt(_METAL**2 - sin * sin)
    r_s, r_p = (cos - g) / (cos + g), (_METAL**2 * cos - g) / (_METAL**2 * cos + g)
    F_s, F_p, product = abs(r_s) ** 2, abs(r_p) ** 2, r_s * np.conj(r_p)
    a, b, c, s = 0.5 * (F_s + F_p), 0.5 * (F_s - F_p), product.real, product.imag
    rows = [[a, b, 0.0, 0.0], [b, a, 0.0, 0.0], [0.0, 0.0, c, s], [0.0, 0.0, -s, c]]
    return _matrix(rows) @ _rotator(-_TURNED)


def _polarizer(angle: Any) -> Array:
    c, s = np.cos(2.0 * angle), np.sin(2.0 * angle)
    rows = [[1.0, c, s, 0.0], [c, c * c, c * s, 0.0], [s, c * s, s * s, 0.0], [0.0] * 4]
    return 0.5 * _matrix(rows)


def _rotator(angle: Any) -> Array:
    c, s = np.cos(2.0 * angle), np.sin(2.0 * angle)
    rows = [[1.0, 0.0, 0.0, 0.0], [0.0, c, -s, 0.0], [0.0, s, c, 0.0], [0.0, 0.0, 0.0, 1.0]]
    return _matrix(rows)


_METAL, _TURNED = 0.05 + 10.0j, -0.05
_KINDS: tuple[tuple[Parameter, Callable[[Any], Any], Callable[[Any], Array]], ...] = (
    (
        Parameter("incidence", 0.55, "rad", 0.5, 0.6),
        partial(Interface, _METAL, azimuth=_TURNED),
        _reflection,
    ),
    (Parameter("axis", 0.05, "rad", 0.0, 0.1), Polarizer, _polarizer),
    (Parameter("turn", -0.05, "rad", -0.1, 0.0), Rotator, _rotator),
)
"""The parameter of each element of a mixed path, what makes it of an angle, and its formula."""


def mixed_path(count: int) -> tuple[PathGraph, nx.DiGraph]:
    """Return a path of interfaces, polarizers and rotators, and the same graph by hand.

    The angle of every second element is a parameter; of the others each has its own.

    >>> path, graph = mixed_path(10)
    >>> sorted(path.parameters), len(path), len(graph)
    (['axis', 'incidence', 'turn'], 10, 8)
    """
    path, graph = PathGraph(), nx.DiGraph()
    node = path.add("lamp", Source())
    for place in range(count - 2):
        parameter, element, formula = _KINDS[place % 3]
        own, is_open = parameter.default * (1.0 - 0.5 * place / count), place % 2 == 0
        node = node >> path.add(f"e{place}", element(parameter if is_open else own))
        graph.add_node(place, formula=formula, angle=parameter.name if is_open else own)
        if place:
            graph.add_edge(place - 1, place)
    node >> path.add("eye", Detector())
    return path, graph


# What is measured.

LIGHT, MATRIX = np.array([[1.0], [0.0], [0.0], [0.0]]), np.eye(4)
"""What a walk by hand begins with: unpolarized light, or nothing that is done to it."""


class Rates(NamedTuple):
    """How many are done a second, at best and by the median, by optipath and by hand."""

    path: str
    work: str
    best: float
    median: float
    by_hand: float | None = None
    by_hand_median: float | None = None


def measured(
    paths: Mapping[str, PathGraph],
    *,
    elements: int = 1000,
    largest: int | None = None,
    long: bool = False,
    engines: Sequence[Any] = (),
    threads: int = 1,
    progress: Callable[[str], object] = lambda _: None,
) -> list[Rates]:
    """Return how fast mixed paths and others are composed and traced, all of it in turns."""
    names: Iterable[Any] = engines or filter(is_installed, ("numpy", "numba"))
    composers = {name: Composer(engine=name, threads=threads) for name in names}
    largest = largest or (1_000_000 if long else 10_000)
    sizes = [*(10**power for power in range(1, len(str(largest - 1)) * long)), largest]
    pairs: dict[str, tuple[PathGraph, nx.DiGraph | None]] = {
        f"{count:,} mixed elements": mixed_path(count)
        for count in (elements, 10, *((100, 10_000) if long else ()))
    }
    pairs |= {name: (path, None) for name, path in paths.items()}
    works: dict[str, tuple[Any, ...]] = {
        f"{name}: {work}": (name, work, *about)
        for name, pair in pairs.items()
        for work, *about in _works(*pair, sizes, composers)
    }
    contenders: dict[str, Action] = {
        key + who: action
        for key, (*_, action, by_hand) in works.items()
        for who, action in zip(_WHO, (action, by_hand), strict=True)
        if action
    }
    gc.freeze()  # Or composing one path pays for a look through the objects of all.
    try:
        timings = race(contenders, tick=progress)
    finally:
        gc.unfreeze()
    results = []
    for key, (name, work, times, *_) in works.items():
        found = [timings[key + who] for who in _WHO if key + who in timings]
        rates = [times / seconds for _, *of_call in found for seconds in of_call]
        results.append(Rates(name, work, *rates))
    return results


_WHO = "", ", by hand"
_MOST = 1_000_000
"""Of how many values at once there are matrices by hand, of 128 bytes each."""

_LONG = 50
"""From how many elements on these are counted, and light is that of one value."""


def _works(
    path: PathGraph,
    graph: nx.DiGraph | None,
    sizes: Sequence[int],
    composers: Mapping[str, Composer],
) -> Iterator[tuple[str, int, Action, Action | None]]:
    """Yield what is measured, how often a call does it, and the call by optipath and by hand."""

    def by_hand(values: Mapping[str, Any], start: Array) -> Action | None:
        fits = graph and np.size(next(iter(values.values()))) <= _MOST
        return partial(walked, graph, values, start) if fits else None

    plan, compose, length = Composer().compose(path), Composer().compose, len(path)
    ends = next(iter(plan.whole.sources)), next(iter(plan.whole.readings))
    try:
        one = {name: float(value[0]) for name, value in random_values(plan, 1).items()}
    except ParameterError:
        one, sizes = {}, ()  # Where nothing varies there are no batches.
    light, matrix = by_hand(one, LIGHT), by_hand(one, MATRIX)
    if light and not np.allclose(light()[:, 0], plan.run(**one).stokes, rtol=1e-9, atol=0.0):
        raise OptipathError(f"light of {length} elements by hand is not that of optipath")
    what, times = ("elements", length) if length >= _LONG else ("paths", 1)
    yield f"{what} composed", times, partial(compose, path), light
    yield f"{what} composed and run", times, lambda: _run(compose(path))(**one), light
    yield "light, one value", 1, partial(_run(plan), **one), light
    elements = [node["element"] for _, node in path.graph.nodes(data=True)]
    matrices = sum(bool(each.inputs and each.outputs) for each in elements)
    if length >= _LONG:
        yield "matrices, one value", matrices, partial(plan.mueller, *ends, **one), matrix
        return
    for engine, composer in composers.items():
        plan = composer.compose(path)
        for size in sizes:
            about, values = f"{size:,} values, {engine}", random_values(plan, size)
            action = partial(_finished, partial(_run(plan), **values))
            yield f"light, {about}", size, action, by_hand(values, LIGHT)
            action = partial(_finished, partial(plan.mueller, *ends, **values))
            yield f"matrices, {about}", matrices * size, action, by_hand(values, MATRIX)


def _run(plan: Plan) -> Callable[..., Any]:
    return getattr(plan, "run" if len(plan.program.detectors) == 1 else "run_all")  # type: ignore[no-any-return]


def _finished(run: Action) -> None:
    """Run, and wait for engines that answer before they are done."""
    result = run()
    for each in result.values() if isinstance(result, dict) else [result]:
        np.asarray(each.matrix if hasattr(each, "matrix") else each.stokes)
