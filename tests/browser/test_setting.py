"""What is set on the page is what the library is asked."""

import numpy as np
import pytest

import optipath as op

pytestmark = pytest.mark.slow

expect = pytest.importorskip("playwright.sync_api", reason="needs the extra 'browser'").expect


def printed(light):
    return ["0" if abs(each) < light.noise else f"{each:.6g}" for each in light.stokes]


def test_a_slider_changes_the_numbers_to_those_of_trace(visited):
    page = visited.open("preset=npgr026&case=8")
    visited.shows(printed(op.load_preset("npgr026", case="8").trace()))
    slider = page.get_by_label("delta, slider")
    for _ in range(3):
        slider.press("ArrowRight")
    visited.shows(printed(op.load_preset("npgr026", case="8").trace(delta="48.3 deg")))
    expect(page.locator("#parameter-delta")).to_have_value("48.3")


def test_a_number_in_another_unit_is_converted(visited):
    page = visited.open("preset=npgr026&case=8")
    page.get_by_label("Unit of delta").select_option("rad")
    expect(page.locator("#parameter-delta")).to_have_value(f"{np.radians(48.0):.10g}")
    page.locator("#parameter-delta").fill("0.5")
    visited.shows(printed(op.load_preset("npgr026", case="8").trace(delta=0.5)))
    page.get_by_label("delta, slider").press("ArrowRight")
    degrees = round(float(np.degrees(0.5)), 1) + 0.1
    visited.shows(printed(op.load_preset("npgr026", case="8").trace(delta=f"{degrees:.1f} deg")))
    written = float(page.locator("#parameter-delta").input_value())
    assert written == pytest.approx(np.radians(degrees), rel=1e-9)


def test_signs_that_the_page_prints_are_read(visited):
    page = visited.open("preset=npgr026&case=8")
    page.locator("#parameter-rho").fill("\N{MINUS SIGN}24.91\N{DEGREE SIGN}")
    visited.shows(printed(op.load_preset("npgr026", case="8").trace(rho="-24.91 deg")))


def test_words_and_places_and_cases_are_chosen(visited):
    page = visited.open("preset=npgr026&case=8")
    words = page.get_by_role("group", name="Words for filter")
    words.get_by_role("button", name="vertical").click()
    path = op.load_preset("npgr026", case="8")
    visited.shows(printed(path.trace(filter="vertical")))
    page.get_by_label("place").select_option("eye")
    moved = op.load_preset("npgr026", case="8", place="eye")
    visited.shows(printed(moved.trace(filter="vertical")))
    page.locator("#case").select_option("7")
    visited.shows(printed(op.load_preset("npgr026", case="7").trace()))
    expect(page.get_by_label("place")).to_have_value("light")
    expect(page.locator("#stokes th[scope=col]")).to_have_text(
        ["", "computed", "published", "difference"]
    )


def test_a_material_asks_for_a_wavelength_and_gets_it(visited):
    page = visited.open("preset=npgr026&case=8")
    assert page.locator("#parameter-wavelength").is_hidden()
    page.locator("#parameter-n1").fill("gold")
    expect(page.locator("#parameter-wavelength-fault")).to_contain_text("wavelength")
    page.locator("#parameter-wavelength").fill("516 nm")
    expect(page.locator("#parameter-wavelength-fault")).to_be_hidden()
    # Johnson and Christy, Phys. Rev. B 6, 4370 (1972), linear between samples.
    path = op.load_preset("npgr026", case="8")
    visited.shows(printed(path.trace(n1=0.70232, k1=2.032392)))


def test_a_wrong_value_is_a_sentence_at_its_field_and_pictures_stay(visited):
    page = visited.open("preset=npgr026&case=8")
    field = page.locator("#parameter-delta")
    field.fill("95")
    sentence = page.locator("#parameter-delta-fault")
    expect(sentence).to_contain_text("outside its range")
    expect(field).to_have_attribute("aria-invalid", "true")
    assert sentence.get_attribute("id") in field.get_attribute("aria-describedby")
    expect(page.locator("#stale")).to_be_visible()
    visited.shows(printed(op.load_preset("npgr026", case="8").trace()))
    field.fill("48")
    expect(sentence).to_be_hidden()
    expect(page.locator("#stale")).to_be_hidden()


def test_an_address_with_a_wrong_value_shows_the_defaults_and_the_sentence(visited):
    page = visited.open("preset=npgr026&value.delta=ninety")
    expect(page.locator("#parameter-delta-fault")).to_contain_text("'ninety'")
    expect(page.locator("#parameter-delta")).to_have_value("ninety")
    visited.shows(printed(op.load_preset("npgr026").trace()))


def test_an_unknown_preset_is_said_and_another_can_be_chosen(visited):
    page = visited.page
    page.goto(f"{visited.address}#preset=npgr027")
    expect(page.locator("#fault")).to_contain_text("did you mean 'npgr026'")
    page.locator("#preset").select_option("malus")
    visited.shows(printed(op.load_preset("malus").trace()))
    expect(page.locator("#fault")).to_be_hidden()


def test_steps_are_undone_and_redone(visited):
    page = visited.open("preset=npgr026&case=8")
    before = printed(op.load_preset("npgr026", case="8").trace())
    after = printed(op.load_preset("npgr026", case="8").trace(delta="48.2 deg"))
    expect(page.locator("#undo")).to_be_disabled()
    slider = page.get_by_label("delta, slider")
    slider.press("ArrowRight")
    slider.press("ArrowRight")
    visited.shows(after)
    page.keyboard.press("Control+z")
    page.keyboard.press("Control+z")
    visited.shows(before)
    expect(page.locator("#parameter-delta")).to_have_value("48")
    page.locator("#redo").click()
    page.keyboard.press("Control+Shift+z")
    visited.shows(after)
    page.get_by_role("button", name="Reset", exact=True).click()
    visited.shows(before)


def test_the_address_carries_the_state(visited, visited_with):
    page = visited.open("preset=npgr026&case=8")
    page.locator("#parameter-rho").fill("20")
    page.get_by_role("button", name="DoLP", exact=True).click()
    page.get_by_label("Poincaré sphere; arrow").press("ArrowLeft")
    visited.shows(printed(op.load_preset("npgr026", case="8").trace(rho="20 deg")))
    page.wait_for_url(lambda url: "DoLP" in url and "rho" in url and "view.sphere" in url)
    other = visited_with()
    again = other.open(page.url.partition("#")[2])
    other.shows(visited.stokes())
    expect(again.locator("#parameter-rho")).to_have_value("20")
    pressed = again.locator("#curve-outputs [aria-pressed=true]")
    expect(pressed).to_have_text(["S0", "S1", "S2", "S3", "DoLP"])
    sphere = "[data-picture=sphere] svg"
    assert again.inner_html(sphere) == page.inner_html(sphere)


def test_another_address_in_the_same_window_is_followed(visited):
    page = visited.open("preset=npgr026&case=8")
    page.evaluate("location.hash = 'preset=malus&value.angle=60+deg'")
    visited.shows(printed(op.load_preset("malus").trace(angle="60 deg")))
    page.keyboard.press("Control+z")
    visited.shows(printed(op.load_preset("npgr026", case="8").trace()))


def test_a_curve_is_chosen_and_its_value_pointed_at(visited):
    page = visited.open("preset=malus")
    assert "against angle (deg)" in curve(page).lower()
    page.get_by_role("button", name="DoP", exact=True).click()
    expect(page.locator("#curve-canvas svg")).to_have_attribute("aria-label", contains("DoP"))
    page.locator("#curve-range").get_by_label("to").fill("90")
    page.keyboard.press("Enter")
    expect(page.locator("#curve-canvas svg")).to_have_attribute("aria-label", contains("to 90:"))
    page.locator("#curve-canvas").scroll_into_view_if_needed()
    box = page.locator("#curve-canvas svg").bounding_box()
    page.mouse.click(box["x"] + 0.5 * box["width"], box["y"] + 0.3 * box["height"])
    expect(page.locator("#parameter-angle")).not_to_have_value("30")
    angle = float(page.locator("#parameter-angle").input_value())
    assert 30.0 < angle < 60.0
    visited.shows(printed(op.load_preset("malus").trace(angle=np.radians(angle))))


def test_pointing_at_a_curve_with_ends_in_another_unit_means_what_it_shows(visited):
    page = visited.open("preset=npgr026&case=8&x=delta&from=0.2+rad&to=1.2+rad")
    page.locator("#curve-canvas").scroll_into_view_if_needed()
    box = page.locator("#curve-canvas svg").bounding_box()
    page.mouse.click(box["x"] + 0.5 * box["width"], box["y"] + 0.3 * box["height"])
    expect(page.locator("#parameter-delta")).not_to_have_value("48")
    degrees = float(page.locator("#parameter-delta").input_value())
    assert np.degrees(0.6) < degrees < np.degrees(0.8)
    visited.shows(printed(op.load_preset("npgr026", case="8").trace(delta=np.radians(degrees))))


def test_wrong_ends_of_a_curve_are_told_beside_it(visited):
    page = visited.open("preset=malus")
    page.locator("#curve-range").get_by_label("from").fill("a lot")
    page.keyboard.press("Enter")
    expect(page.locator("#curve-fault")).to_contain_text("'a lot'")


def test_a_file_with_two_detectors_lets_one_choose(visited_with, tmp_path):
    glass = op.Interface(1.5, op.Parameter("theta", default="50 deg")).named("glass")
    path = op.Source(1.0) >> glass >> op.Detector().named("above")
    path["glass.transmitted"] >> op.Detector().named("below")
    file = tmp_path / "pane.toml"
    file.write_text(path.to_toml())
    visited = visited_with(opened=file)
    page = visited.open()
    lights = path.trace_all()
    visited.shows(printed(lights["above"]))
    page.locator("#detector").select_option("below")
    visited.shows(printed(lights["below"]))
    assert "below" in page.locator("[data-picture=ellipse] svg").get_attribute("aria-label")


def curve(page):
    return page.locator("#curve-canvas svg").get_attribute("aria-label")


def contains(words):
    import re  # noqa: PLC0415

    return re.compile(re.escape(words))
