"""optipath: every engine, and one path at a time."""

from functools import partial

import numpy as np

import optipath as op
from work import Contender

PRESET = "npgr026"
REFERENCE = "optipath, numba"


def plan(materials, **options):
    path = op.load_preset(PRESET, filter="horizontal", **materials._asdict())
    return op.Composer(**options).compose(path)


def prepare(delta, rho, phi, materials, *, engine, dtype="float64", given="float64"):
    run = plan(materials, engine=engine, dtype=dtype).run
    angles = {"delta": delta, "rho": rho, "phi": phi}
    angles = {name: angle.astype(given) for name, angle in angles.items()}
    return lambda: np.asarray(run(**angles).stokes)


def prepare_single(delta, rho, phi, materials):
    run = plan(materials).run
    paths = list(zip(delta.tolist(), rho.tolist(), phi.tolist(), strict=True))
    return lambda: np.array([run(delta=d, rho=r, phi=p).stokes for d, r, p in paths])


single = partial(prepare, engine="numba", dtype="float32")
CONTENDERS = (
    Contender(REFERENCE, partial(prepare, engine="numba"), "as shipped"),
    Contender("optipath, numba, float32", single, "float64 angles"),
    Contender(
        "optipath, numba, float32 throughout", partial(single, given="float32"), "float32 angles"
    ),
    Contender("optipath, numpy", partial(prepare, engine="numpy"), "as shipped"),
    Contender("optipath, jax", partial(prepare, engine="jax"), "as shipped"),
    Contender("optipath, one path a call", prepare_single, "plain floats", most=1_000),
)
