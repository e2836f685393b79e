"""Sweeps in chunks, and plans that travel as texts."""

import importlib
import pickle
import subprocess
import sys

import dask
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import optipath as op
from optipath.sweeps import chunks as chunked_light
from optipath.sweeps.axes import grid_of
from optipath.sweeps.chunks import BLOCK, chunk_sizes, run_block
from optipath.sweeps.plan_recipe import OwnClass, PlanRecipe
from random_paths import Draw
from tables import slow

pytest.importorskip("dask")
MALUS = op.load_preset("malus")
SIZES = {"delta": 3000, "rho": 1000, "phi": 500}


def test_blocks_have_the_sizes_given_or_a_million_points_and_what_is_no_size_is_refused():
    for chunks, sizes in (
        ("auto", {"delta": 2, "rho": 1000, "phi": 500}),
        (700, {"delta": 700, "rho": 700, "phi": 500}),
        ({"delta": 3000}, {"delta": 3000, "rho": 1, "phi": 250}),
        ({"rho": -1, "phi": 10}, chunk_sizes({"phi": 10}, SIZES) | {"rho": 1000}),
        (-1, SIZES),
        ({"rho": "auto", "phi": 10}, chunk_sizes({"phi": 10}, SIZES)),
    ):
        assert chunk_sizes(chunks, SIZES) == sizes
    assert chunk_sizes("auto", {"delta": BLOCK + 2}) == {"delta": BLOCK // 2 + 1}
    assert chunk_sizes("auto", {"delta": 10, "rho": BLOCK}, 4)["rho"] == BLOCK // 4
    for chunks in (0, -2, 1.5, True, "big", None, [10]):
        with pytest.raises(
            op.errors.ParameterError, match=r"give 'auto', a number .* or {'delta': 10}"
        ):
            chunk_sizes(chunks, SIZES)
    with pytest.raises(op.errors.ParameterError, match=r"did you mean 'delta'\?") as caught:
        chunk_sizes({"dleta": 10, "rho": "x", "phi": 0, 3: 1}, SIZES)
    assert len(caught.value.faults) == 4
    with pytest.raises(op.errors.ParameterError, match="there is no axis"):
        chunk_sizes("auto", {})


SINGLE = op.Composer(dtype="float32")
GOLD = {"n1": 0.18, "k1": 3.4, "n2": 0.18, "k2": 3.4}
AXES = {
    "delta": np.linspace(0.01, 1.5, 7),
    "rho": np.linspace(0.0, 3.0, 5),
    "phi": np.linspace(0.0, 1.5, 6),
}


def swept(**given):
    return op.load_preset("npgr026").sweep(**{**AXES, **GOLD, "filter": "horizontal", **given})


def computed(**given):
    return swept(**given).compute(scheduler="synchronous")


def bits_of(variable):
    """Words as they are, of which an array has but addresses."""
    values = variable.to_numpy()
    return values.tolist() if values.dtype.kind == "O" else values.tobytes()


def assert_same_bits(found, expected):
    assert list(found.variables) == list(expected.variables)
    assert found.attrs == expected.attrs
    for name, each in expected.variables.items():
        one, other = ((v.dims, v.attrs, v.dtype, bits_of(v)) for v in (found[name], each))
        assert one == other


TOGETHER = {"delta": AXES["delta"], "phi": AXES["delta"] / 2, "zip": ("delta", "phi")}


@pytest.mark.parametrize(
    ("axes", "several"),
    [
        ({}, ["auto", {"delta": 3, "phi": -1}]),
        (TOGETHER, [3]),
        slow(({}, [1, 4, {"rho": 2}])),
        slow(({"composer": SINGLE}, [4])),
        ({"filter": ["none", "horizontal", "vertical"]}, [{"delta": 4}]),
        slow(({"filter": ["none", "horizontal", "vertical"]}, [2])),
    ],
)
def test_a_sweep_in_chunks_is_that_in_memory(axes, several):
    whole = swept(**axes)
    for chunks in several:
        assert_same_bits(computed(**axes, chunks=chunks), whole)


def test_chunks_may_be_computed_by_threads_and_detectors_are_in_one_block():
    assert_same_bits(swept(chunks=4).compute(scheduler="threads", num_workers=4), swept())
    path = op.PathGraph()
    sheet = path.add("sheet", op.Polarizer(op.Parameter("angle")))
    path.add("lamp", op.Source(2.0)) >> path.add("half", op.BeamSplitter(0.3))
    path["half.reflected"] >> path.add("up", op.Detector())
    path["half.transmitted"] >> sheet >> path.add("on", op.Detector())
    angles = np.linspace(0.0, 1.0, 9)
    found = path.sweep(angle=angles, chunks=2)
    assert found.S0.chunks == ((2,), (2, 2, 2, 2, 1))
    assert_same_bits(found.compute(scheduler="synchronous"), path.sweep(angle=angles))


def test_nothing_is_computed_before_somebody_asks_and_each_block_then_once_for_all(monkeypatch):
    def counted(recipe, block):
        blocks.append(block.shape)
        return run_block(recipe, block)

    blocks = []
    monkeypatch.setattr(chunked_light, "run_block", counted)
    assert swept(chunks=4).S0.chunks == ((4, 3), (4, 1), (4, 2))
    single = swept(chunks=4, composer=SINGLE).data_vars.values()
    assert {each.dtype for each in single} == {np.dtype("float32")}
    one, same, other = (swept(chunks=4, n1=n).S0.data.name for n in (0.18, 0.18, 0.2))
    assert one == same != other
    assert blocks == []
    computed(chunks={"delta": 4})
    assert sorted(blocks) == [(3, 5, 6), (4, 5, 6)]
    blocks.clear()
    found = swept(chunks={"delta": 1}).DoP.isel(delta=3).compute(scheduler="synchronous")
    assert blocks == [(1, 5, 6)]
    assert np.array_equal(found, swept().DoP.isel(delta=3))


def test_the_memory_of_light_is_that_of_its_numbers_and_a_chunk_does_not_keep_it():
    with dask.config.set(scheduler="synchronous"):
        found = swept(chunks=-1).S0.persist().data.compute()
    whole = found
    while whole.base is not None:
        whole = whole.base
    assert whole.nbytes == found.nbytes
    grid = grid_of(MALUS.compose().inputs, {"angle": np.linspace(0.0, 1.0, 1000)})
    block = run_block(PlanRecipe.of(MALUS), grid)
    assert sys.getsizeof(block) >= 4 * 8 * grid.points
    assert sys.getsizeof(pickle.loads(pickle.dumps(block))) == sys.getsizeof(block)


def test_options_of_the_composer_travel_and_paths_without_a_form_in_toml_do_not():
    class Bare(op.Element):
        angle: op.fields.Angle = 0.0

        @staticmethod
        def mueller_rows(xp, angle):
            return np.eye(4).tolist()

    path = op.Source() >> Bare(op.Parameter("angle")) >> op.Detector()
    with pytest.raises(op.errors.PathError, match="kind"):
        path.sweep(angle=[0.0, 1.0], chunks=1)
    plan = sent(MALUS, op.Composer(dtype="float32", engine="numpy", method="textbook")).plan
    assert (plan.dtype, plan.chosen, plan.method) == ("float32", "numpy", "textbook")
    assert PlanRecipe.of(MALUS).plan is PlanRecipe.of(op.load_preset("malus")).plan


def sent(path, *composer):
    """The recipe of a plan, as another process has it."""
    return pickle.loads(pickle.dumps(PlanRecipe.of(path, *composer)))


@settings(max_examples=15, deadline=None)
@given(seed=st.integers(0, 29))
def test_a_path_through_toml_gives_the_same_bits_and_the_same_noise(seed):
    draw = Draw(seed)
    path = draw.path(loops=seed % 3 == 0)
    here, there = (plan.run_all(**draw.values) for plan in (path.compose(), sent(path).plan))
    assert here.keys() == there.keys()
    for name, light in here.items():
        assert light.stokes.tobytes() == there[name].stokes.tobytes()
        assert light.noise.tobytes() == there[name].noise.tobytes()


SCRIPT = """
import pickle, sys
import optipath as op
from optipath.sweeps.plan_recipe import PlanRecipe

class Half(op.Element, kind="half-of-a-script"):
    angle: op.fields.Angle = 0.0

    @staticmethod
    def mueller_rows(xp, angle):
        return [[0.5 * (i == j) for j in range(4)] for i in range(4)]

path = op.Source() >> Half(op.Parameter("angle")) >> op.Detector()
recipe = PlanRecipe.of(path)
assert recipe.plan.run(angle=0.0).intensity == 0.5
sys.stdout.buffer.write(pickle.dumps(recipe))
"""


HALVED = """format = 1
links = [{ from = "lamp.out", to = "half.in" }, { from = "half.out", to = "eye.in" }]
[elements]
lamp = { kind = "source" }
half = { kind = "half-of-a-module" }
eye = { kind = "detector" }
"""


def test_modules_with_elements_are_imported_or_told_where_there_are_none(tmp_path, monkeypatch):
    module = SCRIPT.split("path =", maxsplit=1)[0].replace("script", "module")
    (tmp_path / "halving.py").write_text(module)
    monkeypatch.syspath_prepend(tmp_path)
    other = PlanRecipe(HALVED, own=(OwnClass("halving", "Half", "0123"),))
    lost = PlanRecipe(HALVED, own=(OwnClass("elements_of_nobody", "Half"),))
    done = subprocess.run([sys.executable, "-c", SCRIPT], capture_output=True, check=True)
    for recipe, told in (
        (other, "'Half' of module 'halving' is another one on the work"),
        (lost, "'elements_of_nobody', are not there in another process: No module"),
        (pickle.loads(done.stdout), "of '__main__', are not there in another process: .*half"),
    ):
        with pytest.raises(op.errors.PathError, match=told):
            _ = recipe.plan
    own = OwnClass.of(importlib.import_module("halving").Half)
    assert np.isclose(PlanRecipe(HALVED, own=(own,)).plan.run().intensity, 0.5)


def rotator(times):
    """A path with a class that is defined anew, as by a cell of a notebook that is run again."""

    class Turn(op.Element, kind="turn-of-a-test"):
        angle: op.fields.Angle = 0.0

        @staticmethod
        def mueller_rows(xp, angle):
            c, s = xp.cos(times * angle), xp.sin(times * angle)
            return (1, 0, 0, 0), (0, c, s, 0), (0, -s, c, 0), (0, 0, 0, 1)

    return op.Source(stokes=[1, 1, 0, 0]) >> Turn(op.Parameter("angle")) >> op.Detector()


def test_a_class_that_is_defined_anew_is_another_sweep(tmp_path):
    angles, paths = np.array([0.1, 0.2]), {4: rotator(4), 2: rotator(2)}
    for times, path in paths.items():
        for chosen in ({}, {"chunks": 1}):
            found = path.sweep(angle=angles, **chosen).S1
            assert np.allclose(found, np.cos(times * angles), rtol=0, atol=1e-15)
        with pytest.raises(
            op.errors.PathError, match=r"'.*Turn' is defined in no file .* of a module"
        ):
            path.sweep(angle=angles, store=tmp_path / "a.zarr")
    with pytest.raises(op.errors.PathError, match="is another one on the worker"):
        _ = sent(paths[2]).plan


def test_a_module_that_was_edited_is_another_sweep(tmp_path, monkeypatch):
    module = SCRIPT.split("path =", maxsplit=1)[0].replace("script", "kept-module")
    (tmp_path / "halving_kept.py").write_text(module)
    monkeypatch.syspath_prepend(tmp_path)
    half = importlib.import_module("halving_kept").Half
    path = op.Source() >> half(op.Parameter("angle")) >> op.Detector()
    for _ in range(2):
        path.sweep(angle=[0.1, 0.2], store=tmp_path / "half.zarr")
    (tmp_path / "halving_kept.py").write_text(module + "FACTOR = 0.7")
    with pytest.raises(op.errors.JobError, match=r"another job: it has 'element class .*Half"):
        path.sweep(angle=[0.1, 0.2], store=tmp_path / "half.zarr")


def test_numbers_that_a_module_has_from_elsewhere_are_of_the_sweep(tmp_path, monkeypatch):
    module = SCRIPT.split("path =", maxsplit=1)[0].replace("script", "fed-module")
    fed = "TABLE = {'half': [0.5]}\n\n\ndef factor():\n    return TABLE['half'][0]\n"
    (tmp_path / "halving_fed.py").write_text(fed + module.replace("0.5", "factor()"))
    monkeypatch.syspath_prepend(tmp_path)
    loaded = importlib.import_module("halving_fed")
    path = op.Source() >> loaded.Half(op.Parameter("angle")) >> op.Detector()
    path.sweep(angle=[0.1, 0.2], store=tmp_path / "half.zarr")
    for name, value in (("TABLE", {"half": [0.7]}), ("TABLE", np.array([0.7]))):
        with monkeypatch.context() as patch:
            patch.setattr(loaded, name, value)
            with pytest.raises(op.errors.JobError, match="another job: it has 'element class"):
                path.sweep(angle=[0.1, 0.2], store=tmp_path / "half.zarr")
    path.sweep(angle=[0.1, 0.2], store=tmp_path / "half.zarr")
