"""What a kernel makes of numbers by itself, outside of any path; of those that JAX traces, too."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.kernels.primitives import NUMPY, made
from optipath.values.jax_values import is_traced

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.primitives import Primitives


def kernel_values(
    factory: Callable[[Primitives], Callable[..., tuple[Any, ...]]], *numbers: Any
) -> tuple[Any, ...]:
    """Return what a kernel makes of real numbers.

    Where JAX traces one of them, what comes out is JAX's, with its slopes, in the precision that
    JAX has; else it is NumPy's in float64.

    >>> from optipath.kernels.fresnel.boundary import phase_index
    >>> kernel_values(phase_index, 1.5, 0.0, 1.0, 0.0)
    (array(1.5),)
    """
    if any(map(is_traced, numbers)):
        return _traced_values(factory, numbers)
    argument = np.broadcast_arrays(*(np.asarray(number, np.float64) for number in numbers))
    with np.errstate(all="ignore"):
        result = made(factory, NUMPY)(*argument)
    return tuple(np.array(np.broadcast_to(part, argument[0].shape), np.float64) for part in result)


def _traced_values(factory: Any, numbers: tuple[Any, ...]) -> tuple[Any, ...]:
    import jax.numpy as jnp  # noqa: PLC0415 - an extra, which is there where it traces

    from optipath.values.jax_primitives import JAX, sloped, with_slopes  # noqa: PLC0415

    kind = jnp.zeros(()).dtype
    argument = jnp.broadcast_arrays(*(jnp.asarray(number, kind) for number in numbers))
    shape = argument[0].shape
    values, slopes = (
        [jnp.broadcast_to(jnp.asarray(part, kind), shape) for part in made(factory, xp)(*of)]
        for xp, of in ((JAX, JAX.fixed(argument)), (sloped(kind), argument))
    )
    return tuple(map(with_slopes, values, slopes))
