"""Random numbers of compiled code are NumPy's."""

import numpy as np
import pytest

from uncompiled import uncompiled

pytest.importorskip("numba")

from optipath.surfaces.walk.random_stream import uniform


@pytest.mark.parametrize("seed", [0, 1, 2**63, 12345678901234567890])
def test_the_numbers_are_those_of_numpy(seed):
    stream = np.random.SFC64(seed)
    state = np.array(stream.state["state"]["state"], np.uint64)
    draw = uncompiled(uniform)
    with np.errstate(over="ignore"):
        found = [draw(state) for _ in range(1000)]
    assert found == np.random.Generator(stream).random(1000).tolist()
    assert state.tolist() == stream.state["state"]["state"].tolist()
