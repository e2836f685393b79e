"""The names of what is compiled: a hash of all that the machine code of a text depends on."""

from __future__ import annotations

import hashlib
import os
import platform
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from importlib.resources import files
from typing import Any

from optipath.errors import CacheError

CODE_SUFFIX = ".code"


def name_of_text(text: str) -> str:
    """Return what the names of all entries of a text begin with."""
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def name_of_code(text: str) -> str:
    """Return the name of the entry of a text, by all that its machine code depends on."""
    settings = sorted((k, v) for k, v in os.environ.items() if k.startswith("NUMBA_"))
    key = hashlib.sha256(repr((text, settings, _maker())).encode())
    return f"{name_of_text(text)}-{key.hexdigest()}{CODE_SUFFIX}"


@cache
def _maker() -> Any:
    """Return what makes code of a text: sources, versions, the processor."""
    import llvmlite.binding as llvm  # noqa: PLC0415 - an extra

    here = files("optipath.engines")
    sources = [(here / name).read_text("utf-8") for name in ("numba_helpers.py", "machine_code.py")]
    packages = [_version(name) for name in ("optipath", "numba", "llvmlite", "numpy")]
    try:
        features = llvm.get_host_cpu_features().flatten()
    except RuntimeError:  # LLVM does not know them of every processor
        features = ""
    processor = (llvm.get_process_triple(), llvm.get_host_cpu_name(), features)
    return sources, packages, platform.python_version(), processor


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        if package == "optipath":  # a folder of sources, which are in the key themselves
            return ""
        raise CacheError(f"the version of {package} is not known; install it with pip") from None
