"""How uncertain values are correlated."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import did_you_mean, shown

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

_ROUNDING = 1e-12
_PAIR = 2
_EXAMPLE = '{("n1", "k1"): 0.3}'


def read_correlation(given: Any, names: Sequence[str]) -> tuple[npt.NDArray[np.float64], list[str]]:
    """Return the matrix of correlation coefficients, and what is wrong with what is given.

    Shape: returns matrix (k, k).

    Examples
    --------
    >>> read_correlation({("n", "k"): 0.5}, ["n", "k"])[0]
    array([[1. , 0.5],
           [0.5, 1. ]])
    """
    matrix = np.eye(len(names))
    if given is None:
        return matrix, []
    if not isinstance(given, Mapping):
        return matrix, [f"correlation must be a mapping such as {_EXAMPLE}, not {shown(given)}"]
    faults: list[str] = []
    seen: set[frozenset[str]] = set()
    for pair, coefficient in given.items():
        if wrong := _wrong(pair, coefficient, names):
            faults.append(wrong)
        elif frozenset(pair) in seen:
            faults.append(f"the correlation of {shown(pair)} is given twice; give it once")
        else:
            seen.add(frozenset(pair))
            one, other = (names.index(name) for name in pair)
            matrix[one, other] = matrix[other, one] = coefficient
    if not faults and len(names) and (least := np.linalg.eigvalsh(matrix)[0]) < -_ROUNDING:
        faults.append(
            f"no values can be correlated like this: the matrix of the coefficients has the "
            f"eigenvalue {least:.3g}, and none may be negative; make the coefficients smaller"
        )
    return matrix, faults


def _wrong(pair: Any, coefficient: Any, names: Sequence[str]) -> str:
    if not isinstance(pair, tuple) or len(pair) != _PAIR or pair[0] == pair[1]:
        return f"correlation is of pairs of parameters, such as {_EXAMPLE}, not of {shown(pair)}"
    for name in pair:
        if name not in names:
            near = did_you_mean(name, names)
            return f"correlation names {shown(name)}, which has no uncertainty here{near}"
    real = isinstance(coefficient, (int, float, np.number)) and not isinstance(coefficient, bool)
    if not real or np.iscomplexobj(coefficient) or not -1.0 <= coefficient <= 1.0:
        return (
            f"the correlation of {shown(pair)} is {shown(coefficient)}; give a number "
            f"within -1 .. 1"
        )
    return ""


def root_of(matrix: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Return a root R of a matrix of coefficients, R @ R.T, also where it is singular.

    Examples
    --------
    >>> root_of(np.eye(2))
    array([[1., 0.],
           [0., 1.]])
    """
    values, vectors = np.linalg.eigh(matrix)
    return np.asarray((vectors * np.sqrt(np.maximum(values, 0.0))) @ vectors.T)
