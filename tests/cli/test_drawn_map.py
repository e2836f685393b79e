"""``optipath surface --map``: maps of hemispheres as pictures."""

import pytest

from optipath.cli import main
from optipath.engines.automatic import is_installed
from tables import rows

pytest.importorskip("matplotlib")
COMPILED = pytest.mark.skipif(not is_installed("numba"), reason="needs the extra fast")
FLAT = "format = 1\n[[layers]]\nindex = 1.5\nalpha = 0\n"
SILVER = """\
format = 1
[[layers]]
index = { wavelengths = [400.0, 700.0], unit = "nm", n = [0.5, 0.2], k = [2.1, 4.0] }
alpha = 0
"""
FEW = ["--photons", "2000", "--incidence", "50"]


@pytest.fixture(autouse=True)
def _files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "flat.toml").write_text(FLAT, "utf-8")
    (tmp_path / "silver.toml").write_text(SILVER, "utf-8")


@COMPILED
def test_a_map_is_drawn_into_a_file(capsys, tmp_path):
    drawn = ["surface", "flat.toml", *FEW, "--map", "S0", "--side", "transmitted"]
    assert main([*drawn, "--out", "map.svg"]) == 0
    assert capsys.readouterr().out == "wrote map.svg\n"
    assert ">S0, transmitted, incidence 50°</text>" in (tmp_path / "map.svg").read_text("utf-8")


@COMPILED
def test_a_map_is_of_the_light_and_the_wavelength_that_are_given(tmp_path):
    light = ["--stokes", "1,0,1,0", "--wavelength", "500 nm"]
    drawn = ["surface", "silver.toml", *FEW, *light, "--map", "S3"]
    assert main([*drawn, "--out", "map.svg"]) == 0
    written = (tmp_path / "map.svg").read_text("utf-8")
    assert "S3, reflected, incidence 50°, 500 nm" in written
    assert "source (1, 0, 1, 0)" in written


@rows(
    "sample, options, sentence",
    [
        ("flat", ["--map", "S0"], "--map draws into a file; name it, --out map.png"),
        ("flat", ["--out", "map.png"], "--out is of a map; say of what, --map S0"),
        ("flat", ["--map", "S0", "--out", "a.jpg"], "cannot be drawn; use one of: .png, .svg"),
        ("flat", ["--map", "DoL", "--out", "a.png"], "'DoL' is unknown; did you mean 'DoLP'"),
        ("flat", ["--map", "S0", "--out", "a.png", "--json"], "--json is of tables"),
        ("flat", ["--map", "S0", "--out", "a.png", "--incidence", "20"], "give --incidence once"),
        ("flat", ["--map", "ADM", "--out", "a.png", "--stokes", "1,1,0,0"], "leave --stokes out"),
        (
            "silver",
            ["--map", "S0", "--out", "a.png", "--wavelength", "500 nm", "--side", "transmitted"],
            "nothing goes through an opaque sample; leave --side out",
        ),
        (
            "silver",
            ["--map", "S0", "--out", "a.png", "--wavelength", "500 nm:600 nm:2"],
            "a map of S0 is of one wavelength",
        ),
        (
            "flat",
            ["--map", "S0", "--out", "nowhere/a.png"],
            "cannot be written: there is no such folder",
        ),
    ],
)
def test_what_goes_with_no_map_is_refused_before_photons_are_walked(
    sample, options, sentence, capsys, tmp_path
):
    assert main(["surface", f"{sample}.toml", *FEW, *options]) == 2
    told = capsys.readouterr()
    assert told.out == ""
    assert sentence in told.err
    assert not [*tmp_path.glob("*.png")]
