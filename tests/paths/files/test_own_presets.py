"""A user's own presets: found by name in ./presets and in the folders of OPTIPATH_PRESETS."""

import os
from pathlib import Path

import pytest

import optipath as op
from optipath.paths.files.presets import preset_descriptions, preset_files
from optipath.paths.files.schema import presets_folder


def preset(folder, name, transmittance, description="own"):
    folder.mkdir(exist_ok=True)
    path = op.Source() >> op.Attenuator(transmittance) >> op.Detector()
    text = path.to_toml().replace('description = ""', f'description = "{description}"')
    (folder / f"{name}.toml").write_text(text, "utf-8")


def intensity(name):
    return op.load_preset(name).trace().intensity


@pytest.fixture
def folders(tmp_path, monkeypatch):
    """The folder of this process, and one of two that the environment lists; the other is not."""
    monkeypatch.chdir(tmp_path)
    there = tmp_path / "more"
    there.mkdir()
    monkeypatch.setenv("OPTIPATH_PRESETS", os.pathsep.join([str(there), "", "nowhere"]))
    return tmp_path / "presets", there


def test_a_name_is_that_of_the_library_then_of_this_folder_then_of_those_listed(folders):
    here, there = folders
    names = op.preset_names()
    preset(there, "mine", 0.25)
    assert intensity("mine") == 0.25
    preset(here, "mine", 0.5)
    preset(there, "other-2", 0.125)
    preset(here, "malus", 0.75)
    preset(here, ".hidden", 1.0)
    assert (intensity("mine"), intensity("other-2")) == (0.5, 0.125)
    assert op.load_preset("malus") == op.load_preset(presets_folder() / "malus.toml")
    assert op.preset_names() == sorted([*names, "mine", "other-2"])
    # What no name finds is told of, and is found by its path.
    assert preset_files()[1] == [Path("presets/malus.toml"), there / "mine.toml"]
    assert intensity("presets/malus.toml") == 0.75


def test_a_folder_that_is_reached_twice_is_one(folders, monkeypatch):
    here, there = folders
    preset(here, "mine", 0.5)
    (there / "link").symlink_to(presets_folder(), target_is_directory=True)
    again = [str(here), "presets", "./more/../presets", str(presets_folder()), str(there / "link")]
    monkeypatch.setenv("OPTIPATH_PRESETS", os.pathsep.join(again))
    files, unnamed = preset_files()
    assert files.keys() - {file.stem for file in presets_folder().glob("*.toml")} == {"mine"}
    assert unnamed == []
    monkeypatch.chdir(presets_folder().parent)
    assert "mine" in op.preset_names()
    assert preset_files()[1] == []


def test_an_unknown_name_tells_where_it_was_looked_for(folders):
    here, there = folders
    with pytest.raises(op.errors.PresetError) as error:
        op.load_preset("malos")
    sentence = f"preset 'malos' is unknown, also in '{there}', 'nowhere' (no folder); did you "
    assert str(error.value) == f"{sentence}mean 'malus'?"
    preset(here, "mine", 0.5)
    with pytest.raises(op.errors.PresetError, match=r"also in 'presets', .* mean 'mine'"):
        op.load_preset("mien")


def test_names_stay_within_their_folder_and_are_of_few_letters(folders):
    here, _ = folders
    for name in ("My", "a_b", "ä"):
        preset(here, name, 0.5)
        with pytest.raises(op.errors.PresetError, match="neither the name of a preset"):
            op.load_preset(name)
    for name in ("../more/x", "more/x", "presets/../x"):
        with pytest.raises(op.errors.PresetError, match="neither the name of a preset"):
            op.load_preset(name)
    assert sorted(file.stem for file in preset_files()[1]) == ["My", "a_b", "ä"]
    assert "My" not in op.preset_names()


FAULTY = {
    "text": ("x = [", "is not TOML"),
    "bytes": ("\xff", "is not TOML"),
    "empty": ("", "'format' is missing"),
    "odd": ("format = 1\nelements = {}\ndescription = 3", "'description' must be a text, not 3"),
    "slip": ("format = 1\nelments = {}", "key 'elments' is unknown; did you mean 'elements'?"),
}


def test_a_faulty_file_is_described_by_its_fault_and_spoils_no_other(folders):
    here, _ = folders
    preset(here, "mine", 0.5, "what it is")
    for name, (text, _) in FAULTY.items():
        (here / f"{name}.toml").write_text(text, "utf-8")
    (here / "folder.toml").mkdir()
    (here / "nothing.toml").symlink_to("nowhere")
    found = preset_descriptions()
    assert found["mine"] == "what it is"
    assert all(fault in found[name] for name, (_, fault) in FAULTY.items())
    assert "cannot be read: it is no file" in found["folder"]
    assert "cannot be read: No such file" in found["nothing"]
    faulty = {name for name, text in found.items() if text.startswith("faulty: ")}
    assert faulty == {*FAULTY, "folder", "nothing"}
    for name in faulty:
        with pytest.raises(op.OptipathError):
            op.load_preset(name)


def test_folders_that_are_gone_or_closed_hold_nothing(tmp_path, monkeypatch):
    gone = tmp_path / "gone"
    gone.mkdir()
    (tmp_path / "file").write_text("", "utf-8")
    monkeypatch.chdir(gone)
    gone.rmdir()
    monkeypatch.setenv("OPTIPATH_PRESETS", str(tmp_path / "file"))
    with pytest.raises(op.errors.PresetError, match=r"also in '.*file' \(no folder\); did you"):
        op.load_preset("malos")
    assert "malus" in op.preset_names()
