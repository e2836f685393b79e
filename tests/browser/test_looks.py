"""The page for every window, eye and hand, and what it gives to take along."""

import contextlib
import io
import re
from itertools import pairwise

import pytest

import optipath as op
from page_faults import CONTRASTS, CUT, OVER, UNNAMED

pytestmark = pytest.mark.slow

expect = pytest.importorskip("playwright.sync_api", reason="needs the extra 'browser'").expect

FOCUSED = """(({ id, ariaLabel, textContent }) => id || ariaLabel || textContent)(
  document.activeElement)"""
CASE_8 = "preset=npgr026&case=8"
SIZES = {"phone": (400, 800), "desk": (1280, 900), "wall": (3840, 2160)}


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", SIZES)
def test_nothing_is_cut_or_faint_in_a_window(visited_with, size, scheme):
    width, height = SIZES[size]
    visited = visited_with(viewport={"width": width, "height": height}, color_scheme=scheme)
    page = visited.open("preset=npgr026&case=8&y=S0,S1,S2,S3,DoP,AoP")
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    assert [page.evaluate(faults) for faults in (CONTRASTS, CUT, OVER)] == [[], [], []]
    ground = page.evaluate("getComputedStyle(document.body).backgroundColor")
    brightness = sum(map(int, re.findall(r"\d+", ground)[:3]))
    assert (brightness > 600) is (scheme == "light")


def test_pictures_and_texts_grow_with_the_window_and_on_a_phone_the_light_is_above(visited_with):
    sizes = {}
    for size, (width, height) in SIZES.items():
        page = visited_with(viewport={"width": width, "height": height}).open(CASE_8)
        box = page.locator("[data-picture=ellipse] svg").bounding_box()
        text = page.evaluate("parseFloat(getComputedStyle(document.body).fontSize)")
        sizes[size] = box["width"], text
        light, controls = (page.locator(one).bounding_box() for one in ("#light", "#controls"))
        if size == "phone":
            assert light["y"] + light["height"] <= controls["y"]
        else:
            assert controls["x"] + controls["width"] <= light["x"]
    assert sizes["wall"][0] > 2.5 * sizes["desk"][0]
    assert sizes["wall"][1] > 1.4 * sizes["desk"][1]


def test_every_control_and_picture_has_a_name_and_says_in_words_what_it_shows(visited):
    page = visited.open(CASE_8)
    assert page.evaluate(UNNAMED) == []
    ids = page.evaluate("[...document.querySelectorAll('[id]')].map((each) => each.id)")
    assert len(ids) == len(set(ids))
    told = page.locator("[aria-describedby]").evaluate_all(
        "all => all.flatMap((each) => each.getAttribute('aria-describedby').split(' '))"
    )
    assert set(told) <= set(ids)
    levels = page.evaluate(
        "[...document.querySelectorAll('h1, h2, h3')].map((each) => +each.tagName[1])"
    )
    assert levels[0] == 1
    assert all(after - before <= 1 for before, after in pairwise(levels))
    for picture, words in {
        "ellipse": "left-handed, axis at \N{MINUS SIGN}24.91",
        "sphere": "X2.reflected",
        "scene": "delta = 48",
        "curve": "Against delta (deg) from 0 to 90",
        "energy": "19.1245",
    }.items():
        said = page.locator(f"[data-picture={picture}] svg").get_attribute("aria-label")
        assert words in said, picture
    # Results are announced once they rest.
    expect(page.locator("#said")).to_contain_text("S0 19.1245")
    assert page.locator("#said").get_attribute("aria-live") == "polite"


def test_keys_alone_reach_everything_and_dark_and_light_are_switched_and_remembered(visited):
    page = visited.open(CASE_8)
    reached = set()
    for _ in range(80):
        page.keyboard.press("Tab")
        reached.add(page.evaluate(FOCUSED))
    fields = {"parameter-delta", "delta, slider", "place-place"}
    assert fields | {"preset", "case", "reset", "theme", "export-copy"} <= reached
    assert any("arrow keys turn it" in each for each in reached)
    assert page.evaluate("getComputedStyle(document.activeElement).outlineStyle") != "none"
    page = visited.open()
    ground = "getComputedStyle(document.body).backgroundColor"
    light = page.evaluate(ground)
    page.get_by_role("button", name="Dark").click()
    dark = page.evaluate(ground)
    assert dark != light
    expect(page.get_by_role("button", name="Dark")).to_have_attribute("aria-pressed", "true")
    page.reload()
    assert page.evaluate(ground) == dark


def test_taps_are_dashed_in_space_and_nothing_moves_where_motion_is_not_wanted(visited_with):
    page = visited_with(reduced_motion="reduce").open("preset=ellipsometer-pcsa")
    dashes = "all => all.map((each) => getComputedStyle(each).strokeDasharray)"
    rays = page.locator("[data-picture=scene] .ray")
    taps = page.locator("[data-picture=scene] .ray.tap").evaluate_all(dashes)
    assert taps == ["8px, 4px"]
    assert rays.evaluate_all(dashes).count("none") == rays.count() - 2  # Light leaves, too.
    moving = """[...document.querySelectorAll('*')].map((each) => getComputedStyle(each))
      .filter((each) => each.transitionDuration !== '0s' || each.animationName !== 'none').length"""
    assert page.evaluate(moving) == 0


@pytest.mark.parametrize("picture", ["sphere", "scene"])
def test_pictures_in_space_are_turned_by_keys_and_by_dragging(visited, picture):
    page = visited.open(CASE_8)
    svg = f"[data-picture={picture}] svg"
    first = page.inner_html(svg)
    canvas = page.locator(f"[data-picture={picture}] .canvas")
    canvas.press("ArrowUp")
    assert page.inner_html(svg) != first
    canvas.press("Home")
    assert page.inner_html(svg) == first
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    page.mouse.move(box["x"] + 60, box["y"] + 60)
    page.mouse.down()
    page.mouse.move(box["x"] + 130, box["y"] + 80, steps=3)
    page.mouse.up()
    assert page.inner_html(svg) != first
    page.wait_for_url(lambda url: "view." in url)
    assert f"view.{picture}" in page.url


@pytest.mark.parametrize("name", op.preset_names())
def test_a_preset_is_shown_whole(stayed, name):
    page = stayed.page
    if page.url == "about:blank":
        stayed.open()
    page.locator("#preset").select_option(name)
    path = op.load_preset(name)
    stayed.shows(next(iter(path.trace_all().values())))
    expect(page.locator("#description")).to_have_text(path.description)
    for picture in ("ellipse", "sphere", "scene", "energy"):
        assert page.locator(f"[data-picture={picture}] svg > *").count() > 1, picture
    assert "NaN" not in page.locator("main").inner_html()
    assert [page.evaluate(CUT), page.evaluate(OVER), stayed.complaints] == [[], [], []]


# What the page gives to take along.


def text_of(page, form, part):
    page.locator("#export-forms").get_by_role("button", name=form).click()
    expect(page.locator("#export-text")).to_contain_text(part)
    return page.locator("#export-text").inner_text()


def test_python_toml_and_csv_have_the_numbers_of_the_page(visited, saved, tmp_path):
    page = visited.open("preset=npgr026&case=8&value.delta=30+deg")
    lines = text_of(page, "Python", "load_preset")
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        exec(compile(lines, "lines", "exec"), {})  # noqa: S102 - the lines are for running
    printed = page.locator("#stokes td.value").all_inner_texts()
    assert said.getvalue().split() == ["E", *(t.replace("\N{MINUS SIGN}", "-") for t in printed)]
    text_of(page, "TOML", "parameters")
    name, content = saved(page, page.locator("#export-save").click)
    (tmp_path / "mine.toml").write_bytes(content)
    assert name.endswith(".toml")
    there = op.load_preset("npgr026", case="8").trace(delta="30 deg")
    light = op.load_preset(tmp_path / "mine.toml").trace()
    assert light.stokes == pytest.approx(there.stokes, rel=1e-12)
    rows = text_of(visited.open("preset=malus&y=S0&to=90"), "CSV", "angle").strip().splitlines()
    assert len(rows) > 100
    assert rows[0].startswith("angle")
    assert "S0" in rows[0]


@pytest.mark.parametrize("picture", ["ellipse", "sphere", "scene", "curve", "energy"])
def test_pictures_are_saved_with_their_looks_and_texts(stayed, saved, picture):
    state = "preset=npgr026&case=8"
    if not stayed.page.url.endswith(state):
        stayed.open(state)
    figure = stayed.page.locator(f"[data-picture={picture}]")
    name, content = saved(stayed.page, figure.get_by_role("button", name="SVG").click)
    text = content.decode()
    assert name == f"npgr026-case-8-{picture}.svg"
    found = [part in text for part in ("<text", "<title>", "var(", "class=")]
    assert found == [True, True, False, False]
    name, content = saved(stayed.page, figure.get_by_role("button", name="PNG").click)
    assert name.endswith(".png")
    assert content.startswith(b"\x89PNG")
    assert len(content) > 5000


def test_the_lines_are_copied_and_held_while_a_value_cannot_be(visited_with):
    visited = visited_with(permissions=["clipboard-read", "clipboard-write"])
    page = visited.open("preset=malus")
    text, button = page.locator("#export-text"), page.locator("#export-copy")
    lines = text_of(page, "Python", "load_preset('malus'")
    button.click()
    expect(page.locator("#export-said")).to_have_text("copied")
    assert page.evaluate("navigator.clipboard.readText()").strip() == lines.strip()
    page.locator("#parameter-intensity").fill("-1")
    expect(text).not_to_contain_text("load_preset")
    expect(button).to_be_disabled()
    page.locator("#parameter-intensity").fill("2")
    expect(text).to_contain_text("intensity=2.0")
    expect(button).to_be_enabled()
