"""Frames that elements are given in the world, against their angles."""

import numpy as np
import pytest

import optipath as op
from optipath.elements.boundary import world_angles
from tables import rows
from wired import read_back

P, START = op.Parameter, op.Frame()
SIDE = op.Frame.from_direction(z=(0, 1, 0), x=(1, 0, 0))
"""Behind a mirror at 45 degrees."""
NEARLY = op.Frame.from_direction(z=(0, np.sin(1.4e-3), np.cos(1.4e-3)), x=(1, 0, 0))
MET = op.plane_of_incidence((1, 0, -1), (0, 0, 1))


def refracted(n, side=-1.0):
    """Light at 45 degrees in front that is refracted into a medium, or reflected in it."""
    sine = np.sin(np.pi / 4) / n
    return op.Frame.from_direction((sine, 0, side * np.sqrt(1 - sine**2)), MET.arriving.x)


def lit(element, frames, leaves, behind=None):
    path = op.PathGraph()
    enters = next(iter(frames))
    path.add("lamp", op.Source(stokes=[1, 0.4, 0.3, 0.2]), {"out": frames[enters]})
    path.add("glass", element, frames=frames)
    path.add("eye", op.Detector(), {"in": behind} if behind else None)
    path.connect("lamp.out", f"glass.{enters}")
    path.connect(f"glass.{leaves}", "eye")
    return path


def fault_of(act, **given):
    with pytest.raises(op.OptipathError) as error:
        act(**given)
    (fault,) = error.value.faults
    return fault


@rows(
    "element, leaves, frame, message",
    [
        (op.Interface(1.5, np.pi / 4 + 1e-6), "reflected", SIDE, "it is 45.0000573 deg"),
        (op.Interface(1.5, P("t")), "reflected", SIDE, "of 45 deg; give that, not the parameter"),
        (op.Interface(1.5, P("t", 0.1, bound=True)), "reflected", SIDE, "is 5.72957795 deg"),
        (op.Interface(1.5, np.pi / 2), "reflected", NEARLY, "of 'glass' it is 90 deg"),
        (op.Interface(1.5, np.pi / 4), "reflected", SIDE.turned(1e-4), "must share one x"),
        (op.BeamSplitter(), "reflected", SIDE.turned(1e-4), "must share one x"),
        (op.BeamSplitter(), "transmitted", START.turned(0.1), "straight through"),
    ],
)
def test_frames_that_contradict_the_element_are_refused(element, leaves, frame, message):
    assert message in fault_of(lit(element, {"in": START, leaves: frame}, leaves).check)


def test_frames_that_agree_are_allowed_and_light_from_behind_is_held_to_them_too():
    for incidence in (np.pi / 4, [np.pi / 4, np.pi / 4]):
        frames = {"in": START, "reflected": SIDE}
        lit(op.Interface(1.5, incidence), frames, "reflected").check()
    lit(op.BeamSplitter(), {"in": START, "transmitted": START}, "transmitted").check()
    frames = {"back": refracted(1.5, 1.0), "transmitted": refracted(1.5)}
    path = lit(op.Interface(P("n"), "45 deg"), frames, "transmitted")
    path.trace(n=1.5)
    fault = fault_of(path.trace, n=1.6)
    assert "meet at an incidence of 28.1255057 deg, but by" in fault


def test_elements_stand_in_frames_of_single_precision(tmp_path):
    meets = op.plane_of_incidence([0.3, 0.2, -0.9], [0, 0, 1])
    inside = np.arcsin(meets.sin / 1.5)
    into = op.Frame.from_direction(
        np.sin(inside) * np.array([0.3, 0.2, 0]) / np.hypot(0.3, 0.2) - [0, 0, np.cos(inside)],
        meets.arriving.x,
    )
    frames = {"in": meets.arriving, "reflected": meets.reflected, "transmitted": into}
    single = {p: op.Frame(*map(np.float32, (f.x, f.y, f.z))) for p, f in frames.items()}
    both = {port: single[port] for port in ("in", "reflected")}
    glass, stack = op.Interface(1.5, meets.incidence), op.LayerStack([1, 1.5], meets.incidence)
    for element in (glass, op.Mirror(), op.BeamSplitter(), stack):
        path = lit(element, both, "reflected", meets.reflected)
        exact = element.mueller("in", "reflected").matrix @ [1, 0.4, 0.3, 0.2]
        for light in (path.trace(), read_back(path, tmp_path).trace()):
            np.testing.assert_allclose(light.stokes, exact, rtol=0, atol=2e-6)
    # Light refracted is placed by either pair of frames.
    glass = op.Interface(1.5, np.float32(meets.incidence))
    apart, both_angles = meets.incidence - inside, meets.incidence + inside
    s, p = (np.sin(apart) / np.sin(both_angles)) ** 2, (np.tan(apart) / np.tan(both_angles)) ** 2
    for kept in (both, {port: single[port] for port in ("in", "transmitted")}):
        light = lit(glass, kept, "transmitted", into).trace()
        assert light.intensity == pytest.approx(1 - 0.7 * s - 0.3 * p, rel=1e-6)


THROUGH = {"in": MET.arriving, "transmitted": refracted(1.5)}


@rows("n, t, turned", [(1.5, "10 deg", "3.35222291"), (1.9, "45 deg", "23.1510177")])
def test_values_that_are_given_late_are_held_to_the_frames_as_constants_are(n, t, turned):
    path = lit(op.Interface(P("n"), P("t")), THROUGH, "transmitted")
    s, p = 0.0920134, 0.0920134**2  # Of 45 degrees from air to glass: R_p = R_s^2.
    light = path.trace(n=1.5, t="45 deg")
    assert light.intensity == pytest.approx(1 - 0.7 * s - 0.3 * p, abs=1e-7)
    path.trace(n=np.float32([1.5, 1.5]), t=np.float32(np.pi / 4))
    words = f"turn light by 16.8744943 deg, but by {turned} deg by Snell's law"
    late = fault_of(path.trace, n=n, t=t)
    assert words in late
    assert f"{t} (parameter 't'), n = {n} (parameter 'n')" in late
    assert words in fault_of(path.bind(n=n, t=t).trace)
    assert words in fault_of(path.trace, n=np.array([1.5, n]), t=["45 deg", t])


def test_angles_are_compared_where_they_rest_on_what_is_known_alone():
    frames = {"in": MET.arriving, "reflected": MET.reflected}
    path = lit(op.Interface(P("n"), "10 deg"), frames, "reflected")
    assert "incidence of 45 deg, but by the values of 'glass' it is 10 deg" in fault_of(path.check)
    measured = op.Interface(P("n"), "30 deg", P("m"), incidence_in=P("m0"))
    path = lit(measured, frames, "reflected")
    path.trace(n=1.5, m=1.0, m0=np.sqrt(2))
    fault = fault_of(path.trace, n=1.5, m=1.0, m0=1.5)
    words = "by the values of 'glass' it is 48.5903779 deg (n = 1 (parameter 'm')"
    assert words in fault


def test_a_metal_refracts_as_planes_of_constant_phase_travel():
    # Born & Wolf, Principles of Optics, sec. 14.2: tan = n1 sin / Re sqrt(m^2 - (n1 sin)^2).
    metal = 1.2 + 2.5j
    g = np.sqrt(metal**2 - 0.5).real
    into = op.Frame.from_direction((np.sqrt(0.5), 0, -g), MET.arriving.x)
    frames = {"in": MET.arriving, "transmitted": into}
    path = lit(op.Interface(P("m"), "45 deg"), frames, "transmitted")
    path.trace(m=metal)
    fault = fault_of(path.trace, m=0.2 + 3.4j)
    assert "by Snell's law (n = 0.2 (parameter 'm'), k = 3.4 (parameter 'm'))" in fault
    assert "by Snell's law (n = 1.2 (parameter 'm'))" in fault_of(path.trace, m=1.2)


def test_jax_compares_as_numpy_does():
    jnp = pytest.importorskip("jax.numpy")
    (law,) = world_angles("glass", op.Interface(P("n"), P("t")), THROUGH)
    found = law.operands[0].numbers()
    n = np.array([1.5, 1.9, np.nan])
    for xp in (np, jnp):
        numbers = [xp.asarray(x, dtype=np.float32) for x in (found, np.pi / 4, 1.0, 0.0, n, 0.0)]
        assert law.fits(xp, *numbers).tolist() == [True, False, True]
