"""Walked: what photons tell that fall on a sample from one direction, found when it is asked."""

from __future__ import annotations

import warnings
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

from optipath.errors import MeshWarning
from optipath.surfaces.energies.energy import energy
from optipath.surfaces.hemispheres.measure import measure

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from optipath.lab.published.experiment import Experiment, Walks
    from optipath.surfaces.energies.energy_table import Energy
    from optipath.surfaces.hemispheres.hemisphere import Hemisphere
    from optipath.surfaces.samples.sample import Sample


@dataclass(frozen=True)
class Walked:
    """Photons of an experiment; each kind of them is walked once, when it is asked for."""

    experiment: Experiment
    walks: Walks
    photons: int
    seed: int = 0
    threads: int | None = None
    progress: Callable[[int, int], None] | None = None

    def energy(self, stokes: tuple[float, ...]) -> Energy:
        """Return what share of light of a Stokes vector comes back and goes through."""
        known: dict[tuple[float, ...], Energy] = vars(self).setdefault("_energies", {})
        if stokes not in known:
            with self._meant_mesh():
                known[stokes] = energy(
                    self.sample,
                    self.walks.incidence,
                    self.photons,
                    wavelength=self.walks.wavelengths[0] if self.walks.wavelengths else None,
                    stokes=stokes,
                    **self._walking,
                )
        return known[stokes]

    @cached_property
    def hemisphere(self) -> Hemisphere:
        """What goes into each pixel."""
        return self._hemisphere(None)

    @cached_property
    def once(self) -> Hemisphere:
        """What goes into each pixel after one event."""
        return self._hemisphere(1)

    @cached_property
    def sample(self) -> Sample:
        """What light falls on, with the mesh that is asked for."""
        cells, sample = self.walks.cells, self.experiment.sample
        return sample if cells is None else replace(sample, cells=(cells, cells))

    def _hemisphere(self, events: int | None) -> Hemisphere:
        with self._meant_mesh():
            return measure(
                self.sample,
                self.walks.incidence,
                self.photons,
                [*self.walks.wavelengths] or None,
                self.experiment.sensor,
                events=events,
                **self._walking,
            )

    @property
    def _walking(self) -> dict[str, Any]:
        return {"seed": self.seed, "threads": self.threads, "progress": self.progress}

    @contextmanager
    def _meant_mesh(self) -> Iterator[None]:
        """Warn of no coarse mesh where it is what is looked at."""
        with warnings.catch_warnings():
            if self.walks.cells is not None:
                warnings.simplefilter("ignore", MeshWarning)
            yield
