"""Every preset is shown, without a complaint, with all its pictures."""

import pytest

import optipath as op
from page_faults import CUT, OVER

pytestmark = pytest.mark.slow

expect = pytest.importorskip("playwright.sync_api", reason="needs the extra 'browser'").expect

DRAWN = ("ellipse", "sphere", "scene", "energy")


@pytest.mark.parametrize("name", op.preset_names())
def test_a_preset_is_shown_whole(stayed, name):
    page = stayed.page
    if page.url == "about:blank":
        stayed.open()
    page.locator("#preset").select_option(name)
    path = op.load_preset(name)
    light = next(iter(path.trace_all().values()))
    stayed.shows(["0" if abs(each) < light.noise else f"{each:.6g}" for each in light.stokes])
    expect(page.locator("#description")).to_have_text(path.description)
    for picture in DRAWN:
        assert page.locator(f"[data-picture={picture}] svg > *").count() > 1, picture
    assert "NaN" not in page.locator("main").inner_html()
    assert page.evaluate(CUT) == []
    assert page.evaluate(OVER) == []
    assert stayed.complaints == []
