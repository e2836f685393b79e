"""An element by its matrix: whether light goes straight through it, or leaves it another way."""

import numpy as np
import pytest

import optipath as op
from tables import rows

MATRIX = 0.5 * np.diag([1.0, 0.9, -0.8, -0.8])
MEETS = op.plane_of_incidence(direction=(1.0, 0.0, -1.0), normal=(0.0, 0.0, 1.0))


def reflecting(**given):
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(stokes=[1, 0, 1, 0]), frames={"out": MEETS.arriving})
    frames = {"in": MEETS.arriving, "out": MEETS.reflected}
    sample = path.add("sample", op.MuellerElement(MATRIX, **given), frames=frames)
    lamp >> sample >> path.add("eye", op.Detector())
    return path


def test_what_scatters_has_a_frame_for_each_way():
    light = reflecting(straight=False).trace()
    np.testing.assert_array_equal(light.stokes, MATRIX @ [1, 0, 1, 0])
    np.testing.assert_array_equal(light.frame.z, MEETS.reflected.z)


def test_what_light_goes_straight_through_has_one():
    with pytest.raises(op.PathError, match="lets light go straight through; give its ports one"):
        reflecting().trace()


def test_alone_light_leaves_in_a_frame_of_its_own():
    arriving = op.Light([1, 0, 1, 0], MEETS.arriving)
    behind = op.MuellerElement(MATRIX, straight=False) @ arriving
    assert not np.allclose(behind.frame.z, MEETS.arriving.z)
    through = op.MuellerElement(MATRIX) @ arriving
    np.testing.assert_array_equal(through.frame.z, MEETS.arriving.z)


def test_it_is_written_and_read_back(tmp_path):
    path = reflecting(straight=False)
    file = tmp_path / "path.toml"
    file.write_text(path.to_toml(), "utf-8")
    assert "straight = false" in path.to_toml()
    assert op.load_preset(file) == path


def test_it_stays_so_on_the_way_back():
    assert op.MuellerElement(MATRIX, straight=False).reversed().straight is False


@rows("given", ["no", 2, None])
def test_it_is_yes_or_no(given):
    with pytest.raises(op.OptipathError, match="straight"):
        op.MuellerElement(MATRIX, straight=given)


def test_a_class_may_leave_it_to_its_elements_too():
    class Scatterer(op.Element, kind=""):
        share: op.Fraction = 0.5
        straight: op.YesOrNo = True

        @staticmethod
        def mueller_rows(xp, share, straight):
            return [[share * (row == column) for column in range(4)] for row in range(4)]

    assert Scatterer(straight=False).straight is False
