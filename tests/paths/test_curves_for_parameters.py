"""Curves by wavelength in place of the parameters of a path."""

import numpy as np
import pytest

import optipath as op

TGG = op.drude_rotation([-41.72], [0.08909], unit="rad/(T m)", label="TGG")
GREEN = op.tabulated(["500 nm", "600 nm"], [0.2, 0.8], label="green")


def _verdet(micrometres):
    return -41.72 / (micrometres**2 - 0.08909)


def test_a_curve_stands_where_a_parameter_of_a_preset_does():
    turned = _verdet(0.6328) * -0.5 * 20e-3
    expected = np.cos(np.pi / 4 - turned) ** 2
    isolator = op.load_preset("faraday-isolator")
    at = {"wavelength": "632.8 nm"}
    lights = [
        op.load_preset("faraday-isolator", verdet=TGG).trace_all(**at),
        isolator.bind(verdet=TGG).trace_all(**at),
        isolator.bind(verdet=TGG, **at).trace_all(),
        isolator.trace_all(verdet=TGG, **at),
        isolator.bind(verdet=0.5 * TGG + "0 rad/(T m)", length="40 mm").trace_all(**at),
    ]
    for light in lights:
        assert light["passed"].intensity == pytest.approx(expected, rel=1e-12)


def test_a_curve_takes_precedence_over_a_case():
    path = op.load_preset("faraday-isolator", case="tgg", verdet=TGG)
    again = op.load_preset("faraday-isolator", case="tgg").parameters
    own = {"verdet": _verdet(0.6328)}
    assert again["verdet"].default == pytest.approx(own["verdet"], rel=1e-2)
    assert path.trace_all(wavelength="632.8 nm")["passed"].intensity == pytest.approx(1.0, abs=1e-3)


def test_a_curve_keeps_its_multiple_and_that_of_its_place():
    share = op.Parameter("share")
    path = op.Source() >> op.Attenuator(0.1 + 0.5 * share) >> op.Detector()
    light = path.trace(share=2.0 * GREEN - 0.1, wavelength="550 nm")
    assert light.intensity == pytest.approx(0.1 + 0.5 * (2 * 0.5 - 0.1), rel=1e-14)


def test_a_spectrum_stands_for_the_parameter_of_a_source_and_of_a_detector():
    path = op.Source(spectrum=op.Parameter("s")) >> op.Detector(response=op.Parameter("r"))
    lamp = op.Spectrum(["500 nm", "600 nm"], [1.0, 3.0])
    grid = ["500 nm", "550 nm", "600 nm"]
    light = path.trace(s=lamp, r=GREEN, wavelength=grid)
    np.testing.assert_allclose(light.intensity, [0.2, 1.0, 2.4], rtol=1e-14)


def test_curves_of_the_numbers_of_all_presets_give_the_same_light():
    faults, tried = [], 0
    for preset in op.preset_names():
        path = op.load_preset(preset)
        for name, one in path.parameters.items():
            number = isinstance(one.default, float) and not one.bound and np.isfinite(one.default)
            if not number or isinstance(one, op.Wavelength) or one.words or one.optional:
                continue
            unit = one.unit if one.unit else ""
            text = one.text(one.default)
            curve = op.tabulated(["100 nm", "10 um"], [text, text], unit)
            given = {"wavelength": 5e-7} if "wavelength" not in path.parameters else {}
            try:
                found = path.bind(**{name: curve}).trace_all(**given)
            except op.OptipathError as fault:
                faults.append(f"{preset} {name}: {fault}")
                continue
            tried += 1
            for end, light in path.trace_all().items():
                if not np.allclose(
                    found[end].stokes, light.stokes, rtol=1e-9, atol=1e-12, equal_nan=True
                ):
                    faults.append(f"{preset} {name}: {found[end]} {light}")
    assert faults == []
    assert tried > 50


def test_what_cannot_stand_there_is_refused():
    path = op.load_preset("faraday-isolator")
    refused = [
        (lambda: path.bind(length=TGG), "rad/"),
        (lambda: path.with_defaults(verdet=TGG), r"bind it, by path\.bind\(verdet"),
        (lambda: path.compose().run_all(verdet=TGG), r"write path\.bind\(verdet"),
        (lambda: path.bind(verdet=TGG, vordet=TGG), "'vordet' is unknown"),
        (lambda: path.bind(verdet=TGG).bind(wavelength=GREEN), "must be a number"),
    ]
    for run, told in refused:
        with pytest.raises(op.OptipathError, match=told):
            run()
