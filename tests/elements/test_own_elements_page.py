"""The page on elements of one's own lists what there is."""

import re
from dataclasses import fields
from pathlib import Path

from optipath.kernels.numbers.primitives import Primitives

PAGE = Path(__file__).parents[2] / "docs" / "own-elements.md"


def test_the_page_lists_every_function_of_xp_and_no_other():
    section = PAGE.read_text("utf-8").partition("## The functions of `xp`")[2].partition("##")[0]
    rows = [line.split("|")[1] for line in section.splitlines() if line.startswith("| `")]
    listed = [name for row in rows for name in re.findall(r"`(\w+)", row)]
    assert sorted(listed) == sorted(field.name for field in fields(Primitives))
