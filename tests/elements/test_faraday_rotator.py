import numpy as np
import pytest

import optipath as op
from chains import ENGINES
from paths import chain
from tables import rows

STATE = (1.0, 0.8, 0.1, 0.5)
V, B, L = (op.Parameter(name) for name in "vbl")


def turned(angle):
    """Light of the state, its axis turned from x towards y."""
    c, s = np.cos(2 * angle), np.sin(2 * angle)
    s0, s1, s2, s3 = STATE
    return np.stack([s0 + 0 * c, s1 * c - s2 * s, s1 * s + s2 * c, s3 + 0 * c], axis=-1)


def test_an_angle_turns_from_x_towards_y():
    light = chain([op.FaradayRotator(0.3)], STATE).trace()
    np.testing.assert_allclose(light.stokes, turned(0.3), rtol=0, atol=4e-16)


@rows("engine", ENGINES)
def test_the_angle_is_verdet_constant_times_field_times_length(engine):
    rng = np.random.default_rng(3)
    v, b, length = rng.uniform(-200, 200, 500), rng.uniform(-2, 2, 500), rng.uniform(0, 0.1, 500)
    path = chain([op.FaradayRotator(verdet=V, field=B, length=L)], STATE)
    found = op.Composer(engine=engine).compose(path).run(v=v, b=b, l=length).stokes
    np.testing.assert_allclose(found, turned(v * b * length), rtol=0, atol=5e-14)


def test_light_along_the_field_in_what_has_a_positive_verdet_constant_turns_counter_clockwise():
    """Hecht, Optics, sec. 8.11.2: to who looks at the source, as seen by angles in space."""
    for z in [(0, 0, 1), (0, 0.6, -0.8)]:
        frame = op.Frame.from_direction(z, (1, 0, 0))
        rod = op.FaradayRotator(verdet=4.0, field=0.5, length=0.2)
        light = rod.mueller(frame_in=frame) @ op.Light([1.0, 1.0, 0.0, 0.0], frame)
        axis = np.cos(light.aop) * light.frame.x + np.sin(light.aop) * light.frame.y
        facing = -frame.z
        # Counter-clockwise of up is left, which is up cross facing turned about: facing cross up.
        left = np.cross(-facing, frame.x)
        assert np.arctan2(axis @ left, axis @ frame.x) == pytest.approx(0.4, abs=1e-15)


def test_on_the_way_back_from_a_mirror_the_turns_add_up_where_the_field_is_seen_reversed():
    there, back = (op.FaradayRotator(verdet=-134.0, field=b, length=0.02) for b in (0.1, -0.1))
    light = chain([there, op.Mirror(), back], (1.0, 1.0, 0.0, 0.0)).trace()
    turn = -2 * 134.0 * 0.1 * 0.02
    # In the frame behind the mirror, y is the other way.
    expected = [1.0, np.cos(2 * turn), -np.sin(2 * turn), 0.0]
    np.testing.assert_allclose(light.stokes, expected, rtol=0, atol=3e-16)


@rows(
    "given, fault",
    [
        ({}, "angle is missing; give the angle alone, or verdet, field and length"),
        ({"verdet": 2.0, "length": 0.1}, "field is missing; give the angle alone"),
        ({"angle": 0.1, "field": 0.2}, "angle is given beside field; give the angle alone"),
        ({"angle": op.Parameter("a"), "field": B}, "angle is given beside field"),
        ({"verdet": 2.0, "field": B, "length": -0.1}, "length is -100 mm; give a real length"),
        ({"verdet": "2 rad", "field": B, "length": L}, "'2 rad' is no Verdet constant; use one of"),
        ({"verdet": 1.0, "field": "2 tesla", "length": L}, "did you mean 'T'"),
        ({"verdet": 1.0, "field": 1e7, "length": L}, "field is 1e.07 T; give a real magnetic"),
    ],
)
def test_what_is_given_is_the_angle_or_all_of_the_product(given, fault):
    with pytest.raises(op.OptipathError, match=fault):
        op.FaradayRotator(**given)


def test_all_that_is_missing_is_told_at_once():
    with pytest.raises(op.ValueFault) as error:
        op.FaradayRotator(field=1.0)
    assert len(error.value.faults) == 2


def test_units_of_verdet_constants_and_fields_are_those_of_tables():
    """0.12 min/(Oe cm), as makers of TGG write it, is 34.9 rad/(T m)."""
    rod = op.FaradayRotator(verdet="0.12 arcmin/(G cm)", field="5 kG", length="2 cm")
    assert rod.verdet == pytest.approx(np.radians(0.12 / 60) * 1e4 * 100, rel=1e-15)
    assert rod == op.FaradayRotator(verdet=rod.verdet, field=0.5, length=0.02)
    assert op.FaradayRotator(verdet="2 deg/(T cm)", field=1, length=1).verdet == pytest.approx(
        np.radians(200.0), rel=1e-15
    )


def test_a_file_is_told_by_its_node_which_values_are_missing(tmp_path):
    path = chain([op.FaradayRotator(verdet=1.0, field="10 mT", length=L)])
    text = path.to_toml()
    (tmp_path / "x.toml").write_text(text, "utf-8")
    assert op.load_preset(tmp_path / "x.toml") == path
    assert 'verdet = "1 rad/(T m)"' in text
    (tmp_path / "x.toml").write_text(text.replace('field = "0.01 T"\n', ""), "utf-8")
    with pytest.raises(op.OptipathError, match=r"e0\.field is missing; give the angle alone"):
        op.load_preset(tmp_path / "x.toml")
