"""Polarization: when it matters, how much, and which element brings it in."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.composer import Composer
from optipath.engines.program.program import Evaluation
from optipath.errors import ParameterError, listed, shown
from optipath.kernels.carriers.kernel import Kernel
from optipath.kernels.carriers.structures import DEPOLARIZING_BLOCK
from optipath.values.arrays.read_only import same_fields

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    import numpy.typing as npt

    from optipath.composer.composer import Path
    from optipath.engines.program.program import Program
    from optipath.kernels.numbers.primitives import Primitives
    from optipath.plan.certificate import Certificate
    from optipath.plan.plan import Plan


_ROUNDING, _ALIKE = 1e-12, 1e-9
"""Below which share an element does nothing, and by how much the largest may differ."""


@dataclass(frozen=True, eq=False)
class Polarization:
    """What polarisation does to the intensity at a detector, for each path of a batch.

    Attributes
    ----------
    exact : ndarray, shape (...)
        The intensity.
    certificate : Certificate
        The intensity of the scalar model, in which each element dims light by its mean, and
        bounds of what polarisation can make of it.
    elements : mapping of str to ndarray, shape (...)
        For each element that polarises, the intensity that is there because it does, over that
        of the scalar model; negative where light is missing for it. Elements act together,
        so these need not add up to the difference.
    """

    exact: npt.NDArray[Any]
    certificate: Certificate
    elements: Mapping[str, npt.NDArray[Any]]

    __eq__ = same_fields
    __hash__ = None  # type: ignore[assignment]

    @property
    def scalar(self) -> npt.NDArray[Any]:
        """The intensity of the scalar model."""
        return self.certificate.scalar

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
        As `Composer.compose` and `Plan.run`; and where light goes round, in a loop or between
        the layers of a stack, since the scalar model has no sum over all rounds yet.

    Examples
    --------
    Two panes of glass near Brewster's angle, one behind the other, and crossed:

    >>> import numpy as np
    >>> import optipath as op
    >>> panes = op.load_preset("npgr026", n1=1.5, n2=1.5, delta=0.98, phi=0.98)
    >>> found = op.polarization(panes, rho=[0.0, np.pi / 2])
    >>> print(found.difference.round(2), found.culprits)
    [ 1. -1.] ('X2', 'X1')
    """
    plan = Composer().compose(path)
    ends = tuple(plan.whole.detectors)
    if detector is None and len(ends) != 1:
        raise ParameterError(
            f"the path has {len(ends)} detectors ({', '.join(ends)}); name one, as in "
            f"polarization(path, {shown(ends[0])})"
            if ends
            else "the path has no detector; give it one"
        )
    name = ends[0] if detector is None else detector
    _refuse_rounds(plan.whole)
    certificate = plan.certificate(name, **parameters)
    exact = _intensity(plan, plan.whole, name, parameters)
    shares = {}
    for node, steps in _polarising(plan.whole).items():
        without = _intensity(plan, _without(plan.whole, steps), name, parameters)
        shares[node] = _over(exact - without, certificate.scalar)
    return Polarization(exact, certificate, shares)


def _refuse_rounds(program: Program) -> None:
    """Refuse light that goes round, of which each round would have to be dimmed by the mean."""
    places = [f"at '{program.steps[loop.start].label}'" for loop in program.loops]
    for step in program.steps:
        kernel = None if step.evaluation is None else program.evaluations[step.evaluation].kernel
        if kernel is not None and kernel.structure is DEPOLARIZING_BLOCK:
            places.append(f"between the layers of '{step.label.rpartition('.')[0]}'")
    if places:
        raise ParameterError(
            f"light goes round {listed(list(dict.fromkeys(places)))}, and the scalar model that "
            f"polarisation is measured by has no sum over all rounds; trace the path, which is "
            f"exact"
        )


def _over(difference: Any, scalar: Any) -> npt.NDArray[Any]:
    return np.asarray(difference / np.where(scalar > 0.0, scalar, 1.0))


def _intensity(plan: Plan, program: Program, end: str, parameters: Mapping[str, Any]) -> Any:
    """Return the intensity at an end of a program that stands in for that of a plan."""
    reduction = replace(plan.reduction, program=program, unreduced=False)
    return replace(plan, reduction=reduction, whole=program).run_all(**parameters)[end].intensity


def _polarising(program: Program) -> dict[str, list[int]]:
    """Return the steps of each element that may polarise, by its name."""
    found: dict[str, list[int]] = {}
    for light, step in enumerate(program.steps):
        if step.evaluation is None or not step.inputs:
            continue
        kernel = program.evaluations[step.evaluation].kernel
        if kernel.structure is not None and kernel.structure.unpolarising is not None:
            found.setdefault(step.label.rpartition(".")[0], []).append(light)
    return found


def _without(program: Program, steps: list[int]) -> Program:
    """Return a program in which some steps dim all light alike, by their mean."""
    evaluations, changed = list(program.evaluations), list(program.steps)
    for light in steps:
        step = changed[light]
        old = evaluations[step.evaluation or 0]
        kernel = Kernel(old.kernel.name, old.kernel.structure, _Unpolarising(old.kernel))
        changed[light] = replace(step, evaluation=len(evaluations))
        evaluations.append(Evaluation(kernel, old.arguments, old.presence))
    return replace(program, evaluations=tuple(evaluations), steps=tuple(changed))


@dataclass(frozen=True)
class _Unpolarising:
    """Makes the function of a kernel whose element polarises no light."""

    kernel: Kernel

    def __call__(self, xp: Primitives) -> Callable[..., tuple[Any, ...]]:
        function, structure = self.kernel.made_for(xp), self.kernel.structure
        assert structure is not None and structure.unpolarising is not None  # noqa: S101, PT018
        unpolarising = structure.unpolarising

        def numbers(*arguments: Any) -> tuple[Any, ...]:
            return tuple(unpolarising(function(*arguments)))

        return numbers
