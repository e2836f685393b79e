"""Start-up: importing, loading, composing, the first light."""

import subprocess
import sys

import pytest

import optipath as op

PRESETS = ["malus", "npgr026", "absorbing-pile"]


@pytest.mark.benchmark(group="import")
@pytest.mark.parametrize("names", ["numpy, networkx", "optipath"])
def test_import(benchmark, names):
    command = [sys.executable, "-c", f"import {names}"]
    benchmark.pedantic(subprocess.run, (command,), {"check": True}, rounds=5)


@pytest.mark.benchmark(group="load a preset")
@pytest.mark.parametrize("name", PRESETS)
def test_load(benchmark, name):
    benchmark(op.load_preset, name)


@pytest.mark.benchmark(group="compose a preset")
@pytest.mark.parametrize("name", PRESETS)
def test_compose(benchmark, name):
    benchmark(op.Composer().compose, op.load_preset(name))


@pytest.mark.benchmark(group="the first light of a path that was just loaded")
def test_first_light(benchmark):
    benchmark(lambda: op.load_preset("npgr026", case="8").trace().stokes)
