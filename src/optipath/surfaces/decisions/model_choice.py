"""ModelChoice: which model of light a sample needs, and what says so."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class ModelChoice:
    """The simplest model that is good enough, of those that were compared.

    Attributes
    ----------
    model : {"single-scattering", "scalar", "polarized"}
        The analytic model of one reflection, the walk without polarisation, or with it.
    tolerance : float
        The relative error of a pixel's light that will do.
    undecided : tuple of str
        The simpler models of which the noise does not tell whether they would do.
    smooth : float
        (S0 - U) / U of all light on that side, were all interfaces flat: exact; of several
        wavelengths, the largest.
    difference : tuple of float or None
        The largest abs(S0 - U) / U of a pixel, and its standard error; None where the sample is
        flat, and nothing was walked.
    multiple : tuple of float or None
        The largest share of a pixel's light that has met the surface more than once, and its
        standard error; None where it was not asked for.
    beside_model : tuple of float or None
        The largest abs(model - S0) / S0 of a pixel, of the analytic model of one reflection and
        all light of the pixel, and its standard error; None where it was not asked for.
    evidence : tuple of str
        All of it in words, a line each.
    """

    model: str
    tolerance: float
    undecided: tuple[str, ...]
    smooth: float
    difference: tuple[float, float] | None
    multiple: tuple[float, float] | None
    beside_model: tuple[float, float] | None
    evidence: tuple[str, ...]

    def explain(self) -> str:
        """Return the decision and its evidence as text.

        Examples
        --------
        >>> from optipath.surfaces.decisions.decide import decide
        >>> from optipath.surfaces.samples.sample import Sample
        >>> print(decide(Sample([(1.5, 0.0), (2.4, 0.0)]), "60 deg").explain())
        the polarised model is needed for a tolerance of 2 %
          smooth interfaces, exact: polarisation changes all reflected light by -2.900 %
          the sample is flat, so that this is all
        """
        return "\n  ".join([self.said, *self.evidence])

    @property
    def said(self) -> str:
        """The decision in one sentence."""
        needed = self.model == "polarized" and not self.undecided
        what = "the polarised model is needed" if needed else _TOLD[self.model]
        told = f"{what} for a tolerance of {100.0 * self.tolerance:g} %"
        if not self.undecided:
            return told
        which = " or ".join([_NAMES[name] for name in self.undecided])
        return f"{told}; whether {which} would do, the noise does not tell"


_TOLD = {
    "single-scattering": "the analytic model of single scattering suffices",
    "scalar": "the model without polarisation suffices",
    "polarized": "the polarised model serves",
}

_NAMES = {"single-scattering": "single scattering", "scalar": "the model without polarisation"}
