"""Functions that compiled formulas call, themselves free of branches so that loops vectorise."""

from __future__ import annotations

from typing import Any

import numba as nb
import numpy as np
from llvmlite import ir
from numba.extending import intrinsic


@intrinsic
def _bits_of(typing: Any, number: Any) -> Any:  # noqa: ARG001 - as numba calls it
    def generate(context: Any, builder: Any, signature: Any, argument: Any) -> Any:  # noqa: ARG001
        return builder.bitcast(argument[0], ir.IntType(64))

    return nb.int64(nb.float64), generate


@intrinsic
def _number_of(typing: Any, bits: Any) -> Any:  # noqa: ARG001 - as numba calls it
    def generate(context: Any, builder: Any, signature: Any, argument: Any) -> Any:  # noqa: ARG001
        return builder.bitcast(argument[0], ir.DoubleType())

    return nb.float64(nb.int64), generate


@intrinsic
def _fused(typing: Any, a: Any, b: Any, c: Any) -> Any:  # noqa: ARG001 - as numba calls it
    def generate(context: Any, builder: Any, signature: Any, argument: Any) -> Any:  # noqa: ARG001
        return builder.fma(*argument)

    return a(a, a, a), generate


@intrinsic
def chosen(typing: Any, condition: Any, yes: Any, no: Any) -> Any:  # noqa: ARG001 - as numba calls it
    """Return one of two numbers, without a branch for Numba to follow."""

    def generate(context: Any, builder: Any, signature: Any, argument: Any) -> Any:  # noqa: ARG001
        return builder.select(*argument)

    return yes(condition, yes, yes), generate


@nb.njit(error_model="numpy")
def product_rest(a: Any, b: Any) -> Any:
    """Return what the rounding of a b has lost."""
    return _fused(a, b, -(a * b))


@nb.njit(error_model="numpy")
def exponent(number: Any) -> Any:
    """Return the exponent that frexp gives."""
    wide = np.float64(number)
    small = np.int64(abs(wide) < 2.2250738585072014e-308)
    bits = _bits_of(wide * (1.0 + small * 18014398509481983.0))
    return (((bits >> 52) & 2047) - 1022 - 54 * small) * np.int64(wide != 0.0)


@nb.njit(error_model="numpy")
def ldexp(number: Any, power: Any) -> Any:
    """Return a number times two to a power, in double precision."""
    power = min(max(power, -2040), 2040)
    half = power >> 1
    first, second = (half + 1023) << 52, (power - half + 1023) << 52
    return np.float64(number) * _number_of(first) * _number_of(second)


@nb.njit(error_model="numpy")
def ldexp_single(number: Any, power: Any) -> Any:
    """Return a number times two to a power, in single precision."""
    return np.float32(ldexp(number, power))
