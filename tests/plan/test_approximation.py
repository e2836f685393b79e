import pickle

import numpy as np
import pytest

import optipath as op
from paths import chain
from random_paths import Draw
from tables import rows


def two_panes(n=1.5, k=0.0, reads="intensity"):
    """Unpolarised light on two interfaces, the second turned."""
    material = op.Material(n, k)
    elements = [
        op.Interface(material, op.Parameter("a")),
        op.Interface(material, op.Parameter("b"), azimuth=op.Parameter("turn")),
    ]
    return chain(elements, reads=reads)


@rows("seed", range(150))
def test_no_certificate_is_violated_by_any_path(seed):
    draw = Draw(seed)
    path = draw.path()
    plan = op.Composer(model="full").compose(path)
    for name, light in plan.run_all(**draw.values).items():
        found = plan.certificate(name, **draw.values)
        lit = found.scalar > 0.0
        ratio = light.intensity[lit] / found.scalar[lit]
        assert np.all(found.lower[lit] <= ratio + 1e-13)
        assert np.all(ratio <= found.upper[lit] + 1e-13)
        assert np.all(light.intensity[~lit] == 0.0)


@rows("size", [(), (5,), (3000,), (70_000,), (40, 1, 50)])
@rows("tolerance", [1e-4, 0.01, 0.3])
def test_a_tolerated_intensity_is_as_near_as_it_may_be(size, tolerance):
    draw = np.random.default_rng(3).uniform
    values = {name: draw(0.0, 1.4, size) for name in ("a", "b", "turn")}
    path = two_panes()
    plan = op.Composer(tolerance=tolerance).compose(path)
    exact = path.trace(**values).intensity
    found = plan.run(**values)
    assert found.stokes.shape == (*size, 4)
    assert np.isnan(found.stokes[..., 1:]).all()
    assert np.all(np.abs(found.intensity - exact) <= tolerance * exact)
    certificate = plan.certificate(**values)
    beyond = certificate.error > tolerance
    np.testing.assert_allclose(found.intensity[beyond], exact[beyond], rtol=1e-14)
    np.testing.assert_array_equal(found.intensity[~beyond], certificate.scalar[~beyond])


@rows("size", [(), (5,), (3000,)])
def test_each_of_several_tolerated_intensities_is_as_near_as_it_may_be(rng, size):
    path = op.PathGraph()
    path.add("lamp", op.Source()) >> path.add("first", op.Interface(1.5, op.Parameter("a")))
    ways = ("reflected", 1.0, 0.3), ("transmitted", 1.5, op.Parameter("turn"))
    for way, medium, turn in ways:
        pane = op.Interface(2.0, op.Parameter("b"), outside=medium, azimuth=turn)
        path.add(f"pane {way}", pane)
        path.add(f"eye {way}", op.Detector("intensity"))
        path.connect(f"first.{way}", f"pane {way}.in")
        path.connect(f"pane {way}.reflected", f"eye {way}.in")
    plan = op.Composer(tolerance=0.1).compose(path)
    for most in (0.3, 1.4):
        values = {name: rng.uniform(0.1, most, size) for name in ("a", "b", "turn")}
        exact, found = path.trace_all(**values), plan.run_all(**values)
        bounds = {name: plan.certificate(name, **values) for name in found}
        near = np.max([each.error for each in bounds.values()], axis=0) <= 0.1
        for name, light in found.items():
            wanted = exact[name].intensity
            assert np.all(np.abs(light.intensity - wanted) <= 0.1 * wanted)
            expected = np.where(near, bounds[name].scalar, wanted)
            np.testing.assert_allclose(light.intensity, expected, rtol=1e-13)


def test_the_certificate_of_two_interfaces_is_reached():
    path = two_panes()
    values = {"a": 0.7, "b": 0.7}
    aligned, crossed = (path.trace(turn=turn, **values).intensity for turn in (0.0, np.pi / 2))
    found = path.compose().certificate(turn=0.3, **values)
    assert aligned == pytest.approx(found.upper * found.scalar, rel=1e-12)
    assert crossed == pytest.approx(found.lower * found.scalar, rel=1e-12)


@rows("model", ["sp", "linear"])
def test_a_model_by_name_may_be_tolerated_too(model):
    metal = op.Material(0.2, 3.0)
    elements = [op.Interface(metal, op.Parameter("a"), azimuth=0.4) for _ in range(4)]
    path = chain(elements, reads="intensity")
    assert path.compose().model == "full"
    values = {"a": np.linspace(0.0, 1.5, 400)}
    exact = path.trace(**values).intensity
    plan = op.Composer(model=model, tolerance=0.05).compose(path)
    assert plan.model == model
    found = plan.run(**values).intensity
    assert np.all(np.abs(found - exact) <= 0.05 * exact)
    assert np.any(found != exact)


def test_where_more_is_read_than_the_intensity_the_plan_stays_exact():
    path = two_panes(k=2.0, reads="stokes")
    plan = op.Composer(tolerance=0.5).compose(path)
    assert plan.model == "full"
    assert "certificates are for intensities" in plan.explain()
    with pytest.raises(op.ComposerError, match="'eye' reads more"):
        op.Composer(model="scalar", tolerance=0.5).compose(path)


@rows("tolerance", [0, 1.0, -0.1, "0.1", True, np.nan])
def test_tolerances_that_cannot_be_are_refused(tolerance):
    with pytest.raises(op.ComposerError, match="tolerance must be a number between 0 and 1"):
        op.Composer(tolerance=tolerance)


@rows("options", [{"model": "full"}, {"composing": "jones"}])
def test_a_tolerance_beside_what_is_exact_is_refused(options):
    with pytest.raises(op.ComposerError, match="takes no tolerance"):
        op.Composer(tolerance=0.1, **options)


def test_tolerated_plans_stream_and_can_be_pickled():
    plan = op.Composer(tolerance=0.02).compose(two_panes())
    plan = pickle.loads(pickle.dumps(plan))
    axes = {"a": np.linspace(0, 1.4, 40)[:, np.newaxis], "b": np.linspace(0, 1.4, 50), "turn": 0.2}
    whole = plan.run(**axes).intensity
    parts = np.full(whole.shape, np.nan)
    for part in plan.stream(300, **axes):
        parts[part.where] = part.light.intensity
    np.testing.assert_allclose(parts, whole, rtol=1e-14)


def test_faint_light_and_values_out_of_range_are_left_to_the_exact_model():
    elements = [op.Attenuator(1e-200), op.Attenuator(op.Parameter("t")), op.Interface(1.5, 0.7)]
    path = chain([*elements, op.Interface(1.5, 0.7)], reads="intensity")
    plan = op.Composer(tolerance=0.5).compose(path)
    light, exact = plan.run(t=[1e-200, 0.5]), path.trace(t=[1e-200, 0.5])
    np.testing.assert_allclose(light.log10_intensity, exact.log10_intensity, rtol=0, atol=0.3)
    plan = op.Composer(tolerance=0.1).compose(two_panes())
    with pytest.raises(op.ParameterError, match="'a'"):
        plan.run(a=3.0, b=0.1, turn=0.0)


@rows("size", [(), (3000,)])
def test_tolerated_light_has_the_precision_of_the_plan(size):
    plan = op.Composer(tolerance=0.05, dtype="float32").compose(two_panes())
    values = {"a": np.linspace(0.0, 1.2, 3000) if size else 0.2, "b": 0.3, "turn": 0.3}
    assert plan.run(**values).stokes.dtype == np.float32
