"""Light that goes round: slabs, coats and networks against closed forms and 50 digits."""

import numpy as np
import pytest
from mpmath import mp

import optipath as op
from lossless import networks
from optipath.lab.path_reference import exact_lights
from slabs import slab
from tables import rows, slow

# Light in front of n = 1.5 over 0.608 + 2.12i at 40 deg: A, B, C and S of the sum over all
# rounds, r + t^2 q / (1 - r q) for s, for p and for r_s conj(r_p), in mpmath with 50 digits.
COATED = (
    0.60082614317502016002697448579132125379652501914558,
    0.04379325845130331487061167698178628296673720688986,
    -0.56399840020557617714082243542759277962432665496713,
    0.14233991458225464946225168719640066294691353412397,
)


def closed_slab(n, theta):
    """S0 and S1 of unpolarised light behind a slab: (1 - F) / (1 + F) for s and p, in 50 digits."""
    with mp.workdps(50):
        c, s = mp.cos(theta), mp.sin(theta)
        g = mp.sqrt(n * n - s * s)
        powers = abs((c - g) / (c + g)) ** 2, abs((n * n * c - g) / (n * n * c + g)) ** 2
        along, across = ((1 - F) / (1 + F) for F in powers)
        return float((along + across) / 2), float((along - across) / 2)


def ring(kept, *between):
    """Light of a lamp that a splitter lets out, or keeps; what it keeps meets all between."""
    path = op.PathGraph(loops="sum")
    node = path.add("lamp", op.Source()) >> path.add("join", op.Combiner())
    for element in between:
        node = node >> element
    path.add("split", op.BeamSplitter(kept))
    node >> path["split.in"]
    path["split.reflected"] >> path["join"]
    path["split.transmitted"] >> path.add("eye", op.Detector())
    return path


def gap(theta, lit="front.in"):
    """Air between glass, lit from either side."""
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source(1.0, [1.0, 0.3, -0.5, 0.6]))
    path.add("front", op.Interface(1.0, theta, outside=1.5))
    path.add("back", op.Interface(1.5, theta, outside=1.0, incidence_in=1.5))
    path["front.transmitted"] >> path["back.in"]
    path["back.reflected"] >> path["front.back"]
    path["lamp"] >> path[lit]
    path["front.reflected"] >> path.add("R", op.Detector())
    path["back.transmitted"] >> path.add("T", op.Detector())
    return path


def test_slabs_and_coats_are_their_closed_series():
    rng = np.random.default_rng(0)
    theta = np.concatenate([np.linspace(0, 1.57, 200), rng.uniform(0, 1.57, 200)])
    path = slab(1.5, op.Parameter("theta"))
    expected = np.array([closed_slab(mp.mpf(1.5), mp.mpf(t)) for t in theta])
    for engine in ("numpy", "numba"):
        found = op.Composer(engine=engine).compose(path).run_all(theta=theta)
        np.testing.assert_allclose(found["T"].stokes[:, :2], expected, rtol=1e-14, atol=1e-15)
        np.testing.assert_allclose(found["R"].intensity, 1 - expected[:, 0], rtol=1e-14, atol=1e-15)
    lights = slab(1.5, np.pi / 2).trace_all()
    assert (lights["R"].intensity, lights["T"].intensity) == (1.0, 0.0)
    theta = float(np.radians(40))
    coated = slab(1.5, theta, behind=0.608 + 2.12j)
    A, B, C, S = COATED
    expected = [[A, B, 0, 0], [B, A, 0, 0], [0, 0, C, S], [0, 0, -S, C]]
    found = coated.mueller("lamp", "R").matrix
    np.testing.assert_allclose(found, expected, rtol=4e-15, atol=1e-17)
    stack = op.LayerStack([1.0, 1.5, 0.608 + 2.12j], theta)
    for leaves, end in (("reflected", "R"), ("transmitted", "T")):
        found, expected = coated.mueller("lamp", end), stack.mueller("in", leaves)
        np.testing.assert_allclose(found.matrix, expected.matrix, rtol=1e-15, atol=4e-16)
    grey = op.Medium(length=0.01, absorption=30.0)
    found = slab(1.5, 0.0, medium=grey).trace_all()["T"].intensity
    F, t = 0.04, np.exp(-0.3)
    assert found == pytest.approx((1 - F) ** 2 * t / (1 - F * F * t), rel=1e-14)


@pytest.mark.filterwarnings("ignore::optipath.errors.LoopWarning")
@rows("apart", [1e-3, 1e-5])
def test_a_slab_keeps_its_digits_next_to_grazing_incidence(apart):
    theta = float(np.pi / 2 - apart)
    found = slab(1.5, theta).trace(keep="all")["T"].stokes
    expected = closed_slab(mp.mpf(1.5), mp.mpf(theta))
    np.testing.assert_allclose(found[:2], expected, rtol=1e-11 * 1e-5 / apart + 1e-14)


@pytest.mark.filterwarnings("ignore::optipath.errors.LoopWarning")
@pytest.mark.parametrize("count", [20, slow(150)])
def test_no_energy_gets_lost_in_networks_without_losses(count):
    for network in networks(count):
        total = sum(light.intensity for light in network.path.trace_all().values())
        assert total == pytest.approx(network.emitted, rel=1e-13)


@pytest.mark.parametrize("count", [8, slow(25)])
def test_outlets_count_among_what_leaves_and_networks_are_right_in_all_components(count):
    for network in networks(count, first=1000, size=(1, 4)):
        lights, exact = network.path.trace_all(), exact_lights(network.path)
        for name, light in lights.items():
            expected = np.array([float(part) for part in exact[name].stokes])
            np.testing.assert_allclose(light.stokes, expected, rtol=0, atol=4e-15 * network.emitted)
    path = slab(1.5, 1.0)
    path.remove("R")
    assert path.compose().outlets == ("front.reflected",)
    kept = path.trace(keep="all")
    total = kept["T"].intensity + kept["front.reflected"].intensity
    assert total == pytest.approx(1.0, rel=1e-15)


@pytest.mark.parametrize("engine", ["numpy", slow("numba"), slow("jax")])
def test_engines_agree_on_light_that_goes_round(engine):
    pytest.importorskip(engine)
    n, theta = op.Parameter("n"), op.Parameter("theta")
    path = slab(n, theta, behind=0.608 + 2.12j, state=[1, 0.3, 0.4, 0.5])
    given = {"n": np.linspace(1.1, 2.2, 2000), "theta": np.linspace(0, 1.5, 2000)}
    first = op.Composer(engine="numpy").compose(path).run_all(**given)["R"].stokes
    found = op.Composer(engine=engine).compose(path).run_all(**given)["R"].stokes
    np.testing.assert_allclose(np.asarray(found), first, rtol=0, atol=4e-15)
    one = path.trace_all(n=float(given["n"][7]), theta=float(given["theta"][7]))["R"]
    np.testing.assert_allclose(one.stokes, first[7], rtol=0, atol=4e-15)


def test_every_model_and_precision_gives_the_same_light():
    path = slab(1.5, 0.8, state=[1, 0.3, 0.4, 0.5], medium=op.Rotator(0.3))
    auto, full = (op.Composer(model=model).compose(path).run_all() for model in ("auto", "full"))
    for name, light in auto.items():
        np.testing.assert_allclose(light.stokes, full[name].stokes, rtol=0, atol=1e-15)
    assert op.Composer().compose(slab(1.5, 0.8)).model == "sp"
    theta, path = np.linspace(0, 1.5, 100, dtype=np.float32), slab(1.5, op.Parameter("theta"))
    single = op.Composer(dtype="float32", engine="numpy").compose(path).run_all(theta=theta)["T"]
    double = path.trace_all(theta=theta)["T"]
    np.testing.assert_allclose(single.stokes, double.stokes, rtol=0, atol=1e-6)


def test_faint_light_goes_round_as_well():
    bright, path = slab(1.5, 0.5), slab(1.5, 0.5)
    path.disconnect("lamp.out", "front.in")
    before = "lamp.out"
    for i in range(24):  # So long a chain is carried scaled.
        path.add(f"grey{i}", op.Attenuator(1e-12))
        path.connect(before, f"grey{i}.in")
        before = f"grey{i}.out"
    path.connect(before, "front.in")
    found, expected = path.trace_all()["T"], bright.trace_all()["T"]
    np.testing.assert_allclose(found.normalized, expected.normalized, rtol=0, atol=1e-15)
    assert found.log10_intensity == pytest.approx(expected.log10_intensity - 288, abs=1e-9)


def test_loops_and_jones_columns_are_refused_where_they_cannot_be():
    path = slab(1.5, 0.5)
    assert op.PathGraph().loops == "refuse"
    with pytest.raises(op.errors.PathError, match="loops 'add' is unknown"):
        op.PathGraph(loops="add")
    for refused, told in (
        (lambda: op.Composer(loops="refuse").compose(path), r"back -> front -> back; .*='sum'"),
        (lambda: op.Composer(loops="add"), "loops 'add' is unknown"),
        (lambda: op.Composer(composing="jones").compose(path), r"'front\.transmitted'.*stokes"),
    ):
        with pytest.raises(op.OptipathError, match=told):
            refused()


def test_a_gain_of_one_or_more_is_an_error_alone_and_among_many():
    for gain in (1.0, 1.5):
        path = ring(0.5, op.MuellerElement(np.eye(4) * gain * 2, physical=False))
        for run in (path.trace, path.mueller):
            with pytest.raises(op.errors.ParameterError, match=r"'join\.in' never fades"):
                run()
    path, kept = ring(op.Parameter("kept")), np.linspace(0.0, 0.5, 70_000)
    np.testing.assert_allclose(path.trace(kept=kept).intensity, 1.0, rtol=1e-14)
    kept[1234] = 1.0
    with pytest.raises(op.errors.ParameterError, match="never fades"):
        path.trace(kept=kept)


def test_next_to_a_gain_of_one_nothing_gets_lost_and_it_is_warned_of():
    warned = r"all but 1e-05 comes back .* condition number .* 2e\+05"
    with pytest.warns(op.errors.LoopWarning, match=warned):
        light = ring(0.99999).trace()
    # All of it leaves in the end.
    assert light.intensity == pytest.approx(1.0, rel=1e-13)
    with pytest.warns(op.errors.LoopWarning, match="all but 8.9e-16"):
        assert ring(1.0 - 2.0**-50).trace().intensity == 1.0


def test_a_loop_shared_by_many_sources_is_judged_once():
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source([1.0, 2.0, 3.0, 4.0]))
    path.add("split", op.BeamSplitter(np.array([[1e-6], [0.1], [0.2]])))
    path["lamp"] >> path["split.back"]
    path["split.transmitted"] >> path["split.in"]
    path["split.reflected"] >> op.Detector()
    for run in (path.trace, path.compose().mueller):
        with pytest.warns(op.errors.LoopWarning, match="all but 1e-06"):
            run()


def test_light_from_behind_is_reflected_totally_into_a_gap_as_well():
    # At 60 degrees: lit from behind, beside the stack of the same media.
    theta, state = float(np.radians(60.0)), op.Light([1.0, 0.3, -0.5, 0.6])
    path = gap(theta, lit="back.back")
    light = path.trace_all()["T"].stokes
    totally = op.Interface(1.0, theta, outside=1.5).mueller() @ state
    stack = op.LayerStack([1.5, 1.0, 1.5], theta).mueller("back", "transmitted") @ state
    exact = [float(part) for part in exact_lights(path)["T"].stokes]
    np.testing.assert_allclose([light] * 3, [totally, stack, exact], rtol=0, atol=1e-15)
    # Lit from in front, nothing enters the gap, which would keep all that did.
    lights = gap(1.0).trace_all()
    assert (lights["R"].intensity, lights["T"].intensity) == (1.0, 0.0)


@rows("model", ["auto", "full"])
def test_light_that_cannot_be_keeps_its_energy(model):
    # At this angle no light travels in either medium.
    path = op.PathGraph()
    path.add("lamp", op.Source())
    path.add("face", op.Interface(2.097, 1.0957, outside=1.238, incidence_in=2.4934))
    path["lamp"] >> path["face.back"]
    path["face.transmitted"] >> path.add("eye", op.Detector())
    path["face.reflected"] >> path.add("other", op.Detector())
    lights = op.Composer(model=model).compose(path).run_all()
    assert lights["eye"].intensity + lights["other"].intensity == pytest.approx(1.0, rel=1e-15)


def test_light_goes_round_in_a_medium_that_absorbs():
    path = slab(op.Material(1.5, op.Parameter("k")), 0.5)
    assert path.trace_all(k=0.0)["T"].intensity > 0.9
    known = slab(1.5 + 0.1j, 0.5).trace_all()
    for port, light in path.trace_all(k=0.1).items():
        np.testing.assert_allclose(light.stokes, known[port].stokes, rtol=0, atol=1e-15)
    path = slab(1.5, 0.5)
    path.replace("front", op.Interface(1.5 + 0.1j, 0.5))
    with pytest.raises(op.errors.PathError, match=r"lit from n = 1\.5 and k = 0\.1 behind 'front'"):
        path.trace_all()


def test_stacks_and_piles_are_recognised_and_cost_a_few_unknowns_a_layer():
    text = slab(1.5, 0.5).compose().explain()
    assert "light goes round at front.transmitted: added layer after layer, 2 unknowns" in text
    turned = slab(1.5, 0.5, medium=op.Rotator(0.3), state=[1, 0, 0.5, 0]).compose().explain()
    assert "summed over all rounds" in turned
    n, theta, plates = 1.5, 0.9, 60
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source(1.0))
    before = "lamp.out"
    for i in range(2 * plates):
        inside, outside = (n, 1.0) if i % 2 == 0 else (1.0, n)
        path.add(f"f{i}", op.Interface(inside, theta, outside, incidence_in=1.0))
        path.connect(before, f"f{i}.in")
        if i:
            path.connect(f"f{i}.reflected", f"f{i - 1}.back")
        before = f"f{i}.transmitted"
    path.add("T", op.Detector())
    path.connect(before, "T.in")
    plan = path.compose()
    (loop,) = plan.program.loops
    assert loop.layered
    # Stokes' pile: (1 - F) / (1 + (2m - 1) F) for s and p.
    A, B, _, _ = op.fresnel_reflection(n, np.cos(theta), np.sin(theta))
    along, across = ((1 - F) / (1 + (2 * plates - 1) * F) for F in (A + B, A - B))
    expected = [(along + across) / 2, (along - across) / 2]
    np.testing.assert_allclose(plan.run().stokes[:2], expected, rtol=1e-12)
