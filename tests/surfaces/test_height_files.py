"""Files of heights: text, arrays and pictures, by themselves and as samples name them."""

import sys

import numpy as np
import pytest

import optipath as op
from optipath.surfaces import HeightField
from tables import rows

MAP = np.array([[0.0, 1.5, 4.0], [2.0, 7.0, -1.0], [5.0, 3.0, 8e-3], [1.0, 1.0, 2.0]])
HEIGHTS = np.random.default_rng(3).normal(size=(6, 8))
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


@rows(
    "name, text",
    [
        ("a.txt", "# nm\n0 1.5 4\n2 7\t-1 # a line\n\n5 3 8e-3\n1 1 2"),
        # A mark of UTF-8 before the first number.
        ("a.CSV", b"\xef\xbb\xbf0,1.5,4\r\n2, 7, -1\r\n5,3,8e-3\r\n1,1,2\r\n"),
        ("a.dat", " 0  1.5  4 \n 2  7 -1\n5 3 .008\n1 1 +2\n"),
    ],
)
def test_plain_text_has_a_line_for_each_row_and_arrays_of_numpy_are_read(tmp_path, name, text):
    field = HeightField.from_file(written(tmp_path, name, text), (2.0, 3.0))
    assert np.array_equal(field.heights, MAP)
    assert (field.size, field.periodic) == ((2.0, 3.0), False)
    for dtype in (np.float64, np.int16):
        np.save(tmp_path / "a.npy", MAP.astype(dtype))
        field = HeightField.from_file(str(tmp_path / "a.npy"), 1.0, periodic=True)
        assert np.array_equal(field.heights, MAP.astype(dtype))
        assert field.periodic


@rows("dtype, ending", [(np.float32, "tif"), (np.uint16, "tiff"), (np.uint16, "TIF")])
def test_a_picture_is_read(tmp_path, dtype, ending):
    heights, file = np.abs(MAP).astype(dtype), tmp_path / f"a.{ending}"
    pytest.importorskip("tifffile").imwrite(file, heights)
    assert np.array_equal(HeightField.from_file(file, 1.0).heights, heights)


@rows(
    "name, text, said",
    [
        ("a.txt", "# only remarks\n", "holds no numbers; write a line of heights for each row"),
        ("a.txt", b"\xff\xfe1", "is no text in UTF-8; save it as UTF-8"),
        ("a.txt", "1 2 3\n\n1 2\n", "line 3 has 2 numbers, and line 1 has 3; write as many"),
        ("a.txt", "# x\nx y z\n1 2 3\n", "'x' in line 2 is no number"),
        ("a.csv", "1,2,\n3,4,\n", "'' in line 1 is no number"),
        ("a.txt", "1_0 2 3\n", "it has numbers that are written in an unusual way"),
        ("a.txt", "1 nan 3\n" * 3, "3 of 9 heights are not finite, the first nan at heights[0, 1]"),
        ("a.npy", "", "is no array of numbers: EOF: reading magic string"),
        ("a.npy", "1 2 3\n4 5 6\n", "is no array of numbers: the magic string is not correct"),
        ("a.png", "", f"a file of heights cannot end in '.png'; there are: {ENDINGS}"),
        ("a.tiif", "", "cannot end in '.tiif'; did you mean '.tif'?"),
    ],
)
def test_a_file_that_holds_something_else_is_refused(tmp_path, name, text, said):
    assert said in refused(written(tmp_path, name, text))


def test_arrays_that_are_cut_off_or_could_run_something_and_no_files_are_refused(tmp_path):
    np.save(tmp_path / "a.npy", np.array([[{}]], dtype=object), allow_pickle=True)
    assert "Object arrays cannot be loaded" in refused(tmp_path / "a.npy")
    np.save(tmp_path / "a.npy", MAP)
    whole = (tmp_path / "a.npy").read_bytes()
    assert "is no array of numbers" in refused(written(tmp_path, "b.npy", whole[:-20]))
    assert refused(tmp_path / "a.txt") == "cannot be read: No such file or directory"
    (tmp_path / "a.txt").mkdir()
    assert refused(tmp_path / "a.txt") == "cannot be read: Is a directory"
    with pytest.raises(op.SurfaceError, match="name of a file"):
        HeightField.from_file(3, 1.0)
    # Faults of a size are told with those of the file.
    file = written(tmp_path, "c.txt", "1 nan 3\n" * 3)
    with pytest.raises(op.SurfaceError, match="2 faults") as caught:
        HeightField.from_file(file, 0)
    assert caught.value.about == str(file)


def test_pictures_in_colours_in_several_and_cut_short_are_refused(tmp_path):
    tifffile, file = pytest.importorskip("tifffile"), tmp_path / "a.tif"
    for text in ("nothing", "II*\0\x08\0\0\0"):
        fault = refused(written(tmp_path, "a.tif", text))
        assert fault.startswith(("is no TIFF that can be read: ", "has no pictures; save that"))
    tifffile.imwrite(file, np.zeros((5, 6, 3), np.uint8), photometric="rgb")
    assert "must have two dimensions" in refused(file)
    numbers, colours = np.zeros((5, 6), np.uint8), np.zeros((3, 256), np.uint16)
    tifffile.imwrite(file, numbers, photometric="palette", colormap=colours)
    assert "numbers of colours in a palette" in refused(file)
    with tifffile.TiffWriter(file) as several:
        several.write(MAP)
        several.write(MAP[:2, :2])
    assert "has 2 pictures; save that of the heights alone" in refused(file)
    tifffile.imwrite(file, np.ones((40, 40)))
    whole = file.read_bytes()
    cut = written(tmp_path, "a.tif", whole[: len(whole) // 2])
    assert "it may be cut short, so save it again" in refused(cut)


def test_the_extra_for_pictures_is_named_where_it_is_missing(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "tifffile", None)
    with pytest.raises(op.OptipathError, match=r'pip install "optipath\[tiff\]"'):
        HeightField.from_file(written(tmp_path, "a.tif", ""), 1.0)


# Heights that a file of a sample names: files beside it, and no others.


@pytest.fixture
def folder(tmp_path):
    inner = tmp_path / "samples"
    (inner / "maps").mkdir(parents=True)
    for place in (tmp_path, inner, inner / "maps"):
        np.save(place / "own.npy", HEIGHTS)
    np.savetxt(inner / "own.csv", HEIGHTS, delimiter=",")
    return inner


def load(folder, name, more="size = 3"):
    text = f'format = 1\n[[layers]]\nindex = 1.5\nheights = "{name}"\n{more}\n'
    (folder / "own.toml").write_text(text, "utf-8")
    return op.load_sample(folder / "own.toml")


def fault_of(folder, name, more="size = 3"):
    with pytest.raises(op.SurfaceError) as error:
        load(folder, name, more)
    (fault,) = error.value.faults
    return fault


@rows("name, periodic", [("own.npy", False), ("own.csv", True), ("maps/own.npy", True)])
def test_heights_of_a_file_beside_that_of_the_sample_are_read_and_written(folder, name, periodic):
    sample = load(folder, name, "size = [7.0, 5.0]" + periodic * "\nperiodic = true")
    (layer,) = sample.layers
    assert layer.roughness == HeightField.from_heights(HEIGHTS, (7.0, 5.0), periodic=periodic)
    assert layer.file == name
    (folder / "copy.toml").write_text(sample.to_toml(), "utf-8")
    assert op.load_sample(folder / "copy.toml") == sample


@rows("name", ["../own.npy", "/etc/hosts", "", "a\\\\b.npy", "own.npy/", "a\\nb", "a" * 201])
def test_no_other_file_can_be_named(folder, name):
    fault = fault_of(folder, name)
    assert fault.startswith("layers[0].heights: '")
    assert "is no name of a file beside that of the sample; write one such as" in fault


def test_files_that_are_elsewhere_missing_or_too_large_are_told(folder):
    (folder / "link.npy").symlink_to(folder.parent / "own.npy")
    (folder / "out").symlink_to(folder.parent)
    (folder / "round.npy").symlink_to(folder / "round.npy")
    with (folder / "large.npy").open("wb") as file:
        file.truncate(256 * 1024**2 + 1)
    away, none = "leads out of the folder of the sample", "is no file beside that of the sample"
    told = dict.fromkeys(("link.npy", "out/own.npy"), away)
    told |= dict.fromkeys(("none.npy", "maps", "none/own.npy"), none)
    told |= {"round.npy": "", "large.npy": "is larger than 256 MiB"}
    for name, said in told.items():
        assert fault_of(folder, name).startswith(f"layers[0].heights: '{name}' {said}"), name


@rows(
    "name, more, sentence",
    [
        ("own.npy", "size = -1", "layers[0].heights 'own.npy': size must be a positive number"),
        ("own.npy", "", "layers[0]: 'size' is missing; write the lengths of the sides"),
        ("own.npy", "size = 3\nalpha = 0.1", "layers[0]: 'alpha' and 'heights' say one thing twi"),
        ("own.npy", 'size = 3\nperiodic = "yes"', "layers[0]: 'periodic' must be true or false"),
        ("nan.npy", "size = 3", "layers[0].heights 'nan.npy': 16 of 16 heights are not finite"),
        ("own.toml", "size = 3", "layers[0].heights 'own.toml': a file of heights cannot end"),
    ],
)
def test_what_is_wrong_with_heights_is_told_with_their_file(folder, name, more, sentence):
    np.save(folder / "nan.npy", np.full((4, 4), np.nan))
    assert fault_of(folder, name, more).startswith(sentence)
    (folder / "own.toml").write_text("format = 1\n[[layers]]\nindex = 1.5\nheights = 3\n", "utf-8")
    with pytest.raises(op.SurfaceError, match=r"layers\[0\]: 'heights' must be a text, not 3"):
        op.load_sample(folder / "own.toml")
