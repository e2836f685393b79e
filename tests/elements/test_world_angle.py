"""Boundaries in space whose media or incidence are given when the path runs."""

import numpy as np
import pytest

import optipath as op
from optipath.elements.world_angle import world_angles
from tables import rows

P = op.Parameter
MEETS = op.plane_of_incidence((1, 0, -1), (0, 0, 1))


def refracted(n, side=-1.0):
    """Light at 45 degrees in front that is refracted into a medium, or reflected in it."""
    sine = np.sin(np.pi / 4) / n
    return op.Frame.from_direction((sine, 0, side * np.sqrt(1 - sine**2)), MEETS.arriving.x)


def lit(element, frames, leaves):
    path = op.PathGraph()
    enters = next(iter(frames))
    path.add("lamp", op.Source(), frames={"out": frames[enters]})
    path.add("glass", element, frames=frames)
    path.add("eye", op.Detector())
    path.connect("lamp.out", f"glass.{enters}")
    path.connect(f"glass.{leaves}", "eye")
    return path


def fault_of(path, **given):
    with pytest.raises(op.OptipathError) as error:
        path.trace(**given)
    (fault,) = error.value.faults
    return fault


THROUGH = {"in": MEETS.arriving, "transmitted": refracted(1.5)}
NOT_SO = [({"n": 1.5, "t": "10 deg"}, "3.35222291"), ({"n": 1.9, "t": "45 deg"}, "23.1510177")]


@rows("given, turned", NOT_SO)
def test_values_that_are_given_late_are_held_to_the_frames_as_constants_are(given, turned):
    path = lit(op.Interface(P("n"), P("t")), THROUGH, "transmitted")
    s, p = 0.0920134, 0.0920134**2  # Of 45 degrees from air to glass: R_p = R_s^2.
    assert path.trace(n=1.5, t="45 deg").intensity == pytest.approx(1 - (s + p) / 2, abs=1e-7)
    path.trace(n=np.float32([1.5, 1.5]), t=np.float32(np.pi / 4))
    words = f"is turned by 16.8744943 deg in the world, but by {turned} deg by Snell's law"
    late = fault_of(path, **given)
    assert words in late
    assert f"{given['t']} (parameter 't'), n = {given['n']} (parameter 'n')" in late
    assert words in fault_of(path.bind(**given))
    assert words in fault_of(path, n=np.array([1.5, given["n"]]), t=["45 deg", given["t"]])


def test_angles_are_compared_where_they_rest_on_what_is_known_alone():
    frames = {"in": MEETS.arriving, "reflected": MEETS.reflected}
    path = lit(op.Interface(P("n"), "10 deg"), frames, "reflected")
    with pytest.raises(op.PathError, match="incidence of 45 deg, but its incidence is 10 deg"):
        path.check()
    measured = op.Interface(P("n"), "30 deg", P("m"), incidence_in=P("m0"))
    path = lit(measured, frames, "reflected")
    path.trace(n=1.5, m=1.0, m0=np.sqrt(2))
    fault = fault_of(path, n=1.5, m=1.0, m0=1.5)
    words = "incidence of 45 deg, but its incidence is 48.5903779 deg (n = 1 (parameter 'm')"
    assert words in fault


def test_light_from_behind_is_held_to_the_frames_too():
    frames = {"back": refracted(1.5, 1.0), "transmitted": refracted(1.5)}
    path = lit(op.Interface(P("n"), "45 deg"), frames, "transmitted")
    path.trace(n=1.5)
    fault = fault_of(path, n=1.6)
    assert "meet at an incidence of 28.1255057 deg, but behind 'glass' it is 26.2278" in fault


def test_a_metal_refracts_as_planes_of_constant_phase_travel():
    # Born & Wolf, Principles of Optics, sec. 14.2: tan = n1 sin / Re sqrt(m^2 - (n1 sin)^2).
    metal = 1.2 + 2.5j
    g = np.sqrt(metal**2 - 0.5).real
    into = op.Frame.from_direction((np.sqrt(0.5), 0, -g), MEETS.arriving.x)
    frames = {"in": MEETS.arriving, "transmitted": into}
    path = lit(op.Interface(P("m"), "45 deg"), frames, "transmitted")
    path.trace(m=metal)
    fault = fault_of(path, m=0.2 + 3.4j)
    assert "by Snell's law (n = 0.2 (parameter 'm'), k = 3.4 (parameter 'm'))" in fault
    assert "by Snell's law (n = 1.2 (parameter 'm'))" in fault_of(path, m=1.2)


def test_jax_compares_as_numpy_does():
    jnp = pytest.importorskip("jax.numpy")
    (law,) = world_angles("glass", op.Interface(P("n"), P("t")), THROUGH)
    found, *_ = (operand.numbers() for operand in law.operands[:1])
    n = np.array([1.5, 1.9, np.nan])
    for xp in (np, jnp):
        numbers = [xp.asarray(x, dtype=np.float32) for x in (found, np.pi / 4, 1.0, 0.0, n, 0.0)]
        assert law.fits(xp, *numbers).tolist() == [True, False, True]
