"""Polarization: when it matters, how much, and which element brings it in."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import chain
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.composer import Composer
from optipath.engines.draft import Draft
from optipath.engines.program import Evaluation
from optipath.kernels.kernel import Kernel
from optipath.plan.answers import only
from optipath.plan.certificate import Certificate
from optipath.values.arrays import ComparedByFields

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    import numpy.typing as npt

    from optipath.composer.composer import Path
    from optipath.engines.program import Program
    from optipath.kernels.primitives import Primitives
    from optipath.plan.plan import Plan


_ROUNDING, _ALIKE = 1e-12, 1e-9
"""Below which share an element does nothing, and by how much the largest may differ."""


@dataclass(frozen=True, eq=False)
class Polarization(ComparedByFields):
    """What polarisation does to the intensity at a detector, for each path of a batch.

    Attributes
    ----------
    exact : ndarray, shape (...)
        The intensity.
    scalar : ndarray, shape (...)
        The intensity of the scalar model, in which each element, and each boundary of a stack,
        dims light by its mean; light that goes round is the sum over all rounds of it.
    certificate : Certificate
        The scalar intensity, and bounds of what polarisation can make of it. They tell a stack
        by what it does as a whole, and the other elements by their diattenuations, however these
        stand to each other; in a loop, of all rounds together.
    elements : mapping of str to ndarray, shape (...)
        For each element that polarises, the intensity that is there because it does, over that
        of the scalar model; negative where light is missing for it. Elements act together,
        so these need not add up to the difference.
    """

    exact: npt.NDArray[Any]
    scalar: npt.NDArray[Any]
    certificate: Certificate
    elements: Mapping[str, npt.NDArray[Any]]

    @property
    def difference(self) -> npt.NDArray[Any]:
        """The error of the scalar model, (exact - scalar) / scalar; 0 where both are dark."""
        return _over(self.exact - self.scalar, self.scalar)

    @property
    def culprits(self) -> tuple[str, ...]:
        """The elements with the largest share on any path; none where nothing polarises."""
        largest = {n: np.max(np.abs(share), initial=0.0) for n, share in self.elements.items()}
        most = max(largest.values(), default=0.0)
        if most < _ROUNDING:
            return ()
        return tuple(name for name, share in largest.items() if share > (1.0 - _ALIKE) * most)


def polarization(path: Path, detector: str | None = None, /, **parameters: Any) -> Polarization:
    """Return what polarisation does to the intensity at a detector.

    Parameters
    ----------
    path : PathGraph or networkx.MultiDiGraph
        The path.
    detector : str, optional
        Its name; needed only where there are several.
    **parameters : float or array_like
        As in `Plan.run`.

    Returns
    -------
    Polarization

    Raises
    ------
    PathError, ParameterError
        As `Composer.compose`, `Plan.run` and `Plan.certificate`.

    Examples
    --------
    Two panes of glass near Brewster's angle, one behind the other, and crossed:

    >>> import numpy as np
    >>> import optipath as op
    >>> panes = op.load_preset("npgr026", n1=1.5, n2=1.5, delta=0.98, phi=0.98)
    >>> found = op.polarization(panes, rho=[0.0, np.pi / 2])
    >>> print(found.difference.round(2), found.culprits)
    [ 1. -1.] ('X2', 'X1')

    What a layer of n = 1.5 on 2.4 reflects, with light that goes to and fro in it:

    >>> layer = op.LayerStack([1.0, 1.5, 2.4], np.radians([50.0, 65.0]))
    >>> found = op.polarization(op.Source() >> layer >> op.Detector())
    >>> print((100.0 * found.difference).round(3))
    [-1.785 -3.167]
    """
    plan = Composer().compose(path)
    cure = "polarization(path, NAME)"
    ends = tuple(plan.whole.detectors if detector is None else plan.whole.readings)
    name = only("detector", ends, cure, detector)
    traced = plan.answers.whole.for_jax
    traced.refuse_traced(parameters, "comparisons with the scalar model are made")
    scalar, certificate = _scalar(plan, name, parameters)
    exact = _intensity(plan, plan.whole, name, parameters)
    shares = {}
    for node, steps in polarising(plan.whole).items():
        without = _intensity(plan, without_polarization(plan.whole, steps), name, parameters)
        shares[node] = _over(exact - without, scalar)
    return Polarization(exact, scalar, certificate, shares)


def _scalar(plan: Plan, end: str, parameters: Mapping[str, Any]) -> tuple[Any, Certificate]:
    """Return the intensity of the scalar model, and bounds of the exact one."""
    whole = plan.whole
    stacks = any(evaluation.kernel.unpolarising for evaluation in whole.evaluations)
    result = plan.certificate(end, **parameters)
    if not stacks and not whole.loops:
        return result.scalar, result
    grey = without_polarization(whole, chain.from_iterable(polarising(whole).values()))
    scalar = _intensity(plan, grey, end, parameters)
    # The certificate is of stacks that dim light by what is exact for unpolarised light.
    lit = scalar > 0.0
    share = np.where(lit, result.scalar, 1.0) / np.where(lit, scalar, 1.0)
    return scalar, Certificate(scalar, share * result.lower, share * result.upper)


def _over(difference: Any, scalar: Any) -> npt.NDArray[Any]:
    return np.asarray(difference / np.where(scalar > 0.0, scalar, 1.0))


def _intensity(plan: Plan, program: Program, end: str, parameters: Mapping[str, Any]) -> Any:
    """Return the intensity at an end of a program that stands in for that of a plan."""
    reduction = replace(plan.reduction, program=program, unreduced=False)
    return (
        replace(plan, reduction=reduction, draft=Draft.of(program))
        .run_all(**parameters)[end]
        .intensity
    )


def polarising(program: Program) -> dict[str, list[int]]:
    """Return the steps of each element that may polarise, by its name."""
    results: dict[str, list[int]] = {}
    for light, step in enumerate(program.steps):
        if step.evaluation is None or not step.inputs:
            continue
        kernel = program.evaluations[step.evaluation].kernel
        if kernel.structure is not None and kernel.structure.unpolarising is not None:
            results.setdefault(step.label.rpartition(".")[0], []).append(light)
    return results


def without_polarization(program: Program, steps: Iterable[int]) -> Program:
    """Return a program in which some steps, of stacks each boundary, dim by their mean."""
    evaluations, changed = list(program.evaluations), list(program.steps)
    for light in steps:
        step = changed[light]
        old = evaluations[step.evaluation or 0]
        changed[light] = step._replace(evaluation=len(evaluations))
        evaluations.append(Evaluation(_unpolarising(old.kernel), old.arguments, old.presence))
    return replace(program, evaluations=tuple(evaluations), steps=tuple(changed))


def _unpolarising(kernel: Kernel) -> Kernel:
    """Return the kernel of an element that dims all light by the mean."""
    if kernel.unpolarising is not None:
        return kernel.unpolarising
    cheaper = kernel.without and (kernel.without[0], _unpolarising(kernel.without[1]))
    return Kernel(kernel.name, kernel.structure, _ByMean(kernel), cheaper)


@dataclass(frozen=True)
class _ByMean:
    """Makes the function of a kernel whose element polarises no light."""

    kernel: Kernel

    def __call__(self, xp: Primitives) -> Callable[..., tuple[Any, ...]]:
        function, structure = self.kernel.made_for(xp), self.kernel.structure
        assert structure is not None and structure.unpolarising is not None  # noqa: S101, PT018
        unpolarising = structure.unpolarising

        def numbers(*arguments: Any) -> tuple[Any, ...]:
            return tuple(unpolarising(function(*arguments)))

        return numbers
