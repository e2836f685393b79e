"""One cache of compiled code for all tests, and as many workers as help.

Examples are run in every module but those of an engine whose extra is not installed.
"""

import os
import shutil
import tempfile
from importlib.util import find_spec
from pathlib import Path

import pytest

OF_JAX = [
    "src/optipath/engines/jax_path.py",
    "src/optipath/values/jax_primitives.py",
]

# User code that is type-checked, and run by a test: not by every worker that looks for examples.
collect_ignore = ["tests/typing", *([] if find_spec("jax") else OF_JAX)]


def pytest_ignore_collect(collection_path: Path) -> bool | None:
    """Leave out what has no example: to load half of the library and find none takes seconds."""
    of_library = Path(__file__).parent / "src" in collection_path.parents
    if of_library and collection_path.suffix == ".py":
        return True if b">>> " not in collection_path.read_bytes() else None
    return None


def pytest_configure(config: pytest.Config) -> None:
    """Keep compiled code in a folder of these tests, which all workers share."""
    if not hasattr(config, "workerinput"):
        folder = tempfile.mkdtemp(prefix="optipath-tests-")
        config.add_cleanup(lambda: shutil.rmtree(folder, ignore_errors=True))
        os.environ["OPTIPATH_CACHE"] = os.path.join(folder, "cache")  # noqa: PTH118 - a text
        os.environ["JAX_COMPILATION_CACHE_DIR"] = os.path.join(folder, "jax")  # noqa: PTH118
        os.environ["JAX_PERSISTENT_CACHE_MIN_COMPILE_TIME_SECS"] = "0"
        os.environ.pop("OPTIPATH_PRESETS", None)
        # Many tests start a process, each of which would compile the text of the library anew.
        os.environ.pop("PYTHONDONTWRITEBYTECODE", None)


def pytest_xdist_auto_num_workers(config: pytest.Config) -> int | None:
    """Let benchmarks and tests asked for by name run in this process; None is for xdist to say."""
    alone = config.option.benchmark_only or any("::" in name for name in config.args)
    return 0 if alone else None
