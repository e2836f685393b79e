"""Heights that a file of a sample names: files beside it, and no others."""

import numpy as np
import pytest

import optipath as op
from optipath.surfaces import HeightField

HEIGHTS = np.random.default_rng(3).normal(size=(6, 8))


@pytest.fixture
def folder(tmp_path):
    inner = tmp_path / "samples"
    (inner / "maps").mkdir(parents=True)
    for place in (tmp_path, inner, inner / "maps"):
        np.save(place / "own.npy", HEIGHTS)
    np.savetxt(inner / "own.csv", HEIGHTS, delimiter=",")
    return inner


def load(folder, layer):
    (folder / "own.toml").write_text(f"format = 1\n[[layers]]\nindex = 1.5\n{layer}\n", "utf-8")
    return op.load_sample(folder / "own.toml")


def fault_of(folder, layer):
    with pytest.raises(op.SurfaceError) as error:
        load(folder, layer)
    (fault,) = error.value.faults
    return fault


@pytest.mark.parametrize("name", ["own.npy", "own.csv", "maps/own.npy"])
def test_heights_are_read_out_of_a_file_beside_that_of_the_sample(folder, name):
    (layer,) = load(folder, f'heights = "{name}"\nsize = [7.0, 5.0]').layers
    assert layer.roughness == HeightField.from_heights(HEIGHTS, (7.0, 5.0))
    assert layer.file == name


def test_heights_may_be_periodic(folder):
    (layer,) = load(folder, 'heights = "own.npy"\nsize = 7\nperiodic = true').layers
    assert layer.roughness == HeightField.from_heights(HEIGHTS, 7.0, periodic=True)


def test_a_sample_of_heights_is_written_and_read_back_the_same(folder):
    for more in ("", "periodic = true"):
        sample = load(folder, f'heights = "maps/own.npy"\nsize = [7.0, 5.0]\n{more}')
        (folder / "copy.toml").write_text(sample.to_toml(), "utf-8")
        assert op.load_sample(folder / "copy.toml") == sample


NO_NAMES = [
    "../own.npy",
    "maps/../../own.npy",
    "/etc/hosts",
    "",
    ".",
    "..",
    "C:own.npy",
    "~/own.npy",
]
NO_NAMES += ["a\\\\b.npy", "./own.npy", "own.npy/", "maps//own.npy", ".own.npy", "a\\nb"]
NO_NAMES += ["own\\u0000.npy", 300 * "a" + ".npy"]


@pytest.mark.parametrize("name", NO_NAMES)
def test_no_other_file_can_be_named(folder, name):
    fault = fault_of(folder, f'heights = "{name}"\nsize = 3')
    assert fault.startswith("layers[0].heights: '")
    assert "is no name of a file beside that of the sample; write one such as" in fault


def test_a_link_that_leads_out_of_the_folder_is_not_followed(folder):
    (folder / "link.npy").symlink_to(folder.parent / "own.npy")
    (folder / "out").symlink_to(folder.parent)
    for name in ("link.npy", "out/own.npy"):
        fault = fault_of(folder, f'heights = "{name}"\nsize = 3')
        assert fault == (
            f"layers[0].heights: '{name}' leads out of the folder of the sample; put it there"
        )


def test_a_link_that_leads_to_itself_is_refused(folder):
    (folder / "round.npy").symlink_to(folder / "round.npy")
    fault = fault_of(folder, 'heights = "round.npy"\nsize = 3')
    assert fault.startswith("layers[0].heights: 'round.npy' ")


@pytest.mark.parametrize("name", ["none.npy", "maps", "none/own.npy"])
def test_a_file_that_there_is_not_is_told(folder, name):
    fault = fault_of(folder, f'heights = "{name}"\nsize = 3')
    assert fault == f"layers[0].heights: '{name}' is no file beside that of the sample"


def test_a_file_that_is_too_large_is_not_read(folder):
    with (folder / "large.npy").open("wb") as file:
        file.truncate(256 * 1024**2 + 1)
    assert "'large.npy' is larger than 256 MiB" in fault_of(
        folder, 'heights = "large.npy"\nsize = 3'
    )


def test_what_is_wrong_with_heights_is_told_with_their_file(folder):
    np.save(folder / "nan.npy", np.full((4, 4), np.nan))
    (folder / "text.csv").write_text("a,b\n", "utf-8")
    for name in ("nan.npy", "text.csv", "own.toml"):
        fault = fault_of(folder, f'heights = "{name}"\nsize = 3')
        assert fault.startswith(f"layers[0].heights '{name}': ")


@pytest.mark.parametrize("size", ["-1", "[1, 2, 3]", '"3 nm"', "true", "[1, 0]"])
def test_a_size_that_is_none_is_refused(folder, size):
    fault = fault_of(folder, f'heights = "own.npy"\nsize = {size}')
    assert fault.startswith("layers[0].heights 'own.npy': size must be a positive number")


@pytest.mark.parametrize(
    ("layer", "sentence"),
    [
        ('heights = "own.npy"', "layers[0]: 'size' is missing; write the lengths of the sides"),
        (
            'heights = "own.npy"\nsize = 3\nalpha = 0.1',
            "layers[0]: 'alpha' and 'heights' say one thing twice; leave one of them out",
        ),
        ("heights = 3", "layers[0]: 'heights' must be a text, not 3"),
        (
            'heights = "own.npy"\nsize = 3\nperiodic = "yes"',
            "layers[0]: 'periodic' must be true or false, not 'yes'",
        ),
    ],
)
def test_what_stands_beside_heights_is_checked(folder, layer, sentence):
    assert fault_of(folder, layer).startswith(sentence)
