"""Multiples of a parameter with an offset in files: ``{ parameter = "d", scale = 2, ... }``."""

import numpy as np
import pytest

import optipath as op
from paths import chain

FILE = """
format = 1
description = "a polariser at a multiple of an angle"

[parameters.d]
default = "20 deg"
unit = "deg"

[parameters.share]
default = 0.5

[elements.lamp]
kind = "source"

[elements.filter]
kind = "polarizer"
angle = VALUE

[elements.grey]
kind = "attenuator"
transmittance = SHARE

[elements.eye]
kind = "detector"

[[links]]
from = "lamp.out"
to = "filter.in"
azimuth = AZIMUTH

[[links]]
from = "filter.out"
to = "grey.in"

[[links]]
from = "grey.out"
to = "eye.in"
"""


def loaded(tmp_path, value='"$d"', share='"$share"', azimuth='"0 deg"'):
    text = FILE.replace("VALUE", value).replace("SHARE", share).replace("AZIMUTH", azimuth)
    file = tmp_path / "path.toml"
    file.write_text(text, "utf-8")
    return op.load_preset(file)


@pytest.mark.parametrize(
    ("value", "degrees"),
    [
        ('"$d"', 20.0),
        ('"-$d"', -20.0),
        ('{ parameter = "d" }', 20.0),
        ('{ parameter = "d", scale = 2, offset = "10 deg" }', 50.0),
        ('{ parameter = "d", scale = -0.5 }', -10.0),
        ('{ parameter = "d", offset = "-0.1 rad" }', 20.0 - np.degrees(0.1)),
    ],
)
def test_a_table_stands_for_a_multiple_with_an_offset(value, degrees, tmp_path):
    path = loaded(tmp_path, value)
    # What a linear polariser lets through of unpolarised light is along its axis.
    half = np.radians(2 * degrees)
    expected = 0.25 * np.array([1.0, np.cos(half), np.sin(half), 0.0])
    np.testing.assert_allclose(path.trace().stokes, expected, rtol=1e-12, atol=1e-15)
    file = tmp_path / "copy.toml"
    file.write_text(path.to_toml(), "utf-8")
    assert op.load_preset(file) == path
    assert op.load_preset(file).compose() == path.compose()


def test_it_stands_on_a_link_and_where_numbers_have_no_dimension(tmp_path):
    path = loaded(
        tmp_path,
        share='{ parameter = "share", scale = 2, offset = -0.25 }',
        azimuth='{ parameter = "d", scale = 3 }',
    )
    assert path.trace().intensity == pytest.approx(0.375)
    np.testing.assert_allclose(path.trace(share=0.25).intensity, 0.125)


D, N = op.Parameter("d"), op.Parameter("n")


@pytest.mark.parametrize(
    ("element", "written"),
    [
        (op.Polarizer(2 * D + "10 deg"), '{ parameter = "d", scale = 2.0, offset = "10 deg" }'),
        (op.Polarizer(D + 0.5), '{ parameter = "d", offset = '),
        (op.Polarizer(-D), '"-$d"'),
        (op.Mirror(-N / 2, 0.3), '{ parameter = "n", scale = -0.5 }'),
        (op.Medium(D + "2 mm"), 'offset = "2 mm" }'),
        (op.LayerStack([1.5, 2 * N], 0.3), '[1.5, { parameter = "n", scale = 2.0 }]'),
        (op.Interface(op.Material(1.5, N / 4), 0.3), 'k = { parameter = "n", scale = 0.25 } }'),
    ],
)
def test_multiples_are_written_back(element, written, tmp_path):
    path = chain([element])
    assert written in path.to_toml()
    file = tmp_path / "path.toml"
    file.write_text(path.to_toml(), "utf-8")
    assert op.load_preset(file) == path


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ('{ parameter = "d", scael = 2 }', "key 'scael' is unknown; did you mean 'scale'"),
        ('{ parameter = "dd" }', "parameter 'dd' is not declared; there are: d, share"),
        ('{ parameter = "$d" }', r"parameter '\$d' is not declared; did you mean 'd'"),
        ("{ parameter = 3 }", "parameter 3 is not declared"),
        ("{ scale = 2 }", "needs 'parameter'"),
        ('{ parameter = "d", scale = 0 }', "a scale other than 0"),
        ('{ parameter = "d", scale = nan }', "finite real numbers"),
        ('{ parameter = "d", scale = [1, 2] }', r"'scale' must be one number, not \[1, 2\]"),
        ('{ parameter = "d", scale = "2 deg" }', "'2 deg' has the unit 'deg', but a pure number"),
        ('{ parameter = "d", scale = "1j" }', "finite real numbers"),
        ('{ parameter = "d", scale = true }', "true is not a number"),
        ('{ parameter = "d", offset = 10 }', "10 has no unit, but an angle is asked for"),
        ('{ parameter = "d", offset = "10 nm" }', "'10 nm' is no angle"),
        ('{ parameter = "share", offset = "10 deg" }', "parameter 'share'"),
    ],
)
def test_what_is_wrong_with_a_table_is_told_with_a_cure(value, message, tmp_path):
    with pytest.raises(op.OptipathError, match=message):
        loaded(tmp_path, value).trace()
