"""The legend below the drawing of a path: its parameters, choices and cases."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from rich.cells import cell_len

from optipath.cli.node_box import SMALL
from optipath.cli.path_rows import headings, parameter_rows
from optipath.cli.svg_words import add_text, lines_of, text_width

if TYPE_CHECKING:
    from collections.abc import Sequence
    from xml.etree.ElementTree import Element

    from optipath.paths.path_graph import PathGraph

_WIDEST, _LAST, _CELLS, _BETWEEN = (22, 22, 24), 40, 98, 2  # In letters.
_STEP, _APART = 16.0, 4.0


@dataclass(frozen=True)
class PictureLegend:
    """Tables of texts, one under the other."""

    tables: list[list[tuple[list[str], ...]]]
    columns: list[list[int]]

    @property
    def width(self) -> float:
        """How wide the widest table is."""
        cells = (sum(columns) + _BETWEEN * (len(columns) - 1) for columns in self.columns)
        return text_width(" ", SMALL) * max(cells, default=0)

    def draw(self, parent: Element, x: float, y: float) -> float:
        """Add the tables to a drawing; return where they end."""
        letter = text_width(" ", SMALL)
        for rows, columns in zip(self.tables, self.columns, strict=True):
            for number, row in enumerate(rows):
                for place, cell in enumerate(row):
                    left = x + letter * (sum(columns[:place]) + _BETWEEN * place)
                    kind = "name" if number == 0 else "ink" if place else "name"
                    for line, text in enumerate(cell):
                        add_text(parent, text, left, y + SMALL + _STEP * line, SMALL, kind)
                y += _STEP * max(map(len, row)) + _APART
            y += _STEP
        return y


def legend_of(path: PathGraph, case: str | None = None) -> PictureLegend:
    """Return the legend of a path."""
    found = PictureLegend([], [])
    if rows := parameter_rows(path):
        _add(found, [headings(case), *rows], _WIDEST)
    named: dict[str, list[str]] = {}
    for name, each in path.cases.items():
        named.setdefault(each.note, []).append(name)
    if named:
        alone = [*named] == [""]
        notes = [(", ".join(names), note) for note, names in named.items()]
        _add(found, [("cases", ""), *notes], [_CELLS if alone else _WIDEST[0]])
    return found


def _add(legend: PictureLegend, rows: Sequence[tuple[str, ...]], widest: Sequence[int]) -> None:
    """Add a table whose last column takes the room that the others leave."""
    others = [[lines_of(row[place], most) for row in rows] for place, most in enumerate(widest)]
    columns = [max(cell_len(line) for cell in each for line in cell) for each in others]
    rest = max(_LAST, _CELLS - sum(columns) - _BETWEEN * len(columns))
    last = [lines_of(row[-1], rest) for row in rows]
    legend.tables.append([*zip(*others, last, strict=True)])
    widest_last = max((cell_len(line) for cell in last for line in cell), default=0)
    legend.columns.append([*columns, widest_last])
