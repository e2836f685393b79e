import numpy as np
import pytest

import optipath as op
from paths import chain


def test_two_reflections_of_one_material_crossed_lose_the_square_of_the_diattenuation():
    angle = np.linspace(0.0, 1.5, 7)
    panes = op.load_preset("npgr026", n1=1.5, n2=1.5, rho=np.pi / 2)
    found = op.polarization(panes, delta=angle, phi=angle)
    A, B, _, _ = op.fresnel_reflection(1.5, np.cos(angle), np.sin(angle))
    np.testing.assert_allclose(found.scalar, 100.0 * A * A, rtol=1e-13)
    np.testing.assert_allclose(found.difference, -((B / A) ** 2), rtol=0, atol=1e-13)
    # Without one of the two nothing is lost.
    for share in (found.elements["X1"], found.elements["X2"]):
        np.testing.assert_allclose(share, -((B / A) ** 2), rtol=0, atol=1e-13)


def test_the_element_that_brings_the_difference_in_is_named():
    elements = [op.Interface(0.05 + 3.9j, 0.5), op.Retarder(1.0, 0.3), op.Polarizer(0.7)]
    found = op.polarization(chain(elements, [1.0, 0.0, 0.9, 0.0]))
    assert found.culprits == ("e2",)
    assert set(found.elements) == {"e0", "e1", "e2"}
    assert found.elements["e1"] == 0.0


def test_where_nothing_polarises_there_is_no_difference_and_no_culprit():
    found = op.polarization(chain([op.Rotator(0.3), op.Attenuator(0.5)], [1.0, 0.5, 0.0, 0.2]))
    assert found.difference == 0.0
    assert found.culprits == ()
    assert found.certificate.error >= 0.0


def test_dark_scenes_differ_in_nothing_or_in_all():
    crossed = op.polarization(op.load_preset("two-panes"))
    assert crossed.exact == pytest.approx(0.0, abs=1e-15)
    assert crossed.difference == pytest.approx(-1.0)
    dark = op.polarization(chain([op.Attenuator(0.0), op.Polarizer(0.1), op.Polarizer(1.0)]))
    assert dark.scalar == dark.difference == 0.0


def test_the_detector_is_named_where_there_are_several():
    path = op.PathGraph()
    path.add("lamp", op.Source())
    path.add("split", op.BeamSplitter(0.25))
    path.connect("lamp.out", "split.in")
    for name, way in (("a", "reflected"), ("b", "transmitted")):
        path.add(name, op.Detector())
        path.connect(f"split.{way}", f"{name}.in")
    assert op.polarization(path, "b").exact == 0.75
    with pytest.raises(op.ParameterError, match="2 detectors"):
        op.polarization(path)
    with pytest.raises(op.ParameterError, match="there are: a, b"):
        op.polarization(path, "bb")
