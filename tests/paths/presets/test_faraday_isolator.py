"""The preset faraday-isolator against its closed form."""

import numpy as np
import pytest

import optipath as op

VERDET, LENGTH = -134.0, 0.02


def test_what_passes_an_ideal_one_does_not_come_back():
    lights = op.load_preset("faraday-isolator").trace_all()
    assert lights["passed"].intensity == 1.0
    assert lights["returned"].intensity == 0.0


def test_fields_that_are_wrong_let_light_come_back_by_its_closed_form():
    fields = np.linspace(-0.6, 0.6, 301)
    given = {"verdet": VERDET, "length": LENGTH, "field": fields}
    lights = op.load_preset("faraday-isolator").trace_all(**given)
    short = np.pi / 4 - VERDET * LENGTH * fields
    passed = np.cos(short) ** 2
    np.testing.assert_allclose(lights["passed"].intensity, passed, rtol=0, atol=1e-15)
    returned = np.sin(2 * short) ** 2 / 4
    np.testing.assert_allclose(lights["returned"].intensity, returned, rtol=0, atol=1e-15)


def test_in_the_wrong_field_it_isolates_the_other_way():
    lights = op.load_preset("faraday-isolator").trace_all(field=0.5)
    assert lights["passed"].intensity == pytest.approx(0.0, abs=1e-30)


@pytest.mark.parametrize(("case", "returned"), [("tgg", 7e-12), ("weak-field", 0.00154)])
def test_its_cases_are_of_garnet(case, returned):
    path = op.load_preset("faraday-isolator", case=case)
    assert path.trace().intensity == pytest.approx(returned, rel=0.01)
