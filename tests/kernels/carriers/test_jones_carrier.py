import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from optipath.engines.program.execute import execute
from optipath.kernels.carriers.jones_carrier import JonesCarrier
from optipath.kernels.carriers.matrix_carrier import MatrixCarrier
from optipath.kernels.carriers.scaled_carrier import ScaledCarrier
from optipath.kernels.carriers.stokes_carrier import StokesCarrier
from optipath.kernels.carriers.structures import BLOCK, ROTATION, SCALE
from optipath.kernels.numbers.primitives import FLOAT, NUMPY
from tables import rows

SHARES = st.floats(-1.0, 1.0)
ANGLES = st.floats(-4.0, 4.0)


@st.composite
def lights(draw):
    direction = np.array([draw(SHARES) for _ in range(3)])
    length = max(float(np.linalg.norm(direction)), 1.0)
    return (1.0, *(direction / length).tolist())


@st.composite
def steps(draw):
    kind = draw(st.sampled_from(["scale", "rotation", "block"]))
    if kind == "scale":
        return SCALE, (draw(st.floats(1e-3, 1.0)),)
    angle = draw(ANGLES)
    if kind == "rotation":
        return ROTATION, (np.cos(angle), np.sin(angle))
    Fs, Fp = draw(st.floats(0.01, 1.0)), draw(st.floats(0.01, 1.0))
    size = np.sqrt(Fs * Fp)
    return BLOCK, (Fs, Fp, 0.5 * (Fs - Fp), size * np.cos(angle), size * np.sin(angle))


def result(carrier, light, chain):
    state = carrier.emit(light)
    for structure, numbers in chain:
        state = carrier.act(structure, numbers, state)
    stokes, exponent = carrier.read(state)
    return np.array(stokes) * 2.0**exponent


@given(light=lights(), chain=st.lists(steps(), max_size=6))
def test_all_ways_of_carrying_light_agree(light, chain):
    plain = result(StokesCarrier(FLOAT), light, chain)
    for carrier in (ScaledCarrier(FLOAT), JonesCarrier(FLOAT), MatrixCarrier(FLOAT)):
        np.testing.assert_allclose(result(carrier, light, chain), plain, rtol=0, atol=1e-14)


@given(first=lights(), second=lights(), share=st.floats(1e-9, 1.0))
def test_lights_add_incoherently_in_all_ways(first, second, share):
    second = tuple(share * part for part in second)
    expected = np.add(first, second)
    for carrier in (
        StokesCarrier(FLOAT),
        ScaledCarrier(FLOAT),
        JonesCarrier(FLOAT),
        MatrixCarrier(FLOAT),
    ):
        stokes, exponent = carrier.read(carrier.add(carrier.emit(first), carrier.emit(second)))
        found = np.array(stokes) * 2.0**exponent
        np.testing.assert_allclose(found, expected, rtol=0, atol=2e-15)


@given(light=lights(), chain=st.lists(steps(), min_size=20, max_size=40))
def test_jones_columns_are_never_polarised_by_more_than_100_percent(light, chain):
    s0, *rest = result(JonesCarrier(FLOAT), light, chain)
    assert np.linalg.norm(rest) <= s0 * (1 + 2.3e-16)


def branches():
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(stokes=[1.0, 0.3, 0.2, -0.1]))
    lamp >> path.add("split", op.BeamSplitter(0.3))
    glass = path.add("glass", op.Interface(1.5 + 0.2j, op.Parameter("theta"), azimuth=0.2))
    path.connect("split.reflected", "glass.in")
    path.add("sum", op.Combiner())
    path.connect("split.transmitted", "sum.in")
    (
        glass
        >> path["sum"]
        >> path.add("plate", op.Retarder(0.5, 0.3))
        >> path.add("eye", op.Detector())
    )
    return path


def test_paths_that_part_and_meet_are_carried_by_jones_columns_unless_they_depolarise():
    theta = np.linspace(0, 1.5, 7)
    plan = op.Composer(composing="jones").compose(branches())
    expected = branches().trace(theta=theta)
    np.testing.assert_allclose(plan.run(theta=theta).stokes, expected.stokes, rtol=0, atol=2e-15)
    matrix = branches().mueller(theta=theta).matrix
    np.testing.assert_allclose(plan.mueller(theta=theta).matrix, matrix, rtol=0, atol=5e-15)
    assert "Jones" in plan.explain()
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source())
    (
        lamp
        >> path.add("foil", op.MuellerElement(np.diag([1.0, 0.5, 0.5, 0.5])))
        >> path.add("eye", op.Detector())
    )
    with pytest.raises(op.ComposerError, match=r"'foil\.out' .* may depolarise"):
        op.Composer(composing="jones").compose(path)


@rows("carrier", [StokesCarrier, ScaledCarrier, JonesCarrier, MatrixCarrier])
@rows("dtype", ["float32", "longdouble"])
def test_no_number_changes_its_precision_on_the_way(dtype, carrier):
    paths = [op.load_preset(name) for name in op.preset_names()]
    paths += [branches(), op.load_preset("npgr026", filter=["none", "horizontal"])]
    for path in paths:
        plan = op.Composer(dtype=dtype).compose(path)
        structures = (evaluation.kernel.structure for evaluation in plan.whole.evaluations)
        has_jones = all(s is None or s.jones is not None for s in structures)
        if carrier is JonesCarrier and (plan.whole.loops or not has_jones):
            continue
        given_, _ = plan.inputs.resolve({"theta": 0.3} if "theta" in plan.inputs.open else {})
        leaves = [operand.numbers(given_) for operand in plan.whole.operands]
        leaves = [n if n.dtype == bool else n.astype(dtype) for n in leaves]
        found = execute(
            plan.whole, leaves, carrier(NUMPY), None, lambda number: np.asarray(number, dtype)
        )
        for reading in plan.whole.readings.values():
            read = found[reading.light][0][: reading.components]
            assert {np.asarray(component).dtype for component in read} == {np.dtype(dtype)}
