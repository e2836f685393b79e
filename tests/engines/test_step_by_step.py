"""Light that XLA takes through one element after the other."""

import re
from itertools import pairwise

import pytest

import optipath as op
from optipath.engines.step_by_step import StepByStep
from optipath.kernels.carriers.matrix_carrier import MatrixCarrier
from optipath.kernels.carriers.structures import BLOCK
from optipath.kernels.numbers.primitives import FLOAT
from paths import chain


def test_light_is_carried_as_by_the_carrier_itself():
    carrier = MatrixCarrier(FLOAT)
    light, numbers = carrier.emit((1.0, 0.5, 0.25, 0.125)), (0.5, 0.25, 0.125, 0.3, 0.4)
    by_step = StepByStep(carrier).act(BLOCK, numbers, light)
    assert by_step == carrier.act(BLOCK, numbers, light)


def largest_piece(jax, plates):
    """How many instructions the largest piece has that XLA makes of so many plates."""
    wavelength = op.Parameter("wavelength")
    elements = [op.Waveplate(1e-4, 0.009, wavelength, angle=0.3 * k) for k in range(plates)]
    plan = op.Composer(engine="jax").compose(chain(elements, (1.0, 1.0, 0.0, 0.0)))
    compiled = jax.jit(lambda w: plan.run(wavelength=w).stokes).lower(5e-7).compile()
    lines = compiled.as_text().splitlines()
    starts = [k for k, line in enumerate(lines) if re.match(r"\S.*\{$", line)]
    return max(end - start for start, end in pairwise([*starts, len(lines)]))


def test_no_piece_that_xla_compiles_grows_with_the_path(jax):
    pytest.importorskip("jax.experimental.xla_metadata")
    if jax.default_backend() != "cpu":
        pytest.skip("pieces are kept apart on a CPU")
    assert largest_piece(jax, 4) < 1.2 * largest_piece(jax, 2)
