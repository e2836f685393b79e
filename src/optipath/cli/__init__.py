"""The command line."""


def main(arguments: list[str] | None = None) -> int:
    """Run the command ``optipath`` and return its exit status."""
    from optipath.cli.command import main as command  # noqa: PLC0415 - brings click

    return command(arguments)
