import pytest

from explorer.served import page_server
from optipath.explorer.explored_presets import ExploredPresets
from optipath.explorer.page_answers import PageAnswers


@pytest.fixture(scope="module")
def answers():
    """What answers a page that shows all presets."""
    return PageAnswers(ExploredPresets())


@pytest.fixture(scope="module")
def server():
    with page_server() as found:
        yield found


@pytest.fixture
def answers_of(tmp_path, monkeypatch):
    """A maker of what answers a page with a file of one's own."""
    monkeypatch.chdir(tmp_path)

    def make(name, text):
        (tmp_path / name).write_text(text, "utf-8")
        return PageAnswers(ExploredPresets(name))

    return make
