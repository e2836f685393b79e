"""What to say of what is given as a function, and is none."""

from __future__ import annotations

from optipath.errors import shown


def no_function(name: str, given: object, wanted: str) -> list[str]:
    """Return the sentence for what is no function; none for one, or for None.

    Examples
    --------
    >>> no_function("progress", 3, "two numbers"), no_function("progress", print, "two numbers")
    (['progress is 3; give a function of two numbers'], [])
    """
    if given is None or callable(given):
        return []
    return [f"{name} is {shown(given)}; give a function of {wanted}"]


PHOTONS_TOLD = "two numbers: how many photons there are, and of how many"
"""Of what the function is that is told how far photons have been walked."""
