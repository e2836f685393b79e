"""A slab by its loop, for tests."""

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
