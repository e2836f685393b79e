"""Bounds of the intensity where light goes round: never violated, and nearly reached."""

import warnings

import numpy as np
import pytest

import amplifying
import lossless
import nearly_closed
import optipath as op
from random_matrices import jones, of_jones, unit_vectors
from random_paths import Draw
from tables import rows, slow_except
from wired import wired


class AnyJones(op.Element):
    """The Jones matrix in the first eight entries of what is given for it."""

    physical = False
    parts: op.fields.MuellerMatrix

    @staticmethod
    def jones_rows(_, a, b, c, d, e, f, g, h, *others):
        return ((a, b), (c, d)), ((e, f), (g, h + 0.0 * sum(others)))


def ring(element, inside, behind, share, state=None):
    """Light let into a ring of elements by a combiner, out of it by a splitter, and filtered."""
    names = [f"M{i}" for i in range(inside + behind)]
    row = {name: element(op.Parameter(name)) for name in names}
    lamp = op.Source(stokes=op.Parameter("state") if state is None else state)
    nodes = {"lamp": lamp, "join": op.Combiner(), "split": op.BeamSplitter(share), **row}
    way = ["lamp", "join", *names[1:inside], "split.transmitted", *names[inside:], "eye"]
    ends = [each.partition(".")[0] for each in way[1:]]
    links = [f"{start} -> {end}" for start, end in zip(way, ends, strict=False)]
    links += [f"split.reflected -> {names[0]}", f"{names[0]} -> join"]
    nodes["eye"] = op.Detector(reads="intensity")
    return wired(nodes, ", ".join(links), loops="sum"), names


def pure(J):
    """What `AnyJones` is given for Jones matrices (..., 1, 2, 2)."""
    flat = J.reshape(*J.shape[:-3], 4)
    parts = np.stack([flat.real, flat.imag], axis=-1).reshape(*flat.shape[:-1], 8)
    return np.concatenate([parts, 0.0 * parts], axis=-1).reshape(*flat.shape[:-1], 4, 4)


def depolarizing(J):
    return of_jones(J).sum(axis=-3)


KINDS = {
    "pure": (AnyJones, pure, 1),
    "depolarizing": (lambda M: op.MuellerElement(M, physical=False), depolarizing, 2),
}


def passive(J):
    """Jones matrices (..., terms, 2, 2) scaled so that the brightest light stays as it is."""
    M = depolarizing(J)
    gain = M[..., 0, 0] + np.linalg.norm(M[..., 0, 1:], axis=-1)
    return J / np.sqrt(gain)[..., np.newaxis, np.newaxis, np.newaxis]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("end", ["lower", "upper"])
@pytest.mark.parametrize("inside", slow_except([1, 2], [1, 2, 3]))
@rows("behind, share", [(0, 0.2), (1, 0.8), (1, 0.99)])
def test_no_elements_of_a_loop_found_by_climbing_violate_a_bound(kind, end, inside, behind, share):
    element, given, terms = KINDS[kind]
    rng, count = np.random.default_rng([inside, behind]), 400
    path, names = ring(element, inside, behind, share)
    plan = op.Composer(engine="numpy").compose(path)

    def nearness(state, J):
        """How near the bound the intensity comes: at most 1."""
        values = dict(zip(names, map(given, J), strict=True), state=state)
        found, true = plan.certificate(**values), plan.run(**values).intensity
        assert np.all(found.lower * found.scalar <= true)
        assert np.all(true <= found.upper * found.scalar)
        if end == "upper":
            return true / (found.upper * found.scalar)
        return (1e-3 + found.lower) / (1e-3 + true / found.scalar)

    axes = rng.choice([0.0, 0.5, 0.999], (count, 1)) * unit_vectors(rng, count)
    state = np.concatenate([np.ones((count, 1)), axes], axis=-1)
    J = passive(jones(rng, len(names), count, terms))
    best = nearness(state, J)
    for step in np.geomspace(1.0, 1e-3, 15):
        tried = passive(J + step * jones(rng, len(names), count, terms))
        found = nearness(state, tried)
        better = found > best
        best[better], J[:, better] = found[better], tried[:, better]
    # One element is met on each round: nothing is known better.
    assert best.max() > (0.999 if (inside, behind) == (1, 0) else 0.02)


@rows("share", [0.3, 0.6, 0.9])
def test_rings_that_might_keep_light_have_no_upper_bound_whatever_cancels(share):
    """Rings that polarizing splitters close: with the best elements, more comes back than goes."""
    names, rng = ["A", "B", "C"], np.random.default_rng(5)
    nodes = {name: op.MuellerElement(op.Parameter(name), physical=False) for name in names}
    nodes |= {name: op.Combiner() for name in ("J", "K", "L")}
    nodes |= {name: op.PolarizingBeamSplitter() for name in ("P", "Q")}
    nodes |= {"S": op.BeamSplitter(share), "lamp": op.Source()}
    links = (
        "lamp -> J, J -> C, C -> S, S.transmitted -> eye, S.reflected -> K, K -> A, A -> P, "
        "P.reflected -> K, P.transmitted -> L, L -> Q, Q.reflected -> B, B -> L, Q.transmitted -> J"
    )
    path = wired({**nodes, "eye": op.Detector(reads="intensity")}, links, loops="sum")
    plan = op.Composer(engine="numpy").compose(path)
    matrices = depolarizing(passive(jones(rng, len(names), 100, 1)))
    values = dict(zip(names, matrices, strict=True))
    found, true = plan.certificate(**values), plan.run(**values).intensity
    assert np.all(found.lower * found.scalar <= true)
    assert np.all(true <= found.upper * found.scalar)


@rows("seed", range(60))
def test_no_certificate_of_a_path_with_loops_is_violated(seed):
    draw = Draw(seed)
    plan = op.Composer(model="full").compose(draw.path(loops=True))
    for name, light in plan.run_all(**draw.values).items():
        found = plan.certificate(name, **draw.values)
        assert np.all(found.lower * found.scalar <= light.intensity * (1.0 + 1e-13))
        assert np.all(light.intensity <= found.upper * found.scalar * (1.0 + 1e-13))


@pytest.mark.filterwarnings("ignore::optipath.errors.LoopWarning")
@rows("drawn", [lossless.networks, nearly_closed.networks, amplifying.networks])
def test_no_certificate_of_a_network_out_of_which_little_light_gets_is_violated(drawn):
    for network in drawn(25):
        plan = op.Composer(engine="numpy").compose(network.path)
        try:
            lights = plan.run_all()
        except op.errors.ParameterError:
            continue  # Light gains there.
        for name, light in lights.items():
            found = plan.certificate(name)
            assert np.isfinite(found.scalar)
            assert found.lower * found.scalar <= light.intensity * (1.0 + 1e-13)
            assert light.intensity <= found.upper * found.scalar * (1.0 + 1e-13)


def cavity(k=2.0):
    """Light that goes to and fro between two mirrors, one of which is turned."""
    mirror = op.Interface(op.Material(0.2, k), op.Parameter("b"), azimuth=op.Parameter("turn"))
    nodes = {"lamp": op.Source(), "join": op.Combiner(), "split": op.BeamSplitter(0.6)}
    nodes |= {"glass": op.Interface(1.5, op.Parameter("a")), "mirror": mirror}
    links = "lamp -> join, join -> split, split.reflected -> mirror, mirror.reflected -> glass"
    links += ", glass.reflected -> join, split.transmitted -> eye"
    return wired({**nodes, "eye": op.Detector(reads="intensity")}, links, loops="sum")


@rows("engine", ["auto", "numpy", "numba"])
@rows("size", [(), (5,), (3000,), (40, 1, 50)])
@rows("tolerance", [1e-4, 1e-3, 0.1])
def test_a_tolerated_intensity_of_a_loop_is_as_near_as_it_may_be(engine, size, tolerance):
    draw = np.random.default_rng(3).uniform
    values = {name: draw(0.0, 1.4, size) for name in ("a", "b", "turn")}
    exact = cavity().trace(**values).intensity
    plan = op.Composer(engine=engine, tolerance=tolerance, loops="sum").compose(cavity())
    assert plan.model == "scalar"
    found, certificate = plan.run(**values), plan.certificate(**values)
    assert np.all(np.abs(found.intensity - exact) <= tolerance * exact)
    beyond = certificate.error > tolerance
    np.testing.assert_allclose(found.intensity[beyond], exact[beyond], rtol=1e-13)
    np.testing.assert_allclose(found.intensity[~beyond], certificate.scalar[~beyond], rtol=1e-13)
    assert np.all(np.isnan(found.stokes[..., 1:]))


@rows("model", ["scalar", "sp", "linear"])
def test_models_by_name_are_tolerated_in_loops_and_else_refused_with_the_cure(model):
    values = {"a": np.linspace(0.0, 1.4, 300), "b": 0.3, "turn": 0.4}
    exact = cavity().trace(**values).intensity
    plan = op.Composer(model=model, tolerance=0.01).compose(cavity())
    assert plan.model == model
    assert np.all(np.abs(plan.run(**values).intensity - exact) <= 0.01 * exact)
    with pytest.raises(op.errors.ComposerError, match="give a tolerance, and let all read"):
        op.Composer(model=model).compose(cavity())


def test_explain_and_polarization_tell_the_bounds_of_a_loop():
    path = cavity().bind(a=0.9, b=0.3, turn=0.5)
    found, certificate = op.polarization(path), path.compose().certificate()
    for bound in ("lower", "upper"):
        one, other = (getattr(each, bound) for each in (found.certificate, certificate))
        assert one == pytest.approx(other, rel=1e-12)
    assert certificate.lower < 1.0 + found.difference < certificate.upper
    text = f"at eye, S0 is {certificate.lower:.6g} .. {certificate.upper:.6g} of the scalar model's"
    assert text in path.compose().explain()


def test_light_that_hardly_leaves_a_loop_has_wider_bounds_and_such_that_stays_none():
    ring_of = {"lamp": op.Source(), "join": op.Combiner(), "eye": op.Detector(reads="intensity")}
    links = "lamp -> join, join -> split, split.reflected -> dim, dim -> join"
    for left in (1e-3, 1e-9, 1e-13):
        dim = op.Attenuator(1.0 - left)
        nodes = {**ring_of, "split": op.BeamSplitter(1.0 - left), "dim": dim}
        path = wired(nodes, f"{links}, split.transmitted -> eye", loops="sum")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", op.errors.LoopWarning)
            found, true = path.compose().certificate(), path.trace().intensity
        assert found.lower * found.scalar <= true <= found.upper * found.scalar
    closed = {**ring_of, "split": op.BeamSplitter(1.0), "dim": op.Rotator(0.2)}
    path = wired(closed, f"{links}, split.transmitted -> eye", loops="sum")
    with pytest.raises(op.errors.ParameterError, match="never fades"):
        path.compose().certificate()
    divided = {**ring_of, "split": op.PolarizingBeamSplitter(), "dim": op.Rotator(0.2)}
    path = wired(divided, f"{links}, split.transmitted -> eye", loops="sum")
    found = path.compose().certificate()
    assert (found.lower, found.upper) == (0.0, np.inf)
    assert op.Composer(tolerance=0.5).compose(path).run() == path.trace()
