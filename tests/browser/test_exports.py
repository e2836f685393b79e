"""What the page gives to take along."""

import contextlib
import io

import pytest

import optipath as op

pytestmark = pytest.mark.slow

expect = pytest.importorskip("playwright.sync_api", reason="needs the extra 'browser'").expect


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
    assert said.getvalue().split() == ["E", *visited.stokes()]
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
    assert "<text" in text
    assert "<title>" in text
    assert "var(" not in text
    assert "class=" not in text
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
