"""Paths that several tests build."""

from itertools import count

import optipath as op


def chain(elements, state=(1.0, 0.0, 0.0, 0.0), **reading):
    """A path of elements one behind another, from a source of a state to one detector."""
    path = op.PathGraph()
    node = path.add("lamp", op.Source(stokes=state))
    for number, element in enumerate(elements):
        node = node >> path.add(f"e{number}", element)
    node >> path.add("eye", op.Detector(**reading))
    return path


def composable(made, first=0):
    """What is made of one seed after another, where its path can be composed: all of it is lit."""
    for seed in count(first):
        network = made(seed)
        try:
            network.path.check()
        except op.errors.PathError:
            continue
        yield network
