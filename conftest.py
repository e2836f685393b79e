"""Examples are run in every module but those of an engine whose extra is not installed."""

from importlib.util import find_spec

OF_JAX = [
    "src/optipath/engines/jax_path.py",
    "src/optipath/sweeps/uncertainty/slopes_by_jax.py",
    "src/optipath/values/arrays/jax_primitives.py",
]

collect_ignore = [] if find_spec("jax") else OF_JAX
