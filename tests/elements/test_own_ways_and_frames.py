"""The ways through elements of a user's own, and how these stand in space."""

from typing import ClassVar

import numpy as np
import pytest

import optipath as op
from chains import ENGINES
from paths import chain
from tables import rows, slow_except
from wired import wired


def operations(share):
    return op.Attenuator(share).couplings()[0].operations


class Splits(op.Element):
    """Lets out a share at either side."""

    a: op.fields.Fraction = 0.5
    b: op.fields.Fraction = 0.5
    outputs = ("a", "b")
    natural = "a"

    def couplings(self):
        return [op.Coupling("in", port, operations(getattr(self, port))) for port in "ab"]


def both(a, b):
    nodes = {"lamp": op.Source(), "splits": Splits(a, b), "A": op.Detector(), "B": op.Detector()}
    return wired(nodes, "lamp -> splits, splits.a -> A, splits.b -> B")


def test_all_that_ways_from_one_port_let_out_is_no_more_than_what_comes_in():
    assert sum(light.S0 for light in both(0.75, 0.25).trace_all().values()) == 1.0
    told = r"'splits' .* up to 1\.8 times .* comes in at 'in', at 'a' and 'b' together"
    with pytest.raises(op.errors.PathError, match=told):
        both(0.9, 0.9).check()
    with pytest.raises(op.errors.ParameterError, match=rf"^at share = 0\.9: {told}"):
        both(op.Parameter("share"), 0.9).trace_all(share=[0.1, 0.9])
    with pytest.raises(op.errors.PathError, match=r"up to 1\.8 times"):
        Splits(0.9, 0.9).mueller("in", "a")


DIMS = op.Attenuator(0.5).couplings()[0].operations[0].kernel


def doing(kernel, values):
    return [op.Coupling("in", "out", (op.Operation(kernel, values),))]


@rows(
    "couplings, told",
    [
        (doing(3, (0.5,)), "gives 3; return a tuple of"),
        (doing(DIMS, 0.5), r"gives 0\.5; return a tuple of"),
        (doing(DIMS, (0.5, 0.5)), r"\(0\.5, 0\.5\); give as many .*, \(transmittance\)"),
        (doing(DIMS, op.Operation(DIMS, ()).results(1)), r"the values \(\); give as many as it"),
        (doing(DIMS, ("half",)), "kernel 'attenuator' 'half', which is no number"),
        (doing(DIMS, (op.Parameter("f", 0.5),)), "parameter 'f', which is in no field; give it"),
        ([op.Coupling("in", "out", operations(0.1))] * 2, "from 'in' to 'out' more than once"),
        ([op.Coupling("inn", "out", operations(0.1))], "lead from 'inn'; its inputs are 'in'"),
        ([op.Coupling("in", "oot", operations(0.1))], "lead to 'oot'; its outputs are 'out'"),
        ([op.Coupling("in", "out", 3)], "gives 3; return a tuple of"),
        ([op.Coupling("in", "out", (op.Attenuator(0.5),))], "gives Attenuator"),
    ],
)
def test_ways_and_operations_that_cannot_be_are_told_with_the_class(couplings, told):
    own = type("Own", (op.Element,), {"couplings": lambda _: couplings})
    for act in (chain([own()]).check, chain([own()]).trace, own().mueller):
        with pytest.raises(
            op.errors.PathError, match=rf"^couplings\(\) of element class Own .*{told}"
        ):
            act()


class Parts(op.Element):
    """Parts light between two sides, and polarises it at the second."""

    share: op.fields.Fraction
    outputs = ("a", "b")
    natural = "b"

    def couplings(self):
        polarizer = op.Polarizer(2 * self.share + 0.1).couplings()[0].operations
        return (
            op.Coupling("in", "a", operations(self.share)),
            op.Coupling("in", "b", (*operations(1 - self.share), *polarizer)),
        )


@pytest.mark.parametrize("engine", slow_except(["numpy", "jax"], ENGINES))
def test_couplings_compute_with_fields_that_are_given_when_a_path_runs(engine):
    path = op.Source() >> Parts(op.Parameter("f", 0.9)) >> op.Detector()
    plan = op.Composer(engine=engine).compose(path)
    shares = np.array([0.0, 0.3, 0.8, 1.0])
    angle = 2.0 * (2.0 * shares + 0.1)
    stokes = np.array([np.ones(4), np.cos(angle), np.sin(angle), np.zeros(4)]).T
    expected = 0.5 * (1.0 - shares)[:, None] * stokes
    np.testing.assert_allclose(plan.run(f=shares).stokes, expected, atol=1e-15)
    for _ in range(4):
        one_by_one = [plan.run(f=share).stokes for share in shares.tolist()]
        np.testing.assert_allclose(one_by_one, expected, atol=1e-15)
    np.testing.assert_allclose(plan.mueller(f=shares).matrix[:, 0, 0], expected[:, 0], atol=1e-15)


@rows(
    "body, told",
    [
        (
            {"inputs": ("x",), "mueller_rows": staticmethod(lambda _: np.eye(4))},
            r"its inputs are 'x'.*mueller_rows lead from 'in' to",
        ),
        ({"couplings": lambda _: ()}, "carries no light: Own gives none"),
    ],
)
def test_ports_of_other_names_and_without_light_are_told(body, told):
    with pytest.raises(op.errors.PathError, match=told):
        (op.Source() >> type("Own", (op.Element,), body)() >> op.Detector()).check()


def test_shares_in_float32_may_make_up_the_whole_to_their_rounding():
    path = both(op.Parameter("first"), op.Parameter("second"))
    for first, second in np.float32([[1 / 3, 2 / 3], [0.01, 0.99], [0.6, 0.4]]):
        both(first, second).check()
        for dtype in ("float64", "float32"):
            plan = op.Composer(dtype=dtype).compose(path)
            for times in (1, np.ones(3, np.float32)):
                lights = plan.run_all(first=first * times, second=second * times)
                np.testing.assert_allclose(sum(light.S0 for light in lights.values()), 1.0, 1e-7)
        with pytest.raises(op.errors.PathError, match=r"up to 1\.0001\d* times"):
            both(first, second + np.float32(1e-4)).check()


class AnyMatrix(op.Element):
    matrix: op.fields.MuellerMatrix

    @staticmethod
    def mueller_rows(xp, *numbers):
        return [numbers[start : start + 4] for start in (0, 4, 8, 12)]


class Lamp(op.Element):
    state: op.fields.StokesState
    inputs = ()

    def couplings(self):
        source = op.Source(stokes=self.state)
        return (op.Coupling(None, "out", source.couplings()[0].operations),)


def test_own_elements_and_sources_take_what_those_of_the_library_take_in_float32():
    rng = np.random.default_rng(6)
    for a, b in rng.uniform(0.0, 3.0, (12, 2)):
        matrix = (op.Polarizer(a) @ op.Retarder(b, angle=2.0 * a)).matrix.astype(np.float32)
        op.MuellerElement(matrix)
        chain([AnyMatrix(matrix)]).check()
        chain([AnyMatrix(op.Parameter("m"))]).trace(m=matrix)
        with pytest.raises(op.errors.PathError, match=r"makes light up to .* times as bright"):
            chain([AnyMatrix(2.0 * matrix)]).check()
    lamp = Lamp(op.Parameter("state")) >> op.Detector()
    for direction in rng.normal(size=(12, 3)):
        pure = np.float32([1.0, *direction / np.linalg.norm(direction)])
        (op.Source(stokes=pure) >> op.Detector()).check()
        (Lamp(pure) >> op.Detector()).check()
        lamp.trace(state=pure)
        with pytest.raises(op.OptipathError, match="more than 100 %"):
            lamp.trace(state=pure * np.float32([1.0, 1.1, 1.1, 1.1]))


class Times(op.Element):
    a: op.fields.Real = 1.0

    @staticmethod
    def mueller_rows(xp, a):
        return [[xp.sqrt(a) * (row == column) for column in range(4)] for row in range(4)]


class TimesAnything(Times):
    physical = False


def test_later_runs_are_looked_at():
    plan = chain([Times(op.Parameter("a"))]).compose()
    assert plan.run(a=1.0).S0 == 1.0
    with pytest.raises(op.errors.ParameterError, match="or the rows of 'e0' are not finite there"):
        plan.run(a=-1.0)


@rows("engine", ENGINES)
def test_a_default_stands_in_nobodys_way_where_another_value_is_given(engine):
    plan = op.Composer(engine=engine).compose(chain([Times(op.Parameter("a", 4.0))]))
    for _ in range(6):
        assert plan.run(a=0.25).S0 == 0.5
    for _ in range(6):
        with pytest.raises(op.errors.ParameterError, match=r"^at a = 4: .*2 times as bright"):
            plan.run()


@rows("element_class", [Times, TimesAnything])
def test_rows_that_are_not_finite_are_told_with_their_element(element_class):
    told = r"\(element class Times.*\) has the Mueller matrix \(nan.*not finite; keep divisors"
    with pytest.raises(op.errors.PathError, match=told):
        chain([element_class(-1.0)]).check()
    path = chain([element_class(op.Parameter("a"))])
    for value in (-1.0, [1.0, -1.0]):
        with pytest.raises(op.errors.ParameterError, match=f"^at a = -1: .*{told}"):
            path.trace(a=value)


CHAIN = ((0, 0, 0), (0, 0, 3), (0, 2, 4), (1, 3, 5), (2, 0, 0))
FIRST, SECOND, THIRD = (op.SpecularVertex(1.5, CHAIN, place) for place in (1, 2, 3))


class Mute(op.Element):
    """Has the frame of the second vertex, and does not say how it stands to others."""

    outputs: ClassVar[tuple[str, ...]] = ("reflected",)
    natural: ClassVar[str] = "reflected"
    straight: ClassVar[bool] = False
    self_placed: ClassVar[bool] = True

    def couplings(self):
        return SECOND.couplings()

    def own_frame(self, port):
        return SECOND.own_frame(port)


class Foil(Mute):
    """Reflects as glass does, at the second vertex of the chain."""

    vertices, place = SECOND.vertices, SECOND.place

    def turn_from(self, before):
        return SECOND.turn_from(before)

    def fault_behind(self, before):
        return "" if getattr(before, "place", 0) == 1 else "must come from the first vertex"


def path(*elements):
    """Light along elements, with a turned polariser behind them."""
    return chain([*elements, op.Polarizer(0.3, azimuth=0.2)])


@rows("model", ["auto", "full"])
def test_an_element_of_ones_own_is_placed_among_vertices_as_a_vertex_is(model):
    composer = op.Composer(model=model)
    wanted = composer.compose(path(FIRST, SECOND, THIRD)).run()
    found = composer.compose(path(FIRST, Foil(), THIRD)).run()
    np.testing.assert_array_equal(found.stokes, wanted.stokes)
    for axis in "xyz":
        np.testing.assert_array_equal(getattr(found.frame, axis), getattr(wanted.frame, axis))
    lights = path(Foil()).trace(keep="all")
    for link, port in (("lamp.out -> e0.in", "in"), ("e0.reflected -> e1.in", "reflected")):
        np.testing.assert_array_equal(lights[link].frame.z, Foil().own_frame(port).frame({}).z)


@rows(
    "elements, sentence",
    [
        ((THIRD, Foil()), r"'e0.reflected -> e1.in' must come from the first ver"),
        ((FIRST, Mute()), r"Mute does not say .* give it a method turn_from"),
        ((FIRST, op.Rotator(0.1), Foil()), "'e1' stands relatively between the vertices 'e0' and"),
    ],
)
def test_what_does_not_follow_a_vertex_is_refused(elements, sentence):
    with pytest.raises(op.errors.PathError, match=sentence):
        path(*elements).compose()
