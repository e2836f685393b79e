"""The examples, run as their users run them."""

import runpy
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

EXAMPLES = Path(__file__).parents[1] / "examples"
pytest.importorskip("jax")


@pytest.fixture
def example():
    import jax  # noqa: PLC0415 - an extra

    yield runpy.run_path(EXAMPLES / "index_from_stokes.py")
    jax.config.update("jax_enable_x64", False)  # noqa: FBT003 - as JAX has it


@pytest.mark.parametrize("index", [(0.608, 2.12), (0.17, 3.15), (1.5, 0.2), (2.4, 0.1)])
def test_the_index_comes_back_from_light_without_noise(example, index):
    measured = example["ellipsometer"]().trace(n=index[0], k=index[1]).stokes
    found, _ = example["index_from"](measured)
    np.testing.assert_allclose(found, index, rtol=0, atol=1e-6)


def test_metals_with_little_n_over_k_hardly_polarise_and_glass_does():
    example = runpy.run_path(EXAMPLES / "when_polarization_matters.py")
    largest = {name: share for name, _, share in example["rows"]()}
    assert largest["silver"] < 2e-4 < largest["gold"] < 0.01 < largest["copper"] < 0.1
    assert 0.3 < largest["iron"] < 0.6
    assert largest["glass"] == pytest.approx(1.0, abs=1e-3)


def test_the_example_prints_an_index_within_its_deviations():
    done = subprocess.run(
        [sys.executable, EXAMPLES / "index_from_stokes.py"],
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.startswith("n = 0.6")
