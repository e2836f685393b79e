"""The JAX engine: a program traced, so that it can be differentiated and run on a GPU."""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, Any

import jax
import jax.numpy as jnp
import numpy as np

from optipath.errors import ComposerError
from optipath.jax_values import is_jax, is_traced
from optipath.kernels import Linear, Primitives, cosine, sine
from optipath.kernels.primitives import is_hidden, product_and_rest
from optipath.views import part_of
from optipath.walk import walk

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from optipath.kernels import Components, Way
    from optipath.parameters import Resolved
    from optipath.program import Program, Reading
    from optipath.views import View


def _frexp(number: Any) -> tuple[Any, Any]:
    # Nothing is scaled: XLA takes minutes for a path whose every step is, and gains nothing.
    return number, 0


def _ldexp(number: Any, power: Any) -> Any:
    if isinstance(power, int) and power == 0:
        return number
    one = jnp.ones((), jnp.result_type(number))
    power = jnp.clip(power, -2040, 2040)
    half = power // 2
    return number * jnp.ldexp(one, half) * jnp.ldexp(one, power - half)


JAX = Primitives(
    where=jnp.where,
    sqrt=jnp.sqrt,
    absolute=jnp.abs,
    maximum=jnp.maximum,
    minimum=jnp.minimum,
    sin=jnp.sin,
    cos=jnp.cos,
    exp=jnp.exp,
    atan2=jnp.arctan2,
    frexp=_frexp,
    ldexp=_ldexp,
    two_product=product_and_rest,
    hidden=is_hidden,
    fixed=jax.lax.stop_gradient,
)


@cache
def sloped(dtype: np.dtype[Any]) -> Primitives:
    """Return the primitives for slopes in a precision."""
    # So near to an edge no slope has changed yet, but its sixth power is still a number.
    within = 2.0**-60 if dtype == np.float64 else 2.0**-20

    def root(number: Any) -> Any:
        # At 0 as well with the slope that it has there within: at 0 itself it has none.
        raised = jnp.where(number > 0.0, 0.0, within**2 - JAX.fixed(number))
        return jnp.sqrt(number + raised)

    return replace(JAX, sqrt=root, within=within)


_with_slopes: Any = jax.custom_jvp(lambda value, of: value)  # noqa: ARG005 - its slopes
"""A value with the slopes of another number."""
_with_slopes.defjvps(None, lambda tangent, *_: tangent)


class JaxPath:
    """A program for JAX.

    Parameters
    ----------
    program : Program
        The steps.
    way : type
        How light is carried.
    dtype : dtype
        The precision.
    """

    def __init__(self, program: Program, way: type[Way], dtype: np.dtype[Any]) -> None:
        self.program = program
        self.way = way(JAX)
        self.dtype = dtype
        self._lights = jax.jit(self._traced_lights, static_argnames=("batch", "absent"))
        self._matrix = jax.jit(
            self._traced_matrix, static_argnames=("batch", "absent", "source", "reading")
        )
        self._known_traced = any(view.traced for view in program.leaves)

    def lights(self, resolved: Mapping[str, Resolved], batch: tuple[int, ...]) -> list[Any]:
        """Return Stokes vectors (..., 4) at every end; a component that is not read is NaN."""
        values, absent = _split(resolved)
        with self._precision(values):
            run = self._traced_lights if self._known_traced else self._lights
            return list(run(values, batch=batch, absent=absent))

    def matrix(
        self, resolved: Mapping[str, Resolved], batch: tuple[int, ...], source: str, reading: str
    ) -> Any:
        """Return Mueller matrices (..., 4, 4) from a source to a reading."""
        values, absent = _split(resolved)
        with self._precision(values):
            run = self._traced_matrix if self._known_traced else self._matrix
            return run(values, batch=batch, absent=absent, source=source, reading=reading)

    def _traced_lights(
        self, values: Any, *, batch: tuple[int, ...], absent: frozenset[str]
    ) -> tuple[Any, ...]:
        leaves = self._leaves(values, absent)
        return tuple(self._stokes(leaves, self.way, batch).values())

    def _traced_matrix(
        self,
        values: Any,
        *,
        batch: tuple[int, ...],
        absent: frozenset[str],
        source: str,
        reading: str,
    ) -> Any:
        leaves = self._leaves(values, absent)
        columns = []
        for column in np.eye(4, dtype=self.dtype):
            emitted = {
                step: tuple(map(self._number, column if name == source else 0.0 * column))
                for name, (step, _) in self.program.sources.items()
            }
            columns.append(self._stokes(leaves, Linear(JAX), batch, emitted)[reading])
        return jnp.stack(columns, axis=-1)

    def _stokes(
        self,
        leaves: Sequence[Any],
        way: Way,
        batch: tuple[int, ...],
        emitted: Mapping[int, Components] | None = None,
    ) -> dict[str, Any]:
        """Return the Stokes vector of every reading."""
        found = walk(self.program, JAX.fixed(leaves), way, emitted, self._number)
        # Where the smaller of two intensities changes, the light that is carried has no slope,
        # but what matrices make of it has: light comes from the one, its slope from the other.
        smooth = walk(self.program, leaves, Linear(sloped(self.dtype)), emitted, self._number)
        stokes = {}
        for name, reading in self.program.readings.items():
            components, exponent = found[reading.light]
            if not isinstance(exponent, int):
                components = tuple(_ldexp(part, exponent) for part in components)
            both = components, smooth[reading.light][0]
            stokes[name] = _with_slopes(*(self._stacked(parts, reading, batch) for parts in both))
        return stokes

    def _number(self, number: Any) -> Any:
        if isinstance(number, jax.Array):
            return number.astype(self.dtype)
        with np.errstate(over="ignore", under="ignore"):
            return jnp.asarray(np.asarray(number, self.dtype))

    def _stacked(self, components: Sequence[Any], reading: Reading, batch: tuple[int, ...]) -> Any:
        unread = [jnp.nan] * (4 - reading.components)
        parts = (*components[: reading.components], *unread)
        return jnp.stack([jnp.broadcast_to(self._number(p), batch) for p in parts], axis=-1)

    def _leaves(self, values: Mapping[str, Any], absent: frozenset[str]) -> list[Any]:
        return [self._leaf(view, values, absent) for view in self.program.leaves]

    def _leaf(self, view: View, values: Mapping[str, Any], absent: frozenset[str]) -> Any:
        name = getattr(view.value, "name", "")
        if view.part == "present":
            if view.known:
                return view.present()
            return values.get(f"{name} present", name not in absent)
        value = view.value
        if hasattr(value, "name"):
            value = value.default if value.bound else values[name]
            if is_traced(value) or not view.known:
                value = part_of(jnp.asarray(value), view.raw_part, view.tail)
                return self._done(view, -value if view.value.negative else value)
        elif is_traced(value):
            return self._done(view, part_of(value, view.raw_part, view.tail))
        return self._number(view.numbers({}))

    def _done(self, view: View, value: Any) -> Any:
        value = self._number(value)
        if view.part in ("cos", "sin"):
            # 0 at a right angle, but with its slope.
            return (cosine if view.part == "cos" else sine)(JAX)(value)
        return value

    def _precision(self, values: Mapping[str, Any]) -> Any:
        """Return a context in which JAX computes in the precision of the plan.

        Raises
        ------
        ComposerError
            If it is asked for slopes in double precision and does not have it.
        """
        if self.dtype == np.float32 or jax.config.jax_enable_x64:
            return nullcontext()
        if self._known_traced or any(map(is_traced, values.values())):
            raise ComposerError(
                "JAX computes in float32 until it is told otherwise, but the plan is in "
                "float64; begin with jax.config.update('jax_enable_x64', True), or compose "
                "with dtype='float32'"
            )
        return _double()(True)  # noqa: FBT003 - as JAX has it


@cache
def _double() -> Any:
    if hasattr(jax, "enable_x64"):
        return jax.enable_x64
    from jax.experimental import enable_x64  # noqa: PLC0415 - where older versions have it

    return enable_x64


def _split(resolved: Mapping[str, Resolved]) -> tuple[dict[str, Any], frozenset[str]]:
    """Return the values, and the names of what is not there at all."""
    values: dict[str, Any] = {}
    absent = set()
    for name, (value, present) in resolved.items():
        values[name] = value if is_jax(value) else _known_to_jax(value)
        if not np.all(present):
            if np.any(present):
                values[f"{name} present"] = present
            else:
                absent.add(name)
    return values, frozenset(absent)


def _known_to_jax(value: Any) -> Any:
    """Return an array in a precision and an order of bytes that JAX has."""
    kind = np.complex128 if np.iscomplexobj(value) else np.float64
    return np.asarray(value, kind)
