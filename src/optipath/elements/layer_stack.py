"""LayerStack: any number of smooth layers as one element."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar, Literal, cast

import numpy as np

from optipath.elements.alone import checked_alone, turned_alone
from optipath.elements.boundary import BoundaryElement
from optipath.elements.boundary_media import along_normal
from optipath.elements.coupling import numbers_of, vanishes
from optipath.errors import CoherenceWarning, PathError
from optipath.faults import shown
from optipath.kernels.catalog import stack
from optipath.kernels.fresnel.layers import attenuation
from optipath.kernels.fresnel.stable import interference
from optipath.kernels.primitives import NUMPY, of_module
from optipath.light.frame import Frame
from optipath.light.light import Light
from optipath.light.mueller import Mueller
from optipath.materials.index_domains import (
    FOLLOWS,
    INDEX,
    INDICES,
    LENGTHS,
    LOSSY,
    OPTIONAL_OUTSIDE,
    inner_domain,
)
from optipath.materials.quantities import (
    Angle,
    FollowedIncidence,
    Indices,
    Lengths,
    OptionalIndex,
    OptionalWavelength,
    YesOrNo,
)
from optipath.values.agreement import Agreement, text_of
from optipath.values.angles import warn
from optipath.values.arrays import check_broadcast
from optipath.values.operands import NOTHING, Operand, Operation, operand_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    import numpy.typing as npt

    from optipath.elements.coupling import Coupling
    from optipath.kernels.catalog import Method
    from optipath.values.domains import Domain
    from optipath.values.parameters import Resolved


_NEEDED = {"lengths": "the lengths (one for each layer)", "wavelength": "the wavelength"}


class LayerStack(BoundaryElement, kind="layer-stack"):
    """Smooth parallel layers on a substrate, with the ports of an `Interface`.

    Light goes to and fro between the boundaries; intensities add up, as they do in layers much
    thicker than the coherence length. Thin films interfere, which it does not compute: a layer
    thinner than ten wavelengths is warned of (`CoherenceWarning`). It depolarises, since light
    that has gone round more often has gained other phases.

    Parameters
    ----------
    indices : sequence of float, complex, array_like, Material or Parameter
        The medium in front first, which does not absorb, then the layers, and the substrate last.
        Two media are one `Interface`. The first may be `FOLLOWS`, as ``outside`` of an
        `Interface`.
    incidence : float, array_like, Parameter or FOLLOWS
        The angle of incidence in radians, 0 to pi/2, in the medium in front.
    azimuth, incidence_in, parallel : optional
        As `Interface` takes them.
    lengths : sequence of float, array_like or Parameter, optional
        How thick each layer between the first medium and the last is, in metres. Layers that
        absorb need them: down once through a layer the intensity falls by
        exp(-4 pi Im(g) length / wavelength), g = sqrt(m^2 - (n0 sin(incidence))^2), along the
        slanted way that light takes in it (Byrnes, arXiv:1603.02720). Others take no notice.
        A length of wavelength / (2 pi Re(g)) is always enough; shorter ones are refused where light
        would gain, by the interference that sums of intensities leave out.
    wavelength : float, array_like or Parameter, optional
        The wavelength in vacuum, in metres, 1e-12 to 1e-3; needed where a layer absorbs.

    Examples
    --------
    >>> pane = LayerStack([1.0, 1.5, 1.0], incidence=0.0)
    >>> print(pane.mueller("in", "transmitted").matrix[0, 0].round(12), 2 * 1.5 / (1 + 1.5**2))
    0.923076923077 0.9230769230769231

    A pane of tinted glass, 4 mm thick, and how much stays in it:

    >>> of_pane = {"lengths": ["4 mm"], "wavelength": "550 nm"}
    >>> tinted = LayerStack([1.0, 1.5 + 1e-6j, 1.0], "60 deg", **of_pane)
    >>> print(tinted.mueller("in", "transmitted").matrix[0, 0].round(6), tinted.absorbed().round(6))
    0.756309 [0.104709]
    """

    media_fields: ClassVar[tuple[str, str]] = ("indices[0]", "indices[-1]")
    mirrored: ClassVar[tuple[str, ...]] = ()

    indices: Indices
    incidence: FollowedIncidence
    azimuth: Angle = 0.0
    incidence_in: OptionalIndex | None = None
    parallel: YesOrNo = True
    lengths: Lengths | None = None
    wavelength: OptionalWavelength | None = None

    def __post_init__(self) -> None:
        """Keep values as every element does; warn of layers that are films."""
        super().__post_init__()
        for film in self._films():
            if not film.is_open:
                film.fault()

    def quantities(self) -> Iterator[tuple[str, Any, Domain]]:
        """Yield every value; layers may absorb where lengths and a wavelength are given."""
        missing = [text for name, text in _NEEDED.items() if getattr(self, name) is None]
        inner = inner_domain(" and ".join(missing)) if missing else LOSSY
        # Of indices that are no list, nobody knows how many layers are meant.
        layers = len(self._media) - 2 if self._media is self.indices else None
        narrowed = {
            "indices": replace(INDICES, inner=inner),
            "lengths": replace(LENGTHS, layers=layers),
        }
        for name, domain in self.domains().items():
            yield from narrowed.get(name, domain).parts(name, getattr(self, name))

    def couplings(self) -> tuple[Coupling, ...]:
        """Return what is reflected and what is let through, from either side."""
        wanted = "reflected", "transmitted"
        front, behind = ([self._operation(w, e) for w in wanted] for e in self.inputs)
        return self._ways(front, behind)

    def absorbed(
        self,
        light: Light | npt.ArrayLike | None = None,
        enters: Literal["in", "back"] = "in",
        *,
        method: Method = "stable",
    ) -> npt.NDArray[np.float64]:
        """Return the share of light that stays in each layer: what enters it less what leaves it.

        Parameters
        ----------
        light : Light or array_like, shape (..., 4), optional
            The light that arrives, or its Stokes vector; unpolarised by default.
        enters : {"in", "back"}, optional
            The port where it arrives.
        method : str, optional
            How Fresnel's equations are computed.

        Returns
        -------
        ndarray, shape (..., layers)
            For each layer, from the first medium to the last; NaN of dark light.

        Raises
        ------
        PathError
            As `mueller` does.
        LightError, ShapeError
            If no light can have the Stokes vector, or it does not broadcast with the stack.

        Examples
        --------
        >>> stack = LayerStack([1, 1.5 + 1e-6j, 1.4, 1], 0.0, lengths=[0.01, 0.1], wavelength=5e-7)
        >>> print(stack.absorbed().round(6))
        [0.218291 0.      ]
        """
        if enters not in self.inputs:
            raise PathError(
                f"{self.kind} has no in-port {shown(enters)}; light arrives at 'in' or at 'back'"
            )
        batch, operation = checked_alone(self, enters), self._operation("absorbed", enters)
        with np.errstate(all="ignore"):
            numbers = operation.numbers(NUMPY, lambda value: operand_of(value).numbers({}), method)
            several = np.array([np.broadcast_to(number, batch) for number in numbers])
            shares = several.reshape(len(numbers) // 2, 2, *batch)
            # From the first medium on, whichever light meets first.
            s, p = np.moveaxis(shares[:: -1 if enters == "back" else 1], 0, -1)
            along: Any = 0.0
            if light is not None:
                arriving = light if isinstance(light, Light) else Light(light)
                check_broadcast({self.kind: batch, "the light": arriving.stokes.shape[:-1]})
                frame = turned_alone(self, enters, arriving.frame)
                stokes = (Mueller.of(np.eye(4), frame, Frame()) @ arriving).stokes
                along = (stokes[..., 1] / stokes[..., 0])[..., np.newaxis]
            return np.asarray(0.5 * ((1.0 + along) * s + (1.0 - along) * p))

    def agreements(self, owner: str) -> Iterator[Agreement]:
        """Yield what must hold of the layers that may absorb, and what is known at a run only."""
        yield from (film for film in self._films() if film.is_open)
        incidence, measured = self.measured
        if any(value is FOLLOWS for value in (incidence, measured, self.outside)):
            return  # What it takes over is looked at.
        n0, lengths = numbers_of(measured, INDEX)[0], cast("tuple[Any, ...]", self.lengths)
        pairs = [numbers_of(index, INDEX) for index in self._media]
        for place in self._absorbing(pairs):
            around = [number for pair in pairs[place - 1 : place + 2] for number in pair]
            arguments = (*around, lengths[place - 1], self.wavelength, n0, incidence)
            yield FadingLayer(tuple(map(operand_of, arguments)), f"{owner}.indices[{place}]")

    def _films(self) -> Iterator[ThinLayer]:
        """Yield what is warned of where it does not hold of a layer: that it is no film."""
        if self.wavelength is None or not isinstance(self.lengths, tuple):
            return
        layers = zip(self._media[1:-1], self.lengths, strict=False)
        for place, (index, length) in enumerate(layers, 1):
            arguments = (numbers_of(index, INDEX)[0], length, self.wavelength)
            yield ThinLayer(tuple(map(operand_of, arguments)), f"layer {place} of a LayerStack")

    def _operation(self, wanted: str, enters: str) -> Operation:
        """Return what the stack does to light from one side."""
        pairs = [numbers_of(index, INDEX) for index in self._media]
        lengths: Any = self.lengths
        layers = [(at, pairs[at][1], lengths[at - 1]) for at in self._absorbing(pairs)]
        measured, last = "in front", pairs[-1][1]
        if enters == "back":
            layers = [(len(pairs) - 1 - at, k, length) for at, k, length in layers[::-1]]
            pairs, measured, last = pairs[::-1], "behind", 0.0
        before: tuple[Any, ...] = ()
        if self.incidence_in is not None:
            before, measured = numbers_of(self.incidence_in, OPTIONAL_OUTSIDE)[:1], "before"
        absorption = *(k for _, k, _ in layers), *(length for *_, length in layers)
        if layers:
            absorption = *absorption, self.wavelength
        angle = Operand(self.incidence, "cos"), Operand(self.incidence, "sin")
        numbers = (*(n for n, _ in pairs), last, *absorption, *before, *angle)
        return Operation(stack(wanted, measured, tuple(at for at, *_ in layers)), numbers)

    def _absorbing(self, pairs: list[tuple[Any, Any]]) -> list[int]:
        """Return the places of the layers that may absorb."""
        lengths, inner = self.lengths, range(1, len(pairs) - 1)
        # What is missing, or does not fit, is told as a fault.
        if self.wavelength is None or not isinstance(lengths, tuple) or len(lengths) != len(inner):
            return []
        return [place for place in inner if not vanishes(pairs[place][1])]

    def taking_over(self, **values: Any) -> Any:
        """Return a stack like it with values of the boundary before in place of `FOLLOWS`."""
        if "outside" in values:
            values["indices"] = (values.pop("outside"), *self._media[1:])
        return super().taking_over(**values)

    @property
    def outside(self) -> Any:
        """The index of the medium in front."""
        return self._media[0]

    @property
    def index(self) -> Any:
        """The index of the substrate."""
        return self._media[-1]

    @property
    def _media(self) -> tuple[Any, ...]:
        """The indices; two of air where they are no list, which is told as a fault."""
        several: Any = self.indices
        return several if isinstance(several, tuple) and len(several) > 1 else (1.0, 1.0)


_ROUNDING = 1e-9
"""By how much light may gain, as a share of it: what is next to lossless may have no length."""


@dataclass(frozen=True, eq=False)
class FadingLayer(Agreement):
    """Of light that starts through a layer, no more leaves the face that it meets: e (R + T) <= 1.

    e is the intensity left behind the layer, R and T those of either face from within, of s and p:
    R + T is far more than 1 next to a plasmon or behind total reflection. As each layer then keeps
    some light, no stack emits more than it receives.

    With t = Im g / Re g of the wave along the normal, R + T <= (t + sqrt(1 + t^2))^2, so that a
    length of wavelength / (2 pi Re g) is always enough, as asinh(t) <= t.

    The operands are n, k in front of the layer, of it, and behind, its length, the wavelength, the
    index where the incidence is measured, and the incidence.
    """

    layer: str

    def fits(self, xp: Any, *numbers: Any) -> Any:
        n, k, _, _, length, wavelength, n0, angle = numbers[2:]
        if xp is np:
            goes_on, _ = along_normal(np, n, k, n0, angle)
            enough = (2.0 * math.pi * length * goes_on >= wavelength) | (k == 0.0)
            # Most are far thicker, and nobody need look at their faces.
            if np.all(enough):
                return enough
        with np.errstate(all="ignore"):
            behind = attenuation(of_module(xp))
            left, missing = behind(n, k, length, wavelength, n0, xp.cos(angle), xp.sin(angle))
        stored = [missing + left * share for share in self._absorbed_shares(xp, *numbers)]
        gains = [share < -_ROUNDING for share in stored]
        return ~((k > 0.0) & (gains[0] | gains[1] | gains[2] | gains[3]))

    def sentence(self, *numbers: float) -> str:
        n, k, _, _, length, wavelength, n0, angle = numbers[2:]
        more = -min(float(share) for share in self._absorbed_shares(np, *numbers))
        fades = float(along_normal(np, n, k, n0, angle)[1])
        least = math.log1p(more) * wavelength / (4.0 * math.pi * fades)
        _, _, of_n, of_k, _, _, of_length, of_wavelength, *_ = self.operands
        return (
            f"light would gain in '{self.layer}', of n = {text_of(of_n, n)} and k = "
            f"{text_of(of_k, k)}, at a length of {text_of(of_length, length * 1e9, ' nm')} and a "
            f"wavelength of {text_of(of_wavelength, wavelength * 1e9, ' nm')}: at a face of it "
            f"R + T is above 1 by {more:.4g}, by interference; give a length of at least "
            f"{1.001 * least * 1e9:.6g} nm, or leave the layer out"
        )

    @staticmethod
    def _absorbed_shares(xp: Any, *numbers: Any) -> tuple[Any, ...]:
        """Return 1 - R - T of s and of p, lit from within, at the face above and at that below."""
        (*above, n, k), below = numbers[:4], numbers[4:6]
        n0, angle = numbers[8:]
        arguments = n0, xp.cos(angle), xp.sin(angle)
        other = interference(of_module(xp))
        with np.errstate(all="ignore"):
            return *other(*above, n, k, *arguments)[2:], *other(n, k, *below, *arguments)[:2]


_WAVELENGTHS = 10.0
"""Up to how many wavelengths a layer is a thin film, whose light interferes."""


@dataclass(frozen=True, eq=False)
class ThinLayer(Agreement):
    """A layer is longer than about ten wavelengths in it, or else it is warned of.

    The operands are n of the layer, its length, and the wavelength in vacuum.
    """

    layer: str

    def fits(self, xp: Any, *numbers: Any) -> Any:
        n, length, wavelength = numbers
        return ~(n * length < _WAVELENGTHS * wavelength)

    def sentence(self, *numbers: float) -> str:
        return (
            f"{self.layer} is thinner than ten wavelengths, where light interferes, and a "
            f"LayerStack adds intensities; give the r_s and r_p of a film to a Mirror"
        )

    def fault(self, arguments: Mapping[str, Resolved] = NOTHING) -> str:
        """Warn of a thin layer, which is no fault."""
        if super().fault(arguments):
            warn(self.sentence(), CoherenceWarning)
        return ""

    def inside(self, arguments: Mapping[str, Resolved]) -> Any:
        """Return that any layer is allowed."""
        return True
