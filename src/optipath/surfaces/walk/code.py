"""The photon walk as machine code, which is kept for the next process."""

from __future__ import annotations

import hashlib
from functools import cache, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from optipath.errors import SurfaceError
from optipath.extras import need

if TYPE_CHECKING:
    from collections.abc import Iterable

    from optipath.engines.machine_code import MachineCode


_KINDS = {
    "photon_block": (
        "*int64 *float64 *float64 *float64 *float64 *float64 int64 float64 float64 float64 "
        "*float64 int64 int64 int64 int64 *uint64 "
        "*float64 *float64 *float64 *float64 *float64 int64"
    ),
    "pixel_sums": "*int64 *float64 *float64 int64 int64 int64 int64 int64 *float64",
}
"""The types of arguments, as Numba names them; ``*`` before the type of an array's numbers."""

_SOURCES = "kernels", "engines", "surfaces/walk"
"""What the code is made of."""


@cache
def walk_code(name: str = "photon_block") -> MachineCode:
    """Return a function of the walk as compiled code, which lets other threads do their work."""
    need("photons on rough surfaces", "numba", "llvmlite")
    from optipath.engines.code_cache import CODE  # noqa: PLC0415 - beside it
    from optipath.engines.llvm_engine import is_forbidden  # noqa: PLC0415 - beside it

    if is_forbidden():
        raise SurfaceError(
            "NUMBA_DISABLE_JIT is set, and photons on rough surfaces are compiled; unset it"
        )
    text = f"{name}({_KINDS[name]}) of sources {digest_of(_SOURCES)}"
    return CODE.function(text, partial(_machine_code_of, name, _KINDS[name].split()))


def _machine_code_of(name: str, kinds: list[str], _: str) -> bytes:
    from numba import cfunc, types  # noqa: PLC0415 - not to load code

    from optipath.engines.machine_code import machine_code_of  # noqa: PLC0415 - an extra
    from optipath.surfaces.walk import compiled  # noqa: PLC0415 - an extra

    pointer: Any = types.CPointer  # type: ignore[attr-defined,unused-ignore] # as it has no types
    given = [pointer(getattr(types, k[1:])) if k[0] == "*" else getattr(types, k) for k in kinds]
    function = getattr(compiled, name).py_func
    made: Any = cfunc(types.int64(*given), error_model="numpy")(function)
    # What Numba calls from C reports errors to Python; the function in it gives a status.
    whole, _, wrapper = made.inspect_llvm().partition(f"define i64 @{made.native_name}(")
    whole += wrapper.partition("\n}\n")[2]
    llvm = {"int64": "i64", "float64": "double"}
    places = [f"{llvm.get(kind, 'ptr')} %a{place}" for place, kind in enumerate(kinds)]
    native = made.native_name.removeprefix("cfunc.")
    return machine_code_of(whole + _CALL.format(name=native, places=", ".join(places)))


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


def digest_of(rooms: Iterable[str]) -> str:
    """Return a hash of all sources in some folders of the library."""
    result, here = hashlib.sha256(), Path(__file__).parents[2]
    for room in rooms:
        for file in sorted(here.joinpath(room).rglob("*.py")):
            result.update(file.name.encode() + b"\0" + file.read_bytes())
    return result.hexdigest()
