"""The names of ports, and what to say where one is wrong."""

from __future__ import annotations

from typing import TYPE_CHECKING

from optipath.errors import PathError, did_you_mean

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.elements import Element


def check_port(element: Element, owner: str, port: str, ports: Sequence[str]) -> None:
    """Raise unless a port of a node is one of those given.

    Raises
    ------
    PathError
        With a did-you-mean.

    Examples
    --------
    >>> from optipath.elements import BeamSplitter
    >>> try:
    ...     check_port(BeamSplitter(), "bs", "transmited", BeamSplitter.outputs)
    ... except PathError as error:
    ...     print(error)
    port 'bs.transmited' does not exist; did you mean 'bs.transmitted'?
    """
    if port in ports:
        return
    if port in (*element.inputs, *element.outputs):
        way = "in" if port in element.inputs else "out"
        raise PathError(
            f"port '{owner}.{port}' lets light {way}; a link goes from an out-port to an in-port"
        )
    cure = did_you_mean(f"{owner}.{port}", [f"{owner}.{known}" for known in ports])
    raise PathError(f"port '{owner}.{port}' does not exist{cure}")
