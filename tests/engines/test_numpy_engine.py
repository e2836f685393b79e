"""What engines make of whole paths, against products of the elements' matrices and step by step."""

import re
from dataclasses import replace
from functools import reduce
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import optipath as op
from optipath.engines.jax_path import StepByStep
from optipath.kernels.carriers.carrier import MatrixCarrier
from optipath.kernels.carriers.structures import BLOCK
from optipath.kernels.primitives import FLOAT
from paths import chain
from tables import rows, slow

ANGLES = st.floats(-4.0, 4.0)
FRACTIONS = st.floats(0.0, 1.0)
MEDIA = st.floats(1.0, 2.0)
INDICES = st.builds(complex, st.floats(0.2, 4.0), st.one_of(st.just(0.0), st.floats(1e-3, 5.0)))
STRAIGHT = st.one_of(
    st.builds(op.Polarizer, ANGLES, ANGLES, FRACTIONS, FRACTIONS),
    st.builds(op.Retarder, ANGLES, ANGLES, ANGLES),
    st.builds(op.Rotator, ANGLES),
    st.builds(op.Attenuator, FRACTIONS),
    st.builds(op.Combiner),
)


def reflections_in(medium):
    incidences = st.floats(0.0, np.pi / 2)
    return st.builds(op.Interface, INDICES, incidences, st.just(medium), azimuth=ANGLES)


# All surfaces of a chain stand in one medium.
CHAINS = MEDIA.flatmap(
    lambda medium: st.lists(st.one_of(reflections_in(medium), STRAIGHT), min_size=1, max_size=8)
)
PAIRS = MEDIA.flatmap(lambda medium: st.lists(reflections_in(medium), min_size=2, max_size=2))


@st.composite
def states(draw):
    direction = np.array([draw(st.floats(-1, 1)) for _ in range(3)])
    length = max(np.linalg.norm(direction), 1.0)
    return np.array([1.0, *(direction / length)]) * draw(st.floats(1e-3, 10.0))


def matrix_of(element):
    leaves = "out" if element.straight else "reflected"
    # The frame turned by a is the light turned by -a.
    turn = op.Rotator(-getattr(element, "azimuth", 0.0)).mueller()
    return op.Mueller(element.mueller(leaves=leaves).matrix) @ turn


@settings(max_examples=settings().max_examples // 3)
@given(elements=CHAINS, state=states())
def test_a_chain_is_the_product_of_its_matrices_and_gives_no_more_than_it_gets(elements, state):
    start = op.Mueller(np.eye(4))
    product = reduce(lambda before, matrix: matrix @ before, map(matrix_of, elements), start)
    expected, path = (product @ op.Light(state)).stokes, chain(elements, state)
    light = path.trace()
    np.testing.assert_allclose(light.stokes, expected, rtol=0, atol=1e-13 * state[0])
    np.testing.assert_allclose(path.mueller().matrix, product.matrix, rtol=0, atol=1e-13)
    assert -1e-15 * state[0] <= light.intensity <= state[0] * (1 + 1e-13)
    polarised = np.linalg.norm(light.stokes[1:])
    assert polarised <= light.intensity + 1e-13 * state[0]


@settings(max_examples=settings().max_examples // 3)
@given(elements=PAIRS, azimuth=ANGLES)
def test_light_that_runs_backwards_sees_the_reciprocal_matrix(elements, azimuth):
    forth, back = (
        chain([replace(first, azimuth=0.0), replace(second, azimuth=azimuth)]).mueller().matrix
        for first, second in (elements, elements[::-1])
    )
    # Helmholtz reciprocity: the transpose, with y turned over (Sekera, J. Opt. Soc. Am. 56, 1966).
    over = np.diag([1.0, 1.0, -1.0, 1.0])
    np.testing.assert_allclose(back, over @ forth.T @ over, rtol=0, atol=1e-13)


def test_lights_are_let_go_when_nothing_reads_them_any_more():
    program = chain([op.Rotator(0.1)] * 3).compose().program
    assert program.light_uses == (1,) * len(program.steps)
    assert sum(program.evaluation_uses) == len(program.steps)


N, K, M, A = map(op.Parameter, "nkma")
ENTERED = {
    "glass": op.Interface(N, A),
    "metal": op.Interface(op.Material(N, K), A),
    "glass from a denser medium": op.Interface(N, A, outside=M),
    "a later face": op.Interface(N, A, outside=M, incidence_in=1.2),
    "a layer": op.LayerStack([1.0, M, N], A),
    "a layer of glass": op.LayerStack([1.0, 1.5, N], A),
    "glass in water": op.Interface(N, A, outside=1.33),
    "a layer on metal": op.LayerStack([1.0, M, op.Material(N, K)], A),
}


@pytest.mark.parametrize("method", ["stable", "textbook", slow("compensated"), slow("amplitude")])
@rows("port", ["reflected", "transmitted"])
@rows("element", ENTERED)
def test_formulas_give_what_the_steps_give_by_every_method(element, port, method):
    rng = np.random.default_rng(3)
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(stokes=[1.3, 0.4, -0.55, 0.6]))
    lamp >> path.add("it", ENTERED[element])
    path[f"it.{port}"] >> op.Detector()
    plan = op.Composer(method=method, engine="numpy").compose(path)
    for most in (2.0, 0.0):
        spans = {"n": (0.7, 2.2), "m": (1.2, 2.2), "k": (0.0, most), "a": (0.0, 1.5)}
        values = {name: rng.uniform(*spans[name], 3000) for name in plan.inputs.open}
        few = plan.run(**{name: numbers[:9] for name, numbers in values.items()}).stokes
        # From the fourth on, single runs are compiled.
        each = [{name: float(numbers[i]) for name, numbers in values.items()} for i in range(9)]
        for found in (plan.run(**values).stokes[:9], [plan.run(**one).stokes for one in each]):
            np.testing.assert_allclose(found, few, rtol=0, atol=1e-11)


def test_light_is_carried_as_by_the_carrier_itself():
    carrier = MatrixCarrier(FLOAT)
    light, numbers = carrier.emit((1.0, 0.5, 0.25, 0.125)), (0.5, 0.25, 0.125, 0.3, 0.4)
    by_step = StepByStep(carrier).act(BLOCK, numbers, light)
    assert by_step == carrier.act(BLOCK, numbers, light)


def test_no_piece_that_xla_compiles_grows_with_the_path(jax):
    pytest.importorskip("jax.experimental.xla_metadata")
    if jax.default_backend() != "cpu":
        pytest.skip("pieces are kept apart on a CPU")
    plate = {"birefringence": 0.009, "wavelength": op.Parameter("w")}
    largest = []
    for plates in (2, 4):
        elements = [op.Waveplate(1e-4, **plate, angle=0.3 * k) for k in range(plates)]
        plan = op.Composer(engine="jax").compose(chain(elements, (1.0, 1.0, 0.0, 0.0)))
        compiled = jax.jit(lambda w, plan=plan: plan.run(w=w).stokes).lower(5e-7).compile()
        lines = compiled.as_text().splitlines()
        starts = [k for k, line in enumerate(lines) if re.match(r"\S.*\{$", line)]
        largest.append(max(end - start for start, end in pairwise([*starts, len(lines)])))
    assert largest[1] < 1.2 * largest[0]
