from dataclasses import replace

import numpy as np
import pytest

import optipath as op


@pytest.mark.parametrize("name", op.preset_names())
def test_every_preset_runs_with_its_defaults_and_all_its_cases(name):
    path = op.load_preset(name)
    assert np.all(np.isfinite(path.trace().stokes))
    for case in path.cases:
        assert np.all(np.isfinite(op.load_preset(name, case=case).trace().stokes))


@pytest.mark.parametrize("name", op.preset_names())
def test_every_preset_and_case_is_written_and_read_back_the_same(name, tmp_path):
    whole = op.load_preset(name)
    for path in (whole, *(op.load_preset(name, case=case) for case in whole.cases)):
        file = tmp_path / "copy.toml"
        file.write_text(path.to_toml(), "utf-8")
        copy = op.load_preset(file)
        assert copy == path
        assert copy.compose() == path.compose()
        assert list(copy.parameters) == list(path.parameters)


def test_the_presets_that_were_promised_are_there():
    promised = {"npgr026", "fresnel-rhomb", "two-panes", "three-polarizers", "malus", "senarmont"}
    assert promised <= set(op.preset_names())
    assert op.preset_names() == sorted(op.preset_names())


def test_malus_law():
    angles = np.linspace(-np.pi, np.pi, 101)
    light = op.load_preset("malus").trace(angle=angles)
    np.testing.assert_allclose(light.intensity, 0.5 * np.cos(angles) ** 2, rtol=1e-15, atol=1e-16)


def test_a_third_polarizer_between_crossed_ones_lets_light_through():
    path = op.load_preset("three-polarizers")
    assert path.trace(middle="none").intensity == 0.0
    angles = np.linspace(0, np.pi, 51)
    np.testing.assert_allclose(
        path.trace(middle=angles).intensity, np.sin(2 * angles) ** 2 / 8, rtol=1e-15, atol=1e-16
    )


def test_fresnels_rhomb_makes_circular_light():
    # Born & Wolf, sec. 1.5.4: at 54 deg 37' or 48 deg 37' in glass of n = 1.51 each
    # total reflection retards by 45 degrees.
    path = op.load_preset("fresnel-rhomb")
    for incidence in ("54.616666666666667 deg", "48.616666666666667 deg"):
        stokes = path.trace(incidence=incidence).stokes
        np.testing.assert_allclose(stokes, [0.5, 0, 0, -0.5], rtol=0, atol=1e-3)


def test_two_panes_at_brewsters_angle_follow_malus_law():
    turns = np.linspace(0, np.pi, 51)
    light = op.load_preset("two-panes").trace(turn=turns).intensity
    # tan(theta) = n leaves F_s = ((n^2 - 1) / (n^2 + 1))^2 of s and nothing of p.
    reflectance = (1.25 / 3.25) ** 2
    np.testing.assert_allclose(
        light, 0.5 * reflectance**2 * np.cos(turns) ** 2, rtol=1e-15, atol=1e-17
    )


def test_a_double_pass_is_a_plate_of_twice_the_retardance():
    # Chipman, Lam & Young, table 6.5; then y and z are turned over.
    d, a = np.random.default_rng(2).uniform(-3.0, 3.0, (2, 20))
    c, s = np.cos(2 * a), np.sin(2 * a)
    expected = [
        1 + 0 * a,
        c**2 + s**2 * np.cos(2 * d),
        c * s * (np.cos(2 * d) - 1),
        s * np.sin(2 * d),
    ]
    light = op.load_preset("double-pass-waveplate").trace(retardance=d, angle=a)
    np.testing.assert_allclose(light.stokes.T, expected, atol=1e-15)


def test_senarmonts_compensator_is_dark_at_half_the_retardance():
    retardance = np.linspace(-np.pi, np.pi, 41)
    path = op.load_preset("senarmont")
    dark = path.trace(retardance=retardance, analyzer=np.pi / 2 + retardance / 2).intensity
    bright = path.trace(retardance=retardance, analyzer=retardance / 2).intensity
    np.testing.assert_allclose(dark, 0.0, rtol=0, atol=1e-15)
    np.testing.assert_allclose(bright, 0.5, rtol=0, atol=1e-15)
    assert path.trace().intensity == pytest.approx(0.0, abs=1e-16), "dark by default"


def by_an_ellipsometer(n, k, theta, polarizer, compensator, retardance, analyzer):
    """The intensity behind P, C, S and A, azimuths from p towards s, fields exp(+iwt).

    Azzam & Bashara, Ellipsometry and Polarized Light (1977), sec. 3.4: Jones vectors (p, s).
    """

    def along(angle):
        return np.array([np.cos(angle), np.sin(angle)])

    N, c = n - 1j * k, np.cos(theta)
    g = np.sqrt(1.0 - (np.sin(theta) / N) ** 2)
    sample = np.diag([(N * c - g) / (N * c + g), (c - N * g) / (c + N * g)])
    fast, slow = along(compensator), along(compensator + np.pi / 2)
    plate = np.outer(fast, fast) + np.exp(-1j * retardance) * np.outer(slow, slow)
    return 0.5 * abs(along(analyzer) @ sample @ plate @ along(polarizer)) ** 2


def test_the_ellipsometer_counts_azimuths_from_p_towards_s():
    rng = np.random.default_rng(7)
    limits = {"n": (0.2, 4.0), "k": (0.0, 4.0), "theta": (0.0, 1.5)}
    limits |= dict.fromkeys(["polarizer", "compensator", "retardance", "analyzer"], (-3.0, 3.0))
    plan = op.load_preset("ellipsometer-pcsa").compose()
    for _ in range(50):
        values = {name: rng.uniform(*between) for name, between in limits.items()}
        found = plan.run_all(**values)["photometer"].intensity
        assert found == pytest.approx(by_an_ellipsometer(**values), abs=1e-14)


def test_an_analyzer_at_0_passes_what_the_sample_reflects_of_p():
    # At Brewster's angle, nothing.
    glass = {"n": 1.5, "k": 0.0, "theta": np.arctan(1.5), "retardance": 0.0}
    plan = op.load_preset("ellipsometer-pcsa").compose()
    along_p, along_s = (
        plan.run_all(**glass, analyzer=analyzer)["photometer"].intensity
        for analyzer in (0.0, np.pi / 2)
    )
    assert along_p < 1e-30
    # r_s = (1 - n^2) / (1 + n^2), half of the light of the polariser being s.
    assert along_s == pytest.approx(0.25 * (1.25 / 3.25) ** 2)


def test_psi_and_delta_of_the_light_of_an_ellipsometer_are_those_of_the_sample():
    values = {"n": np.linspace(0.2, 4.0, 20), "k": np.linspace(3.0, 0.1, 20), "theta": 1.2}
    light = op.load_preset("ellipsometer-pcsa").trace(**values)
    sample = op.Interface(values["n"] + 1j * values["k"], 1.2).mueller()
    np.testing.assert_allclose(light.psi, sample.psi, rtol=1e-13)
    np.testing.assert_allclose(light.delta, sample.delta, rtol=1e-13)


def test_values_given_take_precedence_over_the_case_and_others_stay_open():
    path = op.load_preset("npgr026", case="7", filter="horizontal")
    expected = op.load_preset("npgr026", case="8").trace().stokes
    np.testing.assert_array_equal(path.trace().stokes, expected)
    np.testing.assert_allclose(path.trace(intensity=200.0).stokes, 2 * expected)


def test_the_values_of_a_case_can_be_varied():
    path, values = op.load_preset("npgr026"), op.load_preset("npgr026").cases["8"].values
    of_case = op.load_preset("npgr026", case=8)
    angles = np.radians([10.0, 48.0, 80.0])
    found = of_case.trace(delta=angles).stokes
    np.testing.assert_array_equal(found, path.trace(**{**values, "delta": angles}).stokes)
    np.testing.assert_array_equal(of_case.trace().stokes, path.trace(**values).stokes)
    assert (
        of_case.trace(filter="none").intensity
        == path.trace(**{**values, "filter": "none"}).intensity
    )


@pytest.mark.parametrize("name", op.preset_names())
def test_a_case_leaves_every_parameter_open_with_its_range_words_and_unit(name):
    plain = op.load_preset(name)
    for case, said in plain.cases.items():
        for parameter in op.load_preset(name, case=case).parameters.values():
            known = plain.parameters[parameter.name]
            assert not parameter.bound
            default = said.values.get(parameter.name, known.default)
            assert np.all(
                parameter.default == known.parse(default)
                if isinstance(default, str)
                else parameter.default == default
            )
            assert replace(parameter, default=known.default) == known


def test_what_is_given_beside_a_case_is_bound():
    path = op.load_preset("npgr026", case=8, delta=0.5)
    assert [name for name, p in path.parameters.items() if p.bound] == ["delta"]
    with pytest.raises(op.ParameterError, match=r"'delta' is bound.*leave it out of load_preset"):
        path.trace(delta=0.1)
    with pytest.raises(op.ParameterError, match=r"'delta' is bound.*leave it open there"):
        path.bind(delta=0.1)


def test_a_case_leaves_an_element_out_by_default_and_it_can_be_put_back():
    path = op.load_preset("npgr026", case=7)
    assert path.parameters["filter"].default == "none"
    np.testing.assert_array_equal(
        path.trace(filter="horizontal").stokes,
        op.load_preset("npgr026", case=7, filter="horizontal").trace().stokes,
    )


def test_a_path_gets_new_defaults_and_stays_as_it_was():
    path = op.load_preset("malus")
    crossed = path.with_defaults(angle="90 deg")
    assert crossed.trace().intensity == 0.0
    assert crossed.trace(angle=0.0).intensity == 0.5
    assert path.trace().intensity == pytest.approx(0.375)
    with pytest.raises(op.ParameterError) as error:
        path.with_defaults(angel=0.1, intensity=-1.0)
    assert len(error.value.faults) == 2


def test_a_case_may_be_given_as_a_number():
    assert op.load_preset("npgr026", case=7) == op.load_preset("npgr026", case="7")


@pytest.mark.parametrize(
    ("arguments", "messages"),
    [
        (("npgr62",), ["'npgr62' is unknown", "did you mean 'npgr026'"]),
        (("../npgr026",), ["neither the name of a preset"]),
        (("../x",), ["neither the name of a preset"]),
        (("",), ["neither the name of a preset"]),
        (("NPGR026",), ["neither the name of a preset"]),
        (("no-such.toml",), ["cannot be read", "No such file"]),
        (("a\0b.toml",), ["cannot be read"]),
        ((3,), ["not 3"]),
        ((None,), ["not None"]),
    ],
)
def test_presets_that_do_not_exist_are_refused(arguments, messages):
    with pytest.raises(op.PresetError) as error:
        op.load_preset(*arguments)
    for message in messages:
        assert message in str(error.value)


def test_an_unknown_case_is_refused_with_a_suggestion():
    with pytest.raises(op.PresetError, match=r"case 'crosed'.*did you mean 'crossed'"):
        op.load_preset("two-panes", case="crosed")


def test_unknown_and_unsuitable_parameters_are_told_at_once():
    with pytest.raises(op.ParameterError) as error:
        op.load_preset("npgr026", detla=1.0, phi=9.0, n1=-1.0)
    assert len(error.value.faults) == 3
    assert "did you mean 'delta'" in str(error.value)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"\xff\xfe", "not UTF-8: byte 0 is 0xff"),
        (b"a = = 1", "not TOML"),
        (b"a = " + b"[" * 100_000, "not TOML"),
        (b"format = 2", "has format 2, but this version reads format 1"),
        (b"", "'format' is missing"),
        (b"#" * (5 * 1024 * 1024), "larger than 4 MiB"),
    ],
)
def test_files_that_are_no_presets_are_refused(content, message, tmp_path):
    file = tmp_path / "file.toml"
    file.write_bytes(content)
    with pytest.raises(op.OptipathError, match=message):
        op.load_preset(file)


def test_a_huge_file_is_refused_without_reading_it_all(tmp_path):
    file = tmp_path / "huge.toml"
    with file.open("wb") as handle:
        handle.truncate(100 * 1024 * 1024)
    with pytest.raises(op.PresetError, match="larger than"):
        op.load_preset(file)


def test_a_folder_is_no_preset(tmp_path):
    folder = tmp_path / "folder.toml"
    folder.mkdir()
    with pytest.raises(op.PresetError, match="cannot be read"):
        op.load_preset(folder)


def test_a_dichroic_sheet_at_45_degrees_between_crossed_polarizers_is_a_filter_and_a_plate():
    # Along one axis, amplitudes t1 and t2 exp(i delta) interfere.
    path = op.load_preset("dichroic-sheet")
    thickness = np.linspace(0.0, 1e-4, 21)
    t1, t2 = (np.exp(-0.5 * (0.1e6 + sign * 0.09e6) * thickness) for sign in (-1, 1))
    expected = abs(t1 - t2 * np.exp(1j * np.radians(20e6) * thickness)) ** 2 / 8
    found = path.trace(thickness=thickness).intensity
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-15)


def test_the_cases_of_a_dichroic_sheet_are_what_their_notes_say():
    found = {
        case: float(op.load_preset("dichroic-sheet", case=case).trace().intensity)
        for case in ("clear", "aligned")
    }
    assert found["clear"] == pytest.approx(np.sin(np.radians(250.0)) ** 2 / 2, rel=1e-14)
    assert found["aligned"] == pytest.approx(np.exp(-0.25) / 2, rel=1e-15)


def test_a_skewed_dichroic_sheet_is_many_thin_filters_and_plates_in_turn():
    sheet = op.load_preset("dichroic-sheet", case="skewed")
    count = 4096
    plate = np.radians(500.0) / count
    plate = op.Retarder(plate / 2, "45 deg").mueller().matrix
    passed = np.exp(-0.01 * 25 / count), np.exp(-0.19 * 25 / count)
    dye = op.Diattenuator(*passed, "25 deg").mueller().matrix
    whole = np.linalg.matrix_power(plate @ dye @ plate, count)
    first, last = (op.Polarizer(angle).mueller().matrix for angle in (0.0, "90 deg"))
    # Halves before and behind are right to the square of the step.
    assert float(sheet.trace().intensity) == pytest.approx((last @ whole @ first)[0, 0], rel=1e-5)


@pytest.mark.parametrize("case", ["crown", "flint", "brewster"])
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


def test_a_prism_by_its_points_is_the_same():
    apex, n = np.radians(60.0), 1.5
    # It stands on its base, along which light runs inside; outside it is turned down on both sides.
    half = 0.5 * (2.0 * np.arcsin(n * np.sin(apex / 2)) - apex)
    away = [np.cos(half), 0.0, -np.sin(half)]
    points = [[-1 - away[0], 0, away[2]], [-1, 0, 0], [1, 0, 0], [1 + away[0], 0, away[2]]]
    faces = [[-np.cos(apex / 2), 0, np.sin(apex / 2)], [np.cos(apex / 2), 0, np.sin(apex / 2)]]
    chain = op.path_from_vertices(points, [n, 1.0], faces, events="TT")
    expected = op.load_preset("prism-refraction").trace(apex=apex, n=n).stokes
    np.testing.assert_allclose(chain.trace().stokes, expected, rtol=0, atol=1e-15)


@pytest.mark.parametrize("what", ["elements", "parameters", "links"])
def test_a_file_has_4000_entries_of_each_kind_at_most(what, tmp_path):
    header = "[[links]]" if what == "links" else "[{}.x{}]"
    file = tmp_path / "many.toml"
    file.write_text("format = 1\n" + "".join(f"{header.format(what, n)}\n" for n in range(3001)))
    with pytest.raises(op.PathError, match=f"it has 3,001 {what}; give 3,000 at most"):
        op.load_preset(file)
