"""Slabs and stacks by their loops, for tests."""

from itertools import pairwise

import optipath as op


def slab(n, theta, behind=1.0, state=None, medium=None):
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source(1.0, state))
    path.add("front", op.Interface(n, theta))
    path.add("back", op.Interface(behind, theta, outside=n, incidence_in=1.0))
    path.add("R", op.Detector())
    path.add("T", op.Detector())
    path.connect("lamp.out", "front.in")
    if medium is None:
        path.connect("front.transmitted", "back.in")
    else:
        path.add("down", medium)
        path.connect("front.transmitted", "down.in")
        path.connect("down.out", "back.in")
    path.connect("back.reflected", "front.back")
    path.connect("front.reflected", "R.in")
    path.connect("back.transmitted", "T.in")
    return path


def stack(*indices, theta, state=None):
    """Parallel faces between media, lit from the first; the light in each gap is read."""
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source(1.0, state))
    path.add("R", op.Detector())
    path.add("T", op.Detector())
    faces = [f"face{place}" for place in range(1, len(indices))]
    for face, index in zip(faces, indices[1:], strict=True):
        first = face == faces[0]
        incidence, outside = (theta, indices[0]) if first else (op.FOLLOWS, op.FOLLOWS)
        path.add(face, op.Interface(index, incidence, outside=outside))
    path.connect("lamp.out", "face1.in")
    path.connect("face1.reflected", "R.in")
    for before, face in pairwise(faces):
        path.add(f"{before}-{face}", op.Detector())
        path.connect(f"{before}.transmitted", f"{face}.in")
        path.connect(f"{face}.reflected", f"{before}.back")
        path.connect(f"{before}.transmitted", f"{before}-{face}.in", tap=True)
    path.connect(f"{faces[-1]}.transmitted", "T.in")
    return path
