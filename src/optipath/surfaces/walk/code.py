"""The photon walk as machine code, which is kept for the next process."""

from __future__ import annotations

import hashlib
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, Any

from optipath.errors import SurfaceError, need

if TYPE_CHECKING:
    from collections.abc import Iterable
    from importlib.resources.abc import Traversable

    from optipath.engines.machine_code import MachineCode


_TEXT = """\
from optipath.surfaces.walk.compiled import photon_block


def path(
    wholes: "*int64", numbers: "*float64", heights: "*float64", extremes: "*float64",
    media: "*float64", base: "*float64", layers: "int64",
    cos: "float64", sin: "float64", azimuth: "float64", source: "*float64",
    count: "int64", photons: "int64", most: "int64", wanted: "int64",
    state: "*uint64", starts: "*float64", lights: "*float64", sums: "*float64", record: "*float64",
    ends: "*float64", keeps: "int64",
):
    return photon_block(
        (wholes, numbers, heights, extremes), media, base, layers, (cos, sin, azimuth), source,
        count, photons, most, wanted, state, starts, lights, sums, record, ends, keeps
    )


# Of sources {digest}
"""
_PIXELS = """\
from optipath.surfaces.walk.compiled import pixel_sums


def path(
    places: "*int64", turns: "*float64", ends: "*float64", photons: "int64", lights: "int64",
    states: "int64", has_matrix: "int64", has_scalar: "int64", sums: "*float64",
):
    return pixel_sums(
        places, turns, ends, photons, lights, states, has_matrix, has_scalar, sums
    )


# Of sources {digest}
"""
_SOURCES = "kernels", "engines", "surfaces/walk"
"""What the code is made of."""


@cache
def walk_code() -> MachineCode:
    """Return `photon_block` as compiled code, which leaves other threads to do their work."""
    return _code_of(_TEXT)


@cache
def pixel_code() -> MachineCode:
    """Return `pixel_sums` as compiled code; raises what `walk_code` does."""
    return _code_of(_PIXELS)


def _code_of(text: str) -> MachineCode:
    """Return the code of a text."""
    need("photons on rough surfaces", "numba", "llvmlite")
    from optipath.engines.code_cache import CODE  # noqa: PLC0415 - beside it
    from optipath.engines.llvm_engine import is_forbidden  # noqa: PLC0415 - beside it

    if is_forbidden():
        raise SurfaceError(
            "NUMBA_DISABLE_JIT is set, and photons on rough surfaces are compiled; unset it"
        )
    return CODE.function(text.format(digest=_digest()), _machine_code_of)


def _machine_code_of(text: str) -> bytes:
    """Return the machine code of the function ``path`` of a Python text.

    Annotations are types as Numba names them; ``*`` before the type of an array's numbers.
    """
    from numba import cfunc, types  # noqa: PLC0415 - not to load code

    from optipath.engines.machine_code import machine_code_of  # noqa: PLC0415 - an extra

    space: dict[str, Any] = {"__name__": __name__}
    exec(compile(text, "<walk>", "exec", dont_inherit=True), space)  # noqa: S102 - our own
    kinds = list(space["path"].__annotations__.values())
    pointer: Any = types.CPointer  # type: ignore[attr-defined,unused-ignore] # as it has no types
    given = [pointer(getattr(types, k[1:])) if k[0] == "*" else getattr(types, k) for k in kinds]
    made: Any = cfunc(types.int64(*given), error_model="numpy")(space["path"])
    # What Numba calls from C reports errors to Python; the function in it gives a status.
    whole, _, wrapper = made.inspect_llvm().partition(f"define i64 @{made.native_name}(")
    whole += wrapper.partition("\n}\n")[2]
    llvm = {"int64": "i64", "float64": "double"}
    places = [f"{llvm.get(kind, 'ptr')} %a{place}" for place, kind in enumerate(kinds)]
    name = made.native_name.removeprefix("cfunc.")
    return machine_code_of(whole + _CALL.format(name=name, places=", ".join(places)))


_CALL = """
define i64 @path({places}) {{
  %result = alloca i64
  %raised = alloca ptr
  %status = call i32 @{name}(ptr %result, ptr %raised, {places})
  %value = load i64, ptr %result
  %good = icmp eq i32 %status, 0
  %told = select i1 %good, i64 %value, i64 -1
  ret i64 %told
}}
"""


def _digest() -> str:
    """Return a hash of all sources that the code is made of."""
    return digest_of(_SOURCES)


def digest_of(rooms: Iterable[str]) -> str:
    """Return a hash of all sources in some folders of the library."""
    result, here = hashlib.sha256(), files("optipath")
    for room in rooms:
        _add(result, here.joinpath(*room.split("/")))
    return result.hexdigest()


def _add(result: hashlib._Hash, folder: Traversable) -> None:
    for entry in sorted(folder.iterdir(), key=lambda each: each.name):
        if entry.is_dir() and entry.name != "__pycache__":
            _add(result, entry)
        elif entry.name.endswith(".py"):
            result.update(entry.name.encode() + b"\0" + entry.read_bytes())
