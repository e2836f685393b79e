"""Sweeps in chunks, held against sweeps in memory, bit by bit."""

import pickle
import sys

import numpy as np
import pytest

pytest.importorskip("dask")

import dask
import xarray as xr

import optipath as op
from optipath.sweeps.chunked import chunked_light, in_chunks
from optipath.sweeps.chunked.block_light import run_block
from tables import rows

GOLD = {"n1": 0.18, "k1": 3.4, "n2": 0.18, "k2": 3.4}
AXES = {
    "delta": np.linspace(0.01, 1.5, 7),
    "rho": np.linspace(0.0, 3.0, 5),
    "phi": np.linspace(0.0, 1.5, 6),
}


def swept(**given):
    return op.load_preset("npgr026").sweep(**{**AXES, **GOLD, "filter": "horizontal", **given})


def bits_of(variable):
    """Words as they are, of which an array has but addresses."""
    values = variable.to_numpy()
    return values.tolist() if values.dtype.kind == "O" else values.tobytes()


def assert_same_bits(found, expected):
    assert list(found.variables) == list(expected.variables)
    assert found.attrs == expected.attrs
    for name, each in expected.variables.items():
        assert found[name].dims == each.dims
        assert found[name].attrs == each.attrs
        assert found[name].dtype == each.dtype
        assert bits_of(found[name]) == bits_of(each)


@rows("chunks", ["auto", 1, 4, {"rho": 2}, {"delta": 3, "phi": -1}])
def test_a_sweep_in_chunks_is_that_in_memory_however_it_is_cut(chunks):
    assert_same_bits(swept(chunks=chunks).compute(scheduler="synchronous"), swept())


def test_threads_have_the_same_bits():
    assert_same_bits(swept(chunks=4).compute(scheduler="threads", num_workers=4), swept())


def test_nothing_is_computed_before_somebody_asks(monkeypatch):
    monkeypatch.setattr(chunked_light, "run_block", None)
    assert swept(chunks=4).S0.chunks == ((4, 3), (4, 1), (4, 2))


def test_a_block_is_run_once_for_all_that_is_asked_of_it(monkeypatch):
    blocks = []

    def counted(recipe, block):
        blocks.append(block.shape)
        return run_block(recipe, block)

    monkeypatch.setattr(chunked_light, "run_block", counted)
    swept(chunks={"delta": 4}).compute(scheduler="synchronous")
    assert sorted(blocks) == [(3, 5, 6), (4, 5, 6)]


def test_a_part_of_a_sweep_runs_the_blocks_that_it_touches(monkeypatch):
    blocks = []

    def counted(recipe, block):
        blocks.append(block.shape)
        return run_block(recipe, block)

    monkeypatch.setattr(chunked_light, "run_block", counted)
    found = swept(chunks={"delta": 1}).DoP.isel(delta=3).compute(scheduler="synchronous")
    assert blocks == [(1, 5, 6)]
    assert np.array_equal(found, swept().DoP.isel(delta=3))


def test_the_same_sweep_has_the_same_names_and_another_has_others():
    one, same, other = swept(chunks=4), swept(chunks=4), swept(chunks=4, n1=0.2)
    assert one.S0.data.name == same.S0.data.name != other.S0.data.name


def test_several_detectors_are_in_one_block():
    path = op.PathGraph()
    half = path.add("half", op.BeamSplitter(0.3))
    path.add("lamp", op.Source(2.0)) >> half
    path.add("sheet", op.Polarizer(op.Parameter("angle"))) >> path.add("on", op.Detector())
    path.add("up", op.Detector())
    path.connect("half.reflected", "up.in")
    path.connect("half.transmitted", "sheet.in")
    angles = np.linspace(0.0, 1.0, 9)
    found = path.sweep(angle=angles, chunks=2)
    assert found.S0.chunks == ((2,), (2, 2, 2, 2, 1))
    assert_same_bits(found.compute(scheduler="synchronous"), path.sweep(angle=angles))


def test_axes_that_vary_together_are_cut_together():
    given = {"delta": AXES["delta"], "phi": AXES["delta"] / 2, "zip": ("delta", "phi")}
    found = swept(**given, chunks=3)
    assert_same_bits(found.compute(scheduler="synchronous"), swept(**given))


def test_axes_of_words_are_cut():
    words = ["none", "horizontal", "vertical"]
    found = swept(filter=words, chunks=2)
    xr.testing.assert_identical(
        found.compute(scheduler="synchronous"), swept(filter=words).compute()
    )


def test_single_precision_stays_single():
    composer = op.Composer(dtype="float32")
    found = swept(chunks=4, composer=composer)
    assert {each.dtype for each in found.data_vars.values()} == {np.dtype("float32")}
    assert_same_bits(found.compute(scheduler="synchronous"), swept(composer=composer))


def test_a_chunk_does_not_keep_the_light_that_it_is_of():
    with dask.config.set(scheduler="synchronous"):
        found = swept(chunks=-1).S0.persist().data.compute()
    whole = found
    while whole.base is not None:
        whole = whole.base
    assert whole.nbytes == found.nbytes


def test_the_memory_of_light_is_that_of_its_numbers():
    recipe, grid = _recipe_and_grid()
    block = run_block(recipe, grid)
    assert sys.getsizeof(block) >= 4 * 8 * grid.points
    there = pickle.loads(pickle.dumps(block))
    assert sys.getsizeof(there) == sys.getsizeof(block)


def test_a_path_without_a_form_in_toml_is_refused_with_its_reason():
    class Bare(op.Element):
        angle: op.Angle = 0.0

        @staticmethod
        def mueller_rows(xp, angle):
            return [[1.0 * (i == j) for j in range(4)] for i in range(4)]

    path = op.Source() >> Bare(op.Parameter("angle")) >> op.Detector()
    with pytest.raises(op.PathError, match="kind"):
        path.sweep(angle=[0.0, 1.0], chunks=1)


def _recipe_and_grid():
    path = op.load_preset("malus")
    plan = path.compose()
    found = in_chunks.swept_in_chunks(path, plan, _grid(plan), "auto")
    return found.recipe, found.grid


def _grid(plan):
    from optipath.sweeps.axes.read_axes import grid_of  # noqa: PLC0415 - for this alone

    return grid_of(plan.inputs, {"angle": np.linspace(0.0, 1.0, 1000)})
