"""Plans that travel as texts: the same bits there, and what is said of what cannot travel."""

import importlib
import pickle
import subprocess
import sys

import numpy as np
import pytest

import optipath as op
from optipath.sweeps.chunked.own_class import OwnClass
from optipath.sweeps.chunked.plan_recipe import PlanRecipe
from random_paths import Draw
from tables import rows


@rows("seed", range(30))
def test_a_path_through_toml_gives_the_same_bits_and_the_same_noise(seed):
    draw = Draw(seed)
    path = draw.path(loops=seed % 3 == 0)
    here, there = path.compose(), pickle.loads(pickle.dumps(PlanRecipe.of(path))).plan
    lights, others = here.run_all(**draw.values), there.run_all(**draw.values)
    assert lights.keys() == others.keys()
    for name, light in lights.items():
        assert light.stokes.tobytes() == others[name].stokes.tobytes()
        assert light.noise.tobytes() == others[name].noise.tobytes()


def test_options_of_the_composer_travel():
    composer = op.Composer(dtype="float32", engine="numpy", method="textbook")
    recipe = PlanRecipe.of(op.load_preset("malus"), composer)
    plan = pickle.loads(pickle.dumps(recipe)).plan
    assert (plan.dtype, plan.chosen, plan.method) == ("float32", "numpy", "textbook")


def test_a_plan_is_made_once_a_process():
    one, same = (PlanRecipe.of(op.load_preset("malus")) for _ in range(2))
    assert one.plan is same.plan


def test_a_module_that_is_not_there_is_told():
    recipe = PlanRecipe.of(op.load_preset("malus"))
    lost = PlanRecipe(recipe.text, own=(OwnClass("elements_of_nobody", "Half"),))
    with pytest.raises(op.PathError, match="'elements_of_nobody', which cannot be imported here"):
        _ = lost.plan


SCRIPT = """
import pickle, sys
import optipath as op
from optipath.sweeps.chunked.plan_recipe import PlanRecipe

class Half(op.Element, kind="half-of-a-script"):
    angle: op.Angle = 0.0

    @staticmethod
    def mueller_rows(xp, angle):
        return [[0.5 * (i == j) for j in range(4)] for i in range(4)]

path = op.Source() >> Half(op.Parameter("angle")) >> op.Detector()
recipe = PlanRecipe.of(path)
assert recipe.plan.run(angle=0.0).intensity == 0.5
sys.stdout.buffer.write(pickle.dumps(recipe))
"""


def test_a_class_of_a_script_is_there_in_its_process_and_told_of_in_others():
    done = subprocess.run([sys.executable, "-c", SCRIPT], capture_output=True, check=True)
    recipe = pickle.loads(done.stdout)
    with pytest.raises(op.PathError, match="defined in the script itself are not there in another"):
        _ = recipe.plan


def test_a_module_with_elements_is_imported(tmp_path, monkeypatch):
    (tmp_path / "halving.py").write_text(
        SCRIPT.split("path =", maxsplit=1)[0].replace("script", "module")
    )
    monkeypatch.syspath_prepend(tmp_path)
    text = """
format = 1

[elements.lamp]
kind = "source"

[elements.half]
kind = "half-of-a-module"

[elements.eye]
kind = "detector"

[[links]]
from = "lamp.out"
to = "half.in"

[[links]]
from = "half.out"
to = "eye.in"
"""
    other = PlanRecipe(text, own=(OwnClass("halving", "Half", "0123"),))
    with pytest.raises(op.PathError, match="'Half' of module 'halving' is another one on the work"):
        _ = other.plan
    own = OwnClass.of(importlib.import_module("halving").Half)
    assert np.isclose(PlanRecipe(text, own=(own,)).plan.run().intensity, 0.5)


def rotator(times):
    """A path with a class that is defined anew, as by a cell of a notebook that is run again."""

    class Turn(op.Element, kind="turn-of-a-test"):
        angle: op.Angle = 0.0

        @staticmethod
        def mueller_rows(xp, angle):
            c, s = xp.cos(times * angle), xp.sin(times * angle)
            return (1, 0, 0, 0), (0, c, s, 0), (0, -s, c, 0), (0, 0, 0, 1)

    return op.Source(stokes=[1, 1, 0, 0]) >> Turn(op.Parameter("angle")) >> op.Detector()


def test_a_class_that_is_defined_anew_is_another_sweep(tmp_path):
    angles = [0.1, 0.2]
    paths = [rotator(4), rotator(2)]
    for times, path, name in zip((4, 2), paths, "ab", strict=True):
        expected = np.cos(times * np.array(angles))
        for chosen in ({}, {"chunks": 1}, {"store": tmp_path / f"{name}.zarr"}):
            assert np.allclose(path.sweep(angle=angles, **chosen).S1, expected, rtol=0, atol=1e-15)
    with pytest.raises(op.errors.JobError, match=r"another job: it has 'element class .*Turn"):
        paths[1].sweep(angle=angles, store=tmp_path / "a.zarr")
    paths[0].sweep(angle=angles, store=tmp_path / "a.zarr")


def test_where_a_plan_is_not_made_yet_it_is_made_of_the_same_classes_or_not_at_all():
    old, _ = PlanRecipe.of(rotator(4)), rotator(2)
    assert np.isclose(old.plan.run(angle=0.1).stokes[1], np.cos(0.4))
    with pytest.raises(op.PathError, match="is another one on the worker"):
        _ = pickle.loads(pickle.dumps(old)).plan
    again = pickle.loads(pickle.dumps(PlanRecipe.of(rotator(2)))).plan
    assert np.isclose(again.run(angle=0.1).stokes[1], np.cos(0.2))
