"""The published tables are what the command writes."""

import re
from pathlib import Path

import pytest

import optipath as op
from optipath.lab.accuracy.regions import REGIONS
from optipath.lab.accuracy.tables import BEGIN, END, SEARCHED, put_tables, tables

DOCUMENT = Path(__file__).parents[3] / "docs" / "accuracy.md"


def numbers(text):
    """The errors of a text, by row; infinity where all is lost."""
    words = re.findall(r"\| ([^|\n]*) (?=\|)", text)
    return [
        float(w.strip("*")) if re.fullmatch(r"\**[\d.e]+\**", w) else w.strip("*") for w in words
    ]


def test_the_published_tables_are_true():
    # Digits may differ from one platform's cosine to another's, but not what holds.
    published = DOCUMENT.read_text("utf-8")
    fresh = put_tables(published, tables(200))
    old, new = (numbers(text.split(BEGIN)[1].split(END)[0]) for text in (published, fresh))
    assert len(old) == len(new) > 300
    for before, now in zip(old, new, strict=True):
        if isinstance(before, float) and isinstance(now, float):
            both_fail = before >= 1000 and now >= 1000
            assert both_fail or abs(before - now) <= 0.5 * max(before, now) + 0.3
        elif isinstance(before, str) and isinstance(now, str):
            assert before == now


def test_the_published_worst_cases_are_within_the_promised_limits():
    published = DOCUMENT.read_text("utf-8")
    found = published.split(SEARCHED[0])[1].split(SEARCHED[1])[0]
    stable, single, compensated = found.split("Worst cases found of ")[1:]
    for text, limit in ((stable, 20.0), (single, 20.0), (compensated, 1.5)):
        errors = [word for word in numbers(text) if isinstance(word, float)]
        assert len(errors) == (len(REGIONS) + 1) * 8  # and anywhere
        assert max(errors) <= limit


def test_a_document_without_a_place_for_tables_is_refused():
    with pytest.raises(op.OptipathError, match="no place"):
        put_tables("# Accuracy", [])
