"""Examples that are the same every time; or, asked for, many new ones from hypothesis.

HYPOTHESIS_PROFILE=search pytest

With HYPOTHESIS_PROFILE=few they are few: whether all runs with other versions is told by few. With
more, as `.ci/nightly` has it, they are five times as many as by default.
"""

import os
from contextlib import nullcontext

import numpy as np
import pytest
from hypothesis import settings

settings.register_profile("same", max_examples=40, derandomize=True, deadline=None)
settings.register_profile("more", max_examples=200, derandomize=True, deadline=None)
settings.register_profile("search", max_examples=2000, deadline=None)
settings.register_profile("few", max_examples=15, derandomize=True, deadline=None)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "same"))


@pytest.fixture
def rng(request):
    """Random numbers of a test's own, whichever tests run beside it."""
    return np.random.default_rng([*request.node.name.encode()])


@pytest.fixture
def jax():
    """JAX that computes in doubles, where it is installed."""
    jax = pytest.importorskip("jax")
    jax.config.update("jax_enable_x64", True)  # noqa: FBT003 - as JAX has it
    yield jax
    jax.config.update("jax_enable_x64", False)  # noqa: FBT003 - ditto


@pytest.fixture
def jax_once(jax, request):
    """JAX that compiles in slow tests alone: what runs once is sooner done without."""
    slow = request.node.get_closest_marker("slow") is not None
    with nullcontext() if slow else jax.disable_jit():
        yield jax


@pytest.fixture(params=["forwards", pytest.param("backwards", marks=pytest.mark.slow)])
def jacobian(jax, request):
    """Slopes of a function, compiled: forwards, or, slow, backwards as ``jax.grad`` has them."""
    way = jax.jacfwd if request.param == "forwards" else jax.jacrev
    return lambda function, **options: jax.jit(way(function, **options))
