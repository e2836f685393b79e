"""Photon: one of those walked over a sample, replayed with all its events."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, degrees, prod
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from optipath.elements.ends import Source
from optipath.elements.interface import Interface
from optipath.errors import SurfaceError
from optipath.faults import shown
from optipath.kernels.carriers.carried import stokes_of
from optipath.kernels.fresnel.boundary import lossless_boundary
from optipath.kernels.primitives import FLOAT, NUMPY
from optipath.light.frame import Frame
from optipath.surfaces.smooth import path_of_steps
from optipath.surfaces.walk import layout
from optipath.surfaces.walk.beam import BLOCK, beam_of
from optipath.surfaces.walk.meshes import meshes_of
from optipath.values.precision import Numbers, whole_number

if TYPE_CHECKING:
    from collections.abc import Iterable

    from optipath.paths.path_graph import PathGraph
    from optipath.surfaces.sample import Sample
    from optipath.surfaces.walk.beam import PhotonBeam, WalkedBlock


@dataclass(frozen=True, eq=False, repr=False)
class Photon:
    """A photon that has been walked over a sample; ``print(photon)`` has a table of its events.

    Attributes
    ----------
    beam : PhotonBeam
        The photons of which it is one.
    number : int
        Which one.
    surface : int
        Which realisation of the sample's random surfaces it was on.
    events : tuple of PhotonEvent
        Where it has met facets, in their order.
    end : str
        How it ends: ``"up"``, ``"down"``, ``"sideways"`` beside a finite field, or ``"stuck"``
        after as many events as allowed.
    start : Frame
        That of the light that comes: z goes down, x is horizontal. On an isotropic sample it comes
        from an azimuth of its own.
    frame : Frame
        That of the light that leaves: z is its direction, x is s of the last facet.
    stokes : ndarray, shape (..., 4)
        The Stokes vector that leaves, divided by the probability of the way; for each wavelength.
    scalar : ndarray, shape (...)
        The intensity that leaves where there is no polarisation: with the mean of the shares of s
        and p at each event.
    """

    beam: PhotonBeam
    number: int
    surface: int
    events: tuple[PhotonEvent, ...]
    end: str
    start: Frame
    frame: Frame
    stokes: Numbers
    scalar: Numbers

    @property
    def sample(self) -> Sample:
        """What it fell on."""
        return self.beam.sample

    @property
    def seed(self) -> int:
        """That of all random numbers but those of the surfaces."""
        return self.beam.seed

    @property
    def weight(self) -> float:
        """One over the probability of the way: the product of those of all events."""
        return prod(1.0 / event.probability for event in self.events)

    def path(self, which: Place | None = None) -> PathGraph:
        """Return the way of the photon as a path, whose light is that of the photon.

        The source has the whole weight, and each event is an `Interface`: its nodes are ``source``,
        ``facet-1`` and so on, and ``detector``. The frames of the path stand relative to each
        other, so its light is in that of the photon: the numbers of ``path().trace().stokes`` are
        `stokes`, in `frame`. Of several wavelengths, one may be given by its place.

        >>> from optipath.surfaces.sample import Sample
        >>> photon = Sample([(1.5, 0.3)], cells=320).photon(7, "60 deg")
        >>> path = photon.path()
        >>> photon, bool(abs(path.trace().stokes - photon.stokes).max() < 1e-13)
        (<Photon 7 of seed 0: down after 1 event>, True)
        """
        shape = self.beam.indices.n.shape
        if which is not None and not _is_place(which, shape):
            raise SurfaceError(
                f"which is {shown(which)}, but wavelengths have the shape {shape}; give the place "
                f"of one, or leave it out"
            )
        source = Source(self.weight, self.beam.states[0])
        return event_path(source, self.events, which, repr(self)[1:-1])

    def __repr__(self) -> str:
        count = len(self.events)
        events = f"{count} event{'s' if count != 1 else ''}"
        return f"<Photon {self.number} of seed {self.seed}: {self.end} after {events}>"

    def __str__(self) -> str:
        stokes = np.array2string(self.stokes, precision=6)
        return f"{repr(self)[1:-1]}, with light\n{stokes}\n{event_table(self.events)}"


def _is_place(which: Place, shape: tuple[int, ...]) -> bool:
    """Tell whether there is one wavelength at a place."""
    try:
        return not isinstance(which, bool) and np.empty(shape)[which].ndim == 0
    except (IndexError, TypeError, ValueError):
        return False


@dataclass(frozen=True, eq=False)
class PhotonEvent:
    """A photon meets a facet; vectors are along the x and y of the sample and upwards."""

    layer: int
    facet: tuple[int, int, int]
    position: Numbers
    on_mesh: Numbers
    normal: Numbers
    direction: Numbers
    onwards: Numbers
    cos: float
    sin: float
    turn: float
    reflected: bool
    probability: float
    n1: float
    n2: Any

    @property
    def incidence(self) -> float:
        """The angle of incidence in radians."""
        return atan2(self.sin, self.cos)


def event_of(
    beam: PhotonBeam, surface: int, walked: WalkedBlock, number: int, onwards: Numbers
) -> PhotonEvent:
    """Return an event out of the record of a photon."""
    row = walked.record[number]
    layer, column, line, facet = map(int, row[: layout.SIDE])
    cos, sin, cos_2a, sin_2a, share, n1, n2 = map(float, row[layout.COS : layout.POINT])
    position, normal, direction = row[layout.POINT :][:9].reshape(3, 3).copy()
    # The point as one of the layer's own field, in the cell that was met.
    field = beam.sample.fields(surface)[layer]
    top = meshes_of(beam.sample, surface).numbers[layout.NUMBERS * layer + layout.HIGH]
    shift = *walked.starts[2 * layer : 2 * layer + 2], field.heights.max() - top
    on_mesh = position + np.array(shift)
    if field.periodic:
        middle = (np.array([column, line]) + 0.5) * field.spacing
        on_mesh[:2] -= np.round((on_mesh[:2] - middle) / field.size) * field.size
    return PhotonEvent(
        layer,
        (column, line, facet),
        position,
        on_mesh,
        normal,
        direction,
        onwards,
        cos,
        sin,
        turn=0.5 * atan2(sin_2a, cos_2a),
        reflected=bool(row[layout.REFLECTED]),
        probability=share,
        n1=n1,
        n2=beam.indices.base if n2 == layout.OPAQUE else n2,
    )


Place: TypeAlias = int | tuple[int, ...]


def event_path(
    source: Source, events: Iterable[PhotonEvent], which: Place | None, description: str
) -> PathGraph:
    """Return the path of a photon through its events."""
    ports = {True: "reflected", False: "transmitted"}
    steps = [
        (f"facet-{number}", _interface(event, which), ports[event.reflected])
        for number, event in enumerate(events, 1)
    ]
    return path_of_steps(source, steps, description)


def _interface(event: PhotonEvent, which: Place | None) -> Interface:
    index = event.n2 if which is None or not np.ndim(event.n2) else event.n2[which]
    angle, measured_in = event.incidence, None
    if not event.reflected and event.n1 > index:
        # Next to the critical angle, that of refraction has digits which that of incidence lacks.
        wave = lossless_boundary(FLOAT)(event.n1, index, event.cos, event.sin)
        angle, measured_in = atan2(wave.n1 * wave.s, wave.a), index
    # Facets stand at any angle to each other, for which no law of parallel faces holds.
    return Interface(index, angle, event.n1, event.turn, measured_in, parallel=False)


_HEADS = ["", "layer", "", "media", "incidence", "turn", "probability", "x", "y", "z"]


def event_table(events: Iterable[PhotonEvent]) -> str:
    """Return a line for each event of a photon."""
    rows = [_HEADS]
    for number, event in enumerate(events, 1):
        what = "reflected" if event.reflected else "refracted"
        media = f"{_index(event.n1)} | {_index(event.n2)}"
        angles = [f"{degrees(angle):z.3f} deg" for angle in (event.incidence, event.turn)]
        where = [f"{each:z.3f}" for each in event.on_mesh]
        share = f"{event.probability:.6f}"
        rows.append([str(number), str(event.layer), what, media, *angles, share, *where])
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return "\n".join(
        "  ".join(text.rjust(width) for text, width in zip(row, widths, strict=True))
        for row in rows
    )


def _index(index: Any) -> str:
    if np.ndim(index):
        return "n + ik"
    return f"{index.real:g}+{index.imag:g}j" if np.iscomplexobj(index) else f"{index:g}"


def replayed_photon(sample: Sample, number: int, incidence: Any, **light: Any) -> Photon:
    """Return one of the photons that `energy` counts, with all that happens to it."""
    beam = beam_of(sample, incidence, **light, others=whole_number("number", number, 0))
    block, place = divmod(int(number), BLOCK)
    walked, surface = beam.block(block, wanted=place), beam.surface(int(number))
    ends, shape = walked.record[0], beam.indices.n.shape
    first, start_x, last, x = ends[layout.FIRST_K :][:12].reshape(4, 3).copy()
    events = walked.record[1 : int(ends[layout.EVENTS]) + 1]
    directions = [*events[1:, layout.DIRECTION :][:, :3].copy(), last][: len(events)]
    return Photon(
        beam,
        int(number),
        surface,
        events=tuple(
            event_of(beam, surface, walked, place, onwards)
            for place, onwards in enumerate(directions, 1)
        ),
        end=layout.OUTCOME_NAMES[int(ends[layout.OUTCOME])],
        start=Frame.from_direction(first, start_x),
        frame=Frame.from_direction(last, x),
        stokes=np.stack(stokes_of(NUMPY, tuple(walked.lights.T[:4])), axis=-1).reshape(*shape, 4),
        scalar=walked.lights[:, 4].reshape(shape),
    )
