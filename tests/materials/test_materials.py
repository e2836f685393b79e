"""Materials and crystals."""

import pickle
from copy import deepcopy
from functools import partial

import mpmath
import numpy as np
import pytest
from mpmath import mpf

import optipath as op
from crystal_optics import QUARTZ, sellmeier
from optipath.errors import OptipathError
from tables import rows

WAVELENGTHS = ["188 nm", "500 nm", "521 nm", "1937 nm"]
N = [1.28, 0.97, 0.62, 0.92]
K = [1.188, 1.87, 2.08, 13.78]
BK7 = (1.03961212, 0.231792344, 1.01046945), (0.00600069867, 0.0200179144, 103.560653)
drude = op.Material.drude_lorentz
gold = partial(op.Material.tabulated, WAVELENGTHS, N, K, name="gold")
bk7 = partial(op.Material.sellmeier, *BK7, name="BK7")


def test_indices_are_those_of_samples_and_of_published_formulas():
    found = gold().at("516 nm")
    expected = (0.97 - 0.35 * 16 / 21, 1.87 + 0.21 * 16 / 21)
    assert (found.n, found.k) == pytest.approx(expected, rel=1e-14)
    assert type(found.n) is float
    # Of SCHOTT's data sheet: at the lines d, F and C.
    lines = ["587.5618 nm", "486.1327 nm", "656.2725 nm"]
    assert bk7().at(lines).n.round(5).tolist() == [1.5168, 1.52238, 1.51432]
    # I. H. Malitson, J. Opt. Soc. Am. 55, 1205 (1965): fused silica, n_D = 1.45845 at 20 C.
    b, resonances = (0.6961663, 0.4079426, 0.8974794), (0.0684043, 0.1162414, 9.896161)
    found = op.Material.sellmeier(b, resonances=resonances).at("587.56 nm")
    assert round(found.n, 5) == 1.45846


def faced(index):
    return op.Source() >> op.Interface(index, 0.3) >> op.Detector()


def test_a_wavelength_may_be_an_energy_an_array_known_from_the_beginning_or_a_parameter():
    metres = gold().at(1.2398419843320026e-6 / 2.4).n
    assert gold().at("2.4 eV").n == pytest.approx(metres, rel=1e-14)
    assert gold().at(["516 nm", 521e-9]).n.tolist() == [gold().at("516 nm").n, 0.62]
    constant = gold(wavelength="516 nm")
    assert constant == gold().at("516 nm")
    assert constant.refractive_index == constant.n + 1j * constant.k
    assert constant.at("3 um") is constant
    assert constant.span == (0.0, np.inf)
    assert gold().span == (188e-9, 1937e-9)
    assert gold(extrapolate="nearest").span == (0.0, np.inf)
    assert bk7(span=("310 nm", "2.5 um")).span == (310e-9, 2.5e-6)
    assert bk7(span=np.array([310e-9, 2.5e-6])).span == (310e-9, 2.5e-6)
    assert op.Material.tabulated(WAVELENGTHS, N).at("1 um").k == 0.0
    assert op.Material.tabulated(WAVELENGTHS, 1.5, 0.2).at("1 um") == op.Material(1.5, 0.2)
    material = op.Material.sellmeier([op.Parameter("b", 1.25)], [0.0])
    assert material.at("500 nm") == op.Material(1.5, 0.0)
    found = faced(material).trace(b=[1.25, 3.0], wavelength="500 nm").stokes
    assert np.array_equal(found, [faced(n).trace().stokes for n in (1.5, 2.0)])
    path = faced(bk7(wavelength=op.Parameter("laser")))
    assert path.trace(laser="500 nm") == faced(bk7().at("500 nm")).trace()


def test_equal_materials_are_equal_and_shown_as_can_be_read_on_one_line():
    film = op.Material.tauc_lorentz([(1, 3, 1, 2)])
    named = op.Material.cauchy([1.5], name="a\nb")
    for material, shown in (
        (op.Material(1.5, 0.1), "Material(n=1.5, k=0.1)"),
        (gold(), "Material 'gold', 188 nm .. 1937 nm"),
        (bk7(), "Material 'BK7', any wavelength"),
        (op.Material(bk7().n, 0.1), "Material(n=n of BK7, k=0.1)"),
        (film, "Material 'a Tauc-Lorentz model', any wavelength"),
        (named, "Material 'a\\nb', any wavelength"),
        (op.Material.cauchy([1.5], k=0.1, name="a\nb"), "Material(n=n of a\\nb, k=0.1)"),
    ):
        assert repr(material) == shown
    assert "\n" not in repr(named.n)
    for make, whole, real in (
        (op.Material.cauchy, ([1, 2],), ([1.0, 2.0],)),
        (op.Material.sellmeier, ([1], [0]), ([1.0], [-0.0])),
        (drude, (9, 1), (9.0, 1.0, np.float32(1.0))),
        (op.Material.tauc_lorentz, ([(122, 3, 2, 1)], 1), ([(122.0, 3.0, 2.0, 1.0)], 1.0)),
        (gold, (), ()),
    ):
        assert make(*whole) == make(*real)
    for other in (gold(interpolation="monotone"), gold(wavelength=op.Wavelength("other"))):
        assert gold() != other
    assert pickle.loads(pickle.dumps(gold())) == gold()
    assert deepcopy(bk7()) == bk7()


def test_a_metal_is_that_of_its_electrons():
    # By complex arithmetic, at the photon energy of 1 um.
    energy = 1.2398419843320026
    free, bound = energy * (energy + 0.02j), 3.0**2 - energy**2 - 0.5j * energy
    index = np.sqrt(4.0 - 9.0**2 / free + 0.3 * 81 / bound)
    metal = op.Material.drude_lorentz(9.0, 0.02, 1.0, [(0.3, 3.0, 0.5)], 4.0, wavelength="1 um")
    assert metal.refractive_index == pytest.approx(index, rel=1e-13)
    # n^2 = 1 - (wp / w)^2 where nothing is lost: 0.75 at twice the plasma frequency.
    free = op.Material.drude_lorentz(2.0, 0.0, oscillators=[]).at("4 eV")
    np.testing.assert_allclose([free.n, free.k], [0.75**0.5, 0.0], rtol=1e-12, atol=1e-12)


def test_a_file_is_a_material(tmp_path):
    file = tmp_path / "silver.csv"
    file.write_text("wavelength (nm),n,k\n400,0.05,2.1\n700,0.04,4.5\n")
    silver = op.Material.from_csv(file)
    assert repr(silver) == "Material 'silver', 400 nm .. 700 nm"
    assert silver.at("550 nm").k == pytest.approx(3.3, rel=1e-14)
    file.write_text("wavelength (nm),n\n400,1.5\n700,1.4\n")
    with pytest.raises(OptipathError, match="names no column 'k'; there are: n; or give k="):
        op.Material.from_csv(file)
    assert op.Material.from_csv(file, k=0.0).at("400 nm") == op.Material(1.5, 0.0)


POLE = op.Material.sellmeier([1.0], [0.25], name="x")
OPEN = op.Material.sellmeier([op.Parameter("b")], [0.1], name="x")
cauchy, lorentz = op.Material.cauchy, op.Material.tauc_lorentz
REFUSED = [
    (
        lambda: gold().refractive_index,
        "n of gold is not known yet; let the Material",
    ),
    (lambda: gold().at("3 um"), '1937 nm, for which gold is known, or ask for | "nearest" or "lin'),
    (lambda: gold().at(516), "516 metres, which is no wavelength of light; for nanometres"),
    (lambda: gold(wavelength="3 um"), "within 188 nm .. 1937 nm, for which gold is known"),
    (lambda: bk7(span="1 um"), "span of BK7 is '1 um'; give the least and the largest"),
    (lambda: bk7(span=("1 um", "2 nm")), "give the least and the largest wavelength"),
    (lambda: POLE.at("450 nm"), "n of x at 450 nm has no value | below 0 there, or a resonance)"),
    (lambda: POLE.at("500 nm"), "has no value"),
    (lambda: op.Material.tabulated(WAVELENGTHS, N, [0, 0, -1, 0]), "k of a table of n and k is -1"),
    (lambda: op.Material.tabulated([188, 500], [1, 2]), "is 188 metres, which is no wavelength"),
    (lambda: op.Material.sellmeier([1], [1, 2]), "has 1 of b and 2 of c; give as many of each"),
    (lambda: op.Material.sellmeier([1]), "needs c, in square micrometres, or resonances"),
    (lambda: op.Material.of_curve(float), "give a Curve, or use Material.tabulated"),
    (lambda: op.Material.sellmeier(1, [1]), "b of a Sellmeier formula must be a row"),
    (lambda: op.Material.sellmeier([1, "a"], [1, 2]), "b[1] of a Sellmeier formula: 'a'"),
    (lambda: cauchy([1.5, np.nan]), "coefficients[1] of a Cauchy formula is nan"),
    (lambda: cauchy([]), "a row of one coefficient or more, such as [1.0], not []"),
    (lambda: cauchy(np.array(1.5)), "must be a row of one coefficient or more"),
    (lambda: lorentz([]), "has no oscillators; give one or more"),
    (lambda: cauchy([[1.5, 1.6]]), "give one number"),
    (lambda: drude(-9, 0.1), "plasma of a Drude-Lorentz model is -9"),
    (lambda: drude(9, 0.1, 1, [(1, 2, 0)]), "[0] damping of | is 0; give a real coefficient ab"),
    (lambda: drude(9, 0.1, 1.0, [(1, 2)]), "[(strength, energy, damping), "),
    (lambda: lorentz((1, 2, 3, 4)), "give a row of 4 numbers for each"),
    (lambda: lorentz([(1, 2, 4, 1)]), "a broadening below twice the energy"),
    (lambda: OPEN.at("1 um"), "n of x follows from parameter 'b' besides | give it a default"),
    (lambda: op.Crystal.named("quarz"), "did you mean 'quartz'"),
    (lambda: op.Crystal(op.Material(1.5), 1.6), "extraordinary of the crystal is 1.6; give"),
    (lambda: op.Crystal.named("quartz").birefringence.at("3 um"), "known"),
]


@rows("ask, words", REFUSED)
def test_what_cannot_be_is_told_in_words_all_at_once(ask, words):
    with pytest.raises((op.errors.ValueFault, op.errors.ParameterError)) as fault:
        ask()
    for part in words.split(" | "):
        assert part in str(fault.value)
    with pytest.raises(op.errors.ValueFault) as fault:
        drude(-9, -0.1, -1, background="a", span="here")
    assert len(fault.value.faults) == 5


def test_slopes_along_the_wavelength_are_those_of_formulas(jacobian):
    # Of n^2 = 1 + b w^2 / (w^2 - c): dn/dw = -b c w / (n (w^2 - c)^2), w in um.
    material = op.Material.sellmeier([1.2], [0.01])
    n = float(material.at(5e-7).n)
    expected = -1.2 * 0.01 * 0.5 / (n * (0.25 - 0.01) ** 2) * 1e6
    found = jacobian(lambda w: material.at(w).n)(5e-7)
    assert float(found) == pytest.approx(expected, rel=1e-13)
    path = faced(bk7())
    by_run = jacobian(lambda w: path.trace(wavelength=w).stokes[0])(5e-7)
    bound = jacobian(lambda w: path.bind(wavelength=w).trace().stokes[0])(5e-7)
    assert float(bound) == pytest.approx(float(by_run), rel=1e-12)


HANDBOOK = {"quartz": (1.54424, 1.55335), "calcite": (1.65835, 1.48640)}
HANDBOOK |= {"MgF2": (1.37770, 1.38950), "sapphire": (1.76817, 1.76010)}
"""n_o and n_e at 589.3 nm, as handbooks of optics list them."""


@rows("name, indices", HANDBOOK.items())
def test_indices_are_those_of_handbooks_and_a_crystal_has_their_difference(name, indices):
    crystal = op.Crystal.named(name)
    found = [ray.n.at("589.3 nm") for ray in (crystal.ordinary, crystal.extraordinary)]
    np.testing.assert_allclose(found, indices, rtol=0, atol=4e-4)
    assert crystal.birefringence.at("589.3 nm") == pytest.approx(found[1] - found[0], abs=1e-15)
    same = op.Crystal(op.Material(1.5), op.Material(1.6))
    assert same.birefringence == pytest.approx(0.1)
    crystal = op.Crystal(op.Crystal.named("quartz").ordinary, op.Material(1.6))
    assert crystal.birefringence.at("589.3 nm") == pytest.approx(1.6 - 1.5442057, abs=1e-7)
    assert op.Crystal.named("quartz", "1.5 um").rotatory_power is None
    exact = op.Crystal.named("quartz").rotatory_power.at("589.3 nm")
    assert op.Crystal.named("quartz", "589.3 nm").rotatory_power == pytest.approx(exact, rel=1e-15)


def test_birefringence_of_quartz_has_all_its_digits_and_slopes(jax):
    def exact(wavelength):
        return sellmeier(QUARTZ["e"], mpf(wavelength)) - sellmeier(QUARTZ["o"], mpf(wavelength))

    quartz = op.Crystal.named("quartz").birefringence
    grid = np.linspace(2e-7, 2e-6, 41)
    slope = jax.grad(lambda w: quartz.curve.evaluated(w, *quartz.depends_on[1:])[0])(4.3e-7)
    with mpmath.workdps(50):
        np.testing.assert_allclose(quartz.at(grid), [float(exact(float(w))) for w in grid], 2e-15)
        assert float(slope) == pytest.approx(float(mpmath.diff(exact, mpf(4.3e-7))), rel=1e-13)


MEASURED = ["760.4 nm", "656.28 nm", "526.96 nm", "486.13 nm"]
MEASURED += ["430.79 nm", "410.17 nm", "358.18 nm", "226.45 nm"]
SORET_AND_SARASIN = [12.668, 17.318, 27.543, 32.773, 42.604, 47.481, 64.459, 201.824]
"""Rotation of 1 mm of quartz in degrees, J. L. Soret and E. Sarasin (1882), as the Handbuch der
Physik of A. Winkelmann has it."""


def test_quartz_turns_light_as_it_was_measured():
    power = op.Crystal.named("quartz").rotatory_power
    degrees = np.array(SORET_AND_SARASIN)
    assert np.degrees(power.at(MEASURED)) / 1e3 == pytest.approx(degrees, rel=5e-3)
    slab = op.Medium("1 mm", dextrorotation=power)
    light = (op.Source(stokes=[1, 1, 0, 0]) >> slab >> op.Detector()).trace(wavelength=MEASURED)
    turned = -np.degrees(light.aop) - degrees
    assert np.all(np.abs((turned + 90.0) % 180.0 - 90.0) <= 0.005 * degrees)
