"""Files of samples, altered: loaded and written again, or refused."""

import tempfile
from pathlib import Path

import numpy as np
from tests.fuzz.attack import Attack
from tests.fuzz.presets import altered

import optipath as op

_HEIGHTS = """format = 1
description = "measured heights on glass"
outside = 1.33
cells = [64, 32]
surfaces = 2
seed = 3
periodic = true

[[layers]]
index = { sellmeier = { b = [1.04, 0.23], c = [0.006, 0.02] } }
heights = "own.npy"
size = [10.0, 20.0]
periodic = true

[[layers]]
index = { n = 0.5, k = 2.1 }
alpha = [0.1, 0.2]
"""
_TEXTS = [_HEIGHTS, *(op.load_sample(name).to_toml() for name in op.sample_names())]


def make(rng):
    """Make one file; it holds a sample of which some is altered."""
    text = altered(rng, rng.choice(_TEXTS))
    return Attack(text, lambda: _used(text), seconds=4.0)


def _used(text):
    with tempfile.TemporaryDirectory() as folder:
        np.save(Path(folder) / "own.npy", np.eye(9))
        file = Path(folder) / "own.toml"
        file.write_bytes(text.encode("utf-8", "surrogatepass"))
        again = (sample := op.load_sample(file)).to_toml()
        file.write_text(again, encoding="utf-8", newline="")
        assert op.load_sample(file) == sample, "written again, it is another sample"
    found = sample.indices(None if "wavelength" not in repr(sample) else "500 nm")
    assert np.isfinite([found.outside, *found.inner, found.n, found.k]).all()
    assert min(found.outside, *found.inner, found.n + found.k) > 0.0
