"""A sweep as a job of blocks: which part each is, and what tells sweeps from each other."""

import pickle

import numpy as np
import pytest

pytest.importorskip("dask")

import optipath as op
from optipath.sweeps.axes.read_axes import grid_of
from optipath.sweeps.chunked.in_chunks import swept_in_chunks
from optipath.sweeps.kept.sweep_job import SweepJob
from tables import rows


def job_of(chunks=4, **given):
    path = op.load_preset("npgr026")
    plan = path.compose()
    axes = {"delta": np.linspace(0.0, 1.0, 10), "phi": np.linspace(0.0, 1.0, 6)}
    grid = grid_of(plan.inputs, {**axes, **given})
    return SweepJob.of(swept_in_chunks(path, plan, grid, chunks))


def test_blocks_are_disjoint_and_cover_the_grid():
    job, seen = job_of(), np.zeros((10, 6), int)
    for number in range(job.blocks):
        seen[job.region(number)] += 1
    assert job.blocks == 6
    assert np.all(seen == 1)


def test_a_block_has_every_variable_in_its_part():
    job = job_of()
    found = job.compute(5)
    assert found.keys() == job.arrays.keys()
    for region, values in found.values():
        assert region == (slice(8, 10), slice(4, 6))
        assert values.shape == (2, 2)


def test_a_job_that_was_pickled_is_the_same():
    job = job_of()
    there = pickle.loads(pickle.dumps(job))
    assert there.identity == job.identity
    assert there.compute(2)["S1"][1].tobytes() == job.compute(2)["S1"][1].tobytes()


def test_the_same_values_have_one_identity():
    assert job_of(n1=0.2).identity == job_of(n1=np.float64(0.2)).identity


@rows(
    "other",
    [
        {"n1": 0.2 + 1e-15},
        {"phi": np.nextafter(np.linspace(0.0, 1.0, 6), 2.0)},
        {"phi": np.degrees(np.linspace(0.0, 1.0, 6)).tolist()},
        {"chunks": 5},
        {"filter": "vertical"},
    ],
)
@pytest.mark.filterwarnings("ignore::optipath.AngleWarning")
def test_whatever_changes_the_bits_is_another_identity(other):
    if isinstance(other.get("phi"), list):
        other = {"phi": [f"{value} deg" for value in other["phi"]]}
    assert job_of(**{"n1": 0.2, **other}).identity != job_of(n1=0.2).identity


def test_one_value_in_two_units_is_two_sweeps():
    assert job_of(rho="10 deg").identity != job_of(rho=np.radians(10.0)).identity
    assert job_of(rho=0.5).identity == job_of(rho=np.array(0.5)).identity


def test_the_first_line_that_differs_says_what_is_another():
    lines = zip(*(job_of(n1=n).identity.splitlines() for n in (0.2, 0.3)), strict=True)
    assert [pair for pair in lines if pair[0] != pair[1]] == [("fixed n1: 0.2", "fixed n1: 0.3")]


def test_a_block_is_sent_without_the_axes_of_the_others():
    angle = np.linspace(0.0, 1.0, 20_000)
    path = op.load_preset("malus")
    plan = path.compose()
    grid = grid_of(plan.inputs, {"angle": angle})
    job = SweepJob.of(swept_in_chunks(path, plan, grid, 100))
    whole, part = (len(pickle.dumps(each)) for each in (job, job.part(7)))
    assert whole > angle.nbytes
    assert part < angle.nbytes / 10
    (region,), numbers = job.part(7).compute(7)["S0"]
    assert region == slice(700, 800)
    assert numbers.tolist() == path.sweep(angle=angle[region]).S0.values.tolist()
