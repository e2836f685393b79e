"""Mitsuba 3: its Mueller matrices, in the only precision that its LLVM variants have."""

import drjit as dr
import mitsuba

import llvm_backend  # noqa: F401 - says in words where LLVM is missing
from work import INTENSITY, Contender

VARIANT = "llvm_ad_rgb"


def prepare(delta, rho, phi, materials):
    mitsuba.set_variant(VARIANT)
    n1, k1, n2, k2 = materials
    Float, Index, optics = mitsuba.Float, mitsuba.Complex2f, mitsuba.mueller

    def run():
        first = optics.specular_reflection(dr.cos(Float(delta)), Index(n1, k1))
        second = optics.specular_reflection(dr.cos(Float(phi)), Index(n2, k2))
        matrix = first @ optics.rotator(-Float(rho)) @ second @ optics.linear_polarizer(Float(1.0))
        light = matrix @ mitsuba.Vector4f(INTENSITY, 0.0, 0.0, 0.0)
        # Its S3 has the opposite sign.
        light.w = -light.w
        return dr.ravel(light).numpy().reshape(-1, 4)

    return run


CONTENDERS = (
    Contender("Mitsuba 3, mueller", prepare, f"{VARIANT}, float32; the sign of S3 turned"),
)
