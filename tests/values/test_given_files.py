"""Names of files that are no names of files, wherever one is read."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

import optipath as op
from optipath.values.given_files import LARGEST
from optipath.values.text_tables import columns_of
from tables import rows


class _InBytes(os.PathLike):
    def __fspath__(self):
        return b"lamp.csv"


@rows(
    "read",
    [op.Spectrum.from_csv, op.Material.from_csv, op.Material.from_yaml],
)
@rows("path", [None, 5, b"x.csv", "", "a\0b.toml", _InBytes(), ["a.csv"]])
def test_what_is_no_name_of_a_file_is_refused(read, path):
    with pytest.raises(op.OptipathError, match="name of a file"):
        read(path)


@pytest.mark.parametrize("column", [None, 1])
def test_a_column_is_asked_for_by_its_name(column, tmp_path):
    file = tmp_path / "lamp.csv"
    file.write_text("wavelength (nm), power\n400, 1\n500, 1\n")
    with pytest.raises(op.ValueFault, match=f"a text, not by {column}; write .* column='power'"):
        op.Spectrum.from_csv(file, column=column)
    with pytest.raises(op.ValueFault, match="the unit is 5; give a text, such as unit='nm'"):
        op.Spectrum.from_csv(file, unit=5)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no named pipes")
@pytest.mark.parametrize(
    ("name", "read"),
    [
        ("x.csv", op.Spectrum.from_csv),
        ("x.csv", op.Material.from_csv),
        ("x.yml", op.Material.from_yaml),
        ("x.txt", lambda file: op.surfaces.HeightField.from_file(file, size=("1 mm", "1 mm"))),
        ("x.npy", lambda file: op.surfaces.HeightField.from_file(file, size=("1 mm", "1 mm"))),
        ("x.nc", op.surfaces.load_hemisphere),
        ("x.csv", columns_of),
    ],
)
def test_what_is_no_file_is_refused_and_not_waited_for(name, read, tmp_path):
    file = tmp_path / name
    for make in (os.mkfifo, lambda path: path.symlink_to("/dev/zero"), os.mkdir):
        make(file)
        with pytest.raises(op.OptipathError):
            read(file)
        file.rename(tmp_path / f"{len(list(tmp_path.iterdir()))}")


@pytest.mark.skipif(not Path("/dev/fd").is_dir(), reason="there are no names of pipes")
def test_a_pipe_that_somebody_writes_to_is_read():
    reader, writer = os.pipe()
    os.write(writer, b"angle (deg)\n10\n20\n")
    os.close(writer)
    (column,) = columns_of(f"/dev/fd/{reader}")
    os.close(reader)
    assert column.texts == ("10 deg", "20 deg")


def test_a_file_has_a_largest_size(tmp_path):
    file = tmp_path / "large.csv"
    with file.open("wb") as stream:
        stream.truncate(LARGEST + 1)
    with pytest.raises(op.OptipathError, match="larger than 64 MiB"):
        columns_of(file)
