"""Examples are run in every module but those of an engine whose extra is not installed."""

from importlib.util import find_spec

collect_ignore_glob = [] if find_spec("jax") else ["src/optipath/engines/jax_[!e]*.py"]
