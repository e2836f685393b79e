"""The n and k of a metal from Stokes vectors that were measured behind it.

    pip install "optipath[jax]" && python examples/index_from_stokes.py

Light polarised at 45 degrees is reflected at several angles of incidence; SciPy's least
squares finds the index that gives the Stokes vectors measured, with slopes by JAX.
"""

import jax
import jax.numpy as jnp
import numpy as np
from scipy.optimize import least_squares

import optipath as op

jax.config.update("jax_enable_x64", True)  # noqa: FBT003 - as JAX has it

INCIDENCE = np.radians([45.0, 55.0, 65.0, 75.0])


def ellipsometer():
    """Return the path: a polarised lamp, the surface, a detector."""
    path = op.PathGraph("a lamp polarised at 45 degrees, a metal, and a detector")
    lamp = path.add("lamp", op.Source(stokes=[1.0, 0.0, 1.0, 0.0]))
    metal = op.Material(op.Parameter("n"), op.Parameter("k"))
    surface = path.add("surface", op.Interface(metal, incidence=INCIDENCE))
    lamp >> surface >> path.add("eye", op.Detector())
    return path


def index_from(measured, guess=(1.0, 1.0)):
    """Return n and k, and their standard deviations, from Stokes vectors (angles, 4)."""
    path = ellipsometer()

    def misfit(index):
        return (path.trace(n=index[0], k=index[1]).stokes - measured).ravel()

    slopes = jax.jit(jax.jacfwd(misfit))
    found = least_squares(
        jax.jit(misfit), jnp.array(guess), jac=slopes, bounds=([0.0, 0.0], [np.inf, np.inf])
    )
    spread = np.sqrt(2.0 * found.cost / (found.fun.size - 2))
    return found.x, spread * np.sqrt(np.diag(np.linalg.inv(found.jac.T @ found.jac)))


if __name__ == "__main__":
    noise = np.random.default_rng(1).normal(scale=1e-3, size=(len(INCIDENCE), 4))
    measured = ellipsometer().trace(n=0.608, k=2.12).stokes + noise
    (n, k), (sigma_n, sigma_k) = index_from(measured)
    print(f"n = {n:.4f} +- {sigma_n:.4f}, k = {k:.4f} +- {sigma_k:.4f}; true: 0.608, 2.12")
