"""What is set on the page is what the library is asked, and what cannot be set is told."""

import re

import numpy as np
import pytest

import optipath as op

pytestmark = pytest.mark.slow

expect = pytest.importorskip("playwright.sync_api", reason="needs the extra 'browser'").expect

CASE_8 = "preset=npgr026&case=8"


def is_labelled(page, picture, words):
    """Wait until a picture says these words."""
    label = re.compile(re.escape(words))
    expect(page.locator(f"{picture} svg")).to_have_attribute("aria-label", label)


def point_at_the_curve(page):
    page.locator("#curve-canvas").scroll_into_view_if_needed()
    box = page.locator("#curve-canvas svg").bounding_box()
    page.mouse.click(box["x"] + 0.5 * box["width"], box["y"] + 0.3 * box["height"])


def value_of(page, parameter):
    return float(page.locator(f"#parameter-{parameter}").input_value())


def test_a_slider_and_a_field_change_the_numbers_to_those_of_trace(visited):
    page = visited.open(CASE_8)
    visited.shows_npgr026()
    slider = page.get_by_label("delta, slider")
    for _ in range(3):
        slider.press("ArrowRight")
    visited.shows_npgr026(delta="48.3 deg")
    expect(page.locator("#parameter-delta")).to_have_value("48.3")
    # Numbers in another unit and with signs that the page prints are read.
    page = visited.open(CASE_8)
    page.get_by_label("Unit of delta").select_option("rad")
    expect(page.locator("#parameter-delta")).to_have_value(f"{np.radians(48.0):.10g}")
    page.locator("#parameter-delta").fill("0.5")
    visited.shows_npgr026(delta=0.5)
    page.get_by_label("delta, slider").press("ArrowRight")
    degrees = round(float(np.degrees(0.5)), 1) + 0.1
    visited.shows_npgr026(delta=f"{degrees:.1f} deg")
    assert value_of(page, "delta") == pytest.approx(np.radians(degrees), rel=1e-9)
    page = visited.open(CASE_8)
    page.locator("#parameter-rho").fill("\N{MINUS SIGN}24.91\N{DEGREE SIGN}")
    visited.shows_npgr026(rho="-24.91 deg")


def test_words_places_cases_and_materials_are_chosen(visited):
    page = visited.open(CASE_8)
    words = page.get_by_role("group", name="Words for filter")
    words.get_by_role("button", name="vertical").click()
    visited.shows_npgr026(filter="vertical")
    page.get_by_label("place").select_option("eye")
    visited.shows_npgr026(place="eye", filter="vertical")
    page.locator("#case").select_option("7")
    visited.shows_npgr026(case="7")
    expect(page.get_by_label("place")).to_have_value("light")
    columns = ["", "computed", "published", "difference"]
    expect(page.locator("#stokes th[scope=col]")).to_have_text(columns)
    # A material asks for a wavelength and gets it, and without one it does no harm.
    page = visited.open(CASE_8)
    assert page.locator("#parameter-wavelength").is_hidden()
    page.locator("#parameter-n1").fill("gold")
    expect(page.locator("#parameter-wavelength-fault")).to_contain_text("wavelength")
    page.locator("#parameter-wavelength").fill("516 nm")
    expect(page.locator("#parameter-wavelength-fault")).to_be_hidden()
    # Johnson and Christy, Phys. Rev. B 6, 4370 (1972), linear between samples.
    visited.shows_npgr026(n1=0.70232, k1=2.032392)
    page = visited.open(f"{CASE_8}&value.wavelength=500+nm")
    visited.shows_npgr026()
    expect(page.locator("#fault")).to_be_hidden()
    expect(page.locator("#parameter-wavelength")).to_be_hidden()


def test_what_is_wrong_is_a_sentence_at_its_field_and_pictures_stay(visited):
    page = visited.open(CASE_8)
    field = page.locator("#parameter-delta")
    field.fill("95")
    sentence = page.locator("#parameter-delta-fault")
    expect(sentence).to_contain_text("outside its range")
    expect(field).to_have_attribute("aria-invalid", "true")
    assert sentence.get_attribute("id") in field.get_attribute("aria-describedby")
    expect(page.locator("#stale")).to_be_visible()
    visited.shows_npgr026()
    field.fill("48")
    expect(sentence).to_be_hidden()
    expect(page.locator("#stale")).to_be_hidden()
    page = visited.open("preset=npgr026&value.delta=ninety")
    expect(sentence).to_contain_text("'ninety'")
    expect(field).to_have_value("ninety")
    visited.shows(op.load_preset("npgr026").trace())
    # An unknown preset or place is said, and another can be chosen.
    page.goto(f"{visited.address}#preset=npgr027")
    expect(page.locator("#fault")).to_contain_text("did you mean 'npgr026'")
    page.locator("#preset").select_option("malus")
    visited.shows(op.load_preset("malus").trace())
    expect(page.locator("#fault")).to_be_hidden()
    # A place that is none and a detector that is none are cured by reset.
    page = visited.open(f"{CASE_8}&place.place=zz&detector=yy")
    expect(page.locator("#place-place-fault")).to_contain_text("'zz'")
    page.get_by_role("button", name="Reset", exact=True).click()
    visited.shows_npgr026()
    for sentence in ("#fault", "#place-place-fault", "#curve-fault"):
        expect(page.locator(sentence)).to_be_hidden()


def test_steps_are_undone_and_redone_and_the_address_carries_the_state(visited, visited_with):
    page = visited.open(CASE_8)
    expect(page.locator("#undo")).to_be_disabled()
    slider = page.get_by_label("delta, slider")
    slider.press("ArrowRight")
    slider.press("ArrowRight")
    visited.shows_npgr026(delta="48.2 deg")
    page.keyboard.press("Control+z")
    page.keyboard.press("Control+z")
    visited.shows_npgr026()
    expect(page.locator("#parameter-delta")).to_have_value("48")
    page.locator("#redo").click()
    page.keyboard.press("Control+Shift+z")
    visited.shows_npgr026(delta="48.2 deg")
    page.get_by_role("button", name="Reset", exact=True).click()
    visited.shows_npgr026()
    page = visited.open(CASE_8)
    page.locator("#parameter-rho").fill("20")
    page.get_by_role("button", name="DoLP", exact=True).click()
    page.get_by_label("Poincaré sphere; arrow").press("ArrowLeft")
    visited.shows_npgr026(rho="20 deg")
    page.wait_for_url(lambda url: "DoLP" in url and "rho" in url and "view.sphere" in url)
    other = visited_with()
    again = other.open(page.url.partition("#")[2])
    other.shows_npgr026(rho="20 deg")
    expect(again.locator("#parameter-rho")).to_have_value("20")
    pressed = again.locator("#curve-outputs [aria-pressed=true]")
    expect(pressed).to_have_text(["S0", "S1", "S2", "S3", "DoLP"])
    sphere = "[data-picture=sphere] svg"
    assert again.inner_html(sphere) == page.inner_html(sphere)
    # Another address in the same window is followed.
    page = visited.open(CASE_8)
    page.evaluate("location.hash = 'preset=malus&value.angle=60+deg'")
    visited.shows(op.load_preset("malus").trace(angle="60 deg"))
    page.keyboard.press("Control+z")
    visited.shows_npgr026()


def test_a_curve_is_chosen_its_value_pointed_at_and_its_fault_leaves_all_else_as_it_is(visited):
    page = visited.open("preset=malus")
    label = page.locator("#curve-canvas svg").get_attribute("aria-label")
    assert "against angle (deg)" in label.lower()
    page.get_by_role("button", name="DoP", exact=True).click()
    is_labelled(page, "#curve-canvas", "DoP")
    page.locator("#curve-range").get_by_label("to").fill("90")
    page.keyboard.press("Enter")
    is_labelled(page, "#curve-canvas", "to 90:")
    point_at_the_curve(page)
    expect(page.locator("#parameter-angle")).not_to_have_value("30")
    angle = value_of(page, "angle")
    assert 30.0 < angle < 60.0
    visited.shows(op.load_preset("malus").trace(angle=np.radians(angle)))
    # With ends in another unit it means what it shows.
    page = visited.open(f"{CASE_8}&x=delta&from=0.2+rad&to=1.2+rad")
    point_at_the_curve(page)
    expect(page.locator("#parameter-delta")).not_to_have_value("48")
    degrees = value_of(page, "delta")
    assert np.degrees(0.6) < degrees < np.degrees(0.8)
    visited.shows_npgr026(delta=np.radians(degrees))
    page = visited.open("preset=malus")
    page.locator("#curve-range").get_by_label("from").fill("a lot")
    page.keyboard.press("Enter")
    expect(page.locator("#curve-fault")).to_contain_text("'a lot'")
    page = visited.open(f"{CASE_8}&x=delta&from=-5")
    expect(page.locator("#curve-fault")).to_contain_text("-5")
    page.locator("#parameter-delta").fill("30")
    visited.shows_npgr026(delta="30 deg")
    is_labelled(page, "[data-picture=scene]", "delta = 30")
    expect(page.locator("#stale")).to_be_hidden()
    page.locator("#curve-range").get_by_label("from").fill("5")
    page.keyboard.press("Enter")
    expect(page.locator("#curve-fault")).to_be_hidden()
    is_labelled(page, "#curve-canvas", "from 5 to 90")


def test_a_file_with_two_detectors_lets_one_choose(visited_with, tmp_path):
    glass = op.Interface(1.5, op.Parameter("theta", default="50 deg")).named("glass")
    path = op.Source(1.0) >> glass >> op.Detector().named("above")
    path["glass.transmitted"] >> op.Detector().named("below")
    (tmp_path / "pane.toml").write_text(path.to_toml())
    visited = visited_with(opened=tmp_path / "pane.toml")
    page = visited.open()
    lights = path.trace_all()
    visited.shows(lights["above"])
    page.locator("#detector").select_option("below")
    visited.shows(lights["below"])
    assert "below" in page.locator("[data-picture=ellipse] svg").get_attribute("aria-label")


def test_pictures_of_the_preset_before_are_faint_until_there_are_others(visited):
    page, held = visited.open("preset=malus"), []

    def hold(route):
        held.append(route)

    page.route("**/api/trace", hold, times=1)
    page.locator("#preset").select_option("npgr026")
    expect(page.locator("#parameter-delta")).to_be_visible()
    for part in ("#light", "#pictures"):
        expect(page.locator(part)).to_have_class("other")
    page.get_by_label("Unit of delta").select_option("rad")
    held[0].continue_()
    visited.shows(op.load_preset("npgr026").trace())
    for part in ("#light", "#pictures"):
        expect(page.locator(part)).not_to_have_class("other")
    expect(page.locator("#parameter-delta")).to_have_value(f"{np.radians(53.0):.10g}")
