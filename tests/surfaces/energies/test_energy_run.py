import pytest

import optipath as op
from optipath import surfaces
from optipath.surfaces.energies.energy_run import EnergyRun
from optipath.surfaces.walk.given_beam import given_beam

pytest.importorskip("numba")

GLASS = op.Sample([(1.5, 0.5)])


def test_what_is_done_stays_when_it_is_interrupted():
    run = EnergyRun(given_beam(GLASS, "40 deg"), threads=2)

    def interrupt(done, _):
        if done >= 3 * 16384:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run.walk(400_000, interrupt)
    assert run.photons == 3 * 16384
    assert run.energy.R == surfaces.energy(GLASS, "40 deg", photons=3 * 16384).R


def test_a_run_goes_on_where_it_was():
    run = EnergyRun(given_beam(GLASS, "40 deg"), threads=1)
    run.walk(2 * 16384)
    run.walk(50_000)
    whole = surfaces.energy(GLASS, "40 deg", photons=50_000)
    assert (run.photons, run.energy.R, run.energy.T_m_se) == (50_000, whole.R, whole.T_m_se)
