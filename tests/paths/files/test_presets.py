"""The presets: they are read as asked for, and their light is that of closed forms."""

from dataclasses import replace

import mpmath
import numpy as np
import pytest
from mpmath import cos, mpf

import optipath as op
from crystal_optics import lyot, retardance, rhomb, solc
from tables import rows, slow
from wired import read_back

PRESETS = op.preset_names()
CRYSTALS = "lyot-filter", "solc-filter", "quartz-quarter-wave", "achromatic-rhomb"


@pytest.mark.parametrize("most", [2, slow(99)])
@rows("name", PRESETS)
def test_every_preset_and_case_runs_is_read_back_the_same_and_leaves_parameters_open(
    name, most, tmp_path
):
    whole = op.load_preset(name)
    of_cases = {case: op.load_preset(name, case=case) for case in [*whole.cases][:most]}
    for case, path in of_cases.items():
        for parameter in path.parameters.values():
            known = whole.parameters[parameter.name]
            assert not parameter.bound
            default = whole.cases[case].values.get(parameter.name, known.default)
            default = known.parse(default) if isinstance(default, str) else default
            assert np.all(parameter.default == default)
            assert replace(parameter, default=known.default) == known
        if name in (*CRYSTALS, "lyot-depolarizer"):
            told = whole.cases[case].published["eye"]
            np.testing.assert_allclose(path.trace().stokes, told, rtol=0, atol=2e-9)
    for path in (whole, *of_cases.values()):
        assert np.all(np.isfinite(path.trace().stokes))
        copy = read_back(path, tmp_path)
        assert copy == path
        assert copy.compose() == path.compose()
        assert list(copy.parameters) == list(path.parameters)


MALUS = op.load_preset("malus")
ANGLES = np.linspace(0.0, np.pi, 51)
RETARDANCE = np.linspace(-np.pi, np.pi, 41)


@rows(
    "name, values, expected",
    [
        ("malus", {"angle": ANGLES}, 0.5 * np.cos(ANGLES) ** 2),
        ("malus", {"angle": -ANGLES}, 0.5 * np.cos(ANGLES) ** 2),
        ("three-polarizers", {"middle": "none"}, 0.0),
        ("three-polarizers", {"middle": ANGLES}, np.sin(2 * ANGLES) ** 2 / 8),
        # tan(theta) = n leaves F_s = ((n^2 - 1) / (n^2 + 1))^2 of s and nothing of p.
        ("two-panes", {"turn": ANGLES}, 0.5 * (1.25 / 3.25) ** 4 * np.cos(ANGLES) ** 2),
        # Dark at half the retardance, which it is by default, and bright across.
        ("senarmont", {"retardance": RETARDANCE, "analyzer": np.pi / 2 + RETARDANCE / 2}, 0.0),
        ("senarmont", {"retardance": RETARDANCE, "analyzer": RETARDANCE / 2}, 0.5),
        ("senarmont", {}, 0.0),
    ],
)
def test_polarisers_and_plates_follow_malus_law(name, values, expected):
    found = op.load_preset(name).trace(**values).intensity
    slack = {"senarmont": 1e-15 if values else 1e-16, "two-panes": 1e-17}.get(name, 1e-16)
    np.testing.assert_allclose(found, expected, rtol=1e-15, atol=slack)


def test_rhombs_plates_and_isolators_follow_their_closed_forms():
    # Born & Wolf, sec. 1.5.4: at 54 deg 37' or 48 deg 37' in glass of n = 1.51 each
    # total reflection retards by 45 degrees.
    path = op.load_preset("fresnel-rhomb")
    for incidence in ("54.616666666666667 deg", "48.616666666666667 deg"):
        stokes = path.trace(incidence=incidence).stokes
        np.testing.assert_allclose(stokes, [0.5, 0, 0, -0.5], rtol=0, atol=1e-3)
    # Chipman, Lam & Young, table 6.5; then y and z are turned over.
    d, a = np.random.default_rng(2).uniform(-3.0, 3.0, (2, 20))
    c, s = np.cos(2 * a), np.sin(2 * a)
    both = [c**2 + s**2 * np.cos(2 * d), c * s * (np.cos(2 * d) - 1), s * np.sin(2 * d)]
    light = op.load_preset("double-pass-waveplate").trace(retardance=d, angle=a)
    np.testing.assert_allclose(light.stokes.T, [1 + 0 * a, *both], atol=1e-15)
    path, fields, verdet, length = op.load_preset("faraday-isolator"), ANGLES - 1.2, -134.0, 0.02
    ideal = path.trace_all()
    assert (ideal["passed"].intensity, ideal["returned"].intensity) == (1.0, 0.0)
    lights = path.trace_all(verdet=verdet, length=length, field=fields)
    short = np.pi / 4 - verdet * length * fields
    passed, returned = np.cos(short) ** 2, np.sin(2 * short) ** 2 / 4
    np.testing.assert_allclose(lights["passed"].intensity, passed, rtol=0, atol=1e-15)
    np.testing.assert_allclose(lights["returned"].intensity, returned, rtol=0, atol=1e-15)
    # In the wrong field it isolates the other way.
    assert path.trace_all(field=0.5)["passed"].intensity == pytest.approx(0.0, abs=1e-30)
    for case, returned in (("tgg", 7e-12), ("weak-field", 0.00154)):
        garnet = op.load_preset("faraday-isolator", case=case)
        assert garnet.trace().intensity == pytest.approx(returned, rel=0.01)


def by_an_ellipsometer(n, k, theta, polarizer, compensator, retardance, analyzer):
    """The intensity behind P, C, S and A, azimuths from p towards s, fields exp(+iwt).

    Azzam & Bashara, Ellipsometry and Polarized Light (1977), sec. 3.4: Jones vectors (p, s).
    """
    N, c = n - 1j * k, np.cos(theta)
    g = np.sqrt(1.0 - (np.sin(theta) / N) ** 2)
    sample = np.diag([(N * c - g) / (N * c + g), (c - N * g) / (c + N * g)])
    angles = np.array([analyzer, polarizer, compensator, compensator + np.pi / 2])
    last, first, fast, slow = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    plate = np.outer(fast, fast) + np.exp(-1j * retardance) * np.outer(slow, slow)
    return 0.5 * abs(last @ sample @ plate @ first) ** 2


def test_an_ellipsometer_counts_azimuths_from_p_towards_s_and_has_the_psi_and_delta_of_its_sample():
    rng = np.random.default_rng(7)
    limits = {"n": (0.2, 4.0), "k": (0.0, 4.0), "theta": (0.0, 1.5)}
    limits |= dict.fromkeys(["polarizer", "compensator", "retardance", "analyzer"], (-3.0, 3.0))
    path = op.load_preset("ellipsometer-pcsa")
    plan = path.compose()
    for _ in range(50):
        values = {name: rng.uniform(*between) for name, between in limits.items()}
        found = plan.run_all(**values)["photometer"].intensity
        assert found == pytest.approx(by_an_ellipsometer(**values), abs=1e-14)
    # At Brewster's angle an analyser at 0 passes nothing of p; half the light before is s, of
    # which r_s = (1 - n^2) / (1 + n^2) is reflected.
    glass = {"n": 1.5, "k": 0.0, "theta": np.arctan(1.5), "retardance": 0.0}
    across = np.array([0.0, np.pi / 2])
    along_p, along_s = plan.run_all(**glass, analyzer=across)["photometer"].intensity
    assert along_p < 1e-30
    assert along_s == pytest.approx(0.25 * (1.25 / 3.25) ** 2)
    values = {"n": np.linspace(0.2, 4.0, 20), "k": np.linspace(3.0, 0.1, 20), "theta": 1.2}
    light = path.trace(**values)
    sample = op.Interface(values["n"] + 1j * values["k"], 1.2).mueller()
    np.testing.assert_allclose([light.psi, light.delta], [sample.psi, sample.delta], rtol=1e-13)


def test_values_take_precedence_over_a_case_and_stay_open_or_are_bound():
    promised = {"npgr026", "fresnel-rhomb", "two-panes", "three-polarizers", "malus", "senarmont"}
    assert promised <= set(PRESETS)
    assert sorted(PRESETS) == PRESETS
    path, of_case = op.load_preset("npgr026"), op.load_preset("npgr026", case=8)
    found, expected = op.load_preset("npgr026", case="7", filter="horizontal"), of_case.trace()
    np.testing.assert_array_equal(found.trace().stokes, expected.stokes)
    np.testing.assert_allclose(found.trace(intensity=200.0).stokes, 2 * expected.stokes)
    for given in ({"delta": np.radians([10.0, 48.0, 80.0])}, {}, {"filter": "none"}):
        other = path.trace(**{**path.cases["8"].values, **given})
        np.testing.assert_array_equal(of_case.trace(**given).stokes, other.stokes)
    path = op.load_preset("npgr026", case=8, delta=0.5)
    assert [name for name, p in path.parameters.items() if p.bound] == ["delta"]
    for give, cure in ((path.trace, "leave it out of load_preset"), (path.bind, "leave it open")):
        with pytest.raises(op.errors.ParameterError, match=rf"'delta' is bound.*{cure}"):
            give(delta=0.1)
    path = op.load_preset("npgr026", case=7)
    assert path == op.load_preset("npgr026", case="7")
    assert path.parameters["filter"].default == "none"
    np.testing.assert_array_equal(path.trace(filter="horizontal").stokes, found.trace().stokes)
    crossed = MALUS.with_defaults(angle="90 deg")
    assert [crossed.trace().intensity, crossed.trace(angle=0.0).intensity] == [0.0, 0.5]
    assert MALUS.trace().intensity == pytest.approx(0.375)


@rows(
    "load, sentence",
    [
        ("npgr62", "did you mean 'npgr026'"),
        *((name, "neither the name of a preset") for name in ("../npgr026", "", "NPGR026")),
        *(("no-such.toml", "cannot be read: No such file"), ("a\0b.toml", "cannot be read")),
        (None, "not None"),
        (lambda: op.load_preset("two-panes", case="crosed"), "crossed; did you mean 'crossed'"),
        (lambda: op.load_preset("npgr026", detla=1.0, phi=9.0, n1=-1.0), "3 faults"),
        (lambda: op.load_preset("npgr026", detla=1.0), "did you mean 'delta'"),
        (lambda: MALUS.with_defaults(angel=0.1, intensity=-1.0), "2 faults"),
    ],
)
def test_presets_cases_and_values_that_do_not_exist_are_refused(load, sentence):
    values = callable(load) and "crossed" not in sentence
    with pytest.raises(op.errors.ParameterError if values else op.errors.PresetError) as caught:
        load() if callable(load) else op.load_preset(load)
    assert sentence in str(caught.value)


@rows(
    "content, message",
    [
        *((b"\xff\xfe", "not UTF-8 at byte 0"), (b"a = = 1", "not TOML")),
        (b"format = 2", "has format 2, but this version reads format 1"),
        *((b"", "'format' is missing"), (b"#" * (5 * 1024 * 1024), "larger than 4 MiB")),
        # Not all of a huge file is read.
        *((100 * 1024 * 1024, "larger than"), (None, "cannot be read")),
        (b"format = 1\n" + b"[[links]]\n" * 3001, "the preset has no elements"),
    ],
)
def test_folders_and_files_that_are_no_presets_are_refused(content, message, tmp_path):
    file = tmp_path / f"{content is None}.toml"
    if content is None:
        file.mkdir()
    elif isinstance(content, int):
        with file.open("wb") as handle:
            handle.truncate(content)
    else:
        file.write_bytes(content)
    with pytest.raises(
        op.errors.PathError if "3,001" in message else op.OptipathError, match=message
    ):
        op.load_preset(file)


def test_a_dichroic_sheet_is_a_filter_and_a_plate_as_the_notes_of_its_cases_say():
    # Along one axis, amplitudes t1 and t2 exp(i delta) interfere.
    path = op.load_preset("dichroic-sheet")
    thickness = np.linspace(0.0, 1e-4, 21)
    t1, t2 = (np.exp(-0.5 * (0.1e6 + sign * 0.09e6) * thickness) for sign in (-1, 1))
    expected = abs(t1 - t2 * np.exp(1j * np.radians(20e6) * thickness)) ** 2 / 8
    found = path.trace(thickness=thickness).intensity
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-15)
    cases = (op.load_preset("dichroic-sheet", case=c) for c in ("clear", "aligned", "skewed"))
    clear, aligned, skewed = (float(case.trace().intensity) for case in cases)
    assert clear == pytest.approx(np.sin(np.radians(250.0)) ** 2 / 2, rel=1e-14)
    assert aligned == pytest.approx(np.exp(-0.25) / 2, rel=1e-15)
    # One that is skewed is many thin filters and plates in turn.
    count = 4096
    plate = op.Retarder(np.radians(500.0) / count / 2, "45 deg").mueller().matrix
    passed = np.exp(-np.array([0.01, 0.19]) * 25 / count)
    dye = op.Diattenuator(*passed, "25 deg").mueller().matrix
    whole = np.linalg.matrix_power(plate @ dye @ plate, count)
    first, last = (op.Polarizer(angle).mueller().matrix for angle in (0.0, "90 deg"))
    # Halves before and behind are right to the square of the step.
    assert skewed == pytest.approx((last @ whole @ first)[0, 0], rel=1e-5)


@rows("case", ["crown", "flint", "brewster"])
def test_a_prism_at_minimum_deviation_lets_through_what_fresnels_equations_say(case):
    path = op.load_preset("prism-refraction", case=case)
    apex, n = (path.parameters[name].default for name in ("apex", "n"))
    inside, outside = np.cos(apex / 2), np.sqrt(1.0 - (n * np.sin(apex / 2)) ** 2)
    # Both faces let through 4 p q / (p + q)^2, with q = n cos for s and cos / n for p.
    s = (4.0 * n * inside * outside / (outside + n * inside) ** 2) ** 2
    p = (4.0 * n * inside * outside / (n * outside + inside) ** 2) ** 2
    expected = [0.5 * (s + p), 0.5 * (s - p), 0.0, 0.0]
    np.testing.assert_allclose(path.trace().stokes, expected, rtol=0, atol=1e-15)
    if case == "brewster":
        assert p == pytest.approx(1.0, abs=1e-15), "all of p gets through"


def test_prisms_and_clear_piles_are_those_of_points_and_stacks():
    apex, n = np.radians(60.0), 1.5
    # It stands on its base, along which light runs inside; outside it is turned down on both sides.
    half = 0.5 * (2.0 * np.arcsin(n * np.sin(apex / 2)) - apex)
    away = [np.cos(half), 0.0, -np.sin(half)]
    points = [[-1 - away[0], 0, away[2]], [-1, 0, 0], [1, 0, 0], [1 + away[0], 0, away[2]]]
    faces = [[-np.cos(apex / 2), 0, np.sin(apex / 2)], [np.cos(apex / 2), 0, np.sin(apex / 2)]]
    chain = op.path_from_vertices(points, [n, 1.0], faces, events="TT")
    expected = op.load_preset("prism-refraction").trace(apex=apex, n=n).stokes
    np.testing.assert_allclose(chain.trace().stokes, expected, rtol=0, atol=1e-15)
    lights = op.load_preset("absorbing-pile", case="clear").trace_all()
    assert sum(light.intensity for light in lights.values()) == pytest.approx(1.0, abs=1e-15)
    lossless = op.LayerStack([1.0] + [1.5, 1.0] * 4, "56.309932474020215 deg")
    expected = lossless.mueller("in", "transmitted").matrix[:, 0]
    assert lights["transmitted"].stokes == pytest.approx(expected, abs=1e-15)


def plate(polarization, n, k, depth, incidence):
    """What one plate reflects and lets through, by Fresnel's equations for waves that fade."""
    m, y = mpmath.mpc(n, k), mpmath.sin(incidence)
    c, g = mpmath.cos(incidence), mpmath.sqrt(m * m - y * y)
    first, second = (c, g) if polarization == "s" else (c, g / (m * m))
    R = abs((first - second) / (first + second)) ** 2
    T = abs(2 * first / (first + second)) ** 2 * second.real / first
    T_back = abs(2 * second / (first + second)) ** 2 * first / second.real
    t = mpmath.exp(-depth * g.imag)
    rounds = 1 / (1 - R * R * t * t)
    return R + T * T_back * R * t * t * rounds, T * T_back * t * rounds


def pile(R, T, plates=4):
    """R and T of a pile (G. G. Stokes, Proc. R. Soc. Lond. 11, 545 (1862))."""
    root = mpmath.sqrt((1 + R + T) * (1 + R - T) * (1 - R + T) * (1 - R - T))
    a, b = (1 + R * R - T * T + root) / (2 * R), (1 - R * R + T * T + root) / (2 * T)
    bottom = a * b**plates - 1 / (a * b**plates)
    return (b**plates - b**-plates) / bottom, (a - 1 / a) / bottom


@rows("case", ["tinted", "normal", "smoked"])
def test_an_absorbing_pile_is_stokes_formula_in_50_digits(case):
    path = op.load_preset("absorbing-pile", case=case)
    values = {name: parameter.default for name, parameter in path.parameters.items()}
    with mpmath.workdps(50):
        depth = 4 * mpmath.pi * mpf(values["thickness"]) / mpf(values["wavelength"])
        of_plate = [mpf(values[name]) for name in ("n", "k")]
        # At Brewster's angle a plate reflects next to nothing of p.
        of_plate += [depth, mpf(values["theta"])]
        (Rs, Ts), (Rp, Tp) = (pile(*plate(way, *of_plate)) for way in "sp")
        exact = {"reflected": (Rs, Rp), "transmitted": (Ts, Tp)}
        for name, light in path.trace_all().items():
            s, p = exact[name]
            assert light.stokes[0] == pytest.approx(float((s + p) / 2), rel=1e-12)
            assert light.stokes[1] == pytest.approx(float((s - p) / 2), rel=1e-12, abs=1e-15)


VISIBLE = np.linspace(4e-7, 7e-7, 61)


def each(function, number):
    """A closed form of a number and the wavelength, in 50 digits, over the visible ones."""
    with mpmath.workdps(50):
        return np.array([float(function(mpf(number), mpf(float(one)))) for one in VISIBLE])


@rows(
    "name, number, closed",
    [
        *(("lyot-filter", "thickness", lyot), ("solc-filter", "thickness", solc)),
        ("quartz-quarter-wave", "thickness", retardance),
        ("achromatic-rhomb", "incidence", rhomb),
    ],
)
def test_crystals_and_a_rhomb_let_through_and_retard_what_their_closed_forms_say(
    name, number, closed
):
    path = op.load_preset(name)
    exact = each(closed, path.parameters[number].default)
    S0, S1, S2, S3 = op.Composer(engine="numpy").compose(path).run(wavelength=VISIBLE).stokes.T
    if "filter" in name:
        np.testing.assert_allclose(S0, exact, rtol=0, atol=1e-13)
        np.testing.assert_allclose(np.abs(S1), S0, rtol=0, atol=1e-15)
        return
    of_quartz = name == "quartz-quarter-wave"
    size, handed, slack = (1.0, 1.0, 1e-12) if of_quartz else (0.5, -1.0, 1e-14)
    np.testing.assert_allclose(S2, size * np.cos(exact), rtol=0, atol=slack)
    np.testing.assert_allclose(S3, handed * size * np.sin(exact), rtol=0, atol=slack)
    if of_quartz:
        assert path.trace().docp == pytest.approx(1.0, abs=1e-15)
    else:
        assert np.all(np.abs(np.degrees(exact) - 90.0) < 1.2)


@pytest.mark.slow
@rows(
    "name, number, closed, S, wavelengths",
    [
        ("lyot-filter", "thickness", lyot, 0, (4.3e-7, 5.461e-7, 6.57e-7)),
        ("quartz-quarter-wave", "thickness", lambda d, w: cos(retardance(d, w)), 2, (4.3e-7,)),
        ("achromatic-rhomb", "incidence", lambda a, w: cos(rhomb(a, w)) / 2, 2, (4.1e-7, 6.5e-7)),
    ],
)
def test_slopes_are_those_of_the_closed_forms(jax, name, number, closed, S, wavelengths):
    path = op.load_preset(name)
    default = path.parameters[number].default
    plan = op.Composer(engine="jax").compose(path)

    def part(wavelength, value):
        return plan.run(**{"wavelength": wavelength, number: value}).stokes[S]

    for wavelength in wavelengths:
        found = jax.grad(part, argnums=(0, 1))(wavelength, default)
        with mpmath.workdps(50):
            places = (mpf(default), mpf(wavelength))
            exact = [float(mpmath.diff(closed, places, order)) for order in ((0, 1), (1, 0))]
        rtol = 1e-12 if name == "quartz-quarter-wave" else 1e-9
        np.testing.assert_allclose(found, exact, rtol=rtol)


@rows("angle", ["0 deg", "22.5 deg", "45 deg", "70 deg"])
def test_a_band_of_wavelengths_leaves_the_depolarizer_unpolarized(angle):
    path = op.load_preset("lyot-depolarizer")
    band = 1.0 / np.linspace(1.0 / 5e-7, 1.0 / 6e-7, 4001)
    light = path.trace(wavelength=band, angle=angle, thickness="10 mm")
    np.testing.assert_allclose(light.dop, 1.0, rtol=0, atol=1e-13)
    whole = light.stokes.mean(axis=0)
    assert np.linalg.norm(whole[1:]) / whole[0] < 0.02


def test_a_spectrum_of_copper_and_gold_is_that_of_its_samples_at_energies_within_its_range():
    # Linear between 495.9 and 520.9 nm: Phys. Rev. B 6, 4370 (1972), table I.
    share = (516.0 - 495.9) / (520.9 - 495.9)
    gold = 1.04 + 1.833j + share * ((0.62 + 2.081j) - (1.04 + 1.833j))
    copper = 1.22 + 2.564j + share * ((1.18 + 2.608j) - (1.22 + 2.564j))
    known = {"delta": "48 deg", "rho": "34 deg", "phi": "20 deg"}
    known |= {"n1": copper.real, "k1": copper.imag, "n2": gold.real, "k2": gold.imag}
    same = op.load_preset("npgr026").trace(**known)
    light = op.load_preset("copper-gold-spectrum").trace(wavelength="516 nm")
    np.testing.assert_allclose(light.stokes, same.stokes, rtol=1e-13)
    path = op.load_preset("lyot-filter")
    energy, metres = path.trace(wavelength=["2.4 eV", 1.2398419843320026e-6 / 2.4]).intensity
    assert energy == pytest.approx(metres, abs=1e-12)
    with pytest.raises(op.errors.ParameterError, match=r"give 200 nm \.\. 2000 nm"):
        path.trace(wavelength="100 nm")
