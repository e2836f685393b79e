"""The page of the explorer, as a picture.

    pip install "optipath[browser]"
    python examples/explorer_screenshot.py docs

Needs chromium. Serves the page, opens it at a case of `npgr026`, and saves docs/explorer.png.
"""

import shutil
import sys
from pathlib import Path
from threading import Thread

from playwright.sync_api import sync_playwright

from optipath.explorer.answers import PageAnswers
from optipath.explorer.paths import ExploredPresets
from optipath.explorer.server import PageServer

STATE = "preset=npgr026&case=8"
SIZE = {"width": 1440, "height": 1500}


def screenshot(file):
    """Save the page as it is first seen."""
    with PageServer(PageAnswers(ExploredPresets("npgr026"))) as server:
        thread = Thread(target=server.serve_forever)
        thread.start()
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(
                executable_path=shutil.which("chromium"), args=["--no-sandbox"]
            )
            page = browser.new_page(viewport=SIZE)
            page.goto(f"{server.address}#{STATE}")
            page.wait_for_selector("#pictures[aria-busy=false]")
            page.screenshot(path=file)
            browser.close()
        server.shutdown()
        thread.join()


if __name__ == "__main__":
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    screenshot(folder / "explorer.png")
    print(folder / "explorer.png")
