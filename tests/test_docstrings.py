"""Public names are documented as numpydoc has it; of all else, ruff asks for a sentence.

Public are the names of `optipath`, its errors, `optipath.plots` and `optipath.surfaces`, and the
methods of their classes.
"""

import inspect
import re
from functools import cached_property

import optipath as op


def public_objects():
    """Every public name that is defined in the library, and the public methods of classes."""
    for space in (op, op.errors, op.plots, op.surfaces):
        for name in space.__all__:
            thing = getattr(space, name)
            if inspect.isclass(thing):
                yield name, thing
                yield from methods_of(thing)
            elif inspect.isfunction(thing):
                yield name, thing


def methods_of(cls):
    for name, _ in inspect.getmembers(cls):
        if not name.startswith("_"):
            owner = next(base for base in cls.__mro__ if name in vars(base))
            if owner.__module__.startswith("optipath"):
                yield f"{cls.__name__}.{name}", vars(owner)[name]


def function_of(thing):
    """The function that a method or a property of a class is made of; None for what has none."""
    if isinstance(thing, property | cached_property):
        return None
    thing = getattr(thing, "__func__", thing)
    return inspect.unwrap(thing) if inspect.isroutine(thing) else None


def arguments_of(function, *, bound):
    """The names of arguments, without the object or class of a method."""
    parameters = [*inspect.signature(function).parameters.values()][int(bound) :]
    stars = {inspect.Parameter.VAR_POSITIONAL: "*", inspect.Parameter.VAR_KEYWORD: "**"}
    return [stars.get(each.kind, "") + each.name for each in parameters]


def names_under(heading, docstring):
    """The names that a section lists."""
    section = re.search(rf"^{heading}\n-+\n(.*?)(?=^\S[^\n]*\n-+$|\Z)", docstring, re.M | re.S)
    lines = section[1].splitlines() if section else []
    heads = [line.partition(" : ")[0] for line in lines if line[:1].strip()]
    return {name.strip().replace("\\", "") for head in heads for name in head.split(",")}


def lacking(thing, *, bound):
    """What a public docstring leaves out, of a function with two arguments or more."""
    function = function_of(thing)
    if function is None or len(arguments := arguments_of(function, bound=bound)) < 2:
        return
    docstring = inspect.getdoc(thing) or ""
    named = names_under("Parameters", docstring)
    if strange := named - {*arguments}:
        yield f"documents no argument of its own: {', '.join(strange)}"
    if missing := [name for name in arguments if name not in named]:
        yield f"does not document {', '.join(missing)}"
    returns = inspect.signature(function).return_annotation
    if returns not in {"None", "NoReturn"} and not re.search(
        r"^(Returns|Yields)\n-+\n", docstring, re.M
    ):
        yield "has no section Returns"


def lacking_of_class(cls):
    """What the docstrings of a class and of its bases leave out of what makes an object of it."""
    if issubclass(cls, Warning | Exception):
        return
    try:
        arguments = [*inspect.signature(cls).parameters.values()]
    except ValueError:  # What is built in says none.
        return
    texts = [inspect.cleandoc(base.__doc__ or "") for base in cls.__mro__ if base is not object]
    named = {
        n for text in texts for h in ("Parameters", "Attributes") for n in names_under(h, text)
    }
    ordinary = {inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY}
    names = [each.name for each in arguments if each.kind in ordinary]
    if len(names) > 1 and (missing := [name for name in names if name not in named]):
        yield f"does not document {', '.join(missing)}"


def test_public_names_document_their_arguments_and_results():
    faults = []
    for name, thing in public_objects():
        if inspect.isclass(thing):
            faults += [f"{name} {fault}" for fault in lacking_of_class(thing)]
            continue
        bound = "." in name and not isinstance(thing, staticmethod)
        faults += [f"{name} {fault}" for fault in lacking(thing, bound=bound)]
    assert not faults, "\n".join(sorted(faults))
