"""What a path says of sweeps where xarray is not installed."""

import subprocess
import sys

import pytest


def test_without_xarray_one_sentence_names_the_extra():
    program = (
        "import sys; sys.modules['xarray'] = None; import optipath as op; "
        "op.load_preset('malus').sweep(angle=[0.1, 0.2])"
    )
    ended = subprocess.run(  # Since what is imported here stays.
        [sys.executable, "-c", program], capture_output=True, text=True, check=False
    )
    assert ended.stderr.splitlines()[-1] == (
        "optipath.errors.MissingExtraError: "
        'sweeps need xarray, which is not installed; pip install "optipath[sweep]"'
    )


@pytest.mark.parametrize(
    ("call", "brought"),
    [("path.trace(angle=0.1)", set()), ("path.sweep(angle=[0.1, 0.2]).DoP.values", {"xarray"})],
)
def test_what_a_call_imports_of_the_extra(call, brought):
    if brought:
        pytest.importorskip("xarray")
    code = (
        # Where Dask is installed, xarray itself imports it.
        f"import sys; sys.modules['dask'] = None; import optipath as op; "
        f"path = op.load_preset('malus'); {call}; "
        f"print(*[n for n in ('xarray', 'zarr', 'distributed') if n in sys.modules])"
    )
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert set(told.stdout.split()) == brought
