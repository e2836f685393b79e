"""Dr.Jit: the fused formulas on float64 arrays of its LLVM backend."""

import drjit as dr
from drjit.llvm import Array4f64, Float64

import llvm_backend  # noqa: F401 - says in words where LLVM is missing
from formulas import fused
from work import Contender


def prepare(delta, rho, phi, materials):
    stokes = fused(dr, materials)

    def run():
        return dr.ravel(Array4f64(*stokes(Float64(delta), Float64(rho), Float64(phi)))).numpy()

    return lambda: run().reshape(-1, 4)


CONTENDERS = (Contender("Dr.Jit, fused", prepare, "LLVM backend, float64"),)
