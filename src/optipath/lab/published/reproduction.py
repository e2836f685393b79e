"""An experiment done again: what is published, and what photons tell."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from optipath.lab.published.measured_quantities import MEASURES, Found
from optipath.lab.published.walked import Walked

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from optipath.lab.published.experiment import Experiment, Measurement


class Reproduced(NamedTuple):
    """A published number, and the one that has been measured."""

    measurement: Measurement
    found: Found
    photons: int

    @property
    def agrees(self) -> bool | None:
        """Whether it is the published one; None where no number is published."""
        return self.measurement.agrees(self.found.value, self.found.error)


def reproduce(
    experiment: Experiment,
    photons: int | None = None,
    *,
    seed: int = 0,
    threads: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Iterator[Reproduced]:
    """Do an experiment again, and yield what is found, one after the other.

    Examples
    --------
    >>> from optipath.lab.published.experiment_files import load_experiment
    >>> mirror = load_experiment("wang-2017-table-2-alpha-0-4")
    >>> for one in reproduce(mirror, photons=10_000):
    ...     print(one.measurement.walks.incidence, round(one.found.value, 12), one.agrees)
    10 deg 1.0 True
    45 deg 1.0 True
    80 deg 1.0 True
    """
    count = experiment.photons if photons is None else photons
    for walks, measurements in experiment.by_walks():
        walked = Walked(experiment, walks, count, seed, threads, progress)
        for measurement in measurements:
            found = MEASURES[measurement.measure].of(walked, measurement)
            yield Reproduced(measurement, found, count)
