"""Samples as the text of a file."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from fake_curves import metal
from optipath.surfaces import HeightField


def test_only_what_is_not_usual_is_written():
    assert op.Sample([(1.5, 0.1)], description="glass").to_toml() == (
        'format = 1\ndescription = "glass"\n\n[[layers]]\nindex = 1.5\nalpha = 0.1\n'
    )


NUMBERS = st.floats(1e-3, 1e3)
ROUGHNESS = st.floats(1e-6, 100.0)
LAYERS = st.tuples(NUMBERS, st.one_of(st.just(0.0), ROUGHNESS, st.tuples(ROUGHNESS, ROUGHNESS)))


@given(
    st.lists(LAYERS, max_size=3),
    st.tuples(st.builds(complex, NUMBERS, st.just(0.0) | NUMBERS), ROUGHNESS),
    st.fixed_dictionaries(
        {},
        optional={
            "outside": NUMBERS,
            "cells": st.integers(2, 10**6) | st.tuples(st.integers(2, 9), st.integers(2, 9)),
            "surfaces": st.integers(1, 100),
            "seed": st.integers(0, 2**70),
            "periodic": st.booleans(),
            "description": st.text(),
        },
    ),
)
def test_every_sample_of_numbers_is_read_back_the_same(tmp_path_factory, above, base, options):
    sample = op.Sample([*above, base], **options)
    file = tmp_path_factory.mktemp("samples") / "own.toml"
    file.write_text(sample.to_toml(), "utf-8", newline="")
    assert op.load_sample(file) == sample


@pytest.mark.parametrize(
    "material",
    [
        op.Material.cauchy([1.5, 0.004]),
        op.Material.tabulated(["400 nm", "600 nm"], [1.0, 0.5], [1.0, 3.0], name="metal"),
        op.Material.sellmeier([1.04, 0.23], [0.006, 0.02], span=("300 nm", "2 um")),
    ],
)
def test_materials_are_written_as_in_presets(material, tmp_path):
    sample = op.Sample([(op.Material(material.n), 0.1), (material, 0.1)])
    (tmp_path / "own.toml").write_text(sample.to_toml(), "utf-8")
    assert op.load_sample(tmp_path / "own.toml") == sample


def test_a_flat_field_is_an_alpha_of_0():
    sample = op.Sample([(1.5, HeightField.flat())])
    assert sample.to_toml() == op.Sample([(1.5, 0)]).to_toml()


def test_heights_that_are_in_no_file_cannot_be_written(tmp_path):
    heights = HeightField.from_heights(np.eye(5), (3.0, 4.0))
    with pytest.raises(op.SurfaceError) as error:
        op.Sample([(1.5, heights), (2.4, 0.1), (1.5, heights)]).to_toml()
    first, second = error.value.faults
    assert first.startswith(
        "layers[0]: its heights are in no file that it knows of; save them by numpy.save("
    )
    assert second.startswith("layers[2]: its heights are in no file")
    # The cure, as it says.
    np.save(tmp_path / "heights.npy", heights.heights)
    text = '[[layers]]\nindex = 1.5\nheights = "heights.npy"\nsize = [3.0, 4.0]\n'
    (tmp_path / "own.toml").write_text(f"format = 1\n{text}", "utf-8")
    assert text in op.load_sample(tmp_path / "own.toml").to_toml()


def test_a_material_of_ones_own_curve_cannot_be_written():
    with pytest.raises(op.SurfaceError, match=r"layers\[0\]: .* has no form in a preset"):
        op.Sample([(op.Material(*metal()), 0.1)]).to_toml()
