"""The call as a whole: options, detectors, engines, and the answer as a text."""

import subprocess
import sys

import numpy as np
import pytest

import optipath as op
from optipath.errors import MissingExtraError
from optipath.values.arrays import memory
from tables import rows


def malus():
    return op.load_preset("malus")


@pytest.fixture
def _without_jax(monkeypatch):
    monkeypatch.setitem(sys.modules, "jax", None)


@pytest.mark.usefixtures("_without_jax")
def test_without_jax_slopes_are_by_differences_and_it_says_so():
    assert malus().propagate(angle=(0.5, 0.01)).method == "differences"


@pytest.mark.usefixtures("_without_jax")
def test_gradients_without_jax_say_what_brings_it():
    with pytest.raises(MissingExtraError, match=r"optipath\[jax\]"):
        malus().propagate(angle=(0.5, 0.01), method="gradients")


def test_with_jax_slopes_are_by_jax_and_it_says_so():
    pytest.importorskip("jax")
    assert malus().propagate(angle=(0.5, 0.01)).method == "gradients by JAX"


class Untraced(op.Element, kind="untraced"):
    """A polariser of one's own that looks at its angle, which JAX does not know."""

    angle: op.Angle = 0.0

    @staticmethod
    def mueller_rows(xp, angle):
        c = float(np.cos(angle)) ** 2
        return (c, 0, 0, 0), (0, c, 0, 0), (0, 0, c, 0), (0, 0, 0, c)


def test_a_path_that_jax_does_not_trace_has_differences_and_it_says_so():
    pytest.importorskip("jax")
    path = op.Source() >> Untraced(op.Parameter("a")) >> op.Detector()
    found = path.propagate(a=(0.5, 0.01))
    assert found.method == "differences, since JAX does not trace this path"
    np.testing.assert_allclose(found.uncertainty_of("S0"), 0.01 * np.sin(1.0), rtol=1e-9)
    with pytest.raises(op.ParameterError, match="write method='differences'"):
        path.propagate(a=(0.5, 0.01), method="gradients")


def test_a_long_path_has_differences_where_jax_would_take_long_and_it_says_so():
    pytest.importorskip("jax")
    pile = op.load_preset("pile-of-plates")
    found = pile.propagate(n=(1.5, 0.01))
    assert found.method.startswith("differences, since JAX takes long for 1,0")


def test_importing_what_propagates_brings_neither_jax_nor_xarray():
    code = "import optipath as op; op.load_preset('malus').propagate(angle=(0.5, 0.01), "
    code += "method='differences'); import sys; print({'jax', 'xarray', 'dask'} & {*sys.modules})"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "set()\n"


def split():
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(op.Parameter("i")))
    cube = path.add("cube", op.BeamSplitter(op.Parameter("t", 0.3)))
    lamp >> cube
    path.add("ahead", op.Detector())
    path.add("aside", op.Detector())
    path.connect("cube.transmitted", "ahead")
    path.connect("cube.reflected", "aside")
    return path


def test_one_of_several_detectors_is_named():
    path = split()
    with pytest.raises(op.ParameterError, match=r"use propagate\(detector='ahead', \.\.\.\)"):
        path.propagate(i=(2.0, 0.1), method="differences")
    for name, light in path.trace_all(i=2.0).items():
        if name in ("ahead", "aside"):
            found = path.propagate(detector=name, i=(2.0, 0.1), method="differences")
            assert found.light == light
            np.testing.assert_allclose(found.uncertainty_of("S0"), 0.05 * light.intensity)


@rows("method", ["differences", "monte-carlo"])
@rows("options", [{"dtype": "float32"}, {"composing": "jones"}])
def test_a_composer_is_asked_for_the_light(method, options):
    composer = op.Composer(**options)
    found = malus().propagate(angle=(0.5, 0.01), method=method, composer=composer)
    assert found.light == composer.compose(malus()).run(angle=0.5)
    rough = {"rtol": 1e-9 if method == "differences" else 0.05}
    np.testing.assert_allclose(found.uncertainty_of("S0"), 0.005 * np.sin(1.0), **rough)


@rows(
    "options, words",
    [
        ({"method": "gradient"}, "did you mean 'gradients'?"),
        ({"method": np.eye(2)}, "is unknown"),
        ({"samples": 100}, "draws no samples; leave samples out, or write method='monte-carlo'"),
        ({"method": "monte-carlo", "samples": 1}, "within 2 .. 10,000,000, not 1"),
        ({"method": "monte-carlo", "seed": -1}, "seed must be a whole number of 0 or more"),
        ({"composer": "numpy"}, "composer must be an op.Composer(...)"),
        ({"detector": "nose"}, "detector 'nose' does not exist"),
    ],
)
def test_what_is_no_option_is_refused(options, words):
    with pytest.raises(op.ParameterError) as fault:
        malus().propagate(angle=(0.5, 0.01), **options)
    assert words in str(fault.value)


def test_a_parameter_that_is_called_as_an_option_is_told_with_a_cure_that_works():
    path = op.Source(op.Parameter("seed")) >> op.Attenuator(op.Parameter("t")) >> op.Detector()
    with pytest.raises(op.ParameterError, match=r"path\.bind\(seed=\.\.\.\)") as fault:
        path.propagate(t=(0.5, 0.1), seed=3)
    assert len(fault.value.faults) == 1
    found = path.bind(seed=3.0).propagate(t=(0.5, 0.1), method="differences")
    np.testing.assert_allclose(found.uncertainty_of("S0"), 0.3)


def test_more_than_the_machine_has_memory_for_is_refused(monkeypatch):
    monkeypatch.setattr(memory, "memory", lambda: 2**26)
    angles = np.linspace(0.1, 1.0, 70_000)
    with pytest.raises(op.ParameterError, match=r"paths, .* give fewer values at a time"):
        malus().propagate(angle=(angles, 0.1), method="differences")


def test_a_quantity_that_is_none_is_refused():
    found = malus().propagate(angle=(0.5, 0.01), method="differences")
    with pytest.raises(op.ParameterError, match="did you mean 'intensity'"):
        found.uncertainty_of("intensty")


def test_the_answer_is_a_table():
    found = malus().propagate(
        angle=("30 deg", "0.1 deg"), intensity=(1.0, 0.002), method="differences"
    )
    lines = str(found).splitlines()
    assert lines[0] == "differences: angle = 30 deg +- 0.1 deg; intensity = 1 +- 0.002"
    assert lines[1].split() == ["value", "uncertainty", "angle", "intensity"]
    assert lines[2].split() == ["S0", "0.3750", "0.0011", "50", "%", "50", "%"]
    assert lines[8].split() == ["AoP", "30.00", "deg", "0.10", "deg", "100", "%", "0", "%"]
    assert len(lines) == 12


def test_the_table_of_a_batch_says_from_where_to_where():
    found = malus().propagate(angle=(["30 deg", "45 deg"], "0.1 deg"), method="differences")
    lines = str(found).splitlines()
    assert lines[0] == "differences, shape (2,): angle, shape (2,)"
    assert "0.25 .. 0.375" in lines[2]


def test_notes_stand_below_the_table():
    found = malus().propagate(angle=("0 deg", "1 deg"), method="differences")
    assert str(found).splitlines()[12:] == list(found.notes)
