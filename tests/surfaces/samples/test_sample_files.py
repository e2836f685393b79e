"""Samples by name and by path."""

import numpy as np
import pytest

import optipath as op


def test_the_samples_of_the_library_are_there():
    others = [name for name in op.sample_names() if not name.startswith("wang-2017-")]
    assert others == [
        "glass-on-glass", "glass-on-gold", "glass-rough", "gold-rough", "perfect-reflector-rough",
        "silver-rough",
    ]  # fmt: skip
    assert not set(op.sample_names()) & set(op.preset_names())


@pytest.mark.parametrize("name", op.sample_names())
def test_every_sample_is_described_drawn_and_written_and_read_back_the_same(name, tmp_path):
    sample = op.load_sample(name)
    assert sample.description
    assert not sample.description.endswith(".")
    assert all(field.alpha for field in sample.fields())
    file = tmp_path / "copy.toml"
    file.write_text(sample.to_toml(), "utf-8")
    assert op.load_sample(file) == sample
    assert op.load_sample(str(file)) == sample


@pytest.mark.parametrize(
    ("name", "layers"),
    [
        ("glass-rough", [(1.5, 0.25)]),
        ("glass-on-glass", [(1.5, 0.1), (2.4, 0.1)]),
        ("silver-rough", [(0.5 + 2.1j, 0.3)]),
        ("perfect-reflector-rough", [(1j, 1.0)]),
    ],
)
def test_a_sample_of_numbers_is_as_published(name, layers):
    # M. Wang et al., Optics Express 25(19), 2017.
    assert op.load_sample(name).layers == op.Sample(layers).layers


def test_gold_is_that_of_johnson_and_christy():
    found = op.load_sample("gold-rough").indices(["381.5 nm", "659.5 nm"])
    np.testing.assert_allclose(found.n, [1.46, 0.14], rtol=1e-12)
    np.testing.assert_allclose(found.k, [1.933, 3.697], rtol=1e-12)


@pytest.mark.parametrize("incidence", [0.0, 0.5, 1.0, 1.5])
def test_the_perfect_reflector_reflects_all_light_where_it_is_smooth(incidence):
    stack = op.load_sample("perfect-reflector-rough").smooth(incidence)
    # |r_s| = |r_p| = 1 where the index has no real part.
    assert stack.mueller("in", "reflected").matrix[0, 0] == pytest.approx(1.0, abs=1e-15)


def test_a_name_that_is_misspelt_is_told_with_the_one_that_was_meant():
    with pytest.raises(op.SurfaceError, match="sample 'glas-rough' is unknown; did you mean 'gl"):
        op.load_sample("glas-rough")


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        (3, "a sample is a name or the path of a file, not 3"),
        ("Glass", "is neither the name of a sample"),
        ("../samples/glass-rough", "did you mean 'glass-rough'?"),
        ("sample.txt", "see the names with op.sample_names()"),
        ("nowhere/sample.toml", "'nowhere/sample.toml' cannot be read: No such file"),
        ("nul\0.toml", "cannot be read: "),
    ],
)
def test_what_is_neither_a_name_nor_a_file_is_refused(given, sentence):
    with pytest.raises(op.SurfaceError) as error:
        op.load_sample(given)
    assert sentence in str(error.value)


def test_a_file_that_is_no_text_is_refused(tmp_path):
    for name, content in [("bytes", b"\xff\xfe"), ("large", b"#" * (4 * 1024**2 + 1))]:
        (tmp_path / f"{name}.toml").write_bytes(content)
        with pytest.raises(op.SurfaceError, match=r"is not UTF-8|is larger than 4 MiB; no sample"):
            op.load_sample(tmp_path / f"{name}.toml")
