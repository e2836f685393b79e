"""Beams: photons from one direction, walked block after block."""

from __future__ import annotations

from collections import deque
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cached_property
from math import cos, sin
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np
import numpy.typing as npt

from optipath.errors import SurfaceError
from optipath.faults import shown
from optipath.kernels.carriers.carried import carry
from optipath.kernels.primitives import FLOAT
from optipath.light.frame import Frame
from optipath.materials.quantities import ANGLE, INCIDENCE
from optipath.paths.files.schema import Faults
from optipath.surfaces.sample import Sample
from optipath.surfaces.walk import layout
from optipath.surfaces.walk.code import walk_code
from optipath.surfaces.walk.meshes import meshes_of
from optipath.values.arrays import ComparedByFields
from optipath.values.domains import StokesDomain
from optipath.values.precision import whole_number

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
    from concurrent.futures import Future

    from optipath.surfaces.sample import SampleIndices
    from optipath.values.domains import Domain


BLOCK = 1 << 14
"""How many photons share a stream of random numbers."""

PORTION = 1 << 9
"""How many of them walk over one realisation of the surfaces before the next takes its turn."""

TURN = 1 << 19
"""How many photons walk over a realisation before another is drawn in its place."""


@dataclass(frozen=True, eq=False)
class PhotonBeam(ComparedByFields):
    """What is needed to walk any block of photons; block b has the seed of `SeedSequence` child b.

    Surfaces take turns, each for a `PORTION` of photons, and are replaced after a `TURN` of them.
    """

    sample: Sample
    cos: float
    sin: float
    azimuth: float
    indices: SampleIndices
    states: tuple[tuple[float, float, float, float], ...]
    seed: int
    most_events: int

    @property
    def incidence(self) -> float:
        """The angle of incidence in radians."""
        return float(np.arctan2(self.sin, self.cos))

    @cached_property
    def lights(self) -> int:
        """How many lights ride on a photon: for each index of the base, all states."""
        return self.indices.n.size * len(self.states)

    @property
    def plane_azimuth(self) -> float:
        """That of the plane of incidence as directions are told; on an isotropic sample 0."""
        return 0.0 if self.sample.isotropic else self.azimuth

    @property
    def frame(self) -> Frame:
        """That of the light that comes, x perpendicular to the plane of incidence."""
        c, s = np.cos(self.plane_azimuth), np.sin(self.plane_azimuth)
        z, x = np.array([self.sin * c, self.sin * s, -self.cos]), np.array([-s, c, 0.0]) + 0.0
        return Frame(x, np.cross(z, x), z)

    def smooth_sine(self, outcome: int) -> float:
        """Return the sine of the angle at which a smooth sample sends light up or down."""
        if outcome == layout.UP:
            return self.sin
        return self.sin * self.indices.outside / float(self.indices.n.flat[0])

    @property
    def surfaces(self) -> int:
        """How many realisations of the surfaces take turns; one where nothing is random."""
        return self.sample.surfaces if self.sample.is_random else 1

    def surface(self, photon: int) -> int:
        """Return over which realisation of the surfaces a photon walks."""
        if not self.sample.is_random:
            return 0
        drawn, place = divmod(photon // PORTION, TURN // PORTION * self.surfaces)
        return drawn * self.surfaces + place % self.surfaces

    def portions(self, number: int, photons: int) -> Iterator[tuple[int, int, int]]:
        """Yield the portions of a block: the first photon, how many, and over which surface."""
        size = PORTION if self.sample.is_random else BLOCK
        for first in range(0, photons, size):
            yield first, min(size, photons - first), self.surface(BLOCK * number + first)

    def block(
        self, number: int, photons: int = BLOCK, wanted: int = -1, *, keeps: bool = False
    ) -> WalkedBlock:
        """Walk the first photons of a block."""
        count, photons = self.lights, photons if wanted < 0 else wanted + 1
        stream = np.random.SFC64(np.random.SeedSequence(self.seed, spawn_key=(number,)))
        state = np.array(stream.state["state"]["state"], np.uint64)
        starts, lights = np.zeros(2 * len(self.sample.layers)), np.zeros((count, layout.CARRIED))
        record = np.zeros((1 if wanted < 0 else 1 + self.most_events, layout.RECORD))
        ends = np.zeros((photons if keeps else 1, layout.ENDS + layout.CARRIED * count))
        azimuth = np.nan if self.sample.isotropic else self.azimuth
        media, base, source = self._arrays
        before = (media, base, len(self.sample.layers), self.cos, self.sin, azimuth, source, count)
        code, shape = walk_code(), (layout.OUTCOMES, layout.MOST_COUNTED, count, layout.SUMS)
        sums: dict[int, npt.NDArray[np.float64]] = {}
        for first, size, surface in self.portions(number, photons):
            own = sums.setdefault(surface, np.zeros(shape))
            last = wanted - first if first <= wanted < first + size else -1
            into = (state, starts, lights, own, record, ends[keeps * first :], int(keeps))
            if not code(
                *meshes_of(self.sample, surface), *before, size, self.most_events, last, *into
            ):
                raise SurfaceError(
                    "photons meet nothing of the sample: its finite fields are too small for this "
                    "incidence; give larger or periodic ones"
                )
        if not all(np.isfinite(own).all() for own in sums.values()):
            raise SurfaceError(f"photons of block {number} come to what is no number")
        return WalkedBlock(photons, sums, record, starts, lights, ends)

    @cached_property
    def _arrays(self) -> tuple[npt.NDArray[np.float64], ...]:
        """Return the media, the base of each light, and what lights are at first."""
        indices = self.indices
        behind = layout.OPAQUE if indices.opaque else float(indices.n.flat[0])
        media = np.array([indices.outside, *indices.inner, behind])
        base = np.stack([indices.n.ravel(), indices.k.ravel()], axis=-1)
        source = [[*carry(FLOAT, state), state[0]] for state in self.states]
        each = np.repeat(base, len(source), axis=0)
        return media, each, np.tile(np.array(source), (len(base), 1))


UNPOLARISED = (1.0, 0.0, 0.0, 0.0)
_STOKES = StokesDomain("Stokes vector", tail=(4,))
_LEAST_COSINE = 1e-12
"""That of an angle that is 90 deg but for roundings."""


MOST_PHOTONS, MOST_THREADS = 1_000_000_000_000, 1024
"""How many photons a run may ask for, and how many threads."""


def beam_of(
    sample: Sample,
    incidence: Any,
    azimuth: Any = 0.0,
    *,
    wavelength: str | npt.ArrayLike | None = None,
    stokes: npt.ArrayLike = UNPOLARISED,
    seed: int = 0,
    most_events: int = 1000,
    others: Sequence[str] = (),
) -> PhotonBeam:
    """Return the photons that a user asks for."""
    if not isinstance(sample, Sample):
        fault = f"sample is {shown(sample)}; give an op.Sample, such as op.Sample([(1.5, 0.1)])"
        raise SurfaceError(*others, fault)
    faults = Faults(others)
    angle = faults.attempt("", _one, "incidence", incidence, INCIDENCE)
    azimuth = faults.attempt("", _one, "azimuth", azimuth, ANGLE)
    if angle is not None and cos(angle) < _LEAST_COSINE:
        faults.append("incidence is 90 deg, along the sample, where no light gets to it; give less")
    faults += whole_number("seed", seed, 0) + whole_number("most_events", most_events)
    light = faults.attempt("", state_argument, "stokes", stokes)
    indices = faults.attempt("", sample.indices, wavelength)
    if faults or angle is None or indices is None or light is None:
        raise SurfaceError(*faults)
    towards = cos(angle), sin(angle), azimuth
    return PhotonBeam(sample, *towards, indices, (light,), int(seed), int(most_events))


def state_argument(name: str, stokes: npt.ArrayLike) -> tuple[float, float, float, float]:
    """Return the Stokes vector (4,) of the light that falls on a sample."""
    faults = Faults()
    state: Any = faults.attempt("", _one, name, stokes, _STOKES.unphysical)
    if state is not None and not (state[0] > 0.0 and _STOKES.allows(np.array(state))):
        faults.append(f"{name} is {[*state]}; give S0 > 0 and S1^2 + S2^2 + S3^2 <= S0^2")
    SurfaceError.raise_for(faults)
    return state  # type: ignore[no-any-return]


def _one(name: str, value: Any, domain: Domain) -> Any:
    """Return one number of a domain, or one vector, as Python has it."""
    result = np.asarray(domain.check(name, value))
    if result.shape != domain.tail:
        raise SurfaceError(
            f"{name} has the shape {result.shape}; photons come one way at a time, so give one "
            f"{domain.name}"
        )
    return tuple(result.tolist()) if domain.tail else float(result)


class WalkedBlock(NamedTuple):
    """What has become of the photons of a block.

    Shapes: sums (OUTCOMES, MOST_COUNTED, lights, SUMS); record (events + 1, RECORD); starts (2
    layers,); lights (lights, CARRIED); ends (photons, ENDS + CARRIED lights).
    """

    photons: int
    sums: Mapping[int, npt.NDArray[np.float64]]
    record: npt.NDArray[np.float64]
    starts: npt.NDArray[np.float64]
    lights: npt.NDArray[np.float64]
    ends: npt.NDArray[np.float64]


_AHEAD = 4
"""How many blocks a thread are handed out before the first of them is waited for."""

Block = TypeVar("Block")


def walked_in_order(
    beam: PhotonBeam, todo: range, photons: int, threads: int, work: Callable[[int, int], Block]
) -> Generator[Block]:
    """Yield blocks in their order, however many threads; closing the generator stops them."""
    walk_code()
    executor = ThreadPoolExecutor(threads)
    waiting: deque[Future[Block]] = deque()
    try:
        for number in todo:
            size = min(BLOCK, photons - BLOCK * number)
            # Here and not by a thread, whose warnings nobody would know where from.
            for _, _, surface in beam.portions(number, size):
                meshes_of(beam.sample, surface)
            waiting.append(executor.submit(work, number, size))
            if len(waiting) > _AHEAD * threads:
                yield waiting.popleft().result()
        while waiting:
            yield waiting.popleft().result()
    finally:
        executor.shutdown(cancel_futures=True)
