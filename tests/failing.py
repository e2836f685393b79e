"""What fails in another process, which knows this folder and no other module of the tests."""

from optipath.extras import missing_extra


def fails():
    """Raise an error that is made of something else than its sentence."""
    raise missing_extra("plots", "matplotlib")
