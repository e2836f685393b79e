"""Light that goes round: slabs, coats and networks against closed forms and 50 digits."""

import warnings

import numpy as np
import pytest
from mpmath import mp

import optipath as op
from lossless import networks
from optipath.lab.accuracy.path_reference import exact_lights
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
    path = slab(1.5, float(np.radians(40)), behind=0.608 + 2.12j)
    matrix = path.mueller("lamp", "R").matrix
    A, B, C, S = COATED
    expected = [[A, B, 0, 0], [B, A, 0, 0], [0, 0, C, S], [0, 0, -S, C]]
    np.testing.assert_allclose(matrix, expected, rtol=4e-15, atol=1e-17)
    theta = float(np.radians(40))
    stack = op.LayerStack([1.0, 1.5, 0.608 + 2.12j], theta)
    looped = slab(1.5, theta, behind=0.608 + 2.12j)
    for leaves, end in (("reflected", "R"), ("transmitted", "T")):
        matrix = stack.mueller("in", leaves).matrix
        np.testing.assert_allclose(
            looped.mueller("lamp", end).matrix, matrix, rtol=1e-15, atol=4e-16
        )
    grey = op.Medium(length=0.01, absorption=30.0)
    found = slab(1.5, 0.0, medium=grey).trace_all()["T"].intensity
    F, t = 0.04, np.exp(-0.3)
    assert found == pytest.approx((1 - F) ** 2 * t / (1 - F * F * t), rel=1e-14)


@rows("apart", [1e-3, 1e-5])
def test_a_slab_keeps_its_digits_next_to_grazing_incidence(apart):
    theta = float(np.pi / 2 - apart)
    expected = closed_slab(mp.mpf(1.5), mp.mpf(theta))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", op.LoopWarning)
        found = slab(1.5, theta).trace(keep="all")["T"].stokes
    np.testing.assert_allclose(found[:2], expected, rtol=1e-11 * 1e-5 / apart + 1e-14)


@pytest.mark.parametrize("count", [40, slow(150)])
def test_no_energy_gets_lost_in_networks_without_losses(count):
    for network in networks(count):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", op.LoopWarning)
            lights = network.path.trace_all()
        total = sum(light.intensity for light in lights.values())
        assert total == pytest.approx(network.emitted, rel=1e-13)


def test_outlets_count_among_what_leaves_and_networks_are_right_in_all_components():
    for network in networks(25, first=1000, size=(1, 4)):
        lights, exact = network.path.trace_all(), exact_lights(network.path)
        for name, light in lights.items():
            expected = np.array([float(part) for part in exact[name].stokes])
            np.testing.assert_allclose(light.stokes, expected, rtol=0, atol=4e-15 * network.emitted)
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source(3.0)) >> path.add("front", op.Interface(1.5, 1.0))
    path.add("back", op.Interface(1.0, 1.0, outside=1.5, incidence_in=1.0))
    path.connect("front.transmitted", "back.in")
    path.connect("back.reflected", "front.back")
    path.add("eye", op.Detector())
    path.connect("back.transmitted", "eye.in")
    kept = path.trace(keep="all")
    assert path.compose().outlets == ("front.reflected",)
    assert kept["eye"].intensity + kept["front.reflected"].intensity == pytest.approx(
        3.0, rel=1e-15
    )


@pytest.mark.parametrize("engine", ["numba", slow("jax")])
def test_engines_agree_on_light_that_goes_round(engine):
    pytest.importorskip(engine)
    path = slab(
        op.Parameter("n"), op.Parameter("theta"), behind=0.608 + 2.12j, state=[1, 0.3, 0.4, 0.5]
    )
    path.bind(n=1.5)
    given = {"n": np.linspace(1.1, 2.2, 2000), "theta": np.linspace(0, 1.5, 2000)}
    first = op.Composer(engine="numpy").compose(path).run_all(**given)["R"].stokes
    found = op.Composer(engine=engine).compose(path).run_all(**given)["R"].stokes
    np.testing.assert_allclose(np.asarray(found), first, rtol=0, atol=4e-15)
    one = path.trace_all(n=float(given["n"][7]), theta=float(given["theta"][7]))["R"]
    np.testing.assert_allclose(one.stokes, first[7], rtol=0, atol=4e-15)


def test_every_model_and_precision_gives_the_same_light():
    path = slab(1.5, 0.8, state=[1, 0.3, 0.4, 0.5], medium=op.Rotator(0.3))
    plans = [op.Composer(model=model).compose(path) for model in ("auto", "full")]
    lights = [plan.run_all() for plan in plans]
    for name in lights[0]:
        np.testing.assert_allclose(
            lights[0][name].stokes, lights[1][name].stokes, rtol=0, atol=1e-15
        )
    assert op.Composer().compose(slab(1.5, 0.8)).model == "sp"
    theta = np.linspace(0, 1.5, 100, dtype=np.float32)
    path = slab(1.5, op.Parameter("theta"))
    single = op.Composer(dtype="float32", engine="numpy").compose(path).run_all(theta=theta)["T"]
    np.testing.assert_allclose(
        single.stokes, path.trace_all(theta=theta)["T"].stokes, rtol=0, atol=1e-6
    )


def test_faint_light_goes_round_as_well():
    path, bright = op.PathGraph(loops="sum"), slab(1.5, 0.5)
    for name, element in bright.graph.nodes(data="element"):
        path.add(name, element)
    before = "lamp.out"
    for i in range(24):  # So long a chain is carried with an exponent.
        path.add(f"grey{i}", op.Attenuator(1e-50))
        path.connect(before, f"grey{i}.in")
        before = f"grey{i}.out"
    path.connect(before, "front.in")
    for start, end, (leaves, enters) in bright.graph.edges(keys=True):
        if start != "lamp":
            path.connect(f"{start}.{leaves}", f"{end}.{enters}")
    found, expected = path.trace_all()["T"], bright.trace_all()["T"]
    np.testing.assert_allclose(found.normalized, expected.normalized, rtol=0, atol=1e-15)
    assert found.log10_intensity == pytest.approx(expected.log10_intensity - 1200, abs=1e-9)


def test_loops_jones_columns_and_certificates_are_refused_where_they_cannot_be():
    path = slab(1.5, 0.5)
    with pytest.raises(op.PathError, match=r"cycle: back -> front -> back; .* loops='sum'"):
        op.Composer(loops="refuse").compose(path)
    plain = op.PathGraph()
    assert plain.loops == "refuse"
    with pytest.raises(op.PathError, match="loops 'add' is unknown"):
        op.PathGraph(loops="add")
    with pytest.raises(op.ComposerError, match="loops 'add' is unknown"):
        op.Composer(loops="add")
    path = slab(1.5, 0.5)
    with pytest.raises(op.ComposerError, match=r"goes round at 'front\.transmitted'.*stokes"):
        op.Composer(composing="jones").compose(path)
    with pytest.raises(op.ParameterError, match="no certificates for light that goes round"):
        path.compose().certificate("R")
    assert op.Composer(tolerance=0.01).compose(path.reading("intensity")).instead is None


@rows("gain", [1.0, 1.5])
def test_a_gain_of_one_or_more_is_an_error(gain):
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source(1.0)) >> path.add("join", op.Combiner())
    path.add("amplifier", op.MuellerElement(np.eye(4) * gain * 2, physical=False))
    path.add("split", op.BeamSplitter(0.5))
    path["join"] >> path["amplifier"]
    path.connect("amplifier.out", "split.in")
    path.connect("split.reflected", "join.in")
    path.add("eye", op.Detector())
    path.connect("split.transmitted", "eye.in")
    for run in (path.trace, path.mueller):
        with pytest.raises(op.ParameterError, match=r"'join\.in' never fades"):
            run()


def test_next_to_a_gain_of_one_nothing_gets_lost_and_it_is_warned_of():
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source(1.0)) >> path.add("join", op.Combiner())
    path.add("split", op.BeamSplitter(0.99999))
    path["join"] >> path["split"]
    path.connect("split.reflected", "join.in")
    path.add("eye", op.Detector())
    path.connect("split.transmitted", "eye.in")
    with pytest.warns(
        op.LoopWarning, match=r"all but 1e-05 comes back .* condition number .* 2e\+05"
    ):
        light = path.trace()
    # All of it leaves in the end.
    assert light.intensity == pytest.approx(1.0, rel=1e-13)
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source()) >> path.add("join", op.Combiner())
    path.add("split", op.BeamSplitter(1.0 - 2.0**-50))
    path["join"] >> path["split"]
    path.connect("split.reflected", "join.in")
    path.add("eye", op.Detector())
    path.connect("split.transmitted", "eye.in")
    with pytest.warns(op.LoopWarning, match="all but 8.9e-16"):
        assert path.trace().intensity == 1.0


def test_a_loop_shared_by_many_sources_is_judged_once():
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source([1.0, 2.0, 3.0, 4.0]))
    path.add("split", op.BeamSplitter(np.array([[1e-6], [0.1], [0.2]])))
    path.add("eye", op.Detector())
    path.connect("lamp.out", "split.back")
    path.connect("split.transmitted", "split.in")
    path.connect("split.reflected", "eye.in")
    for run in (path.trace, path.compose().mueller):
        with pytest.warns(op.LoopWarning, match="all but 1e-06"):
            run()


def test_light_from_behind_is_reflected_totally_into_a_gap_as_well():
    # Glass, air gap, glass, at 60 degrees: lit from behind, beside the stack of the same media.
    theta, state = float(np.radians(60.0)), [1.0, 0.3, -0.5, 0.6]
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source(1.0, state))
    path.add("front", op.Interface(1.0, theta, outside=1.5))
    path.add("face", op.Interface(1.5, theta, outside=1.0, incidence_in=1.5))
    path.add("eye", op.Detector())
    path.add("dark", op.Dump())
    path.connect("front.transmitted", "face.in")
    path.connect("face.reflected", "front.back")
    path.connect("lamp.out", "face.back")
    path.connect("face.transmitted", "eye.in")
    path.connect("front.reflected", "dark.in")
    light = path.trace()
    expected = op.Interface(1.0, theta, outside=1.5).mueller() @ op.Light(state)
    np.testing.assert_allclose(light.stokes, expected.stokes, rtol=0, atol=1e-15)
    stack = op.LayerStack([1.5, 1.0, 1.5], theta).mueller("back", "transmitted")
    np.testing.assert_allclose(light.stokes, (stack @ op.Light(state)).stokes, rtol=0, atol=1e-15)
    exact = [float(part) for part in exact_lights(path)["eye"].stokes]
    np.testing.assert_allclose(light.stokes, exact, rtol=0, atol=1e-15)


@rows("model", ["auto", "full"])
def test_light_that_cannot_be_keeps_its_energy(model):
    # At this angle no light travels in either medium.
    face = op.Interface(2.097, 1.0957, outside=1.238, incidence_in=2.4934)
    path = op.PathGraph()
    path.add("lamp", op.Source())
    path.add("face", face)
    path.connect("lamp.out", "face.back")
    for end, port in (("eye", "transmitted"), ("other", "reflected")):
        path.add(end, op.Detector())
        path.connect(f"face.{port}", f"{end}.in")
    lights = op.Composer(model=model).compose(path).run_all()
    assert lights["eye"].intensity + lights["other"].intensity == pytest.approx(1.0, rel=1e-15)


def test_a_gain_among_many_paths_is_found():
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source(1.0)) >> path.add("join", op.Combiner())
    path.add("split", op.BeamSplitter(op.Parameter("kept")))
    path["join"] >> path["split"]
    path.connect("split.reflected", "join.in")
    path.add("eye", op.Detector())
    path.connect("split.transmitted", "eye.in")
    kept = np.linspace(0.0, 0.5, 70_000)
    np.testing.assert_allclose(path.trace(kept=kept).intensity, 1.0, rtol=1e-14)
    kept[1234] = 1.0
    with pytest.raises(op.ParameterError, match="never fades"):
        path.trace(kept=kept)


def test_what_is_closed_is_dark_where_no_light_gets_in():
    # Beyond the critical angle nothing enters the air gap, which would keep all that did.
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source(1.0)) >> path.add("front", op.Interface(1.0, 1.0, outside=1.5))
    path.add("back", op.Interface(1.5, 1.0, outside=1.0, incidence_in=1.5))
    path.connect("front.transmitted", "back.in")
    path.connect("back.reflected", "front.back")
    for end, port in (("R", "front.reflected"), ("T", "back.transmitted")):
        path.add(end, op.Detector())
        path.connect(port, f"{end}.in")
    lights = path.trace_all()
    assert (lights["R"].intensity, lights["T"].intensity) == (1.0, 0.0)


def test_light_goes_round_in_a_medium_that_absorbs():
    path = slab(op.Material(1.5, op.Parameter("k")), 0.5)
    assert path.trace_all(k=0.0)["T"].intensity > 0.9
    known = slab(1.5 + 0.1j, 0.5).trace_all()
    for port, light in path.trace_all(k=0.1).items():
        np.testing.assert_allclose(light.stokes, known[port].stokes, rtol=0, atol=1e-15)
    path = slab(1.5, 0.5)
    path.replace("front", op.Interface(1.5 + 0.1j, 0.5))
    with pytest.raises(op.PathError, match=r"lit from n = 1\.5 and k = 0\.1 behind 'front'"):
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
