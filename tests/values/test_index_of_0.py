"""An index of refraction of exactly 0 is none; n of 0 with absorption is one."""

import numpy as np
import pytest

import optipath as op

N, K = op.Parameter("n"), op.Parameter("k")


def _path(index):
    return op.Source() >> op.Interface(index, 0.3) >> op.Detector()


def test_an_index_of_0_is_refused_with_its_place():
    table = op.tabulated(["400 nm", "500 nm"], [1.5, 0.0])
    rows = [
        (
            lambda: op.Interface(np.diag([1.5, 1.5, 1.6]), 0.3),
            r"Interface index is 0.0 at \(0, 1\)",
        ),
        (lambda: op.Interface(0, 0.3), "Interface index is 0"),
        (lambda: op.Interface(0j, 0.3), "Interface index is 0j"),
        (lambda: op.Interface(1.5, 0.3, outside=0.0), "Interface outside is 0"),
        (lambda: op.LayerStack([1, 0, 1.5], 0.3), r"indices\[1\] is 0"),
        (lambda: op.LayerStack([1, 1.2, 0], 0.3), r"indices\[2\] is 0"),
        (lambda: op.path_from_vertices([[0, 0, 0], [0, 0, 1], [0, 1, 1]], materials=[0]), "index"),
        (lambda: op.fresnel_reflection(0.0, 1.0, 0.0), "index is 0"),
        (lambda: op.Material(0), "Material n is 0"),
        (lambda: op.Material(0.0, 0.0), "Material n is 0"),
        (lambda: op.Material([1.5, 0.0], 0.0), r"Material n is 0(\.0)? at 1"),
        (lambda: op.Material([1.5, 0.0], [0.0, 0.0]), r"Material n is 0(\.0)? at 1"),
        (lambda: op.Material.tabulated(["400 nm", "500 nm"], [1.5, 0.0]), "n of .* at 500 nm"),
        (lambda: op.Material.tabulated(["1 um", "2 um"], [0.0, 1.0], [0.0, 1.0]), "at 1000 nm"),
        (lambda: _path(N).trace(n=0), "'n' .* is 0"),
        (lambda: _path(N).trace(n=np.array([1.5, 0.0])), "'n' .* is 0"),
        (lambda: _path(op.Material(N)).trace(n=0), "'n' .* is 0"),
        (lambda: _path(op.Material(N, K)).bind(n=0, k=0), "'n' .* is 0"),
        (lambda: _path(table).trace(wavelength="500 nm"), "the table at 500 nm is 0"),
    ]
    for make, told in rows:
        with pytest.raises(op.OptipathError, match=told):
            make()


def test_n_of_0_with_absorption_is_an_index():
    for index in (1j, op.Material(0.0, 1.0), op.Material([1.5, 0.0], [0.0, 1.0])):
        assert np.all(_path(index).trace().intensity <= 1.0)
    assert _path(op.Material(N, K)).trace(n=0.0, k=1.0).intensity == pytest.approx(1.0)


def test_traced_indices_are_what_they_were(jax_once):
    # At 0.3 rad, by differences of the closed form.
    cos, sin = np.cos(0.3), np.sin(0.3)

    def reflected(n):
        g = np.sqrt(n * n - sin * sin)
        s, p = (cos - g) / (cos + g), (n * n * cos - g) / (n * n * cos + g)
        return 0.5 * (s * s + p * p)

    slope = jax_once.grad(lambda n: _path(N).trace(n=n).stokes[0])(1.5)
    assert slope == pytest.approx((reflected(1.50001) - reflected(1.49999)) / 2e-5, rel=1e-6)
