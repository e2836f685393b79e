"""Paths wired by words, and read again from the files that they are written to."""

import optipath as op


def wired(nodes, links, **about):
    """A path of elements by name and of links, ``"lamp -> front, front.transmitted -> back"``."""
    path = op.PathGraph(**about)
    for name, element in nodes.items():
        path.add(name, element)
    for link in filter(None, links.split(", ")):
        path.connect(*link.split(" -> "))
    return path


def read(text, folder, **given):
    """The path of a text, by way of a file."""
    file = folder / "path.toml"
    file.write_text(text, "utf-8")
    return op.load_preset(file, **given)


def read_back(path, folder):
    """The path that is read from what a path is written as."""
    return read(path.to_toml(), folder)
