"""The page in a real browser, served by this process; skipped where there is no browser."""

import shutil
from contextlib import ExitStack
from pathlib import Path

import pytest

import optipath as op
from explorer.served import page_server

BROWSERS = ("chromium", "chromium-browser", "google-chrome")


@pytest.fixture(scope="module")
def browser():
    """A browser for the tests of a file: its event loop is not for tests of other folders."""
    playwright = pytest.importorskip("playwright.sync_api", reason="needs the extra 'browser'")
    found = next(filter(None, map(shutil.which, BROWSERS)), None)
    if found is None:
        pytest.skip("needs chromium")
    with playwright.sync_playwright() as started:
        browser = started.chromium.launch(executable_path=found, args=["--no-sandbox"])
        yield browser
        browser.close()


@pytest.fixture(scope="session")
def address():
    """Where the page is served, until the tests end."""
    with page_server("npgr026") as server:
        yield server.address


class Visit:
    """A page that is open, and what it asked for and complained of."""

    def __init__(self, context, address):
        self.address = address
        self.asked, self.complaints = [], []
        self.page = context.new_page()
        self.page.set_default_timeout(15000)
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("console", self._heard)

    def _heard(self, message):
        if message.type in {"error", "warning"}:
            self.complaints.append(message.text)

    def open(self, state=""):
        """Open the page at a state, and wait until it shows numbers and pictures."""
        self.page.goto("about:blank")
        self.page.goto(self.address + (f"#{state}" if state else ""))
        self.page.wait_for_selector("#stokes td")
        self.page.wait_for_selector("#pictures[aria-busy=false]")
        return self.page

    def shows(self, light):
        """Wait until the page shows the numbers of a light."""
        from playwright.sync_api import expect  # noqa: PLC0415 - an extra

        texts = ["0" if abs(each) < light.noise else f"{each:.6g}" for each in light.stokes]
        texts = [text.replace("-", "\N{MINUS SIGN}") for text in texts]
        expect(self.page.locator("#stokes td.value")).to_have_text(texts, timeout=15000)

    def shows_npgr026(self, case="8", place="light", **values):
        """Wait until the page shows the numbers of npgr026 with some values."""
        self.shows(op.load_preset("npgr026", case=case, place=place).trace(**values))

    def imported(self, module, expression):
        """The value of an expression with `it`, a module of the page."""
        code = f"async () => {{ const it = await import('./page/{module}'); return {expression}; }}"
        return self.page.evaluate(code)


def visit(browser, address, **options):
    context = browser.new_context(accept_downloads=True, **options)
    visited = Visit(context, address)
    yield visited
    outside = [url for url in visited.asked if not url.startswith((address, "blob:", "about:"))]
    context.close()
    assert not visited.complaints
    assert not outside


@pytest.fixture(scope="module")
def stayed(browser, address):
    """A visit that all tests of a file share."""
    yield from visit(browser, address)


@pytest.fixture
def visited(stayed):
    """The visit of the file, of which nothing is remembered, and which ends without a complaint."""
    yield stayed
    assert not stayed.complaints
    stayed.page.evaluate("localStorage.clear()")


@pytest.fixture
def visited_with(browser, address):
    """A maker of visits: to a file of one's own, or with options such as ``viewport``."""
    open_ones, served = [], ExitStack()

    def make(opened=None, **options):
        place = address if opened is None else served.enter_context(page_server(opened)).address
        generator = visit(browser, place, **options)
        open_ones.append(generator)
        return next(generator)

    yield make
    with served:
        for generator in open_ones:
            next(generator, None)


@pytest.fixture
def saved(tmp_path):
    """A saver of what a click downloads: its name and its bytes."""

    def save(page, click):
        with page.expect_download() as downloading:
            click()
        kept = Path(tmp_path) / downloading.value.suggested_filename
        downloading.value.save_as(kept)
        return kept.name, kept.read_bytes()

    return save
