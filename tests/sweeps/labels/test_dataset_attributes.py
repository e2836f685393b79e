"""What the Dataset of a sweep says of itself."""

from importlib.metadata import version

import numpy as np
import pytest

import optipath as op

pytest.importorskip("xarray")


def test_the_path_is_there_as_toml_that_gives_it_back(tmp_path):
    path = op.load_preset("npgr026")
    found = path.sweep(delta=[0.1, 0.2])
    (tmp_path / "path.toml").write_text(found.attrs["path"], "utf-8")
    assert op.load_preset(tmp_path / "path.toml") == path


def test_the_explanation_and_the_version_are_there():
    path = op.load_preset("malus")
    attrs = path.sweep(angle=[0.1, 0.2]).attrs
    assert attrs["explanation"] == path.compose().explain()
    assert attrs["optipath_version"] == version("optipath")


def test_options_are_as_the_composer_has_them():
    composer = op.Composer(method="textbook", engine="numpy", model="full")
    attrs = op.load_preset("malus").sweep(angle=[0.1], composer=composer).attrs
    told = {name: attrs[name] for name in ("method", "engine", "model", "dtype")}
    assert told == {"method": "textbook", "engine": "numpy", "model": "full", "dtype": "float64"}


def test_a_path_that_changes_is_told_as_it_is_now():
    path = op.load_preset("malus")
    path.sweep(angle=[0.1])
    path.description = "another one"
    assert 'description = "another one"' in path.sweep(angle=[0.1]).attrs["path"]


def test_a_path_without_a_form_in_toml_is_swept_and_says_why():
    class Grey(op.Element):
        @staticmethod
        def mueller_rows(xp):
            return np.eye(4).tolist()

    path = op.Source() >> Grey() >> op.Attenuator(op.Parameter("t")) >> op.Detector()
    found = path.sweep(t=[0.25, 0.5])
    assert found.S0.values.tolist() == [0.25, 0.5]
    assert found.attrs["path"].startswith("the path cannot be written here, since it has no form")


def test_frames_are_told_where_they_are_constant():
    assert op.load_preset("malus").sweep(angle=[0.1]).attrs["frame"] == (
        "eye: x = 1, 0, 0; y = 0, 1, 0; z = 0, 0, 1"
    )
    found = op.load_preset("npgr026-3d").sweep(delta=[0.1, 0.2])
    assert found.attrs["frame"] == "E: depends on the values"
