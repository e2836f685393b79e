"""What is told of the parameters and choices of a path, a row for each."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from optipath.paths.path_graph import PathGraph
    from optipath.values.parameters import Parameter

Row = tuple[str, str, str, str]
"""The name, the default, the range, and what it is."""


def headings(case: str | None) -> Row:
    """Return what stands above the columns: of a path with the values of a case no defaults.

    Examples
    --------
    >>> headings(None)[1], headings("8")[1]
    ('default', 'value')
    """
    return "parameter", "default" if case is None else "value", "range", "what it is"


def parameter_rows(path: PathGraph) -> list[Row]:
    """Return the rows of a path.

    Examples
    --------
    >>> import optipath as op
    >>> parameter_rows(op.load_preset("malus"))[0]
    ('angle', '30 deg', '-360 deg .. 360 deg', 'turn of the analyser against the polariser')
    """
    rows = [_row(parameter) for parameter in path.parameters.values()]
    for name, choice in path.choices.items():
        described = "; ".join(filter(None, [choice.help, ", ".join(choice.behind)]))
        rows.append((name, choice.place(path.graph), "", described))
    return rows


def _row(parameter: Parameter) -> Row:
    described = "; ".join(filter(None, [parameter.help, ", ".join(parameter.all_words)]))
    default = ("bound to " if parameter.bound else "") + parameter.default_text()
    return parameter.name, default, parameter.range_text(), described
