"""Frames that elements are given in the world, against their angles."""

import numpy as np
import pytest

import optipath as op
from optipath.elements.world_angle import world_angles
from tables import rows

START = op.Frame()

SIDE = op.Frame.from_direction(z=(0, 1, 0), x=(1, 0, 0))
"""Behind a mirror at 45 degrees."""


def faults_of(element, frames, leaves):
    path = op.PathGraph()
    path.add("lamp", op.Source(), {"out": START})
    path.add("element", element, {"in": START, **frames})
    path.add("eye", op.Detector())
    path.connect("lamp.out", "element.in")
    path.connect(f"element.{leaves}", "eye.in")
    try:
        path.check()
    except op.PathError as error:
        return " | ".join(error.faults)
    return ""


@rows("incidence", [np.pi / 4, [np.pi / 4, np.pi / 4]])
def test_an_incidence_that_agrees_with_the_frames_is_allowed(incidence):
    assert faults_of(op.Interface(1.5, incidence), {"reflected": SIDE}, "reflected") == ""


@rows(
    "incidence, message",
    [
        (np.pi / 4 + 1e-6, "incidence of 45 deg, but its incidence is 45.0000573 deg"),
        (op.Parameter("t"), "incidence of 45 deg; give that, not the parameter 't'"),
        (op.Parameter("t", 0.1, bound=True), "but its incidence is 5.72957795 deg"),
    ],
)
def test_an_incidence_that_the_frames_contradict_is_refused(incidence, message):
    assert message in faults_of(op.Interface(1.5, incidence), {"reflected": SIDE}, "reflected")


@rows("element", [op.Interface(1.5, np.pi / 4), op.BeamSplitter()])
@rows("turn", [1e-4, 0.5])
def test_reflected_light_keeps_its_x(element, turn):
    found = faults_of(element, {"reflected": SIDE.turned(turn)}, "reflected")
    assert "must share one x" in found


def test_light_from_behind_and_through_a_splitter_is_held_to_the_frames_too():
    found = faults_of(op.BeamSplitter(), {"transmitted": START.turned(0.1)}, "transmitted")
    assert "straight through" in found
    assert faults_of(op.BeamSplitter(), {"transmitted": START}, "transmitted") == ""
    frames = {"back": refracted(1.5, 1.0), "transmitted": refracted(1.5)}
    path = lit(op.Interface(P("n"), "45 deg"), frames, "transmitted")
    path.trace(n=1.5)
    fault = fault_of(path, n=1.6)
    assert "meet at an incidence of 28.1255057 deg, but behind 'glass' it is 26.2278" in fault
    nearly = op.Frame.from_direction(z=(0, np.sin(1.4e-3), np.cos(1.4e-3)), x=(1, 0, 0))
    found = faults_of(op.Interface(1.5, np.pi / 2), {"reflected": nearly}, "reflected")
    assert "but its incidence is 90 deg" in found


MEETS = op.plane_of_incidence([0.3, 0.2, -0.9], [0, 0, 1])

INSIDE = np.arcsin(MEETS.sin / 1.5)


def rounded(frame):
    return op.Frame(*map(np.float32, (frame.x, frame.y, frame.z)))


@pytest.mark.parametrize(
    "element",
    [
        op.Interface(1.5, MEETS.incidence),
        op.Mirror(),
        op.BeamSplitter(),
        op.LayerStack([1, 1.5], MEETS.incidence),
    ],
)
def test_elements_that_reflect_stand_in_frames_of_single_precision(element, tmp_path):
    arriving, reflected = MEETS.arriving, MEETS.reflected
    path = op.PathGraph()
    path.add("lamp", op.Source(stokes=[1, 0.4, 0.3, 0.2]), {"out": arriving})
    path.add("element", element, {"in": rounded(arriving), "reflected": rounded(reflected)})
    path.add("eye", op.Detector(), {"in": reflected})
    path.connect("lamp", "element")
    path.connect("element.reflected", "eye")
    exact = element.mueller("in", "reflected").matrix @ [1, 0.4, 0.3, 0.2]
    file = tmp_path / "path.toml"
    file.write_text(path.to_toml())
    for light in (path.trace(), op.load_preset(file).trace()):
        np.testing.assert_allclose(light.stokes, exact, rtol=0, atol=2e-6)


def test_light_refracted_between_frames_of_single_precision_is_placed_by_them():
    into = op.Frame.from_direction(
        np.sin(INSIDE) * np.array([0.3, 0.2, 0]) / np.hypot(0.3, 0.2) - [0, 0, np.cos(INSIDE)],
        MEETS.arriving.x,
    )
    for kept in (["in", "reflected"], ["in", "transmitted"]):
        frames = {"in": MEETS.arriving, "reflected": MEETS.reflected, "transmitted": into}
        path = op.PathGraph()
        path.add("lamp", op.Source(), {"out": MEETS.arriving})
        glass = op.Interface(1.5, np.float32(MEETS.incidence))
        path.add("glass", glass, {port: rounded(frames[port]) for port in kept})
        path.add("eye", op.Detector(), {"in": into})
        path.connect("lamp", "glass")
        path.connect("glass.transmitted", "eye")
        s = (np.sin(MEETS.incidence - INSIDE) / np.sin(MEETS.incidence + INSIDE)) ** 2
        p = (np.tan(MEETS.incidence - INSIDE) / np.tan(MEETS.incidence + INSIDE)) ** 2
        assert path.trace().intensity == pytest.approx(1 - (s + p) / 2, rel=1e-6)


P = op.Parameter

MET = op.plane_of_incidence((1, 0, -1), (0, 0, 1))


def refracted(n, side=-1.0):
    """Light at 45 degrees in front that is refracted into a medium, or reflected in it."""
    sine = np.sin(np.pi / 4) / n
    return op.Frame.from_direction((sine, 0, side * np.sqrt(1 - sine**2)), MET.arriving.x)


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


THROUGH = {"in": MET.arriving, "transmitted": refracted(1.5)}

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
    frames = {"in": MET.arriving, "reflected": MET.reflected}
    path = lit(op.Interface(P("n"), "10 deg"), frames, "reflected")
    with pytest.raises(op.PathError, match="incidence of 45 deg, but its incidence is 10 deg"):
        path.check()
    measured = op.Interface(P("n"), "30 deg", P("m"), incidence_in=P("m0"))
    path = lit(measured, frames, "reflected")
    path.trace(n=1.5, m=1.0, m0=np.sqrt(2))
    fault = fault_of(path, n=1.5, m=1.0, m0=1.5)
    words = "incidence of 45 deg, but its incidence is 48.5903779 deg (n = 1 (parameter 'm')"
    assert words in fault


def test_a_metal_refracts_as_planes_of_constant_phase_travel():
    # Born & Wolf, Principles of Optics, sec. 14.2: tan = n1 sin / Re sqrt(m^2 - (n1 sin)^2).
    metal = 1.2 + 2.5j
    g = np.sqrt(metal**2 - 0.5).real
    into = op.Frame.from_direction((np.sqrt(0.5), 0, -g), MET.arriving.x)
    frames = {"in": MET.arriving, "transmitted": into}
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
