"""Paths through materials that depend on the wavelength."""

import numpy as np
import pytest

import optipath as op
from chains import ENGINES
from optipath.errors import OptipathError

STATE = (1.0, 0.3, 0.2, 0.1)
B, C = (1.03961212, 0.231792344, 1.01046945), (0.00600069867, 0.0200179144, 103.560653)
BK7 = op.Material.sellmeier(B, C, name="BK7")
TINTED = op.Material.sellmeier(B, C, k=2e-6, name="tinted glass")
SILICA = op.Material.cauchy([1.458, 0.00354], name="silica")
GOLD = op.Material.tabulated(
    ["400 nm", "500 nm", "521 nm", "700 nm"],
    [1.47, 0.97, 0.62, 0.13],
    [1.95, 1.87, 2.08, 4.0],
    name="gold",
)
WAVELENGTHS = np.array([450e-9, 516e-9, 633e-9])


def slab(at, _, outside=op.FOLLOWS, behind=1.0):
    path = op.PathGraph()
    path.add("lamp", op.Source(1.0, STATE))
    path.add("front", op.Interface(at(BK7), 0.7))
    path.add("back", op.Interface(at(behind), op.FOLLOWS, outside=at(outside)))
    path.add("eye", op.Detector())
    path.connect("lamp", "front")
    path.connect("front.transmitted", "back")
    path.connect("back.transmitted", "eye")
    return path


def slab_with_echoes(at, _):
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source(1.0, STATE))
    path.add("front", op.Interface(at(BK7), 0.7))
    path.add("back", op.Interface(1.0, op.FOLLOWS, outside=op.FOLLOWS))
    path.add("eye", op.Detector())
    path.add("dump", op.Dump())
    path.connect("lamp", "front")
    path.connect("front.transmitted", "back")
    path.connect("back.reflected", "front.back")
    path.connect("front.reflected", "dump")
    path.connect("back.transmitted", "eye")
    return path


def stack(at, wavelength):
    layers = [1.0, at(TINTED), at(SILICA), at(GOLD)]
    lengths = ["1 mm", "2 mm"]
    pane = op.LayerStack(layers, 0.6, lengths=lengths, wavelength=wavelength)
    return op.Source(1.0, STATE) >> pane >> op.Detector()


def chain(at, _):
    points = [[0, -1, 1], [0, 0, 0], [0, 1, -1.5], [0.3, 2, 0.2], [0.5, 3, 1]]
    return op.path_from_vertices(points, materials=[at(GOLD), at(SILICA), at(GOLD)], events="RRR")


def double_pass(at, _):
    metal = op.Interface(at(GOLD), 0.0)
    way = op.there_and_back(op.Medium("1 mm", absorption="1 1/cm"), metal)
    return op.Source(1.0, STATE) >> way >> op.Detector()


def turned_round(at, _):
    return slab(at, _).reversed()


PATHS = [slab, slab_with_echoes, stack, chain, double_pass, turned_round]


# JAX compiles loops and stacks for many seconds.
RUNS = [
    (build, engine) for build in PATHS for engine in ENGINES if engine != "jax" or build == slab
]


@pytest.mark.parametrize(("build", "engine"), RUNS)
def test_light_of_each_wavelength_is_that_of_the_numbers_there(build, engine):
    path = build(lambda given: given, op.Wavelength())
    together = op.Composer(engine=engine).compose(path).run(wavelength=WAVELENGTHS).stokes
    for found, wavelength in zip(np.asarray(together), WAVELENGTHS.tolist(), strict=True):

        def at(given, wavelength=wavelength):
            return given.at(wavelength) if isinstance(given, op.Material) else given

        expected = build(at, wavelength).trace().stokes
        np.testing.assert_allclose(found, expected, rtol=1e-14, atol=1e-17)


@pytest.mark.parametrize("build", PATHS)
def test_a_wavelength_that_is_bound_is_one_that_is_given(build):
    path = build(lambda given: given, op.Wavelength())
    bound = path.bind(wavelength="516 nm").trace().stokes
    np.testing.assert_allclose(bound, path.trace(wavelength="516 nm").stokes, rtol=1e-14)


def test_one_material_on_both_sides_of_a_link_is_one_medium():
    by_hand = slab(lambda given: given, None, outside=BK7).trace(wavelength="516 nm")
    assert by_hand == slab(lambda given: given, None).trace(wavelength="516 nm")


@pytest.mark.parametrize("outside", [SILICA, 1.5])
def test_two_materials_on_both_sides_of_a_link_are_refused_by_their_names(outside):
    path = slab(lambda given: given, None, outside=outside)
    with pytest.raises(OptipathError) as fault:
        path.trace(wavelength="516 nm")
    told = str(fault.value)
    assert "'back.in' is lit from n = 1.520" in told
    assert "(n of BK7) behind 'front'" in told
    assert told.endswith("op.FOLLOWS for outside")
    assert "[" not in told


def test_rays_are_refracted_by_the_index_of_their_wavelength():
    # Snell's law at the second face, into silica: n sin(incidence) is that in air.
    path = slab(lambda given: given, None, behind=SILICA)
    for wavelength in WAVELENGTHS.tolist():
        glass, silica = BK7.at(wavelength).n, SILICA.at(wavelength).n
        first = np.arcsin(np.sin(0.7) / glass)
        front = op.Interface(glass, 0.7).mueller("in", "transmitted").matrix
        back = op.Interface(silica, first, outside=glass).mueller("in", "transmitted").matrix
        found = path.trace(wavelength=wavelength).stokes
        np.testing.assert_allclose(found, back @ front @ STATE, rtol=1e-13)


def test_what_stands_alone_asks_for_a_wavelength():
    with pytest.raises(OptipathError, match="n of gold of interface depends on the wavelength"):
        op.Interface(GOLD, 0.3).mueller()


@pytest.mark.parametrize("wavelength", ["300 nm", "5 um"])
def test_beyond_its_range_a_material_is_refused_where_it_stands(wavelength):
    path = stack(lambda given: given, op.Wavelength())
    with pytest.raises(OptipathError) as fault:
        path.trace(wavelength=["500 nm", wavelength])
    assert "within 400 nm .. 700 nm, for which gold is known" in str(fault.value)
    assert "layer-stack.indices[3].n" in str(fault.value)


def test_a_line_that_goes_on_below_0_is_refused_with_the_place_and_the_material():
    metal = op.Material.tabulated(
        [500e-9, 600e-9], [0.9, 0.1], [2.0, 3.0], name="metal", extrapolate="linear"
    )
    path = op.Source() >> op.Interface(metal, 0.3) >> op.Detector()
    with pytest.raises(OptipathError) as fault:
        path.trace(wavelength=["550 nm", "700 nm"])
    assert str(fault.value) == (
        "n of metal at 700 nm is -0.7 (beyond its samples a straight line goes on), and "
        "interface.index.n takes a real index of refraction of 0 or more; give another wavelength"
    )


def test_jax_gets_nan_where_a_material_is_not_known(jax):
    path = op.Source() >> op.Interface(GOLD, 0.3) >> op.Detector()
    light = jax.jit(lambda w: path.trace(wavelength=w).stokes)
    assert np.isnan(light(5e-6)).all()
    assert np.isfinite(light(5e-7)).all()


def reference(mp, wavelength, strength, plasma, length):
    """The intensity behind a pane of glass that absorbs, of light reflected by a metal there."""
    w = wavelength * 10**6
    strengths = (strength, *map(mp.mpf, B[1:]))
    glass = mp.sqrt(
        1 + sum(b * w**2 / (w**2 - mp.mpf(c)) for b, c in zip(strengths, C, strict=True))
    )
    constant = mp.mpf("6.62607015e-34") * 299792458 / mp.mpf("1.602176634e-19")
    energy = constant / wavelength
    metal = mp.sqrt(4 - plasma**2 / (energy * (energy + mp.mpc(0, 1) * mp.mpf(0.07))))
    there, tilt = mp.mpf(0.7), mp.mpf(0.9)
    inside = mp.asin(mp.sin(there) / glass)
    one, other = mp.cos(there), glass * mp.cos(inside)
    passes = [
        4 * one * other / (one + other) ** 2,
        4 * glass * mp.cos(inside) * one / (glass * one + mp.cos(inside)) ** 2,
    ]
    cosine = mp.cos(tilt)
    slanted = mp.sqrt(metal**2 - mp.sin(tilt) ** 2)
    mirrors = [
        abs((cosine - slanted) / (cosine + slanted)) ** 2,
        abs((metal**2 * cosine - slanted) / (metal**2 * cosine + slanted)) ** 2,
    ]
    dimmed = mp.exp(-200 * length)
    s1 = mp.mpf(STATE[1])
    weights = [(1 + s1) / 2, (1 - s1) / 2]
    parts = zip(weights, passes, mirrors, strict=True)
    return sum(weight * t**2 * dimmed * r for weight, t, r in parts)


def test_slopes_of_light_in_wavelength_coefficients_and_thickness_have_twelve_digits(jax):
    mp = pytest.importorskip("mpmath")
    glass = op.Material.sellmeier([op.Parameter("b"), *B[1:]], C)
    metal = op.Material.drude_lorentz(op.Parameter("plasma"), 0.07, background=4.0)
    path = op.PathGraph()
    path.add("lamp", op.Source(1.0, STATE))
    path.add("front", op.Interface(glass, 0.7))
    path.add("glass", op.Medium(op.Parameter("length"), absorption="2 1/cm"))
    path.add("back", op.Interface(1.0, op.FOLLOWS, outside=op.FOLLOWS))
    path.add("mirror", op.Interface(metal, 0.9, parallel=False))
    path.add("eye", op.Detector())
    path.connect("lamp", "front")
    path.connect("front.transmitted", "glass")
    path.connect("glass", "back")
    path.connect("back.transmitted", "mirror")
    path.connect("mirror.reflected", "eye")
    names = ("wavelength", "b", "plasma", "length")
    values = (516e-9, B[0], 9.03, 2e-3)

    def intensity(*given):
        return path.trace(**dict(zip(names, given, strict=True))).stokes[0]

    with mp.workdps(50):
        exact = [mp.mpf(value) for value in values]
        assert intensity(*values) == pytest.approx(float(reference(mp, *exact)), rel=1e-14)
        slopes = jax.jit(jax.grad(intensity, (0, 1, 2, 3)))(*values)
        for place, slope in enumerate(slopes):
            order = tuple([int(each == place) for each in range(4)])
            wanted = mp.diff(lambda *given: reference(mp, *given), tuple(exact), order)
            assert float(slope) == pytest.approx(float(wanted), rel=1e-12)
