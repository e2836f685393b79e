"""Every contender runs on one thread; to be imported before anything that starts threads."""

import os

for _library in ("OPENBLAS", "OMP", "MKL", "NUMBA"):
    os.environ[f"{_library}_NUM_THREADS"] = "1"
os.environ.setdefault("XLA_FLAGS", "--xla_cpu_multi_thread_eigen=false")
if hasattr(os, "sched_setaffinity"):
    # XLA has threads of its own whatever its flags say; one core leaves no use for them.
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
