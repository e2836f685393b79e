"""Blocks of photons that threads walk, handed on in their order."""

from __future__ import annotations

from collections import deque
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, TypeVar

from optipath.surfaces.walk.kept_meshes import kept_meshes
from optipath.surfaces.walk.photon_beam import BLOCK
from optipath.surfaces.walk.walk_code import walk_code

if TYPE_CHECKING:
    from collections.abc import Callable, Generator
    from concurrent.futures import Future

    from optipath.surfaces.walk.photon_beam import PhotonBeam

_AHEAD = 4
"""How many blocks a thread are handed out before the first of them is waited for."""

Found = TypeVar("Found")


def walked_in_order(
    beam: PhotonBeam,
    todo: range,
    photons: int,
    threads: int,
    work: Callable[[int, int], Found],
) -> Generator[Found]:
    """Yield what becomes of blocks, in their order, however many threads there are.

    No more are handed out than keep all threads at work; who closes the generator stops them.
    """
    walk_code()
    kept = kept_meshes(beam.sample)
    executor = ThreadPoolExecutor(threads)
    waiting: deque[Future[Found]] = deque()
    try:
        for number in todo:
            size = min(BLOCK, photons - BLOCK * number)
            # Here and not by a thread, whose warnings nobody would know where from.
            for _, _, surface in beam.portions(number, size):
                kept.of(surface)
            waiting.append(executor.submit(work, number, size))
            if len(waiting) > _AHEAD * threads:
                yield waiting.popleft().result()
        while waiting:
            yield waiting.popleft().result()
    finally:
        executor.shutdown(cancel_futures=True)
