import pytest

from optipath.explorer.explored_presets import ExploredPresets
from optipath.explorer.page_answers import PageAnswers


@pytest.fixture(scope="module")
def answers():
    """What answers a page that shows all presets."""
    return PageAnswers(ExploredPresets())
