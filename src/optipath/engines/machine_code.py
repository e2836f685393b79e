"""Machine code: a function in LLVM's language compiled, loaded, and freed when it is dropped."""

from __future__ import annotations

import ctypes
import json
import os
from functools import cache
from typing import Any

import llvmlite.binding as llvm

_TYPES = {"i64": ctypes.c_int64, "double": ctypes.c_double}
"""What is given by its value; all else is an array, which lives as long as the call."""


class _Array(ctypes.c_void_p):
    """Where the first number of an array is."""

    @classmethod
    def from_param(cls, array: Any) -> Any:
        try:
            return ctypes.byref(ctypes.c_char.from_buffer(array))
        except (TypeError, ValueError):  # The array is read-only, or empty.
            return ctypes.c_void_p(array.__array_interface__["data"][0])


@cache
def processor() -> tuple[str, str, str]:
    """Return the platform, and the name and the features of its processor."""
    try:
        features = llvm.get_host_cpu_features().flatten()
    except RuntimeError:  # LLVM does not know them of every processor
        features = ""
    return llvm.get_process_triple(), llvm.get_host_cpu_name(), features


def machine_code_of(text: str) -> bytes:
    """Return the machine code of the function ``path`` of a module, which returns an integer."""
    module, machine = optimized(text)
    path = module.get_function("path")
    kinds = [str(argument.type) for argument in path.arguments]
    needs = [f.name for f in module.functions if f.is_declaration and "llvm." not in f.name]
    header = json.dumps({"kinds": kinds, "needs": needs})
    return header.encode() + b"\n" + bytes(machine.emit_object(module))


def optimized(text: str) -> tuple[Any, Any]:
    """Return a module for this processor, its loops vectorized, and what writes its code."""
    _begin()
    _, cpu, features = processor()
    machine = llvm.Target.from_default_triple().create_target_machine(
        cpu=cpu, features=features, opt=3, jit=True
    )
    module = llvm.parse_assembly(text)
    module.triple, module.data_layout = machine.triple, str(machine.target_data)
    options = llvm.create_pipeline_tuning_options(speed_level=3)
    options.loop_vectorization = True
    builder = llvm.create_pass_builder(machine, options)
    builder.getModulePassManager().run(module, builder)
    return module, machine


class MachineCode:
    """A function in the memory of this process; its memory is free again when it is dropped."""

    def __init__(self, code: bytes) -> None:
        header, _, body = code.partition(b"\n")
        about = json.loads(header)
        _begin()
        for name in about["needs"]:
            _find(name)
        machine = llvm.Target.from_default_triple().create_target_machine(jit=True)
        self._engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), machine)
        self._engine.add_object_file(llvm.ObjectFileRef.from_data(body))
        self._engine.finalize_object()
        kinds: Any = [_TYPES.get(kind, _Array) for kind in about["kinds"]]
        address = self._engine.get_function_address("path")
        self._function = ctypes.CFUNCTYPE(ctypes.c_int64, *kinds)(address)

    def __call__(self, *arguments: Any) -> int:
        """Return the integer that the function gives for numbers and arrays; it fails below 0."""
        result: int = self._function(*arguments)
        if result < 0:
            raise RuntimeError("compiled code has failed")
        return result


def _find(name: str) -> None:
    """Tell LLVM where a function of C's is that compiled code calls."""
    try:
        function = getattr(ctypes.CDLL(None if os.name == "posix" else "ucrtbase"), name)
    except (AttributeError, OSError):
        raise RuntimeError(f"compiled code calls '{name}', which there is not") from None
    llvm.add_symbol(name, ctypes.cast(function, ctypes.c_void_p).value)


@cache
def _begin() -> None:
    """Make LLVM ready for this processor."""
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
