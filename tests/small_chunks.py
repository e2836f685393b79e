"""Measurements in chunks so small that many are walked in a moment, here and by workers."""

from importlib import import_module

from distributed import WorkerPlugin

CHUNK = 1 << 14
_HOME = "optipath.surfaces.hemisphere"
PLACES = [f"{_HOME}.{name}.CHUNK" for name in ("beam", "chunks", "measure")]


class SmallChunks(WorkerPlugin):
    """Workers walk them, those too that are started in the place of others."""

    def setup(self, worker):
        for place in PLACES:
            module, _, name = place.rpartition(".")
            setattr(import_module(module), name, CHUNK)
