"""Files of experiments, altered: loaded, or refused."""

import tempfile
from pathlib import Path

from tests.fuzz.attack import Attack
from tests.fuzz.presets import altered

import optipath as op
from optipath.lab.published.experiment_files import load_experiment

_OWN = """format = 1
description = "a varnish on brass"
source = "measured"
sample = "own.toml"
photons = 1_000
sensor = 64

[[measurements]]
measure = "adm"
incidence = ["50 deg", "1 rad"]
text = "a tenth"
published = [0.1, [0.08, 0.1]]
within = 0.01
brighter_than = 0.2
noise = 0.2
azimuth = 20
cells = 100

[[measurements]]
measure = "dolp"
incidence = ["50 deg"]
text = "a half"
stokes = [1.0, 0.0, 0.5, 0.0]
"""
_SAMPLE = op.Sample([(1.5, 0.1), (2.4, 0.2)]).to_toml()


def make(rng):
    """Make one file; it holds an experiment of which some is altered."""
    text = altered(rng, _OWN)
    return Attack(text, lambda: _used(text), seconds=4.0)


def _used(text):
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "own.toml").write_text(_SAMPLE, "utf-8")
        file = Path(folder) / "experiment.toml"
        file.write_bytes(text.encode("utf-8", "surrogatepass"))
        found = load_experiment(file)
    assert [one for _, several in found.by_walks() for one in several]
    assert all(one.agrees(0.1, 0.0) in {None, False, True} for one in found.measurements)
