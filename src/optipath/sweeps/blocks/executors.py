"""Executors beside those of Python: one that does all at once, and that of a cluster."""

from __future__ import annotations

from concurrent.futures import Executor, Future
from functools import partial
from typing import TYPE_CHECKING, Any

import cloudpickle

from optipath.errors import JobError

if TYPE_CHECKING:
    from collections.abc import Callable


class AtOnce(Executor):
    """An executor that does what it is given there and then."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Do it, and return what came of it."""
        done: Future[Any] = Future()
        try:
            done.set_result(fn(*args, **kwargs))
        except Exception as error:  # noqa: BLE001 - whoever asks for the result gets it
            done.set_exception(error)
        return done


class Travelling(Executor):
    """An executor of a cluster that says what is wrong where a worker cannot load what it gets.

    Of what distributed loads itself, nobody is told more than that the worker was lost.
    """

    def __init__(self, executor: Executor) -> None:
        self._executor = executor

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Have it done by a worker, and return what will come of it, or a `JobError`."""
        return self._executor.submit(_unpacked, cloudpickle.dumps(partial(fn, *args, **kwargs)))


def _unpacked(packed: bytes) -> Any:
    try:
        work = cloudpickle.loads(packed)
    except (ImportError, AttributeError) as fault:
        return JobError(
            f"a worker cannot load the job: {fault}; see that what defines it is a module that "
            f"the workers can import, too"
        )
    return work()
