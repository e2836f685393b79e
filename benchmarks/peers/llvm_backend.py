"""Dr.Jit's LLVM backend on one thread; where LLVM is missing, using it would end the process."""

import drjit

if not drjit.has_backend(drjit.JitBackend.LLVM):
    raise ImportError("Dr.Jit finds no LLVM; DRJIT_LIBLLVM_PATH may name its shared library")
drjit.set_thread_count(1)
