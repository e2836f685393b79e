"""Names of files that are no names of files, wherever one is read."""

from __future__ import annotations

import os

import pytest

import optipath as op


class _InBytes(os.PathLike):
    def __fspath__(self):
        return b"lamp.csv"


@pytest.mark.parametrize(
    "read",
    [op.Spectrum.from_csv, op.Material.from_csv, op.Material.from_yaml],
)
@pytest.mark.parametrize("path", [None, 5, b"x.csv", "", "a\0b.toml", _InBytes(), ["a.csv"]])
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
