import numpy as np
import pytest

import optipath as op
from optipath import surfaces
from optipath.surfaces.energies.energy_run import EnergyRun

pytest.importorskip("numba")


def test_light_that_is_all_there_is_not_warned_of():
    surfaces.energy(op.Sample([(1.5, 0.7), (2.4, 0.7)]), "70 deg", photons=50_000)


def test_trapped_light_that_few_photons_carry_is_warned_of(monkeypatch):
    sums = EnergyRun._add

    def lose(self, walked):
        # As if heavy photons had not been met.
        for each in walked.sums.values():
            each[0, 2:, :, 1] *= 0.5
        sums(self, walked)

    monkeypatch.setattr(EnergyRun, "_add", lose)
    with pytest.warns(op.PhotonWarning, match="where nothing absorbs, off by"):
        found = surfaces.energy(op.Sample([(1.5, 0), (2.4, 0)]), "60 deg", photons=50_000)
    assert np.isclose(float(found.scalar.R + found.scalar.T), 1.0)
