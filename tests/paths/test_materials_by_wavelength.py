"""Materials and curves by wavelength in paths, and in place of the parameters of a path."""

import copy
import pickle

import mpmath as mp
import numpy as np
import pytest

import optipath as op
from batches_of_chains import quickly
from chains import ENGINES
from optipath.lab.path_reference import exact_stokes
from optipath.paths.drawing import draw
from tables import rows, slow
from wired import read_back, wired

STATE = (1.0, 0.3, 0.2, 0.1)
B, C = (1.03961212, 0.231792344, 1.01046945), (0.00600069867, 0.0200179144, 103.560653)
BK7 = op.Material.sellmeier(B, C, name="BK7")
TINTED = op.Material.sellmeier(B, C, k=2e-6, name="tinted glass")
SILICA = op.Material.cauchy([1.458, 0.00354], name="silica")
OF_GOLD = [4e-7, 5e-7, 5.21e-7, 7e-7], [1.47, 0.97, 0.62, 0.13], [1.95, 1.87, 2.08, 4.0]
GOLD = op.Material.tabulated(*OF_GOLD, name="gold")
WAVELENGTHS = np.array([450e-9, 516e-9, 633e-9])
FOLLOWING = op.Interface(1.0, op.FOLLOWS, outside=op.FOLLOWS)
BELOW = op.Material.tabulated([5e-7, 6e-7], [0.9, 0.1], [2, 3], name="metal", extrapolate="linear")
GRID = np.array([4.0e-7, 4.4e-7, 5.16e-7])
NODES, N, K = [4e-7, 5e-7, 6e-7], [1.5, 1.0, 0.3], [1.9, 1.8, 2.9]
TGG = op.drude_rotation([-41.72], [0.08909], unit="rad/(T m)", label="TGG")
GREEN = op.tabulated(["500 nm", "600 nm"], [0.2, 0.8], label="green")
ISOLATOR, PANES = op.load_preset("faraday-isolator"), op.load_preset("npgr026")
OF_N, SHARED_K = op.Parameter("n"), op.Parameter("k")


def as_it_is(given):
    return given


def slab(at=as_it_is, _=None, outside=op.FOLLOWS, behind=1.0):
    back = op.Interface(at(behind), op.FOLLOWS, outside=at(outside))
    ends = {"lamp": op.Source(1.0, STATE), "front": op.Interface(at(BK7), 0.7), "back": back}
    links = "lamp -> front, front.transmitted -> back, back.transmitted -> eye"
    return wired({**ends, "eye": op.Detector()}, links)


def slab_with_echoes(at, _):
    ends = {"lamp": op.Source(1.0, STATE), "front": op.Interface(at(BK7), 0.7), "back": FOLLOWING}
    ends |= {"eye": op.Detector(), "dump": op.Dump()}
    links = "lamp -> front, front.transmitted -> back, back.reflected -> front.back, front -> dump"
    return wired(ends, f"{links}, back.transmitted -> eye", loops="sum")


def stack(at, wavelength):
    layers, lengths = [1.0, at(TINTED), at(SILICA), at(GOLD)], ["1 mm", "2 mm"]
    pane = op.LayerStack(layers, 0.6, lengths=lengths, wavelength=wavelength)
    return op.Source(1.0, STATE) >> pane >> op.Detector()


def chain(at, _):
    points = [[0, -1, 1], [0, 0, 0], [0, 1, -1.5], [0.3, 2, 0.2], [0.5, 3, 1]]
    return op.path_from_vertices(points, materials=[at(GOLD), at(SILICA), at(GOLD)], events="RRR")


def double_pass(at, _):
    way = op.there_and_back(op.Medium("1 mm", absorption="1 1/cm"), op.Interface(at(GOLD), 0.0))
    return op.Source(1.0, STATE) >> way >> op.Detector()


PATHS = [slab, slab_with_echoes, stack, chain, double_pass, lambda at, _: slab(at).reversed()]
# Loops and stacks are compiled for many seconds, by JAX most of all.
BUILT = [("numpy", PATHS), *(slow((e, [slab])) for e in ENGINES[1:]), slow(("numba", PATHS))]


@pytest.mark.parametrize(("engine", "built"), BUILT)
def test_light_of_each_wavelength_is_that_of_the_numbers_there(engine, built):
    for build in built:
        path = build(as_it_is, op.Wavelength())
        together = op.Composer(engine=engine).compose(path).run(wavelength=WAVELENGTHS).stokes
        for found, wavelength in zip(np.asarray(together), WAVELENGTHS.tolist(), strict=True):

            def at(given, wavelength=wavelength):
                return given.at(wavelength) if isinstance(given, op.Material) else given

            expected = build(at, wavelength).trace().stokes
            np.testing.assert_allclose(found, expected, rtol=1e-14, atol=1e-17)
        bound = path.bind(wavelength="516 nm").trace().stokes
        np.testing.assert_allclose(bound, path.trace(wavelength="516 nm").stokes, rtol=1e-14)


def test_rays_are_refracted_by_the_index_of_their_wavelength_and_are_nan_where_it_is_not_known(jax):
    # One material on both sides is one medium.
    assert slab(outside=BK7).trace(wavelength="516 nm") == slab().trace(wavelength="516 nm")
    # Snell's law at the second face, into silica: n sin(incidence) is that in air.
    path = slab(behind=SILICA)
    for wavelength in WAVELENGTHS.tolist():
        glass, silica = BK7.at(wavelength).n, SILICA.at(wavelength).n
        first = np.arcsin(np.sin(0.7) / glass)
        front = op.Interface(glass, 0.7).mueller("in", "transmitted").matrix
        back = op.Interface(silica, first, outside=glass).mueller("in", "transmitted").matrix
        found = path.trace(wavelength=wavelength).stokes
        np.testing.assert_allclose(found, back @ front @ STATE, rtol=1e-13)
    path = op.Source() >> op.Interface(GOLD, 0.3) >> op.Detector()
    light = jax.jit(lambda w: path.trace(wavelength=w).stokes)
    assert np.isnan(light(5e-6)).all()
    assert np.isfinite(light(5e-7)).all()


def reference(wavelength, strength, plasma, length):
    """The intensity behind a pane of glass that absorbs, of light reflected by a metal there."""
    w = wavelength * 10**6
    strengths = (strength, *map(mp.mpf, B[1:]))
    terms = (b * w**2 / (w**2 - mp.mpf(c)) for b, c in zip(strengths, C, strict=True))
    glass = mp.sqrt(1 + sum(terms))
    energy = mp.mpf("6.62607015e-34") * 299792458 / mp.mpf("1.602176634e-19") / wavelength
    metal = mp.sqrt(4 - plasma**2 / (energy * (energy + mp.mpc(0, 1) * mp.mpf(0.07))))
    there, tilt = mp.mpf(0.7), mp.mpf(0.9)
    inside = mp.asin(mp.sin(there) / glass)
    one, other = mp.cos(there), glass * mp.cos(inside)
    behind = mp.cos(inside)
    passes = [4 * a * b / (a + b) ** 2 for a, b in ((one, other), (glass * one, behind))]
    cosine = mp.cos(tilt)
    slanted = mp.sqrt(metal**2 - mp.sin(tilt) ** 2)
    mirrors = [abs((a - slanted) / (a + slanted)) ** 2 for a in (cosine, metal**2 * cosine)]
    dimmed = mp.exp(-200 * length)
    s1 = mp.mpf(STATE[1])
    parts = zip([(1 + s1) / 2, (1 - s1) / 2], passes, mirrors, strict=True)
    return sum(weight * t**2 * dimmed * r for weight, t, r in parts)


def test_slopes_of_light_in_wavelength_coefficients_and_thickness_have_twelve_digits(jax):
    glass = op.Material.sellmeier([op.Parameter("b"), *B[1:]], C)
    metal = op.Material.drude_lorentz(op.Parameter("plasma"), 0.07, background=4.0)
    pane = op.Medium(op.Parameter("length"), absorption="2 1/cm")
    ends = {"lamp": op.Source(1.0, STATE), "front": op.Interface(glass, 0.7), "glass": pane}
    ends |= {"back": FOLLOWING, "mirror": op.Interface(metal, 0.9, parallel=False)}
    links = "lamp -> front, front.transmitted -> glass, glass -> back, back.transmitted -> mirror"
    path = wired({**ends, "eye": op.Detector()}, f"{links}, mirror -> eye")
    names = ("wavelength", "b", "plasma", "length")
    values = (516e-9, B[0], 9.03, 2e-3)

    def intensity(*given):
        return path.trace(**dict(zip(names, given, strict=True))).stokes[0]

    with mp.workdps(50):
        exact = [mp.mpf(value) for value in values]
        assert intensity(*values) == pytest.approx(float(reference(*exact)), rel=1e-14)
        with quickly("jax"):
            slopes = jax.grad(intensity, (0, 1, 2, 3))(*values)
        for place, slope in enumerate(slopes):
            order = tuple([int(each == place) for each in range(4)])
            wanted = mp.diff(reference, tuple(exact), order)
            assert float(slope) == pytest.approx(float(wanted), rel=1e-12)


def paint(wavelength=None):
    return op.Material.tabulated(NODES, N, K, name="paint", wavelength=wavelength)


def interpolated(wavelengths):
    return np.interp(wavelengths, NODES, N), np.interp(wavelengths, NODES, K)


def panes(case=7, **given):
    return op.load_preset("npgr026", case=case, **given)


def test_materials_bound_to_indices_give_n_and_k_of_the_path_at_one_wavelength():
    path = panes(n1=paint())
    assert "wavelength" in path.parameters
    assert {"n1", "k1"}.isdisjoint(path.parameters)
    n, k = interpolated(GRID)
    expected = panes().trace(n1=n, k1=k).stokes
    np.testing.assert_allclose(path.trace(wavelength=GRID).stokes, expected, rtol=1e-13)
    # What was published for other values is left out.
    assert path.cases["7"].published == {}
    assert "k1" not in path.cases["7"].values
    assert path.cases["7"].values["n2"] == 0.608
    path = op.load_preset("npgr026").bind(n1=paint(), n2=paint(), wavelength="500 nm")
    assert path.trace() == op.load_preset("npgr026").trace(n1=1.0, k1=1.8, n2=1.0, k2=1.8)
    path = panes(n1=paint()).bind(wavelength="500 nm").bind(n2=paint())
    assert path.trace() == panes(n1=paint()).bind(wavelength="500 nm", n2=paint()).trace()
    assert path.parameters["wavelength"].bound
    path = panes().bind(n1=op.Material(1.12, 2.16))
    assert path.parameters["k1"].bound
    assert path.trace() == panes().trace()
    # The k of the case would be none of glass.
    assert panes().bind(n1=op.Material(1.5)).trace() == panes().trace(n1=1.5, k1=0.0)
    path = op.Source() >> op.Interface(op.Parameter("m"), "40 deg") >> op.Detector()
    light = path.bind(m=paint()).trace(wavelength="500 nm")
    np.testing.assert_allclose(light.stokes, path.trace(m=1.0 + 1.8j).stokes, rtol=1e-13)


TWO = r"^[^[]*'back.in' is lit from n = 1\.520[^[]*\(n of BK7\) behind 'front'[^[]*for outside$"
STACK = stack(as_it_is, op.Wavelength())
PART = (op.Source() >> op.Interface(paint(), 0.3)).bind(wavelength="500 nm")
BEYOND = r"layer-stack\.indices\[3\]\.n.* within 400 nm .. 700 nm, for which gold"


def lit(*indices):
    path = op.Source()
    for index in indices:
        path = path >> op.Interface(op.Material(*index) if isinstance(index, tuple) else index, 0.3)
    return path >> op.Detector()


@rows(
    "give, sentence",
    [
        *((lambda n=n: slab(outside=n).trace(wavelength="516 nm"), TWO) for n in (SILICA, 1.5)),
        (
            op.Interface(GOLD, 0.3).mueller,
            "n of gold of interface has no value yet, as it depends on the wave",
        ),
        *((lambda w=w: STACK.trace(wavelength=["500 nm", w]), BEYOND) for w in ("300 nm", "5 um")),
        (
            lambda: lit(BELOW).trace(wavelength=["550 nm", "700 nm"]),
            "metal at 700 nm is -0.7 .* ind",
        ),
        (lambda: PANES.bind(n1=paint(), k1=0.1), "'k1' is given by 'n1', .* leave k1 out"),
        (lambda: PANES.trace(n1=paint()), r"depends on wavelength, .* path.bind\(n1=...\)"),
        (lambda: PANES.with_defaults(n1=paint()), r"bind it, by path.bind\(.1=...\)"),
        (lambda: PANES.bind(delta=paint()), "'delta' .* stands for an index of refraction"),
        (lambda: PANES.bind(k1=paint()), "'k1' .* stands for an index of refraction"),
        (lambda: PANES.bind(n1=paint(), wavelength="1 um"), "1000 nm; .* .. 600 nm, for .* paint"),
        (lambda: PANES.bind(n1=paint(), wavelength=516), "write '516 nm'"),
        (lambda: lit((OF_N, 2.0)).bind(n=paint()), r"k is 2\.0, but .* has a k of its own"),
        (
            lambda: lit((OF_N, SHARED_K), (1.5, SHARED_K)).bind(n=paint()),
            "index.k is k, .* and nowhere else",
        ),
        (lambda: lit((0.5 * OF_N, SHARED_K)).bind(n=paint()), r"'n' stands as 0.5 \* n"),
        ((PART >> op.Interface(paint(), 0.3) >> op.Detector()).trace, "w.* is open .*, and bound"),
        # Curves of one number.
        (lambda: ISOLATOR.bind(length=TGG), "rad/"),
        (lambda: ISOLATOR.with_defaults(verdet=TGG), r"bind it, by path\.bind\(verdet"),
        (lambda: ISOLATOR.compose().run_all(verdet=TGG), r"write path\.bind\(verdet"),
        (lambda: ISOLATOR.bind(verdet=TGG, vordet=TGG), "'vordet' is unknown"),
        (lambda: ISOLATOR.bind(verdet=TGG).bind(wavelength=GREEN), "must be a number"),
    ],
)
def test_what_a_material_or_a_curve_cannot_do_is_told_with_the_cure(give, sentence):
    with pytest.raises(op.OptipathError, match=sentence):
        give()


def test_a_path_with_a_material_is_copied_written_drawn_and_explained(tmp_path):
    path = panes(n1=paint())
    for other in (copy.copy(path), copy.deepcopy(path), pickle.loads(pickle.dumps(path))):
        assert other == path
        assert other.trace(wavelength="500 nm") == path.trace(wavelength="500 nm")
    assert read_back(path, tmp_path) == path
    assert panes(n1=paint("500 nm")) != path
    plan = pickle.loads(pickle.dumps(path.compose()))
    assert plan.run(wavelength=GRID) == path.trace(wavelength=GRID)
    path = op.load_preset("npgr026", n1=paint())
    assert "X1  interface  index=paint  incidence=$delta" in draw(path)
    explained = str(path.compose().explanation())
    assert "parameter wavelength: must be given" in explained
    assert "n of paint follows from wavelength" in explained
    green = str(path.bind(wavelength="516 nm").compose().explanation())
    assert ("parameter wavelength = 516 nm" in green, "paint" in green) == (True, False)


def test_questions_of_a_plan_and_the_reference_take_the_wavelength():
    n, k = interpolated(5.16e-7)
    path, same = panes(8, n1=paint()), panes(8, n1=float(n), k1=float(k))
    green = path.bind(wavelength="516 nm")
    for ask in (
        lambda one: one.trace().stokes,
        lambda one: one.mueller().matrix,
        lambda one: one.reversed().trace().stokes,
        lambda one: one.paths()[0].light.stokes,
        lambda one: op.polarization(one).certificate.upper,
        lambda one: one.compose().certificate().lower,
    ):
        np.testing.assert_allclose(ask(green), ask(same), rtol=1e-12, atol=1e-15)
    exact = [float(part) for part in exact_stokes(path, wavelength="516 nm")["E"]]
    np.testing.assert_allclose(path.trace(wavelength="516 nm").stokes, exact, rtol=20 * 2.0**-52)


def test_a_curve_stands_where_a_parameter_does_with_its_multiple():
    verdet = -41.72 / (0.6328**2 - 0.08909)
    expected = np.cos(np.pi / 4 - verdet * -0.5 * 20e-3) ** 2
    at = {"wavelength": "632.8 nm"}
    lights = [
        op.load_preset("faraday-isolator", verdet=TGG).trace_all(**at),
        ISOLATOR.bind(verdet=TGG).trace_all(**at),
        ISOLATOR.bind(verdet=TGG, **at).trace_all(),
        ISOLATOR.trace_all(verdet=TGG, **at),
        ISOLATOR.bind(verdet=0.5 * TGG + "0 rad/(T m)", length="40 mm").trace_all(**at),
    ]
    for light in lights:
        assert light["passed"].intensity == pytest.approx(expected, rel=1e-12)
    # It takes precedence over a case.
    path = op.load_preset("faraday-isolator", case="tgg", verdet=TGG)
    again = op.load_preset("faraday-isolator", case="tgg").parameters
    assert again["verdet"].default == pytest.approx(verdet, rel=1e-2)
    assert path.trace_all(**at)["passed"].intensity == pytest.approx(1.0, abs=1e-3)
    path = op.Source() >> op.Attenuator(0.1 + 0.5 * op.Parameter("share")) >> op.Detector()
    light = path.trace(share=2.0 * GREEN - 0.1, wavelength="550 nm")
    assert light.intensity == pytest.approx(0.1 + 0.5 * (2 * 0.5 - 0.1), rel=1e-14)
    path = op.Source(spectrum=op.Parameter("s")) >> op.Detector(response=op.Parameter("r"))
    lamp = op.Spectrum(["500 nm", "600 nm"], [1.0, 3.0])
    light = path.trace(s=lamp, r=GREEN, wavelength=["500 nm", "550 nm", "600 nm"])
    np.testing.assert_allclose(light.intensity, [0.2, 1.0, 2.4], rtol=1e-14)


@pytest.mark.parametrize(("step", "least"), [(4, 12), slow((1, 50))])
def test_curves_of_the_numbers_of_all_presets_give_the_same_light(step, least):
    tried = 0
    for preset in op.preset_names()[::step]:
        path = op.load_preset(preset)
        given = {"wavelength": 5e-7} if "wavelength" not in path.parameters else {}
        for name, one in path.parameters.items():
            number = isinstance(one.default, float) and not one.bound and np.isfinite(one.default)
            if not number or isinstance(one, op.Wavelength) or one.words or one.optional:
                continue
            tried += 1
            curve = op.tabulated(["100 nm", "10 um"], [one.text(one.default)] * 2, one.unit or "")
            found, told = path.bind(**{name: curve}).trace_all(**given), f"{preset} {name}"
            for end, light in path.trace_all().items():
                stokes = found[end].stokes
                np.testing.assert_allclose(stokes, light.stokes, 1e-9, 1e-12, err_msg=told)
    assert tried > least
