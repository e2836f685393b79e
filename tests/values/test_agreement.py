"""What is said where numbers of two boundaries do not fit: the path, and a cure that works."""

import re

import numpy as np
import pytest

import optipath as op
from tables import rows

P = op.Parameter


def two_faces(front, back):
    path = op.PathGraph()
    path.add("lamp", op.Source()) >> path.add("front", front)
    path["front.transmitted"] >> path.add("back", back)
    path["back.transmitted"] >> path.add("eye", op.Detector())
    return path


def fault_of(path, **given):
    with pytest.raises(op.OptipathError) as error:
        path.trace(**given)
    (fault,) = error.value.faults
    return fault


def test_one_bad_path_of_many_is_told_with_its_place():
    back = op.Interface(1.0, 0.1, outside=P("o"), parallel=False)
    path = two_faces(op.Interface(P("n"), 0.3), back)
    n = np.linspace(1.4, 1.8, 100_000)
    o = n.copy()
    o[[4711, 9999]] = 1.2
    assert fault_of(path, n=n, o=o).endswith("(at 4711, of 100000 paths)")
    grid = np.broadcast_to(n[:100, None], (100, 300)).copy()
    grid[7, 30] = 1.2
    assert fault_of(path, n=n[:100, None], o=grid).endswith("(at (7, 30), of 30000 paths)")
    assert fault_of(path.bind(n=n, o=o)).endswith("(at 4711, of 100000 paths)")
    assert not fault_of(path, n=1.5, o=1.2).endswith("paths)")


def test_no_number_of_one_path_is_offered_to_many():
    path = two_faces(op.Interface(P("n"), 0.3), op.Interface(1.0, P("t"), outside=P("o")))
    given = {"n": 1.5, "o": 1.5, "t": np.arcsin(np.sin(0.3) / 1.5)}
    assert "give o = 1.5, or op.FOLLOWS" in fault_of(path, **given | {"o": np.array([1.5, 1.6])})
    several = fault_of(path, **given | {"n": np.array([1.4, 1.5]), "o": np.array([1.5, 1.5])})
    assert "give op.FOLLOWS for outside (at 0" in several
    late = fault_of(path, **given | {"t": [0.1, 0.2]})
    assert f"an incidence of {np.degrees(given['t']):.10g} deg in n = 1.5" in late
    n = np.array([1.5, 1.6])
    several = fault_of(path, **given | {"n": n, "o": n})
    assert "give 'back' an incidence of op.FOLLOWS (" in several


@rows(
    "parameter, given, words",
    [
        (P("x", minimum=0.1), [0.5, 0.05], "is 0.05 at 1, outside its range; give 0.1 or more"),
        (P("x"), [[0.5], [2.0]], r"is 2 at \(1, 0\); give a real fraction"),
        (P("x"), [0.5, np.nan], "is nan at 1; give a finite"),
        (P("x"), 2.0, "is 2; give a real fraction"),
    ],
)
def test_what_is_not_allowed_is_told_with_its_place(parameter, given, words):
    path = op.Source() >> op.Attenuator(parameter) >> op.Detector()
    with pytest.raises(op.OptipathError, match=words):
        path.trace(x=np.array(given))
    with pytest.raises(op.ValueFault, match=r"index is \(1.5-1j\) at 1; give"):
        op.Interface(np.array([1.5, 1.5 - 1j]), 0.3)


@rows("angle", [89.97722848292891, 89.9999999, 40.0, 1e-9])
@rows("n, outside", [(1.561013496050288, 1.290977624), (1.4, 1.4 + 1e-13)])
def test_the_cure_of_an_angle_passes_as_it_is_written(angle, n, outside):
    front = op.Interface(n, f"{angle} deg", outside=outside)

    def back(incidence, before=None):
        face = op.Interface(1.0, incidence, outside=n, incidence_in=before)
        return two_faces(front, face)

    fault = fault_of(back(0.3))
    cures = re.findall(r"([0-9.e-]+ deg) (in n|with incidence_in) = ([0-9.]+)[ ,]", fault)
    offered = [cure for cure in cures if f"({cure[0]}" not in fault]
    assert offered
    for incidence, how, index in offered:
        back(incidence, None if how == "in n" else float(index)).check()
    if (angle, n) == (89.97722848292891, 1.561013496050288):
        # Figures that differ differ as they are printed.
        here, there = re.findall(r"([0-9.]+) at '", fault_of(back("55.79305157 deg")))
        assert here != there
