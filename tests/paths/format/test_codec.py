import numpy as np
import pytest

import optipath as op
from optipath.paths.drawing import draw
from paths import chain

ELEMENTS = [
    op.Mirror(),
    op.Mirror(-0.97 + 0.12j, 0.92 - 0.26j, azimuth=0.3),
    op.Mirror(np.array([-0.9 + 0.1j, 0.3j]), -op.Parameter("r", 0.5 - 0.5j)),
    op.Mirror(np.array([-0.9, 0.3]), op.Parameter("r", np.array([0.5, 0.5j]))),
    op.Mirror(np.array([-0.9, 0.3]), op.Parameter("r", np.array([0.5, 0.25]))),
    op.Interface(np.array([0.17, 3.15]), 0.3),
    op.LayerStack([1.0, np.array([1.5, 1.6]), np.array([0.17, 3.15])], 0.3),
    op.LayerStack([1.0, 1.5, 0.2 + 3.0j], 0.3),
    op.Diattenuator(0.9, op.Parameter("least"), angle=0.2, azimuth=0.1),
    op.Depolarizer(0.3),
    op.Medium(0.2, 0.7, rotation=-np.radians(66.5)),
    op.Medium(op.Parameter("l", 1e-3, minimum=0.0), 12.3, retardance=97.3, angle=0.1, azimuth=0.2),
    op.FaradayRotator(-0.3),
    op.FaradayRotator(verdet=-134.0, field=-op.Parameter("b", "5 mT", unit="mT"), length=0.02),
    op.CircularPolarizer("left", 0.9, op.Parameter("leakage")),
    op.Waveplate(op.Parameter("d", "1 mm"), 0.0091, np.array([5e-7, 6e-7]), 0.1, azimuth=0.2),
    op.Medium(0.1, op.Parameter("a", [1.0, 2.0], unit="1/m"), rotation=op.Parameter("b")),
]


def loaded(text, tmp_path):
    file = tmp_path / "path.toml"
    file.write_text(text, "utf-8")
    return op.load_preset(file)


@pytest.mark.parametrize("element", ELEMENTS)
def test_an_element_goes_to_toml_and_back(element, tmp_path):
    path = chain([element])
    assert loaded(path.to_toml(), tmp_path) == path


@pytest.mark.parametrize("element", ELEMENTS)
def test_an_element_can_be_drawn(element):
    assert element.kind in draw(chain([element]))


@pytest.mark.parametrize("place", ["field", "default", "case"])
def test_a_pair_of_numbers_for_an_index_is_asked_about(place, tmp_path):
    index = op.Parameter("gold", 1.5) if place != "field" else 1.5
    text = chain([op.Interface(index, 0.3)]).to_toml()
    told = r"\{ n = 0\.17, k = 3\.15 \} for the one, \{ n = \[0\.17, 3\.15\] \} for the other"
    given = {
        "field": text.replace("index = 1.5", "index = PAIR"),
        "default": text.replace("default = 1.5", "default = PAIR"),
        "case": text + "[cases.a]\nvalues = { gold = PAIR }\n",
    }[place]
    with pytest.raises(op.PathError, match=told):
        loaded(given.replace("PAIR", "[0.17, 3.15]"), tmp_path)
    case = "a" if place == "case" else None
    (tmp_path / "path.toml").write_text(given.replace("PAIR", "{ n = 0.17, k = 3.15 }"))
    gold = chain([op.Interface(op.Material(0.17, 3.15), 0.3)])
    assert op.load_preset(tmp_path / "path.toml", case=case).trace() == gold.trace()
    (tmp_path / "path.toml").write_text(given.replace("PAIR", "{ n = [0.17, 3.15] }"))
    assert op.load_preset(tmp_path / "path.toml", case=case).trace().shape == (2,)


def test_amplitudes_are_written_by_their_real_and_imaginary_parts():
    text = chain([op.Mirror(-0.5 + 0.25j, op.Parameter("r", 0.5j))]).to_toml()
    assert "r_s = { re = -0.5, im = 0.25 }" in text
    assert "default = { re = 0.0, im = 0.5 }" in text


def test_an_amplitude_without_an_imaginary_part_is_real(tmp_path):
    text = chain([op.Mirror(-0.5 + 0.25j, 1.0)]).to_toml()
    text = text.replace("re = -0.5, im = 0.25", "re = -0.5")
    assert loaded(text, tmp_path) == chain([op.Mirror(-0.5, 1.0)])


def test_numbers_of_a_parameter_are_written_in_its_unit():
    text = chain([op.Medium(op.Parameter("l", 0.2, unit="dm"))]).to_toml()
    assert 'default = "2 dm"' in text


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("re = -0.5, im = 0.25", "im = 0.25", ["an amplitude written as a table needs 're'"]),
        ("re = -0.5, im = 0.25", "n = 1, k = 2", ["key 'n' is unknown", "needs 're'"]),
        ("re = -0.5, im = 0.25", 're = "$a"', ["parameter '$a' is not declared"]),
        ("re = -0.5, im = 0.25", "re = 3", ["m.r_s is (3+0j); give"]),
        ('"100 mm"', '"100 deg"', ["'100 deg' is no length; use one of nm, um"]),
        ('"100 mm"', "100", ["100 has no unit, but a length is asked for; write '100 mm'"]),
        ('"0.5 1/cm"', "0.5", ["an inverse length is asked for; write '0.5 1/cm'"]),
        ('"1 deg/mm"', '"1 deg"', ["'1 deg' is no angle per length; use one of deg/um"]),
        ('"0 deg/mm"', '"1 deg/mm"', ["slab.retardance is 1 deg/mm; give 0 beside a rotation"]),
    ],
)
def test_faults_of_a_file_are_named_with_a_cure(old, new, expected, tmp_path):
    path = op.PathGraph()
    slab = op.Medium(0.1, 50.0, rotation=np.radians(1000.0))
    lamp = path.add("lamp", op.Source())
    lamp >> path.add("m", op.Mirror(-0.5 + 0.25j)) >> path.add("slab", slab)
    path["slab"] >> path.add("eye", op.Detector())
    text = path.to_toml()
    assert old in text
    with pytest.raises(op.OptipathError) as error:
        loaded(text.replace(old, new), tmp_path)
    for part in expected:
        assert part in str(error.value)
