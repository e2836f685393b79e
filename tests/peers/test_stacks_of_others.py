"""What other software computes for absorbing layers and their faces, against ours.

The script `computing/tmm_stack_figures.py` has made the file in `figures/stacks/`.
"""

import json
from pathlib import Path

import numpy as np
import pytest

import optipath as op

pytestmark = pytest.mark.filterwarnings(
    "ignore::optipath.CoherenceWarning"
)  # Of films, on purpose.

FIGURES = json.loads((Path(__file__).parent / "figures/stacks/tmm.json").read_text("utf-8"))


def figures(kind):
    return pytest.mark.parametrize("setup", [pytest.param(s, id=s["name"]) for s in FIGURES[kind]])


@figures("shares")
def test_a_stack_shares_light_out_as_that_of_tmm(setup):
    layers = [complex(*index) for index in setup["indices"]]
    stack = op.LayerStack(
        [setup.get("front", 1.0), *layers, complex(*setup.get("substrate", [1.0, 0.0]))],
        np.radians(setup["incidence"]),
        lengths=[length * 1e-9 for length in setup["lengths"]],
        wavelength=500e-9,
    )
    reflected, transmitted = (
        stack.mueller("in", port).matrix[0, :2] for port in ("reflected", "transmitted")
    )
    for share, sign in zip(setup["shares"], (1.0, -1.0), strict=True):
        ours = [
            reflected @ [1.0, sign],
            *stack.absorbed([1.0, sign, 0.0, 0.0]),
            transmitted @ [1.0, sign],
        ]
        np.testing.assert_allclose(ours, share, rtol=0.0, atol=FIGURES["precision"])


@figures("powers")
def test_a_face_lit_from_an_absorbing_medium_has_the_powers_of_tmm(setup):
    face = op.Interface(
        complex(*setup["behind"]),
        np.radians(setup["incidence"]),
        outside=complex(*setup["front"]),
        incidence_in=1.0,
    )
    rows = [face.mueller("in", port).matrix[0, :2] for port in ("reflected", "transmitted")]
    ours = [[row @ [1.0, sign] for row in rows] for sign in (1.0, -1.0)]
    np.testing.assert_allclose(ours, setup["powers"], rtol=0.0, atol=FIGURES["precision"])
