import pytest

from optipath.errors import PresetError
from optipath.paths.presets.toml_files import file_of, names_in, presets_folder, text_of


@pytest.fixture
def folder(tmp_path):
    for name in ("thick", "thin"):
        (tmp_path / f"{name}.toml").write_text(name, "utf-8")
    (tmp_path / "other.txt").write_text("", "utf-8")
    (tmp_path / "more").mkdir()
    (tmp_path / "more" / "hidden.toml").write_text("", "utf-8")
    return tmp_path


def test_names_are_those_of_the_files_of_one_folder(folder):
    assert names_in(folder) == ["thick", "thin"]
    assert names_in(folder / "nowhere") == []
    assert "glass-rough" not in names_in(presets_folder())


def test_a_name_is_a_file_of_the_folder_and_a_path_is_its_own(folder):
    assert file_of("thin", "film", folder, "a look") == folder / "thin.toml"
    own = folder / "more" / "own.toml"
    assert file_of(own, "film", folder, "a look") == file_of(str(own), "film", folder, "") == own


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ("thinn", "film 'thinn' is unknown; did you mean 'thin'?"),
        ("hidden", "film 'hidden' is unknown; there are: thick, thin"),
        (
            "more/hidden",
            "'more/hidden' is neither the name of a film (a-z, 0-9 and -) nor the path ",
        ),
        ("../thin", "'../thin' is neither the name of a film (a-z, 0-9 and -) nor the path "),
        (None, "a film is a name or the path of a file, not None"),
    ],
)
def test_what_is_neither_is_refused(folder, given, sentence):
    with pytest.raises(PresetError) as error:
        file_of(given, "film", folder, "a look")
    assert str(error.value).startswith(sentence)


def test_a_text_is_that_of_a_file_without_a_mark_of_its_order_of_bytes(folder):
    (folder / "thin.toml").write_bytes(b"\xef\xbb\xbfa = 1")
    assert text_of(folder / "thin.toml", "film") == "a = 1"
    with pytest.raises(PresetError, match="cannot be read: it is no file"):
        text_of(folder / "more", "film")
