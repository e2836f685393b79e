"""Files of heights: text, arrays of NumPy's and pictures; and what is none of these."""

import sys

import numpy as np
import pytest

import optipath as op

HeightField = op.surfaces.HeightField
MAP = np.array([[0.0, 1.5, 4.0], [2.0, 7.0, -1.0], [5.0, 3.0, 8e-3], [1.0, 1.0, 2.0]])
ENDINGS = ".txt, .csv, .dat, .asc, .npy, .tif, .tiff"


def written(folder, name, text):
    file = folder / name
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    return file


def refused(file, size=1.0):
    with pytest.raises(op.SurfaceError) as caught:
        HeightField.from_file(file, size)
    assert caught.value.about == str(file)
    return caught.value.faults[0]


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.txt", "# nm\n0 1.5 4\n2 7\t-1 # a line\n\n5 3 8e-3\n1 1 2"),
        ("a.CSV", "0,1.5,4\r\n2, 7, -1\r\n5,3,8e-3\r\n1,1,2\r\n"),
        ("a.dat", " 0  1.5  4 \n 2  7 -1\n5 3 .008\n1 1 +2\n"),
    ],
)
def test_plain_text_has_a_line_for_each_row(tmp_path, name, text):
    field = HeightField.from_file(written(tmp_path, name, text), (2.0, 3.0))
    assert np.array_equal(field.heights, MAP)
    assert field.size == (2.0, 3.0)
    assert not field.periodic


@pytest.mark.parametrize("dtype", [np.float64, np.int16])
def test_an_array_of_numpy_is_read(tmp_path, dtype):
    np.save(tmp_path / "a.npy", MAP.astype(dtype))
    field = HeightField.from_file(str(tmp_path / "a.npy"), 1.0, periodic=True)
    assert np.array_equal(field.heights, MAP.astype(dtype))
    assert field.periodic


@pytest.mark.parametrize("dtype", [np.float32, np.uint16])
@pytest.mark.parametrize("ending", ["tif", "tiff", "TIF"])
def test_a_picture_is_read(tmp_path, dtype, ending):
    tifffile = pytest.importorskip("tifffile")
    heights = np.abs(MAP).astype(dtype)
    tifffile.imwrite(tmp_path / f"a.{ending}", heights)
    field = HeightField.from_file(tmp_path / f"a.{ending}", 1.0)
    assert np.array_equal(field.heights, heights)


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("a.txt", "", "holds no numbers; write a line of heights for each row"),
        ("a.txt", "# only remarks\n", "holds no numbers"),
        ("a.txt", b"\xff\xfe1", "is no text in UTF-8; save it as UTF-8"),
        ("a.txt", "1 2 3\n\n1 2\n", "line 3 has 2 numbers, and line 1 has 3; write as many"),
        ("a.txt", "# x\nx y z\n1 2 3\n", "'x' in line 2 is no number"),
        ("a.txt", "1;2;3\n", "'1;2;3' in line 1 is no number"),
        ("a.txt", "1,5\t2,5\n", r"'5\t2' in line 1 is no number"),
        ("a.csv", "1,2,\n3,4,\n", "'' in line 1 is no number"),
        ("a.txt", "1_0 2 3\n", "it has numbers that are written in an unusual way"),
        ("a.txt", "1 nan 3\n" * 3, "3 of 9 heights are not finite, the first nan at heights[0, 1]"),
        ("a.txt", "1 2\n", "heights of shape (1, 2) are too few"),
        ("a.npy", "", "is no array of numbers: EOF: reading magic string"),
        ("a.npy", "1 2 3\n4 5 6\n", "is no array of numbers: the magic string is not correct"),
        ("a.png", "", f"a file of heights cannot end in '.png'; there are: {ENDINGS}"),
        ("a.tiif", "", "cannot end in '.tiif'; did you mean '.tif'?"),
        ("heights", "", f"a file of heights cannot end in ''; there are: {ENDINGS}"),
    ],
)
def test_a_file_that_holds_something_else_is_refused(tmp_path, name, text, said):
    assert said in refused(written(tmp_path, name, text))


def test_an_array_that_could_run_something_is_refused(tmp_path):
    np.save(tmp_path / "a.npy", np.array([[{}]], dtype=object), allow_pickle=True)
    assert "Object arrays cannot be loaded" in refused(tmp_path / "a.npy")


def test_an_array_that_is_cut_off_is_refused(tmp_path):
    np.save(tmp_path / "a.npy", MAP)
    whole = (tmp_path / "a.npy").read_bytes()
    assert "is no array of numbers" in refused(written(tmp_path, "b.npy", whole[:-20]))


def test_a_file_that_is_not_there_is_told(tmp_path):
    assert refused(tmp_path / "a.txt") == "cannot be read: No such file or directory"


def test_a_folder_is_told(tmp_path):
    (tmp_path / "a.txt").mkdir()
    assert refused(tmp_path / "a.txt") == "cannot be read: Is a directory"


@pytest.mark.parametrize("path", [3, None, "", "a\0.txt"])
def test_what_is_no_name_of_a_file_is_refused(path):
    with pytest.raises(op.SurfaceError, match="name of a file"):
        HeightField.from_file(path, 1.0)


def test_faults_of_a_size_are_told_with_those_of_the_file(tmp_path):
    file = written(tmp_path, "a.txt", "1 nan 3\n" * 3)
    with pytest.raises(op.SurfaceError) as caught:
        HeightField.from_file(file, 0)
    assert len(caught.value.faults) == 2
    assert caught.value.about == str(file)


@pytest.mark.parametrize("text", ["", "nothing", "II*\0\x08\0\0\0"])
def test_what_is_no_picture_is_refused(tmp_path, text):
    pytest.importorskip("tifffile")
    fault = refused(written(tmp_path, "a.tif", text))
    assert fault.startswith(("is no TIFF that can be read: ", "has no pictures; save that"))


def test_a_picture_in_colours_is_refused(tmp_path):
    tifffile = pytest.importorskip("tifffile")
    tifffile.imwrite(tmp_path / "a.tif", np.zeros((5, 6, 3), np.uint8), photometric="rgb")
    assert "must have two dimensions" in refused(tmp_path / "a.tif")


def test_a_picture_of_colours_of_a_palette_is_refused(tmp_path):
    tifffile = pytest.importorskip("tifffile")
    numbers, colours = np.zeros((5, 6), np.uint8), np.zeros((3, 256), np.uint16)
    tifffile.imwrite(tmp_path / "a.tif", numbers, photometric="palette", colormap=colours)
    assert "numbers of colours in a palette" in refused(tmp_path / "a.tif")


def test_several_pictures_in_a_file_are_refused(tmp_path):
    tifffile = pytest.importorskip("tifffile")
    with tifffile.TiffWriter(tmp_path / "a.tif") as file:
        file.write(MAP)
        file.write(MAP[:2, :2])
    assert "has 2 pictures; save that of the heights alone" in refused(tmp_path / "a.tif")


def test_the_extra_for_pictures_is_named_where_it_is_missing(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "tifffile", None)
    with pytest.raises(op.OptipathError, match=r'pip install "optipath\[tiff\]"'):
        HeightField.from_file(written(tmp_path, "a.tif", ""), 1.0)


def test_a_mark_of_utf_8_before_the_first_number_is_no_number(tmp_path):
    (tmp_path / "a.csv").write_bytes(b"\xef\xbb\xbf" + b"0,1,2\n3,4,5\n6,7,8\n")
    field = HeightField.from_file(tmp_path / "a.csv", 1.0)
    assert np.array_equal(field.heights, np.arange(9.0).reshape(3, 3))


def test_a_picture_that_is_cut_short_is_told_so(tmp_path):
    tifffile = pytest.importorskip("tifffile")
    tifffile.imwrite(tmp_path / "a.tif", np.ones((40, 40)))
    whole = (tmp_path / "a.tif").read_bytes()
    (tmp_path / "a.tif").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(op.SurfaceError, match="it may be cut short, so save it again"):
        HeightField.from_file(tmp_path / "a.tif", 1.0)
