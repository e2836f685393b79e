import subprocess
import sys
import warnings

import pytest

import optipath as op
from measured_hemispheres import measured
from tables import rows

figures = pytest.importorskip("matplotlib.figure")


@pytest.mark.parametrize(
    ("form", "begins", "holds"),
    [
        ("png", b"\x89PNG", b""),
        ("svg", b"<?xml", b">angle of polarisation (\xc2\xb0)</text>"),
        ("pdf", b"%PDF", b"/FontFile2"),  # TrueType, no outlines
    ],
)
def test_a_picture_is_saved_in_every_form_with_texts_as_such(form, begins, holds, tmp_path):
    file = tmp_path / f"map.{form}"
    op.plots.save(op.plots.hemisphere(measured("glass on glass"), "AoP"), file, 60)
    content = file.read_bytes()
    assert content.startswith(begins)
    assert holds in content


def test_a_picture_that_is_drawn_anew_has_the_same_bits(tmp_path):
    files = [tmp_path / "a.svg", tmp_path / "b.svg"]
    for file in files:
        op.plots.save(op.plots.in_plane(measured("silver"), "S1"), file)
    assert files[0].read_bytes() == files[1].read_bytes()


@pytest.mark.parametrize("name", ["map.jpg", "map", "map.svg.gz"])
def test_an_ending_that_cannot_be_drawn_is_refused(name, tmp_path):
    figure = figures.Figure()
    with pytest.raises(op.OptipathError, match=r"cannot be drawn; use one of: .png, .svg, .pdf"):
        op.plots.save(figure, tmp_path / name)
    assert not [*tmp_path.iterdir()]


@pytest.mark.parametrize("form", ["png", "svg", "pdf"])
def test_letters_that_the_font_lacks_are_saved_without_a_warning(form, tmp_path):
    figure = figures.Figure()
    figure.text(0.5, 0.5, "\u5149")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        op.plots.save(figure, tmp_path / f"x.{form}")


def test_a_folder_that_is_not_there_is_told_as_no_fault_of_a_surface(tmp_path):
    with pytest.raises(op.OptipathError, match=r"x.png' cannot be written: No such file") as told:
        op.plots.save(figures.Figure(), tmp_path / "none" / "x.png")
    assert type(told.value) is op.OptipathError


@pytest.mark.parametrize("nothing", [None, [], "map"])
def test_what_is_no_picture_is_refused(nothing, tmp_path):
    with pytest.raises(op.OptipathError, match="give what a function of plots returned"):
        op.plots.save(nothing, tmp_path / "map.png")


def test_pictures_need_no_window():
    names = "; ".join(f"op.plots.{name}" for name in op.plots.__all__)
    code = f"import sys, optipath as op; {names}; print('matplotlib.pyplot' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"


def test_an_unknown_picture_is_told():
    with pytest.raises(AttributeError, match="'hemispher'; did you mean 'hemisphere'"):
        _ = op.plots.hemispher


def test_pictures_without_matplotlib_say_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(op.OptipathError, match=r'pip install "optipath\[plot\]"'):
        op.plots.__getattr__("save")


@pytest.mark.parametrize("place", ["nowhere/map.png", "a.png/b.png", "folder.png"])
def test_a_place_that_takes_no_file_is_told_by_the_name_that_was_given(place, tmp_path):
    (tmp_path / "a.png").write_bytes(b"")
    (tmp_path / "folder.png").mkdir()
    with pytest.raises(op.OptipathError, match=rf"{place}' cannot be written: ") as told:
        op.plots.save(figures.Figure(), tmp_path / place)
    assert "draft" not in str(told.value)


@rows("name", [3, None, b"map.png", ""])
def test_what_is_no_name_of_a_file_is_refused(name):
    with pytest.raises(op.OptipathError, match="name of a file"):
        op.plots.save(figures.Figure(), name)
