"""Thin layers of a LayerStack, and psi and Delta of what has none, are warned of."""

import warnings

import numpy as np
import pytest

import optipath as op


def warned(action):
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("default")
        action()
    return [one.category for one in told]


def stack(length, n=1.5, **others):
    given = {"lengths": [length], "wavelength": "500 nm"} | others
    return op.LayerStack([1.0, n, 1.5], 0.3, **given)


def test_layers_thinner_than_ten_wavelengths_are_warned_of():
    path = op.Source() >> stack(op.Parameter("d")) >> op.Detector()
    by_wavelength = op.Source() >> stack("1 um", wavelength=op.Wavelength()) >> op.Detector()
    by_index = op.Source() >> stack("1 um", op.Parameter("n")) >> op.Detector()
    rows = [
        (lambda: stack("5 nm"), 1),
        (lambda: stack("3 um"), 1),  # 9 wavelengths in it
        (lambda: stack("3.4 um"), 0),
        (lambda: stack("3 um", 2.0), 0),
        (lambda: stack(np.array([1e-3, 1e-7])), 1),
        (lambda: stack("5 nm", wavelength=None), 0),
        (lambda: stack("4 mm"), 0),
        (lambda: path.bind(d="100 nm"), 1),
        (lambda: path.bind(d="1 mm").trace(), 0),
        (lambda: path.trace(d="25 nm"), 1),
        (lambda: path.trace(d=["1 mm", "25 nm"]), 1),
        (lambda: path.trace(d="1 mm"), 0),
        (lambda: by_wavelength.trace(wavelength="500 nm"), 1),
        (lambda: by_index.trace(n=1.4), 1),
    ]
    for number, (action, count) in enumerate(rows):
        assert warned(action) == [op.CoherenceWarning] * count, number


def test_psi_and_delta_of_what_has_no_ratio_of_amplitudes_are_warned_of_once_a_place():
    glass = op.Interface(1.5, "56 deg").mueller()
    rows = [
        (glass, 0),
        (op.Interface(0.2 + 3.0j, "70 deg").mueller(), 0),
        (op.Mueller(glass.matrix + 1e-4 * np.eye(4)[::-1] * glass.matrix[0, 0]), 0),
        (op.Retarder(0.5, 0.0).mueller(), 0),
        (op.Retarder(0.5, 0.3).mueller(), 1),
        (op.Depolarizer(0.5).mueller(), 1),
        (op.Mueller(np.zeros((4, 4))), 0),
    ]
    for number, (matrix, count) in enumerate(rows):

        def twice(matrix=matrix):
            for _ in range(2):
                matrix.ellipsometric_angles()

        assert warned(twice) == [op.CoherenceWarning] * count, number


def test_traced_matrices_are_not_warned_of():
    jax = pytest.importorskip("jax")
    angles = jax.jit(lambda m: op.Mueller(m).ellipsometric_angles())
    assert warned(lambda: angles(np.diag([1.0, 0.5, 0.5, 0.5]).astype("f4"))) == []
