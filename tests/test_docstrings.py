"""Public docstrings name what is given and say what comes back, as numpydoc writes them.

A method without a docstring has that of the class which its own stands on, as `help` shows it.
"""

import ast
import re
from pathlib import Path

import optipath as op

SOURCE = Path(op.__file__).parent
LATER = set()
EXEMPT = {"property", "cached_property", "setter", "overload"}


def public_definitions(node, owners=()):
    """Every public function and class of a module, with the classes around it."""
    for child in node.body:
        if isinstance(child, ast.FunctionDef):
            del child.body[1:]  # Of which nothing but the docstring is read.
        if isinstance(child, ast.FunctionDef | ast.ClassDef) and not child.name.startswith("_"):
            yield child, owners
            if isinstance(child, ast.ClassDef):
                yield from public_definitions(child, (*owners, child))


def decorators_of(node):
    return {ast.unparse(d).split("(")[0].rpartition(".")[2] for d in node.decorator_list}


def bases_of(node):
    return {ast.unparse(base).split("[")[0].rpartition(".")[2] for base in node.bases}


def arguments_of(function, *, bound):
    """The names of what a function takes, beside the object or class that it belongs to."""
    a = function.args
    named = [arg.arg for arg in (*a.posonlyargs, *a.args)][int(bound) :]
    rest = [f"*{a.vararg.arg}"] if a.vararg else []
    named_rest = [f"**{a.kwarg.arg}"] if a.kwarg else []
    return [*named, *rest, *(arg.arg for arg in a.kwonlyargs), *named_rest]


def fields_of(node):
    """The names of what makes an object of a class."""
    for child in node.body:
        if isinstance(child, ast.FunctionDef) and child.name == "__init__":
            return arguments_of(child, bound=True)
    is_element = any(keyword.arg == "kind" for keyword in node.keywords)
    if not (is_element or "dataclass" in decorators_of(node) or "NamedTuple" in bases_of(node)):
        return []
    return [
        child.target.id
        for child in node.body
        if isinstance(child, ast.AnnAssign)
        and not child.target.id.startswith("_")
        and "ClassVar" not in ast.unparse(child.annotation)
        and "init=False" not in ast.unparse(child)
    ]


def names_under(heading, docstring):
    """The names that a section lists."""
    section = re.search(rf"^{heading}\n-+\n(.*?)(?=^\S[^\n]*\n-+$|\Z)", docstring, re.M | re.S)
    lines = section[1].splitlines() if section else []
    heads = [line.partition(" : ")[0] for line in lines if line[:1].strip()]
    return {name.strip().replace("\\", "") for head in heads for name in head.split(",")}


def lacking(node, owner):
    """What a docstring leaves unsaid of two or more arguments."""
    docstring = ast.get_docstring(node)
    if not docstring:
        yield "has no docstring, nor has what it stands on"
        return
    if isinstance(node, ast.ClassDef):
        given = fields_of(node)
    else:
        given = arguments_of(
            node, bound=owner is not None and "staticmethod" not in decorators_of(node)
        )
    if len(given) < 2:
        return
    named = names_under("Parameters", docstring)
    if strange := named - {*given}:
        yield f"says under Parameters what it does not take: {', '.join(strange)}"
    said = named | names_under("Attributes", docstring)
    if unsaid := [name for name in given if name not in said]:
        yield f"says nothing under Parameters of {', '.join(unsaid)}"
    returns = getattr(node, "returns", None)
    gives = returns and ast.unparse(returns) not in {"None", "NoReturn", "Iterator[None]"}
    if gives and not re.search(r"^(Returns|Yields)\n-+\n", docstring, re.M):
        yield "has no section Returns"


def is_told_above(name, owner, classes):
    """Tell whether a class that this one stands on documents a method of that name."""
    for base in (classes[base] for base in bases_of(owner) if base in classes):
        for child in base.body:
            if getattr(child, "name", None) == name and ast.get_docstring(child):
                return True
        if is_told_above(name, base, classes):
            return True
    return False


def test_public_docstrings_have_parameters_and_returns():
    found = [
        (file, *item)
        for file in SOURCE.rglob("*.py")
        for item in public_definitions(ast.parse(file.read_text("utf-8")))
    ]
    classes = {node.name: node for _, node, _ in found if isinstance(node, ast.ClassDef)}
    faults = []
    for file, node, owners in found:
        place = file.relative_to(SOURCE)
        owner = owners[-1] if owners else None
        inherits = (
            owner and not ast.get_docstring(node) and is_told_above(node.name, owner, classes)
        )
        if place.parts[0] in LATER or EXEMPT & decorators_of(node) or inherits:
            continue
        name = ".".join(part.name for part in (*owners, node))
        faults += [f"{place}:{node.lineno} {name} {fault}" for fault in lacking(node, owner)]
    assert not faults, "\n".join(["docstrings to complete:", *sorted(faults)])
