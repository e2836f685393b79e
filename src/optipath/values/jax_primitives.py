"""The primitives that JAX computes with, and those that it takes slopes with."""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, Any

import jax
import jax.numpy as jnp
import numpy as np

from optipath.kernels.primitives import of_module
from optipath.values.jax_values import is_jax

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from optipath.kernels.primitives import Primitives


def _scaling(number: Any) -> int:
    # Nothing is scaled: XLA takes minutes for a path whose every step is, and gains nothing.
    del number
    return 0


def _ldexp(number: Any, power: Any) -> Any:
    if isinstance(power, int) and power == 0:
        return number
    one = jnp.ones((), jnp.result_type(number))
    power = jnp.clip(power, -2040, 2040)
    half = power // 2
    return number * jnp.ldexp(one, half) * jnp.ldexp(one, power - half)


def _apart(function: Callable[..., Any]) -> Callable[..., Any]:
    """Make a function, of numbers in nested tuples, a piece of its own for XLA.

    Fused, XLA on a CPU computes shared terms again for each result: time grows with the square of
    the size of a piece at least, and with a power of its depth at the worst.
    """

    def called(*argument: Any) -> Any:
        numbers, form = jax.tree_util.tree_flatten(argument)
        known: dict[int, Any] = {}
        forms: list[Any] = []

        def of_arrays(arrays: dict[int, Any]) -> dict[int, Any]:
            together = [arrays.get(place, number) for place, number in enumerate(numbers)]
            result = function(*jax.tree_util.tree_unflatten(form, together))
            results, form_of_result = jax.tree_util.tree_flatten(result)
            forms.append(form_of_result)
            outcome, plain = _parted(results)
            known.update(plain)
            return outcome

        with _not_inlined():
            outcome = jax.jit(of_arrays)(_parted(numbers)[0])
        together = outcome | known
        in_order = [together[place] for place in range(len(together))]
        return jax.tree_util.tree_unflatten(forms[-1], in_order)

    return called


def _parted(numbers: Sequence[Any]) -> tuple[dict[int, Any], dict[int, Any]]:
    """Return numbers by their places: those that are JAX's, and those that are not."""
    places = dict(enumerate(numbers))
    arrays = {place: number for place, number in places.items() if is_jax(number)}
    return arrays, {place: number for place, number in places.items() if place not in arrays}


def _not_inlined() -> Any:
    if jax.default_backend() != "cpu":
        return nullcontext()
    try:
        from jax.experimental.xla_metadata import set_xla_metadata  # noqa: PLC0415 - newer versions
    except ImportError:
        return nullcontext()
    return set_xla_metadata(inlineable="false")


JAX = replace(
    of_module(jnp), scaling=_scaling, ldexp=_ldexp, fixed=jax.lax.stop_gradient, apart=_apart
)


@cache
def sloped(dtype: np.dtype[Any]) -> Primitives:
    """Return the primitives for slopes in a precision."""
    # So near to an edge no slope has changed yet, but its sixth power is still a number.
    within = 2.0**-60 if dtype == np.float64 else 2.0**-20

    def root(number: Any) -> Any:
        if jnp.iscomplexobj(number):
            return jnp.sqrt(number)
        # At 0 as well with the slope that it has there within: at 0 itself it has none.
        raised = jnp.where(number > 0.0, 0.0, within**2 - JAX.fixed(number))
        return jnp.sqrt(number + raised)

    return replace(JAX, sqrt=root, within=within)


with_slopes: Any = jax.custom_jvp(lambda value, of: value)  # noqa: ARG005 - its slopes
"""A value with the slopes of another number."""
with_slopes.defjvps(None, lambda tangent, *_: tangent)
