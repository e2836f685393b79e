"""What of an element's own values must fit together."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from optipath.values.agreement import Agreement


class OwnAgreements:
    """An element whose values may have to fit to each other; mostly they need not."""

    def agreements(self, owner: str) -> Iterable[Agreement]:
        """Return what must fit of the values, known or given when the path runs.

        Parameters
        ----------
        owner : str
            What sentences call the element.

        Returns
        -------
        iterable of Agreement
        """
        del owner
        return ()
