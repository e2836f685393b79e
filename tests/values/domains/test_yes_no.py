import numpy as np
import pytest

import optipath as op
from optipath.values.domains.quantities import YesOrNo
from paths import chain
from tables import rows


class Shutter(op.Element, kind="test-shutter"):
    shut: YesOrNo = False

    @staticmethod
    def mueller_rows(xp, shut):
        through = xp.where(shut, 0.0, 1.0)
        return [[through * (row == column) for column in range(4)] for row in range(4)]


@rows("shut, through", [(True, 0.0), (False, 1.0)])
def test_a_yes_no_field_gives_its_rows_1_or_0(shut, through):
    assert chain([Shutter(shut)]).trace().stokes[0] == through


def test_a_bool_of_numpy_is_a_bool():
    assert Shutter(np.array([True])[0]).shut is True
    assert Shutter(np.array([True])[0]) == Shutter(shut=True) != Shutter(shut=False)


@rows("value", [1, 0.0, "yes", None, [True], np.array([True, False])])
def test_anything_else_is_refused_in_words(value):
    with pytest.raises(op.OptipathError, match=r"shut is .*; give True or False"):
        chain([Shutter(value)]).check()


def test_it_cannot_be_a_parameter():
    with pytest.raises(op.OptipathError, match="cannot be a parameter; give True or False"):
        chain([Shutter(op.Parameter("a"))]).check()


@pytest.mark.parametrize("shut", [True, False])
def test_it_goes_to_toml_and_back(shut, tmp_path):
    path = chain([Shutter(shut)])
    text = path.to_toml()
    assert f"shut = {str(shut).lower()}\n" in text
    file = tmp_path / "shutter.toml"
    file.write_text(text, "utf-8")
    assert op.load_preset(file) == path


def test_a_file_that_gives_a_number_is_refused(tmp_path):
    file = tmp_path / "shutter.toml"
    file.write_text(chain([Shutter(shut=True)]).to_toml().replace("= true", "= 1"), "utf-8")
    with pytest.raises(op.OptipathError, match=r"shut: the value is 1; give true or false"):
        op.load_preset(file)


def test_a_value_that_is_none_of_both_is_not_written():
    with pytest.raises(op.OptipathError, match="shut is 3; give True or False"):
        chain([Shutter(3)]).to_toml()
