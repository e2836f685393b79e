"""What the page shows of a state that cannot be, or not wholly."""

import numpy as np
import pytest

import optipath as op

pytestmark = pytest.mark.slow

playwright = pytest.importorskip("playwright.sync_api", reason="needs the extra 'browser'")
expect = playwright.expect


def printed(light):
    return ["0" if abs(each) < light.noise else f"{each:.6g}" for each in light.stokes]


def test_a_fault_of_the_curve_leaves_all_else_as_it_is(visited):
    page = visited.open("preset=npgr026&case=8&x=delta&from=-5")
    expect(page.locator("#curve-fault")).to_contain_text("-5")
    page.locator("#parameter-delta").fill("30")
    visited.shows(printed(op.load_preset("npgr026", case="8").trace(delta="30 deg")))
    expect(page.locator("[data-picture=scene] svg")).to_have_attribute(
        "aria-label", contains("delta = 30")
    )
    expect(page.locator("#stale")).to_be_hidden()
    page.locator("#curve-range").get_by_label("from").fill("5")
    page.keyboard.press("Enter")
    expect(page.locator("#curve-fault")).to_be_hidden()
    expect(page.locator("#curve-canvas svg")).to_have_attribute(
        "aria-label", contains("from 5 to 90")
    )


def test_a_wavelength_in_the_address_that_nothing_asks_for_does_no_harm(visited):
    page = visited.open("preset=npgr026&case=8&value.wavelength=500+nm")
    visited.shows(printed(op.load_preset("npgr026", case="8").trace()))
    expect(page.locator("#fault")).to_be_hidden()
    expect(page.locator("#parameter-wavelength")).to_be_hidden()


def test_a_place_that_is_none_and_a_detector_that_is_none_are_cured_by_reset(visited):
    page = visited.open("preset=npgr026&case=8&place.place=zz&detector=yy")
    expect(page.locator("#place-place-fault")).to_contain_text("'zz'")
    page.get_by_role("button", name="Reset", exact=True).click()
    visited.shows(printed(op.load_preset("npgr026", case="8").trace()))
    for sentence in ("#fault", "#place-place-fault", "#curve-fault"):
        expect(page.locator(sentence)).to_be_hidden()


def test_what_is_taken_along_is_marked_and_held_while_a_value_cannot_be(visited):
    page = visited.open("preset=malus")
    text, button = page.locator("#export-text"), page.locator("#export-copy")
    expect(text).to_contain_text("load_preset('malus'")
    page.locator("#parameter-intensity").fill("-1")
    expect(text).not_to_contain_text("load_preset")
    expect(button).to_be_disabled()
    page.locator("#parameter-intensity").fill("2")
    expect(text).to_contain_text("intensity=2.0")
    expect(button).to_be_enabled()


def test_pictures_of_the_preset_before_are_faint_until_there_are_others(visited):
    page = visited.open("preset=malus")
    held = []

    def hold(route):
        held.append(route)

    page.route("**/api/trace", hold, times=1)
    page.locator("#preset").select_option("npgr026")
    expect(page.locator("#parameter-delta")).to_be_visible()
    for part in ("#light", "#pictures"):
        expect(page.locator(part)).to_have_class("other")
    page.get_by_label("Unit of delta").select_option("rad")
    held[0].continue_()
    visited.shows(printed(op.load_preset("npgr026").trace()))
    for part in ("#light", "#pictures"):
        expect(page.locator(part)).not_to_have_class("other")
    expect(page.locator("#parameter-delta")).to_have_value(f"{np.radians(53.0):.10g}")


def contains(words):
    import re  # noqa: PLC0415

    return re.compile(re.escape(words))
