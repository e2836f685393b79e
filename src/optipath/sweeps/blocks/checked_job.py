"""Whether a job says of itself what a store needs to know."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import JobError, shown
from optipath.values.whole_numbers import is_whole

if TYPE_CHECKING:
    from collections.abc import Iterator

    from optipath.sweeps.blocks.block_job import BlockJob


def check_job(job: BlockJob) -> None:
    """Refuse a job whose arrays cannot be kept.

    Parameters
    ----------
    job : BlockJob
        What is to be computed.

    Raises
    ------
    JobError
        With all faults.
    """
    faults = list(_faults(job))
    if faults:
        raise JobError(*faults)


def _faults(job: BlockJob) -> Iterator[str]:
    if not isinstance(job.identity, str):
        yield f"identity is {shown(job.identity)}; give a text that says all of what is computed"
    if not is_whole(job.blocks):
        yield f"blocks is {shown(job.blocks)}; give a whole number from 1"
    if not job.arrays:
        yield "arrays are none; give a KeptArray for each array that blocks fill"
    sizes = dict[str, int]()
    given: dict[str, Mapping[str, Any]] = {"array": job.arrays, "coordinate": job.coords}
    for what, several in given.items():
        for name, each in several.items():
            about = f"{what} {shown(name)}"
            if what == "array" and name in job.coords:
                yield f"{about} is called as a coordinate; give one of them another name"
            if not isinstance(name, str) or name == "blocks" or not name or {*name} & {*"./\\"}:
                yield (
                    f"{about} cannot be called so, and 'blocks' is what a store calls its record; "
                    f"give another name, without points and slashes"
                )
            faults = list(_array_faults(each) if what == "array" else _coord_faults(each))
            faults += _attrs_faults(each.attrs)
            yield from (f"{about} has {fault}" for fault in faults)
            shape = each.shape if what == "array" else np.shape(each.values)
            for dimension, size in () if faults else zip(each.dims, shape, strict=True):
                if sizes.setdefault(dimension, size) != size:
                    yield (
                        f"{about} has {size} along '{dimension}', where another one has "
                        f"{sizes[dimension]}; give one number, or another dimension"
                    )
    yield from (f"the job has {fault}" for fault in _attrs_faults(job.attrs))


def _array_faults(kept: Any) -> Iterator[str]:
    lengths = (len(kept.dims), len(kept.shape), len(kept.chunks))
    if len({*lengths}) != 1:
        yield (
            f"{lengths[0]} dims, a shape of {lengths[1]} and chunks of {lengths[2]}; give as many "
            f"of each"
        )
    for what, numbers in (("shape", kept.shape), ("chunks", kept.chunks)):
        if not all(map(is_whole, numbers)):
            yield f"{what} {shown(numbers)}; give whole numbers from 1"
    yield from _dims_faults(kept.dims)
    try:
        kind = np.dtype(kept.dtype).kind
    except TypeError:
        kind = ""
    if kind not in (*"biufcSU",):
        yield f"dtype {shown(kept.dtype)}; give one of numbers, such as 'float64'"


def _coord_faults(whole: Any) -> Iterator[str]:
    if not isinstance(whole.values, np.ndarray) or whole.values.dtype.kind not in "biufcSU":
        yield f"the values {shown(whole.values)}; give an array of numbers, or of words"
    elif whole.values.ndim != len(whole.dims):
        yield f"{len(whole.dims)} dims for values of shape {whole.values.shape}; give as many"
    yield from _dims_faults(whole.dims)


def _dims_faults(dims: Any) -> Iterator[str]:
    if isinstance(dims, str) or len({*dims}) != len(dims):
        yield f"dims {shown(dims)}; give a tuple of names, each once"


def _attrs_faults(attrs: Any) -> Iterator[str]:
    for name, value in attrs.items() if isinstance(attrs, Mapping) else [("attrs", attrs)]:
        try:
            json.dumps({name: value})
        except (TypeError, ValueError):
            yield f"the attribute {shown(name)} {shown(value)}; give what JSON can hold"
