"""Pictures, drawn with Matplotlib into axes that are given or made; nothing is shown by itself."""

from optipath.extras import need
from optipath.public_names import public_names


def check_matplotlib() -> None:
    """Raise where Matplotlib is not installed."""
    need("pictures", "matplotlib")


__getattr__, __dir__, __all__ = public_names(__name__, needs=check_matplotlib)
