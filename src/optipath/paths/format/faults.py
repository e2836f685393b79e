"""The faults met while reading, kept so that all can be told at once."""

from __future__ import annotations

from typing import TYPE_CHECKING, ParamSpec, TypeVar

from optipath.errors import OptipathError

if TYPE_CHECKING:
    from collections.abc import Callable

T = TypeVar("T")
P = ParamSpec("P")


class Faults(list[str]):
    """A list of sentences, each with its place in the file."""

    def attempt(
        self, where: str, action: Callable[P, T], *arguments: P.args, **keywords: P.kwargs
    ) -> T | None:
        """Return what an action gives, or None after keeping its faults.

        Parameters
        ----------
        where : str
            The place in the file.
        action : callable
            What may raise an `OptipathError`.
        *arguments, **keywords : Any
            What it is called with.

        Returns
        -------
        Any
            What it returns.

        Examples
        --------
        >>> from optipath.values.units import dimension_of
        >>> faults = Faults()
        >>> faults.attempt("parameters.delta", dimension_of, "degg")
        >>> faults
        ["parameters.delta: unit 'degg' is unknown; did you mean 'deg'?"]
        """
        try:
            return action(*arguments, **keywords)
        except OptipathError as error:
            self += [f"{where}: {fault}" for fault in error.faults]
            return None
