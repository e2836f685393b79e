"""What the engine makes of whole paths, against products of the elements' matrices."""

from functools import reduce

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from paths import chain

ANGLES = st.floats(-4.0, 4.0)
FRACTIONS = st.floats(0.0, 1.0)
REFLECTIONS = st.builds(
    op.Interface,
    index=st.builds(complex, st.floats(0.2, 4.0), st.one_of(st.just(0.0), st.floats(1e-3, 5.0))),
    incidence=st.floats(0.0, np.pi / 2),
    outside=st.floats(1.0, 2.0),
    azimuth=ANGLES,
)
ELEMENTS = st.one_of(
    REFLECTIONS,
    st.builds(op.Polarizer, ANGLES, ANGLES, FRACTIONS, FRACTIONS),
    st.builds(op.Retarder, ANGLES, ANGLES, ANGLES),
    st.builds(op.Rotator, ANGLES),
    st.builds(op.Attenuator, FRACTIONS),
    st.builds(op.Combiner),
)
CHAINS = st.lists(ELEMENTS, min_size=1, max_size=8)


@st.composite
def states(draw):
    direction = np.array([draw(st.floats(-1, 1)) for _ in range(3)])
    length = max(np.linalg.norm(direction), 1.0)
    return np.array([1.0, *(direction / length)]) * draw(st.floats(1e-3, 10.0))


def matrix_of(element):
    leaves = "out" if element.straight else "reflected"
    # The frame turned by a is the light turned by -a.
    turn = op.Rotator(-getattr(element, "azimuth", 0.0)).mueller()
    return element.mueller(leaves=leaves) @ turn


@given(elements=CHAINS, state=states())
def test_a_chain_is_the_product_of_its_matrices(elements, state):
    start = op.Mueller(np.eye(4))
    product = reduce(lambda before, matrix: matrix @ before, map(matrix_of, elements), start)
    expected = (product @ op.Light(state)).stokes
    path = chain(elements, state)
    np.testing.assert_allclose(path.trace().stokes, expected, rtol=0, atol=1e-13 * state[0])
    np.testing.assert_allclose(path.mueller().matrix, product.matrix, rtol=0, atol=1e-13)


@given(elements=CHAINS, state=states())
def test_no_chain_gives_more_than_it_gets_nor_more_than_polarised_light(elements, state):
    light = chain(elements, state).trace()
    assert -1e-15 * state[0] <= light.intensity <= state[0] * (1 + 1e-13)
    polarised = np.linalg.norm(light.stokes[1:])
    assert polarised <= light.intensity + 1e-13 * state[0]


@given(elements=st.lists(REFLECTIONS, min_size=2, max_size=2), azimuth=ANGLES)
def test_light_that_runs_backwards_sees_the_reciprocal_matrix(elements, azimuth):
    forth, back = (op.PathGraph() for _ in range(2))
    for path, (first, second) in ((forth, elements), (back, elements[::-1])):
        turned = op.Interface(second.index, second.incidence, second.outside, azimuth)
        straight = op.Interface(first.index, first.incidence, first.outside)
        lamp = path.add("lamp", op.Source())
        lamp >> path.add("a", straight) >> path.add("b", turned) >> path.add("eye", op.Detector())
    # Helmholtz reciprocity: the transpose, with y turned over (Sekera, J. Opt. Soc. Am. 56, 1966).
    over = np.diag([1.0, 1.0, -1.0, 1.0])
    expected = over @ forth.mueller().matrix.T @ over
    np.testing.assert_allclose(back.mueller().matrix, expected, atol=1e-13)


def test_lights_are_let_go_when_nothing_reads_them_any_more():
    program = chain([op.Rotator(0.1)] * 3, [1.0, 0, 0, 0]).compose().program
    assert program.light_uses == (1,) * len(program.steps)
    assert sum(program.evaluation_uses) == len(program.steps)
