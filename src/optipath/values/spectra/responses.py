"""What may be a response: values by wavelength, and no power."""

from __future__ import annotations

from typing import Any

from optipath.errors import ValueFault, listed
from optipath.values.spectra.spectrum import Spectrum


def check_response(owner: str, response: Any) -> None:
    """Raise where a response is a spectrum with power in bins or lines.

    Examples
    --------
    >>> check_response("the response", Spectrum.constant(0.5))
    """
    curve = getattr(response, "curve", response)
    terms = curve.kind.terms if isinstance(curve, Spectrum) else ()
    if powers := [term.label for term in terms if not term.is_pointwise]:
        raise ValueFault(
            f"{owner} has {listed(powers)}, which is power and no response; give relative values "
            f"at wavelengths, Spectrum.sampled(wavelengths, values)"
        )
