"""The range of a formula is one of wavelengths of light."""

import pytest

import optipath as op
from tables import rows


@rows(
    "make",
    [
        lambda span: op.Material.cauchy([1.5], span=span, name="x"),
        lambda span: op.Material.sellmeier([1.2], [0.01], span=span, name="x"),
        lambda span: op.Material.drude_lorentz(9.0, 0.1, span=span, name="x"),
        lambda span: op.Material.tauc_lorentz([(100, 3, 2, 1)], span=span, name="x"),
    ],
)
def test_nanometres_that_are_taken_for_metres_are_refused(make):
    with pytest.raises(op.ValueFault) as fault:
        make((400, 700))
    assert str(fault.value) == (
        "the least wavelength of the span of x is 400 metres, which is no wavelength of light; "
        "multiply those in nanometres by 1e-9, and those in micrometres by 1e-6"
    )
    assert "400 nm .. 700 nm" in repr(make((400e-9, 700e-9)))
