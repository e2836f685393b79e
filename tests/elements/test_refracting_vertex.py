import numpy as np
import pytest

import optipath as op
from tables import rows

INTO_GLASS = [[0.0, -1.0, 1.0], [0.0, 0.0, 0.0], [0.0, 1.0, -np.sqrt(3.5)]]  # 45 degrees, 1.5
MIXED = [*INTO_GLASS, [0.0, 2.0, -np.sqrt(3.5) + 1.0]]
TURNED = [[0.0, 0.0, 1.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0]]


def path_of(*nodes):
    path, before = op.PathGraph(), None
    for name, element in nodes:
        node = path.add(name, element)
        if before is not None:
            before >> node
        before = node
    return path


@rows("method", ["stable", "compensated", "amplitude", "textbook"])
def test_a_vertex_lets_through_what_an_interface_at_its_angle_does(method):
    matrix = op.RefractingVertex(1.5, INTO_GLASS, place=1).mueller(method=method)
    expected = op.Interface(1.5, np.pi / 4).mueller("in", "transmitted", method=method)
    np.testing.assert_allclose(matrix.matrix, expected.matrix, rtol=0, atol=1e-15)
    np.testing.assert_allclose(matrix.frame_in.z, [0, np.sqrt(0.5), -np.sqrt(0.5)], rtol=1e-15)
    np.testing.assert_array_equal(matrix.frame_out.x, [1, 0, 0])


@rows("method", ["stable", "compensated", "amplitude", "textbook"])
def test_light_out_of_glass_is_that_into_it(method):
    back = op.RefractingVertex(1.0, INTO_GLASS[::-1], place=1, outside=1.5)
    angle = np.arcsin(np.sin(np.pi / 4) / 1.5)
    expected = op.Interface(1.0, angle, outside=1.5).mueller("in", "transmitted", method=method)
    np.testing.assert_allclose(
        back.mueller(method=method).matrix, expected.matrix, rtol=0, atol=1e-14
    )


def test_a_refraction_may_follow_a_reflection_and_go_before_one():
    path = path_of(
        ("lamp", op.Source()),
        ("filter", op.Polarizer(0.3)),
        ("top", op.RefractingVertex(op.Material(1.5), MIXED, 1)),
        ("bottom", op.SpecularVertex(0.2 + 3.4j, MIXED, 2, outside=op.FOLLOWS)),
        ("eye", op.Detector()),
    )
    light = path.trace()
    chain = op.path_from_vertices(MIXED, [1.5, 0.2 + 3.4j], events="TR")
    polarized = op.Polarizer(0.3).mueller().matrix[:, 0]
    np.testing.assert_allclose(light.stokes, chain.mueller().matrix @ polarized, rtol=1e-14)
    assert light.frame == chain.trace().frame


def test_a_medium_that_does_not_follow_is_told():
    path = path_of(
        ("lamp", op.Source()),
        ("top", op.RefractingVertex(1.5, MIXED, 1)),
        ("bottom", op.SpecularVertex(0.2 + 3.4j, MIXED, 2)),
        ("eye", op.Detector()),
    )
    with pytest.raises(op.PathError, match=r"lit from n = 1.5 behind 'top'.*outside is 1; give"):
        path.check()


@rows(
    "arguments, others, message",
    [
        ((1.5, TURNED, 1), {}, "by 90 deg at 'RefractingVertex', but .* turns it by 48.1896851"),
        ((1.5, INTO_GLASS, 2), {}, "place must be a whole number of 1 .. 1, not 2"),
        ((1.5, INTO_GLASS, 1), {"count": 0}, "count must be a whole number above 0, not 0"),
        ((1.5, op.Parameter("p"), 1), {}, "tell the number of vertices of the chain, count=..."),
        ((1.5 + 1j, INTO_GLASS, 1), {}, "index is complex; give a real index .* light goes on in"),
        (
            (op.Material(1.5, 1), INTO_GLASS, 1),
            {},
            "index.k is 1; give 0, since light goes on in there",
        ),
        ((1.5, op.VerticesByAngles((0.3,)), 1), {}, "are angles, which say reflections alone"),
    ],
)
def test_what_is_no_such_vertex_is_refused(arguments, others, message):
    with pytest.raises(op.ValueFault, match=message) as error:
        op.RefractingVertex(*arguments, **others)
    assert len(error.value.faults) == 1


def test_an_absorbing_medium_given_when_the_path_runs_is_refused():
    path = op.path_from_vertices(INTO_GLASS, [op.Parameter("n")], events="T")
    with pytest.raises(op.ParameterError, match="light goes on in"):
        path.trace(n=1.5 + 0.1j)


def test_vertices_that_do_not_follow_each_other_are_refused():
    first, other = op.RefractingVertex(1.5, MIXED, 1), op.SpecularVertex(2.0, TURNED, 1, 1.5)
    path = path_of(("lamp", op.Source()), ("a", first), ("b", other), ("eye", op.Detector()))
    with pytest.raises(op.PathError, match="must lead from a vertex to the next of one chain"):
        path.check()


def test_a_chain_that_refracts_is_explained_and_drawn():
    path = op.path_from_vertices(INTO_GLASS, [1.5], events="T")
    assert "Fresnel transmission (stable, lossless)" in path.compose().explain()
    assert "RefractingVertex" in str(path) or "refracting-vertex" in path.to_toml()
