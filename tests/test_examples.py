"""The examples, run as their users run them."""

import json
import runpy
from itertools import islice
from pathlib import Path

import numpy as np
import pytest

import optipath as op
from pictures import faults_of
from tables import slow

EXAMPLES = Path(__file__).parents[1] / "examples"
pytest.importorskip("jax")


@pytest.fixture
def example():
    import jax  # noqa: PLC0415 - an extra

    yield runpy.run_path(EXAMPLES / "index_from_stokes.py")
    jax.config.update("jax_enable_x64", False)  # noqa: FBT003 - as JAX has it


@pytest.mark.parametrize(
    "index", [[0.608, 2.12], *map(slow, ([0.17, 3.15], [1.5, 0.2], [2.4, 0.1]))], ids=str
)
def test_the_index_comes_back_from_light_without_noise(example, index):
    measured = example["ellipsometer"]().trace(n=index[0], k=index[1]).stokes
    found, _ = example["index_from"](measured)
    np.testing.assert_allclose(found, index, rtol=0, atol=1e-6)


def test_metals_with_little_n_over_k_hardly_polarise_and_glass_does():
    example = runpy.run_path(EXAMPLES / "when_polarization_matters.py")
    largest = {name: share for name, _, share in example["rows"]()}
    assert largest["silver"] < 2e-4 < largest["gold"] < 0.01 < largest["copper"] < 0.1
    assert 0.3 < largest["iron"] < 0.6
    assert largest["glass"] == pytest.approx(1.0, abs=1e-3)


@pytest.mark.usefixtures("jax")
def test_the_example_prints_an_index_within_its_deviations(capsys):
    # As a text: it becomes sys.argv[0], and old versions of JAX look there for flags.
    runpy.run_path(str(EXAMPLES / "index_from_stokes.py"), run_name="__main__")
    assert capsys.readouterr().out.startswith("n = 0.6")


def test_the_convergence_of_surfaces_is_measured_with_all_light_accounted_for():
    pytest.importorskip("numba")
    example = runpy.run_path(EXAMPLES / "surface_convergence.py")
    case = example["Case"]("1j", 1.0, 0.5, lengths=10, cells=4, waves=100, surfaces=2)
    found = example["measured"](case)
    assert found["R_s"][0] + found["R_m"][0] == pytest.approx(1.0, abs=1e-6)
    assert found["R_m"][0] > 10.0 * found["R_m"][1] > 0.0


def test_independent_waves_are_drawn_with_the_variances_of_their_paper():
    example = runpy.run_path(EXAMPLES / "surface_convergence.py")
    squares = [
        (np.mean(drawn**2), np.mean((np.diff(drawn) * 2.5) ** 2))
        for drawn in (example["heights"](20, 5, 1000, "independent", n, 0) for n in range(8))
    ]
    # E. Heitz (2015): the variance of heights is 1, and of slopes 1/2 at alpha 1; the cells are
    # 0.4 wide, and a field differs from others by a tenth of it.
    np.testing.assert_allclose(np.mean(squares, axis=0), (1.0, 0.5), rtol=0.1)


def test_the_documents_have_every_case_of_the_convergence_of_surfaces():
    example = runpy.run_path(EXAMPLES / "surface_convergence.py")
    stored = json.loads((EXAMPLES.parent / "docs" / "surfaces.json").read_text("utf-8"))
    assert {example["Case"](*row["case"]) for row in stored} == set(example["CASES"])


def test_the_virtual_ellipsometer_tells_the_polarisation_that_smooth_facets_make():
    pytest.importorskip("matplotlib")
    pytest.importorskip("xarray")
    example = runpy.run_path(EXAMPLES / "rough_ellipsometer.py")
    gold = complex(op.load_sample(example["SAMPLE"]).indices(example["WAVELENGTH"]).base)
    matrix = op.Interface(gold, "50 deg").mueller("in", "reflected").matrix
    found, expected = example["of_matrix"](matrix[np.newaxis]), matrix @ [1.0, 0.0, 1.0, 0.0]
    facets = example["of_smooth_facets"](45, np.array([55.0]))
    np.testing.assert_allclose(found, facets, rtol=0, atol=1e-11)
    assert found[0, 1, 0] == pytest.approx(np.hypot(expected[1], expected[2]) / expected[0])


@pytest.mark.parametrize("count", [1, pytest.param(None, marks=pytest.mark.report)])
@pytest.mark.parametrize(
    ("script", "given"),
    [
        ("hemisphere_maps", {"photons": 2048, "pixels": 24}),
        ("pictures_in_space", {}),
        ("pictures_of_light", {}),
        ("pictures_of_curves", {}),
    ],
)
def test_no_text_in_the_pictures_of_an_example_is_over_another_or_cut(script, given, count):
    pytest.importorskip("matplotlib")
    for extra in ("numba", "xarray") if given else ():
        pytest.importorskip(extra)
    example = runpy.run_path(EXAMPLES / f"{script}.py")
    for name, drawn in islice(example["pictures"](**given), count):
        one = drawn.flat[0] if hasattr(drawn, "flat") else drawn
        assert faults_of(getattr(one, "figure", one)) == [], name
        assert (EXAMPLES.parent / "docs" / f"{name}.png").exists()
