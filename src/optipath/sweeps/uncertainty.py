"""Uncertainty propagation: from values with uncertainties to light with its own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, get_args

import numpy as np

from optipath.composer.composer import Composer
from optipath.errors import OptipathError, ParameterError
from optipath.faults import shown, unknown
from optipath.materials.material import Material
from optipath.paths.path_graph import PathGraph
from optipath.plan.answers import only
from optipath.sweeps.axes import unknown_names
from optipath.sweeps.first_order import changes_of, nonlinearity_of, slopes_of, spread_of
from optipath.sweeps.light_figures import LightAt, UncertainValue
from optipath.sweeps.monte_carlo import samples_at_once, spread_of_samples
from optipath.sweeps.propagation import Propagation, notes_of_first_order
from optipath.values.arrays import array_of, broadcast_fault, enough_for, first_place, numbers_for
from optipath.values.jax_values import check_known
from optipath.values.parameters import check_named
from optipath.values.precision import whole_number
from optipath.values.units import dimension_of, format_quantity, parse_quantity
from optipath.values.use import axes_for

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from optipath.plan.inputs import Inputs


_BYTES = 1100
"""What a path takes for each value that is uncertain, with all that is made on the way."""

_BYTES_OF_A_SAMPLE = 2600
"""What a path takes in each sample that runs at once; those of other blocks take nothing."""

UncertaintyMethod: TypeAlias = Literal["auto", "gradients", "differences", "monte-carlo"]
_SAMPLES = 10_000
_FEWEST, _MOST = 2, 10_000_000
OPTIONS = frozenset(PathGraph.propagate.__kwdefaults__ or ())
"""What `PathGraph.propagate` takes by name beside parameters."""


def propagate(
    path: PathGraph,
    unnamed: tuple[object, ...],
    arguments: dict[str, Any],
    method: str,
    samples: int | None,
    seed: int | None,
    correlation: object,
    detector: str | None,
    composer: Composer | None,
) -> Propagation:
    """Return the light of a path with its uncertainty; see `PathGraph.propagate`."""
    plan = path.compose()
    check_named("propagate", unnamed, plan.inputs.open)
    ParameterError.raise_for(
        f"'{name}' is an option of propagate() and a parameter of this path; path.bind({name}=...) "
        f"gives the parameter its value"
        for name in plan.inputs.open
        if name in OPTIONS
    )
    exact, uncertain, faults = _read_all(plan.inputs, arguments)
    # A value whose uncertainty cannot be read is one of them all the same.
    names = [n for n, value in arguments.items() if isinstance(value, tuple) and n not in exact]
    faults += _option_faults(method, samples, seed, composer)
    matrix = _correlation_of(correlation, names, faults)
    end, ends = "", tuple(plan.program.detectors)
    with OptipathError.collecting(faults):
        end = only("detector", ends, f"propagate(detector='{ends[0]}', ...)", detector)
    ParameterError.raise_for(faults)
    request = plan if composer is None else path.plan_by(composer)
    values = {n: v[0] if isinstance(v, tuple) and n in names else v for n, v in arguments.items()}
    request.inputs.warn_of_angles(values)
    uncertainties = {name: arguments[name][1] for name in names}
    request.inputs.warn_of_angles(uncertainties, "the standard uncertainty of parameter")
    light_at = LightAt(request, end, exact, tuple(uncertain))
    light = light_at({})
    if method == "monte-carlo":
        count, start = _SAMPLES if samples is None else int(samples), int(seed or 0)
        block = min(count, samples_at_once(light.shape)), *light.shape
        with enough_for(block, _BYTES_OF_A_SAMPLE, error=ParameterError):
            spread, mean, notes = spread_of_samples(light_at, light, matrix, count, start)
        found, left = f"Monte Carlo, {count:,} samples, seed {start}", np.zeros_like(spread.shares)
    else:
        if composer is not None:
            exactly = replace(
                composer, engine="auto", dtype="float64", tolerance=None, model="auto"
            )
            light_at = replace(light_at, plan=exactly.compose(path))
        with enough_for(light.shape, _BYTES * len(uncertain), error=ParameterError):
            slopes, found, rounding = slopes_of(light_at, method)
            center = light_at({})
            changes = changes_of(center, slopes, light_at.uncertain, rounding)
            spread = spread_of(changes, matrix)
            left = nonlinearity_of(light_at, center, changes, spread.uncertainties, matrix)
        notes = notes_of_first_order(light, light_at.uncertain, spread.uncertainties, left)
        mean = np.asarray(light.stokes, np.float64)
    about = light_at.uncertain, found, tuple(notes)
    return Propagation(light, mean, spread.covariance, *about, *spread[1:], left)


def _option_faults(method: str, samples: Any, seed: Any, composer: Any) -> list[str]:
    result = unknown("method", method, get_args(UncertaintyMethod))
    drawn = [name for name, n in (("samples", samples), ("seed", seed)) if n is not None]
    if drawn and not result and method != "monte-carlo":
        result.append(
            f"method='{method}' draws no samples; leave {' and '.join(drawn)} out, or write "
            f"method='monte-carlo'"
        )
    if composer is not None and not isinstance(composer, Composer):
        result.append(f"composer must be an op.Composer(...), not {shown(composer)}")
    if samples is not None:
        result += whole_number("samples", samples, _FEWEST, _MOST)
    if seed is not None:
        result += whole_number("seed", seed, 0)
    return result


_PAIR = 2


def _read_all(
    inputs: Inputs, arguments: Mapping[str, Any]
) -> tuple[dict[str, Any], list[UncertainValue], list[str]]:
    """Return what is exact, what is uncertain, and what is wrong with either."""
    faults = unknown_names(inputs, arguments)
    known = {name: value for name, value in arguments.items() if name in inputs.open}
    exact = {name: value for name, value in known.items() if not isinstance(value, tuple)}
    uncertain: list[UncertainValue] = []
    for name, value in known.items():
        if name not in exact:
            with OptipathError.collecting(faults):
                uncertain.append(_read(inputs, name, value))
    if not any(isinstance(value, tuple) for value in arguments.values()):
        faults.append(
            "nothing that is given has an uncertainty; give a value and its standard uncertainty, "
            f"such as {next(iter(inputs.open), 'delta')}=(0.8, 0.001)"
        )
    values = {**exact, **{each.name: each.value for each in uncertain}}
    try:
        inputs.resolve(values)
    except OptipathError as fault:
        # What could not be read is no value.
        unread = {*arguments} - {*values}
        faults += [each for each in fault.faults if each.subject not in unread]
    return exact, uncertain, faults


def _read(inputs: Inputs, name: str, arguments: tuple[Any, ...]) -> UncertainValue:
    if len(arguments) != _PAIR:
        raise ParameterError(
            f"parameter '{name}' is a tuple of {len(arguments)}; a value and its standard "
            f"uncertainty are two, and several values without one are a list or an array"
        )
    if inputs.tails.get(name):
        raise ParameterError(
            f"parameter '{name}' is of several numbers, which have no uncertainty here; give "
            f"them exactly, as a list or an array"
        )
    value, sigma = _value(inputs, name, arguments[0]), _sigma(inputs, name, arguments[1])
    shapes = {f"the values of '{name}'": value.shape, "their uncertainties": sigma.shape}
    ParameterError.raise_for(broadcast_fault(shapes))
    value, sigma = np.broadcast_arrays(value, sigma)
    low, high = inputs.limits[name]
    return UncertainValue(name, value, sigma, low, high, inputs.open[name].unit)


def _value(inputs: Inputs, name: str, value: Any) -> Any:
    in_parts = (
        f"parameter '{name}' is complex, and its parts have an uncertainty each; write "
        f"op.Material(op.Parameter('n'), op.Parameter('k')) in the path, and give n and k"
    )
    if isinstance(value, Material):
        raise ParameterError(in_parts)
    check_known(f"propagate({name}=...)", value)
    value, present = inputs.numbers_for(name, axes_for(name, value, inputs.uses))
    if not np.all(present):
        raise ParameterError(
            f"parameter '{name}' is 'none', which takes an element out of the path and has no "
            f"uncertainty; give it without one, {name}='none'"
        )
    if np.iscomplexobj(value):
        raise ParameterError(in_parts)
    return np.asarray(value, np.float64)


def _sigma(inputs: Inputs, name: str, sigma: Any) -> Any:
    what, unit = f"the standard uncertainty of parameter '{name}'", inputs.open[name].unit
    check_known(what, sigma)
    dimension = inputs.dimensions.get(name, dimension_of(unit))
    numbers = numbers_for(what, sigma, lambda text: parse_quantity(text, dimension), ParameterError)
    array = array_of(what, numbers, ParameterError)
    if array.dtype.kind not in "iuf":
        raise ParameterError(f"{what} is {shown(sigma)}; give a number of 0 or more")
    if np.any(bad := ~(np.isfinite(array) & (array >= 0.0))):
        result = format_quantity(float(array[bad].ravel()[0]), unit)
        raise ParameterError(
            f"{what} is {result}{first_place(bad)}; give a finite number of 0 or more"
        )
    return array.astype(np.float64)


_ROUNDING = 1e-12
_EXAMPLE = '{("n1", "k1"): 0.3}'


def _correlation_of(
    argument: Any, names: Sequence[str], faults: list[str]
) -> npt.NDArray[np.float64]:
    """Return the matrix (k, k) of correlation coefficients."""
    matrix = np.eye(len(names))
    if argument is None:
        return matrix
    if not isinstance(argument, Mapping):
        faults.append(f"correlation must be a mapping such as {_EXAMPLE}, not {shown(argument)}")
        return matrix
    before = len(faults)
    seen: list[set[int]] = []
    for pair, coefficient in argument.items():
        is_pair = isinstance(pair, tuple) and len(pair) == _PAIR and pair[0] != pair[1]
        if not is_pair or any(name not in names for name in pair):
            faults.append(
                f"correlation is of pairs of parameters that have an uncertainty, such as "
                f"{_EXAMPLE}, not of {shown(pair)}; there are: {', '.join(names)}"
            )
            continue
        one, other = (names.index(name) for name in pair)
        is_number = isinstance(coefficient, (int, float, np.number))
        if not is_number or np.iscomplexobj(coefficient) or not -1.0 <= coefficient <= 1.0:
            faults.append(
                f"the correlation of {shown(pair)} is {shown(coefficient)}; give a number "
                f"within -1 .. 1"
            )
        elif {one, other} in seen:
            faults.append(f"the correlation of {shown(pair)} is given twice; give it once")
        else:
            seen.append({one, other})
            matrix[one, other] = matrix[other, one] = coefficient
    if (
        len(faults) == before
        and len(names)
        and (least := np.linalg.eigvalsh(matrix)[0]) < -_ROUNDING
    ):
        faults.append(
            f"no values can be correlated like this: the matrix of the coefficients has the "
            f"eigenvalue {least:.3g}, and none may be negative; make the coefficients smaller"
        )
    return matrix
