"""The engines that a plan may be composed for, by their names."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.engines.jax_engine import JaxEngine
from optipath.engines.numba_engine import NumbaEngine
from optipath.engines.numpy_engine import NumpyEngine

if TYPE_CHECKING:
    from optipath.engines.engine import Engine

REGISTRY: dict[str, Engine[Any, Any]] = {
    engine.name: engine for engine in (NumpyEngine(), NumbaEngine(), JaxEngine())
}
