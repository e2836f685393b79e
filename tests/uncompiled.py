"""Functions of Numba as plain Python, for numbers of NumPy, which divide by 0."""

from types import FunctionType


def uncompiled(function, known=None):
    """The Python function behind a compiled one; what it calls is uncompiled as well."""
    known = {} if known is None else known
    source = function.py_func
    if source in known:
        return known[source]
    space = dict(source.__globals__)
    known[source] = FunctionType(source.__code__, space, source.__name__, source.__defaults__)
    for name in source.__code__.co_names:
        if hasattr(space.get(name), "py_func"):
            space[name] = uncompiled(space[name], known)
    return known[source]
