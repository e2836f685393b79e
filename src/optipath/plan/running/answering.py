"""Answering: what runners have in common, whether they run one model or two in turn."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from optipath.plan.running.question import Question


class Answering(ABC):
    """What answers questions about a path."""

    @property
    @abstractmethod
    def ran_by(self) -> tuple[str, ...]:
        """The engines that have answered the last question; none before the first."""

    @abstractmethod
    def answer(self, question: Question, parameters: Mapping[str, Any]) -> Any:
        """Return what is asked for."""

    @abstractmethod
    def stream(
        self, question: Question, size: int, parameters: Mapping[str, Any]
    ) -> Iterator[tuple[Any, Any]]:
        """Yield what is asked for, part by part."""
