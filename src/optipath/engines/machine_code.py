"""Machine code: a text compiled by Numba, loaded by LLVM alone, and freed when it is dropped."""

from __future__ import annotations

import ctypes
import json
from copy import copy
from functools import cache
from importlib import import_module
from typing import Any

import llvmlite
import llvmlite.binding as llvm

_PLAIN = {"int64": ctypes.c_int64, "float64": ctypes.c_double}
"""What is given by its value; all else is an array, which lives as long as the call."""


class _Array(ctypes.c_void_p):
    """Where the first number of an array is."""

    @classmethod
    def from_param(cls, array: Any) -> Any:
        try:
            return ctypes.byref(ctypes.c_char.from_buffer(array))
        except (TypeError, ValueError):  # The array is read-only, or empty.
            return ctypes.c_void_p(array.__array_interface__["data"][0])


def compiled(text: str) -> bytes:
    """Return the machine code of the function ``path`` of a text.

    Annotations are the types as Numba names them; ``*`` before the type of an array's numbers.
    """
    library, name, kinds = _library(text)
    module = llvm.parse_assembly(library.get_llvm_str())
    needs = [f.name for f in module.functions if f.is_declaration and "llvm." not in f.name]
    header = json.dumps({"name": name, "kinds": kinds, "needs": needs})
    return header.encode() + b"\n" + bytes(library.emit_native_object())


def assembly(text: str) -> str:
    """Return what `compiled` makes of a text, to be read by people."""
    result: str = _library(text)[0].get_asm_str()
    return result


def _library(text: str) -> tuple[Any, str, list[str]]:
    """Return the code of a text as Numba has it, the name of its function, and its types."""
    from numba.core import compiler, registry, types  # noqa: PLC0415 - not to load code
    from numba.core.compiler_lock import global_compiler_lock  # noqa: PLC0415

    space: dict[str, Any] = {"__name__": __name__}
    exec(compile(text, "<formula>", "exec", dont_inherit=True), space)  # noqa: S102 - our own
    path = space["path"]
    kinds = list(path.__annotations__.values())
    flags: Any = compiler.Flags()
    flags.error_model = "numpy"
    # Nothing is written where something is read, which spares the loops looking.
    flags.noalias = True
    flags.no_compile = flags.no_cpython_wrapper = flags.no_cfunc_wrapper = True
    pointer: Any = types.CPointer  # type: ignore[attr-defined,unused-ignore] # as it has no types
    arguments = tuple(
        pointer(getattr(types, kind[1:])) if kind[0] == "*" else getattr(types, kind)
        for kind in kinds
    )
    with global_compiler_lock:
        target = registry.cpu_target
        context = target.target_context.subtarget(_internal_codegen=_codegen()("optipath"))
        made = compiler.compile_extra(
            _typing(target.typing_context), context, path, arguments, types.int64, flags, {}
        )
        made.library.finalize()
    return made.library, made.fndesc.llvm_func_name, kinds


def _typing(context: Any) -> Any:
    """Return a typing context that looks up an operation on the same types once: half the time."""
    result, known = copy(context), {}

    def resolved(function: Any, argument: Any, named: Any) -> Any:
        key = function, argument, *named.items()
        if key not in known:
            known[key] = context.resolve_function_type(function, argument, named)
        return known[key]

    result.resolve_function_type = resolved
    return result


@cache
def _codegen() -> Any:
    """Return a generator of code for this processor, apart from Numba's, which never frees it."""
    from numba.core import codegen  # noqa: PLC0415 - not to load code

    class Codegen(codegen.JITCPUCodegen):  # type: ignore[misc] # numba has no types
        _library_class = codegen.AOTCodeLibrary

        def _add_module(self, module: Any) -> None:
            del module

    return Codegen


class MachineCode:
    """A function in the memory of this process; its memory is free again when it is dropped."""

    def __init__(self, code: bytes) -> None:
        header, _, body = code.partition(b"\n")
        about = json.loads(header)
        _begin()
        if not all(map(llvm.address_of_symbol, about["needs"])):
            # Some functions are known to LLVM once Numba has begun.
            _ = import_module("numba.core.registry").cpu_target.target_context
        for name in about["needs"]:
            if not llvm.address_of_symbol(name):
                raise RuntimeError(f"compiled code calls '{name}', which there is not")
        machine = llvm.Target.from_default_triple().create_target_machine(jit=True)
        self._engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), machine)
        self._engine.add_object_file(llvm.ObjectFileRef.from_data(body))
        self._engine.finalize_object()
        self._room = ctypes.c_void_p()
        self._raised = ctypes.addressof(self._room)
        kinds: Any = (_PLAIN.get(kind, _Array) for kind in about["kinds"])
        # As Numba calls functions: first where the result goes, and what would be raised.
        self._function = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_void_p, ctypes.c_void_p, *kinds)(
            self._engine.get_function_address(about["name"])
        )

    def __call__(self, *arguments: Any) -> int:
        """Return the integer that the function gives for numbers and arrays."""
        result = ctypes.c_int64()
        if self._function(ctypes.addressof(result), self._raised, *arguments):
            raise RuntimeError("compiled code has failed")
        return result.value


@cache
def _begin() -> None:
    """Make LLVM ready for this processor."""
    if tuple(map(int, llvmlite.__version__.split(".")[:2])) < (0, 45):
        llvm.initialize()
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
