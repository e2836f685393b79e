"""Interface: a smooth boundary by Fresnel's equations; Mirror: one by given amplitudes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from optipath.elements.boundary import BoundaryElement
from optipath.elements.coupling import Coupling, numbers_of, vanishes
from optipath.elements.element import Element
from optipath.elements.frame_checks import x_faults
from optipath.kernels.catalog import (
    PHASE_INDEX,
    PLAIN_AMPLITUDES,
    REFLECTION,
    REFLECTION_FROM_ABSORBING,
    TRANSMISSION,
    TRANSMISSION_FROM_ABSORBING,
    TRANSMISSION_FROM_BEHIND,
)
from optipath.materials.index_domains import INDEX, LIT_INDEX
from optipath.materials.quantities import (
    AMPLITUDE,
    Amplitude,
    Angle,
    FollowedIncidence,
    Index,
    LitIndex,
    OptionalLitIndex,
    YesOrNo,
)
from optipath.values.arrays import read_only
from optipath.values.operands import Operand, Operation

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.kernels.kernel import KernelFamily
    from optipath.light.frame import Frame


class Interface(BoundaryElement, kind="interface"):
    """A smooth boundary; its frames have x = s, perpendicular to the plane of incidence.

    Light from the front enters at ``in``; what is reflected leaves at ``reflected``, and what
    is refracted at ``transmitted``, as the power carried into the medium behind: a radiance is
    multiplied by (n2 / n1)^2 besides (Nicodemus, Am. J. Phys. 31, 368 (1963)). Light from
    behind enters at ``back``: what is reflected leaves at ``transmitted``, and what is
    refracted at ``reflected``.

    Either medium may absorb. Light in an absorbing medium has come in by a smooth face that is
    parallel to this one: its planes of constant amplitude are parallel to the face. What is
    reflected and let through, each over what arrives, need not add up to 1 there
    ("Light in and out of media that absorb", in the documentation). A wave that fades along the
    normal faster than it goes on is refused.

    Parameters
    ----------
    index : float, complex, array_like, Material or Parameter
        The index of refraction n + ik of the medium behind the boundary.
    incidence : float, array_like, Parameter or FOLLOWS
        The angle of incidence in radians, 0 to pi/2, of light from the front; with `FOLLOWS`, that
        of the boundary before, whose light has been refracted by Snell's law. In a medium that
        absorbs, the real angle: that of the normal to the planes of constant phase.
    outside : float, complex, array_like, Material, Parameter or FOLLOWS, optional
        The index of the medium in front; with `FOLLOWS`, the medium that the light of the
        boundary before comes in.
    azimuth : float, array_like or Parameter, optional
        The angle by which the frame of ``in`` is turned about the direction of travel
        against the frame of the port before it. For ``back``, which light from the next
        boundary of a stack enters without a turn, a link may say it.
    incidence_in : float, complex, array_like, Material or Parameter, optional
        The index of the medium in which the incidence is measured; ``outside`` by default.
        With it, one angle serves all parallel interfaces of a stack, refracted from the medium
        in front of the stack by Snell's law. Where that gets no light into ``outside``, since
        all has been reflected before, all is reflected here, too.
    parallel : bool, optional
        Whether it is parallel to a boundary before whose refracted light enters it, so that
        n sin(incidence) must be the same; False for a face that stands at an angle to that one,
        such as the second of a prism, whose incidence is its own. It says nothing of the faces
        behind, and none that sends light back to the one before can have it.

    Examples
    --------
    >>> Interface(index=0.608 + 2.12j, incidence=0.349).outside
    1.0
    >>> glass = Interface(index=1.5, incidence=0.0)
    >>> print(glass.mueller("in", "transmitted").matrix[0, 0])
    0.96
    """

    mirrored: ClassVar[tuple[str, ...]] = ()
    lit_from_absorbing: ClassVar[bool] = True
    lit_behind = LIT_INDEX

    index: Index
    incidence: FollowedIncidence
    outside: LitIndex = 1.0
    azimuth: Angle = 0.0
    incidence_in: OptionalLitIndex | None = None
    parallel: YesOrNo = True

    def couplings(self) -> tuple[Coupling, ...]:
        """Return what is reflected and what is let through, from either side.

        Between media that do not absorb, both are the same from the two sides (Stokes'
        relations): r' = -r for s and for p, and power carried either way is ``1 - |r|^2``. Where
        the medium in front may be one that light does not get into, since it has been
        refracted before, what is reflected from behind is another matter. With absorption,
        r' = -r as well, but what is let through differs.
        """
        first, second = [numbers_of(index, INDEX) for index in (self.outside, self.index)]
        angle = (Operand(self.incidence, "cos"), Operand(self.incidence, "sin"))
        before = self._index_of_angle(angle)
        reflect, transmit = [_between(f, first, second, *before, *angle) for f in _FROM_FRONT]
        reflect_back, through_back = reflect, transmit
        if before:
            reflect_back = _between(_FROM_FRONT[0], second, first, *before, *angle)
        if not (vanishes(first[1]) and vanishes(second[1])):
            numbers = (*first, *second, *before, *angle)
            through_back = Operation(TRANSMISSION_FROM_BEHIND, numbers)
        return self._ways((reflect, transmit), (reflect_back, through_back))

    def _index_of_angle(self, angle: tuple[Any, ...]) -> tuple[Any, ...]:
        """Return n0 of the medium in which the incidence is measured, unless that is in front."""
        if self.incidence_in is None:
            return ()
        n, k = numbers_of(self.incidence_in, INDEX)
        return (n,) if vanishes(k) else Operation(PHASE_INDEX, (n, k, *angle)).results(1)


_FROM_FRONT = (
    (REFLECTION, REFLECTION_FROM_ABSORBING),
    (TRANSMISSION, TRANSMISSION_FROM_ABSORBING),
)


def _between(
    families: tuple[KernelFamily, KernelFamily],
    first: tuple[Any, ...],
    second: tuple[Any, ...],
    *angle: Any,
) -> Operation:
    """Return the operation for light from the first of two media, of (n, k) each."""
    usual, from_absorbing = families
    if vanishes(first[1]):
        return Operation(usual, (first[0], *second, *angle))
    return Operation(from_absorbing, (*first, *second, *angle))


_IDEAL = {"r_s": -1.0, "r_p": 1.0}


class Mirror(Element, kind="mirror"):
    """A mirror whose amplitude reflection coefficients are known; ideal unless told otherwise.

    Light that enters at ``in`` leaves at ``reflected``; both frames have x = s,
    perpendicular to the plane of incidence. The field is exp(-iwt), and y turns over with
    the light: r_p = -r_s at normal incidence. So what light meets again on its way back has its
    axes at the opposite angle. C + iS = r_s conj(r_p); Born & Wolf,
    Principles of Optics, sec. 1.5.2.

    Parameters
    ----------
    r_s, r_p : float, complex, array_like or Parameter, optional
        What the field is multiplied by along s and along p; of a size of 1 or less. Where one
        alone is given, r_p = -r_s, as at normal incidence; -1 and 1 where none is.
    azimuth : float, array_like or Parameter, optional
        As `Interface` takes it.

    Examples
    --------
    >>> aluminium = Mirror(r_s=-0.97 + 0.12j, r_p=0.92 - 0.26j)
    >>> (aluminium.mueller().matrix[0] * 2).round(4)
    array([1.8693, 0.0413, 0.    , 0.    ])
    >>> Mirror(r_s=-0.9)
    Mirror(r_s=-0.9, r_p=0.9, azimuth=0.0)
    """

    outputs: ClassVar[tuple[str, ...]] = ("reflected",)
    natural: ClassVar[str] = "reflected"
    straight: ClassVar[bool] = False
    mirrored: ClassVar[tuple[str, ...]] = ()

    r_s: Amplitude | None = None
    r_p: Amplitude | None = None
    azimuth: Angle = 0.0

    def __post_init__(self) -> None:
        """Let one amplitude follow from the other where that alone is given."""
        missing = [name for name in _IDEAL if getattr(self, name) is None]
        for name in missing:
            object.__setattr__(self, name, _IDEAL[name])
        super().__post_init__()
        # What is wrong with the one that is given is told of that alone.
        if len(missing) == 1 and not self.faults(""):
            (argument,) = _IDEAL.keys() - missing
            object.__setattr__(self, missing[0], read_only(-getattr(self, argument)))

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the reflection from ``in`` to ``reflected``."""
        numbers = numbers_of(self.r_s, AMPLITUDE) + numbers_of(self.r_p, AMPLITUDE)
        reflecting = Operation(PLAIN_AMPLITUDES, numbers)
        return (Coupling("in", "reflected", (reflecting,), reflects=True),)

    def frame_faults(self, owner: str, frames: Mapping[str, Frame]) -> list[str]:
        return x_faults(owner, frames)
