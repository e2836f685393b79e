"""What a job may say of itself: all that is wrong is told before a store is made."""

import re
from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip("zarr")

from optipath.errors import JobError
from optipath.sweeps.blocks.block_job import KeptArray, WholeArray
from optipath.sweeps.blocks.keep_blocks import keep_blocks

ARRAY = KeptArray(("x",), (6,), (2,))


def job_with(**other):
    usual = {"identity": "a", "blocks": 3, "arrays": {"a": ARRAY}, "coords": {}, "attrs": {}}
    return SimpleNamespace(**(usual | other))


@pytest.mark.parametrize(
    ("other", "told"),
    [
        ({"identity": 3}, "identity is 3; give a text"),
        ({"blocks": -1}, "blocks is -1; give a whole number"),
        ({"blocks": 2.5}, "blocks is 2.5; give a whole number"),
        ({"arrays": {}}, "arrays are none"),
        ({"arrays": {"blocks": ARRAY}}, "array 'blocks' cannot be called so"),
        ({"arrays": {"a/b": ARRAY}}, "array 'a/b' cannot be called so"),
        ({"coords": {"a": WholeArray(("x",), np.zeros(6))}}, "array 'a' is called as a coord"),
        ({"arrays": {"a": ARRAY._replace(dims=("x", "y"))}}, "has 2 dims, a shape of 1 and chu"),
        ({"arrays": {"a": ARRAY._replace(chunks=(0,))}}, "array 'a' has chunks (0,); give whole"),
        ({"arrays": {"a": ARRAY._replace(shape=(6.5,))}}, "array 'a' has shape (6.5,); give w"),
        ({"arrays": {"a": ARRAY._replace(dtype="flot")}}, "array 'a' has dtype 'flot'; give one"),
        ({"arrays": {"a": ARRAY._replace(attrs={"n": np.ones(2)})}}, "attribute 'n'"),
        ({"arrays": {"a": KeptArray(("x", "x"), (6, 6), (2, 2))}}, "each once"),
        ({"coords": {"x": WholeArray(("x",), np.zeros(5))}}, "coordinate 'x' has 5 along 'x', w"),
        ({"coords": {"x": WholeArray(("x",), [1, 2])}}, "coordinate 'x' has the values"),
        ({"coords": {"x": WholeArray((), np.zeros(6))}}, "has 0 dims for values of shape (6,)"),
        ({"attrs": {"n": {1}}}, "the job has the attribute 'n'"),
    ],
)
def test_what_cannot_be_kept_is_told_and_no_store_is_made(tmp_path, other, told):
    with pytest.raises(JobError, match=re.escape(told)):
        keep_blocks(job_with(**other), tmp_path / "a.zarr")
    assert not [*tmp_path.iterdir()]
