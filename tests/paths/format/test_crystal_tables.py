"""Crystals in files, by their names."""

import pytest

import optipath as op

PLATE = op.Waveplate.quarter("550 nm", "calcite", order=2)
SLAB = op.Medium("1 mm", dextrorotation=op.Crystal.named("quartz").rotatory_power)


@pytest.mark.parametrize("element", [PLATE, SLAB], ids=["birefringence", "rotation"])
def test_a_crystal_is_written_by_its_name_and_read_back(element, tmp_path):
    path = op.Source(stokes=[1, 1, 0, 0]) >> element >> op.Detector()
    text = path.to_toml()
    assert f'crystal = "{"calcite" if element is PLATE else "quartz"}"' in text
    file = tmp_path / "path.toml"
    file.write_text(text, "utf-8")
    copy = op.load_preset(file)
    light = [one.trace(wavelength="500 nm").stokes.tolist() for one in (path, copy)]
    assert light[0] == light[1]


@pytest.mark.parametrize(
    ("field", "said"),
    [
        ('birefringence = { crystal = "quarz" }', "did you mean 'quartz'"),
        ("birefringence = { crystal = 3 }", "'crystal' must be a text, not 3"),
        ('birefringence = { crystal = "quartz", orders = 3 }', "'orders'"),
        ('birefringence = 0.009\nangle = { crystal = "quartz" }', "gives no angle"),
    ],
)
def test_what_is_no_crystal_is_refused_in_words(field, said, tmp_path):
    file = tmp_path / "path.toml"
    text = (
        f'[elements.plate]\nkind = "waveplate"\nthickness = "1 mm"\nwavelength = "550 nm"\n{field}'
    )
    file.write_text(f'format = 1\ndescription = "a plate"\n\n{text}\n', "utf-8")
    with pytest.raises(op.OptipathError, match=said):
        op.load_preset(file)
