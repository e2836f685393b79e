"""Products such as ``element @ light``: what cannot stand in them is told what can."""

import numpy as np
import pytest

import optipath as op
from tables import rows

LIGHT = op.Light([1.0, 0.6, 0.0, 0.8])
ELEMENT = op.Polarizer(0.3)
MATRIX = ELEMENT.mueller()
PATH = op.Source() >> ELEMENT >> op.Detector()


def test_a_matrix_acts_on_an_element_as_on_its_matrix():
    plate = op.Retarder("90 deg", 0.2, azimuth=0.1)
    found = (MATRIX @ plate) @ LIGHT
    np.testing.assert_allclose(found.stokes, (MATRIX @ (plate @ LIGHT)).stokes, atol=1e-15)


@rows(
    "product, expected",
    [
        (lambda: MATRIX @ [1, 0, 0, 0], r"has no frames; .* optipath.Light\(numbers\) for light"),
        (lambda: MATRIX @ np.eye(4), r"has no frames; write .* optipath.Mueller\(matrix\)"),
        (lambda: np.eye(4) @ MATRIX, "has no frames"),
        (lambda: np.eye(4) @ ELEMENT, "has no frames"),
        (lambda: [1, 0] @ ELEMENT, "has no frames"),
        (lambda: np.eye(4) @ LIGHT, "has no frames"),
        (lambda: ELEMENT @ [1, 0, 0, 0], "has no frames"),
        (lambda: op.Polarizer @ LIGHT, r"^Polarizer is a class; write Polarizer\(\.\.\.\)$"),
        (lambda: MATRIX @ op.Polarizer, "is a class"),
        (lambda: ELEMENT @ op.Polarizer, "is a class"),
        (lambda: PATH @ LIGHT, r"PathGraph begins with light of its own; write path.mueller\(\) @"),
        (lambda: PATH.compose() @ LIGHT, "Plan begins with light of its own"),
        (lambda: MATRIX @ PATH, "begins with light of its own"),
        (lambda: PATH @ ELEMENT, "begins with light of its own"),
        (lambda: ELEMENT.named("a") @ LIGHT, "write the element without a name"),
        (lambda: op.Source() @ LIGHT, "source lets no light through, which begins there; ask"),
        (lambda: op.Detector() @ LIGHT, "detector lets no light through, which ends there; ask"),
        (lambda: op.BeamSplitter() @ LIGHT, r'say the ports, such as element.mueller\("in", "refl'),
    ],
)
def test_what_cannot_stand_in_a_product_is_told_what_can(product, expected):
    with pytest.raises(op.OptipathError, match=expected):
        product()


def test_the_cure_of_a_path_is_what_it_does():
    found = PATH.mueller() @ LIGHT
    np.testing.assert_allclose(found.stokes, (ELEMENT @ LIGHT).stokes, atol=1e-15)


def test_a_beam_splitter_acts_on_light_by_its_ports():
    light = op.BeamSplitter(0.3).mueller("in", "transmitted") @ LIGHT
    np.testing.assert_allclose(light.stokes, 0.7 * LIGHT.stokes, rtol=1e-15)
