"""UnknownSample: what stands for a sample that a file does not hold."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NoReturn

from optipath.errors import SurfaceError


@dataclass(frozen=True, repr=False)
class UnknownSample:
    """What stands for a sample that is not known, and refuses to be asked for more than this.

    Examples
    --------
    >>> UnknownSample("its heights are in no file", isotropic=True, digest="").layers
    Traceback (most recent call last):
    optipath.errors.SurfaceError: the sample of this hemisphere is not known: its heights are in \
    no file; give it, op.load_hemisphere(path, sample=...)
    """

    why: str
    isotropic: bool
    digest: str
    text: str | None = None

    def to_toml(self) -> str:
        """Return the text of its file, as it has been read."""
        if self.text is None:
            raise SurfaceError(self.why)
        return self.text

    def __getattr__(self, name: str) -> NoReturn:
        if name.startswith("__"):
            raise AttributeError(name)  # Python itself asks for what need not be there.
        raise SurfaceError(
            f"the sample of this hemisphere is not known: {self.why}; give it, "
            f"op.load_hemisphere(path, sample=...)"
        )

    def __repr__(self) -> str:
        return "a sample that is not known"
