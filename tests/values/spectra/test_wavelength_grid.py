"""Wavelengths in equal steps."""

from __future__ import annotations

import pytest

import optipath as op
from tables import rows


def test_each_is_the_number_that_its_text_stands_for():
    found = op.wavelengths("380 nm", "700 nm", "40 nm")
    expected = [op.Wavelength().resolve(f"{place} nm").value for place in range(380, 701, 40)]
    assert found.tolist() == [float(place) for place in expected]


def test_numbers_are_in_metres():
    assert op.wavelengths(4e-7, 5e-7, 5e-8).tolist() == [4e-7, 4.5e-7, 5e-7]


@rows(
    "given, sentence",
    [
        (("380 nm", "700 nm", "45 nm"), "7.11111 steps of 45 nm; .* as up to 695 nm"),
        (("700 nm", "380 nm", "40 nm"), "do not rise"),
        (("380 nm", "700 nm", "0 nm"), "step"),
        ((380, 700, 40), "metres"),
        (("380 nm", "700 nm", "400 nm"), "up to 780 nm"),
    ],
)
def test_steps_that_do_not_fit_are_refused(given, sentence):
    with pytest.raises(op.ValueFault, match=sentence):
        op.wavelengths(*given)
