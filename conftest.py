"""Examples are run in every module but that of an engine whose extra is not installed."""

from importlib.util import find_spec

collect_ignore = [] if find_spec("jax") else ["src/optipath/engines/jax_engine.py"]
