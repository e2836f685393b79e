"""Benchmarks stand by themselves: what they import is the library, packages, and each other."""

import ast
import sys
from pathlib import Path

BENCHMARKS = Path(__file__).parents[1] / "benchmarks"
FILES = sorted(BENCHMARKS.rglob("*.py"))


def imports_of(file):
    for node in ast.walk(ast.parse(file.read_text("utf-8"))):
        if isinstance(node, ast.ImportFrom):
            yield node.module or ""
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)


def test_benchmarks_import_nothing_from_tests():
    tests = {file.stem for file in Path(__file__).parent.rglob("*.py")} - {"conftest"}
    there = {*sys.stdlib_module_names, *(file.stem for file in FILES)}
    strange = {
        f"{file.relative_to(BENCHMARKS)} imports {name}"
        for file in FILES
        for name in imports_of(file)
        if {*name.split(".")} & (tests - there | {"tests"})
    }
    assert len(FILES) > 15
    assert not strange
    assert not [file.name for file in FILES if '"tests"' in file.read_text("utf-8")]
