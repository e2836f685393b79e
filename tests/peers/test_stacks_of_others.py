"""What other software computes for absorbing layers and their faces, against ours.

The script `computing/tmm_figures.py` has made the file in `figures/stacks/`.
"""

import json
from pathlib import Path

import numpy as np
import pytest

import optipath as op
from tables import rows

FIGURES = json.loads((Path(__file__).parent / "figures/stacks/tmm.json").read_text("utf-8"))
PORTS = ("reflected", "transmitted")


@pytest.mark.filterwarnings("ignore::optipath.CoherenceWarning")  # Of films, on purpose.
@rows("setup", FIGURES["shares"])
def test_a_stack_shares_light_out_as_that_of_tmm(setup):
    layers = [complex(*index) for index in setup["indices"]]
    media = [setup.get("front", 1.0), *layers, complex(*setup.get("substrate", [1.0, 0.0]))]
    lengths = [length * 1e-9 for length in setup["lengths"]]
    incidence = np.radians(setup["incidence"])
    stack = op.LayerStack(media, incidence, lengths=lengths, wavelength=500e-9)
    reflected, transmitted = (stack.mueller("in", port).matrix[0, :2] for port in PORTS)
    for share, sign in zip(setup["shares"], (1.0, -1.0), strict=True):
        absorbed = stack.absorbed([1.0, sign, 0.0, 0.0])
        ours = [reflected @ [1.0, sign], *absorbed, transmitted @ [1.0, sign]]
        np.testing.assert_allclose(ours, share, rtol=0.0, atol=FIGURES["precision"])


@rows("setup", FIGURES["powers"])
def test_a_face_lit_from_an_absorbing_medium_has_the_powers_of_tmm(setup):
    behind, front = complex(*setup["behind"]), complex(*setup["front"])
    incidence = np.radians(setup["incidence"])
    face = op.Interface(behind, incidence, outside=front, incidence_in=1.0)
    lines = [face.mueller("in", port).matrix[0, :2] for port in PORTS]
    ours = [[line @ [1.0, sign] for line in lines] for sign in (1.0, -1.0)]
    np.testing.assert_allclose(ours, setup["powers"], rtol=0.0, atol=FIGURES["precision"])
