import json

import pytest

from optipath.cli import main

pytest.importorskip("numba")
pytest.importorskip("xarray")


def told(capsys, *arguments):
    status = main(["surface", *arguments, "--decide"])
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def test_the_model_is_told_with_its_evidence(capsys):
    given = ["glass-on-glass", "--incidence", "60", "--photons", "5e4"]
    status, out, _ = told(capsys, *given)
    assert status == 0
    assert "the polarised model is needed for a tolerance of 2 %" in out
    assert "50,000 photons, 64 x 64 pixels" in out


def test_json_has_one_object_for_each_angle(capsys):
    given = ["glass-on-glass", "--incidence", "50, 60", "--photons", "2e4", "--tolerance", "0.9"]
    status, out, _ = told(capsys, *given, "--json")
    found = json.loads(out)["directions"]
    assert (status, [each["incidence"] for each in found]) == (0, [50.0, 60.0])
    assert {each["tolerance"] for each in found} == {0.9}


def test_a_polarised_source_is_refused(capsys):
    status, _, err = told(capsys, "glass-rough", "--incidence", "30", "--stokes", "1,1,0,0")
    assert (status, err) == (2, "optipath: --decide is of unpolarised light; leave --stokes out\n")


def test_light_may_be_looked_at_below(capsys):
    given = ["glass-rough", "--incidence", "30", "--photons", "2e3", "--tolerance", "0.5"]
    status, out, _ = told(capsys, *given, "--side", "transmitted")
    assert status == 0
    assert "polarisation changes all transmitted light" in out


def test_that_no_pixel_counts_is_one_sentence(capsys):
    status, _, err = told(capsys, "glass-rough", "--incidence", "0", "--photons", "1")
    assert status == 2
    assert err.splitlines()[-1].startswith("optipath: no pixel counts: of 1 photon none is ref")
