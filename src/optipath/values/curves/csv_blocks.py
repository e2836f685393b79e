"""Blocks of a file of columns: n and k one after another, as refractiveindex.info exports them."""

from __future__ import annotations

from optipath.errors import ValueFault, listed

Line = tuple[int, list[str]]


def joined_blocks(lines: list[Line]) -> list[Line]:
    """Return the lines of a file with several blocks as those of one table.

    Parameters
    ----------
    lines : list of tuple
        The number of each line, and its values; the first one has names.

    Returns
    -------
    list of tuple
        As they are where there is one block; else those of the first, with the values of others.

    Raises
    ------
    ValueFault
        If the blocks are not of the same wavelengths.

    Examples
    --------
    >>> file = [(1, ["wl", "n"]), (2, ["0.5", "1.9"]), (3, ["wl", "k"]), (4, ["0.5", "2.1"])]
    >>> joined_blocks(file)
    [(1, ['wl', 'n', 'k']), (2, ['0.5', '1.9', '2.1'])]
    """
    axis = lines[0][1][0] if lines else ""
    starts = [at for at, (_, cells) in enumerate(lines) if cells[0] == axis and len(cells) > 1]
    if len(starts) < 2 or starts[0]:
        return lines
    ends = [*starts[1:], len(lines)]
    first, *others = [lines[start:end] for start, end in zip(starts, ends, strict=True)]
    for block in others:
        if fault := _fault(first, block):
            raise ValueFault(fault)
    return [
        (number, [*cells, *[cell for block in others for cell in block[at][1][1:]]])
        for at, (number, cells) in enumerate(first)
    ]


def _fault(first: list[Line], block: list[Line]) -> str:
    """Return why a block is not beside the first one, or nothing."""
    number, names = block[0]
    behind = f"the block of {listed(names[1:])} that begins in line {number}"
    cure = "write one table, with a line for each wavelength"
    for (one, cells), (other, its) in zip(first, block, strict=False):
        if cells[0] != its[0]:
            return f"line {other} has the wavelength {its[0]}, and line {one} {cells[0]}; {cure}"
    if len(first) != len(block):
        return f"{behind} has {len(block) - 1} wavelengths, and the first {len(first) - 1}; {cure}"
    return ""
