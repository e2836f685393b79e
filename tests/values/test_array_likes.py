"""What a user may give as numbers, in every place that takes some, and how many."""

from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

import optipath as op
from optipath.values import arrays as memory
from optipath.values.arrays import same
from tables import rows

CORNER = [[0.0, 0.0, 3.0], [0.0, 0.0, 0.0], [0.0, 4.0, 0.0]]


class Made:
    """Numbers with more than numbers: names of axes, a row of a table, a unit."""

    def __init__(self, values, **more):
        self.values = np.asarray(values)
        vars(self).update(more)

    def __array__(self, dtype=None, copy=None):
        return self.values


def labelled(values):
    """As xarray has them."""
    return Made(values, dims=("x",), coords={})


class Raises:
    """Raises whatever is asked of it."""

    def __array__(self, dtype=None, copy=None):
        raise OSError("the file is gone")

    def _raise(self, *_):
        raise RuntimeError("no")

    __len__ = __iter__ = __getitem__ = __float__ = __index__ = __int__ = __bool__ = _raise
    __eq__ = __lt__ = __repr__ = __str__ = __neg__ = _raise
    __hash__ = None


def masked(values):
    array = np.ma.masked_array(np.asarray(values, float))
    array.mask = np.zeros(array.shape, bool)
    array.mask[..., -1:] = True
    return array


def endless():
    within = []
    within.extend([within, within])
    return within


class NoArray:
    def __array__(self, dtype=None, copy=None):
        raise RuntimeError("cannot be made an array")


class NoFloat:
    def __float__(self):
        raise ZeroDivisionError


MORE_THAN_NUMBERS = [
    *((masked, ".compressed()"), (lambda values: [np.ma.masked, values], ".compressed()")),
    (labelled, ".to_numpy()"),
    (lambda values: [labelled(values), labelled(values)], ".to_numpy()"),
    (lambda values: Made(values, index=range(2), to_numpy=True), ".to_numpy()"),
    (lambda values: Made(values, unit="deg"), "in radians or metres"),
    (lambda values: Made(values, units="degree"), "in radians or metres"),  # As astropy and pint.
]
MANY_AXES, UNEQUAL = np.full((1,) * 40, 0.5), [[0.5], [0.5, 0.5]]
NO_NUMBERS = [Raises(), [0.5, Raises()], np.array(["2020-01-01"], "M8[D]"), np.array([1], "m8[s]")]
NO_NUMBERS += [np.zeros(2, [("a", float)]), {0.5}, {"a": 0.5}, (x for x in [0.5]), Decimal("0.5")]
NO_NUMBERS += [Fraction(1, 2), complex(np.nan, 1.0), np.array([0.5, None]), b"0.5"]
NO_NUMBERS += [np.array([b"0.5"]), float, 10**5000, endless(), UNEQUAL, MANY_AXES]
WIDE = np.broadcast_to(np.float64(0.3), (10**12,))
HOSTILE = [endless(), UNEQUAL, NoArray(), [NoArray(), 1.0], NoFloat(), [NoFloat(), 1.0]]
HOSTILE += [range(10**15), WIDE, [WIDE]]


def path():
    glass = op.Interface(op.Parameter("m", 1.5), op.Parameter("theta", 0.1))
    turn = op.Rotator(op.Parameter("angle", 0.1))
    return op.Source(op.Parameter("intensity", 1.0)) >> glass >> turn >> op.Detector()


def linked(azimuth):
    graph = op.PathGraph()
    graph.add("lamp", op.Source())
    graph.add("eye", op.Detector())
    graph.connect("lamp.out", "eye.in", azimuth)
    return graph.trace()


def lit(**state):
    return (op.Source(**state) >> op.Detector()).trace()


def each(call, options):
    """A call with each of its options, by name."""
    return [lambda value, name=name: call(**{name: value}) for name in options.split()]


RUNS = "trace", "mueller", "paths"
OF_PLANS = "certificate", "evaluations"
SCALARS = {
    "a field": lambda v: op.Interface(1.5, v).mueller(),
    "an index": lambda v: op.Interface(v, 0.1).mueller(),
    "a material": lambda v: op.Interface(op.Material(v, 0.1), 0.1).mueller(),
    "an absorbing material": lambda v: op.Interface(op.Material(1.5, v), 0.1).mueller(),
    "a layer": lambda v: op.LayerStack([1.0, v, 1.5], 0.1).mueller(),
    "a length": lambda v: op.Medium(v, 0.1).mueller(),
    "an extinction": lambda v: op.Medium.from_extinction(1e-6, v, 500e-9).mueller(),
    "the azimuth of a link": linked,
    "an intensity": lambda v: lit(intensity=v),
    **{name: lambda v, name=name: getattr(path(), name)(theta=v) for name in RUNS},
    **{name: lambda v, name=name: getattr(path().compose(), name)(theta=v) for name in OF_PLANS},
    "trace of an index": lambda v: path().trace(m=v),
    "trace of an angle": lambda v: path().trace(angle=v),
    "trace on every link": lambda v: path().trace(keep="all", theta=v),
    "a stream": lambda v: list(path().compose().stream(10, theta=v)),
    "polarization": lambda v: op.polarization(path(), theta=v),
    "bind": lambda v: path().bind(theta=v).trace(),
    "a preset": lambda v: op.load_preset("malus", angle=v).trace(),
    "a default": lambda v: op.Parameter("a", v),
    "a limit": lambda v: op.Parameter("a", minimum=v),
    "a word": lambda v: op.Parameter("a", words={"up": v}),
    "a cosine": lambda v: op.CosSin(v, 0.5),
    "fresnel_reflection": lambda v: op.fresnel_reflection(v, 0.6, 0.8),
    "fresnel_transmission": lambda v: op.fresnel_transmission(1.5, v, v),
    "refraction_angle": lambda v: op.refraction_angle(1.5, v),
    "intensity_bounds": lambda v: op.intensity_bounds(v, [0.1]),
    "vertices_from_angles": lambda v: op.vertices_from_angles([v]),
    "a material of a chain": lambda v: op.path_from_vertices(CORNER, [v]),
    "a turn of a frame": lambda v: op.Frame().turned(v),
}
VECTORS = {
    "a state": (lambda v: lit(stokes=v), [1.0, 0.0, 0.0, 0.0]),
    "Light": (op.Light, [1.0, 0.0, 0.0, 0.0]),
    "Mueller": (op.Mueller, np.eye(4)),
    "MuellerElement": (lambda v: op.MuellerElement(v).mueller(), np.eye(4)),
    "Frame": (op.Frame, [1.0, 0.0, 0.0]),
    "from_direction": (lambda v: op.Frame.from_direction(v, [0, 1, 0]), [1.0, 0.0, 0.0]),
    "rotated": (lambda v: op.Frame().rotated(v), np.eye(3)),
    "plane_of_incidence": (lambda v: op.plane_of_incidence(v, [0, 0, 1]), [1.0, 0.0, -1.0]),
    "path_from_vertices": (lambda v: op.path_from_vertices(v, [1.5]), CORNER),
    "normals": (lambda v: op.path_from_vertices(CORNER, [1.5], v), [[0.0, 1.0, 1.0]]),
    "materials": (lambda v: op.path_from_vertices(CORNER, v), [1.5]),
    "indices of a stack": (lambda v: op.LayerStack(v, 0.1).mueller(), [1.0, 1.3, 1.5]),
    "incidences": (op.vertices_from_angles, [0.1]),
    "diattenuations": (lambda v: op.intensity_bounds(0.1, v), [0.1]),
}
PAIRS = ["an index", "a layer", "fresnel_reflection", "a material of a chain"]
"""Where a tuple of two may be the parts of one complex number."""
PLACES = {**{name: (use, [0.5, 0.25]) for name, use in SCALARS.items()}, **VECTORS}


@rows("place", PLACES)
def test_masks_labels_and_units_are_refused_with_the_cure(place):
    use, values = PLACES[place]
    for made, cure in MORE_THAN_NUMBERS:
        if place == "indices of a stack" and not isinstance(made(values), (list, np.ndarray)):
            continue  # A list of media is given, and nothing else.
        if place == "incidences" and isinstance(made(values), list):
            continue  # Two incidences ask for a turn first.
        with pytest.raises(op.OptipathError) as error:
            use(made(values))
        assert cure in str(error.value)


@rows("place", PLACES)
def test_whatever_is_no_number_is_refused_in_words(place):
    for value in NO_NUMBERS:
        if value is MANY_AXES and place == "a default":
            continue  # Told when the path is composed.
        if value is UNEQUAL and place in ("indices of a stack", "diattenuations"):
            continue  # Each is an array of its own.
        with pytest.raises(op.OptipathError) as error:
            PLACES[place][0](value)
        assert all(c.isprintable() or c == "\n" for c in str(error.value))


TAKEN = [np.ma.masked_array([0.5, 0.25]), np.array([0.5, 0.25]).view(np.recarray)]
TAKEN += [memoryview(np.array([0.5, 0.25])), (0.5, 0.25), [np.float32(0.5), 0.25]]
TAKEN += [np.array([0.5, 0.25], kind) for kind in (">f8", np.float16, np.longdouble)]


@rows("given", TAKEN)
def test_arrays_that_say_no_more_than_their_numbers_are_taken_for_them(given):
    for name, use in SCALARS.items():
        asked = isinstance(given, (tuple, list)) and name in PAIRS
        if name not in ("a limit", "a word", "a cosine", "fresnel_transmission") and not asked:
            use(given)
    assert np.array_equal(path().trace(theta=given).stokes, path().trace(theta=[0.5, 0.25]).stokes)
    assert op.Interface(1.5, given) == op.Interface(1.5, [0.5, 0.25])
    of_matrix = path().trace(theta=np.array([[0.5, 0.25]]).view(np.matrix))
    assert of_matrix.stokes.shape == (1, 2, 4)


def test_an_array_that_is_made_of_something_else_is_looked_at_once():
    class Changing:
        numbers = np.array([0.5, 0.25])

        def __array__(self, dtype=None, copy=None):
            return self.numbers

    element = op.Interface(1.5, Changing())
    before = element.mueller().matrix.copy()
    Changing.numbers[:] = 1.0
    assert np.array_equal(element.mueller().matrix, before)

    class Slow:
        def __array__(self, dtype=None, copy=None):
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        path().trace(theta=Slow())
    assert not same(Raises(), 0.5)
    assert not same((Raises(),), (0.5,))


MOST = np.longdouble("1e400")


@rows("endless", [range(10**12), range(2**62)])
def test_more_numbers_than_there_is_memory_for_are_refused_before_they_are_made(endless):
    for give in (
        lambda: path().trace(theta=endless),
        lambda: op.fresnel_reflection(1.5, endless, 0.8),
        lambda: op.Light(endless),
        lambda: op.Parameter("x", endless),
    ):
        with pytest.raises(op.OptipathError):
            give()


@pytest.mark.skipif(not np.isfinite(MOST), reason="longdouble is float64 here")
@rows("most", [MOST, -MOST])
def test_what_is_beyond_a_double_is_refused_in_a_sentence(most):
    slab, bound = op.load_preset("glass-slab"), op.load_preset("npgr026").bind
    for use in (
        lambda: slab.trace_all(length=most, absorption=np.zeros(3, "g")),
        *(lambda: bound(n2=most).trace_all(), lambda: bound(n2=np.array([most, 1])).trace_all()),
    ):
        with pytest.raises(op.OptipathError):
            use()
    for value in (most, [most], np.array([most])):
        with pytest.raises(op.OptipathError, match="give a finite"):
            op.Polarizer(value).mueller()


def test_a_number_of_jax_is_taken_wherever_a_number_is():
    jnp = pytest.importorskip("jax.numpy")
    number, malus = jnp.array(0.5), op.load_preset("malus")
    for given in (number, jnp.array([0.5, 0.75])[0]):
        assert malus.trace(angle=given) == malus.trace(angle=0.5)
    assert op.Polarizer(number) == op.Polarizer(0.5)
    assert op.Frame().turned(number) == op.Frame().turned(0.5)
    assert op.refraction_angle(number, 1.5) == op.refraction_angle(0.5, 1.5)
    with pytest.raises(op.OptipathError, match="n and k not negative"):
        op.Interface(jnp.array(1.5 - 0.5j), 0.3)


@rows(
    "given, cure",
    [
        (op.Light([1.0, 0.0, 1.0, 0.0]), r"is a Light, .* op\.Source\(stokes=light\.stokes\)"),
        (op.Mueller(np.eye(4)), r"is a Mueller, .* op\.MuellerElement\(mueller\.matrix\)"),
    ],
)
@rows("take", [op.Source, op.Polarizer, op.Frame().turned, op.Light, op.Mueller])
def test_light_and_matrices_with_frames_are_no_numbers(given, cure, take):
    with pytest.raises(op.OptipathError, match=cure):
        take(given)


TWO = [5e-7, 6e-7]


@rows(
    "take",
    [
        *(SCALARS[place] for place in ("an index", "a layer", "trace", "bind")),
        lambda value: op.Polarizer(value).mueller(),
        lambda value: op.load_preset("copper-gold-spectrum").trace(wavelength=value),
        lambda value: op.Material.tabulated(TWO, n=value),
        lambda value: op.Material.tabulated(value, n=[1.5, 1.6]),
        lambda value: op.Material.tabulated(TWO, n=[1.5, 1.6], k=value),
        lambda value: op.tabulated(TWO, value),
    ],
)
def test_what_is_no_array_is_refused_in_a_sentence_wherever_numbers_are_given(take):
    for value in HOSTILE:
        with pytest.raises(op.OptipathError):
            take(value)


NPGR026 = op.load_preset("npgr026")
ALONG = np.linspace(0.0, 1.5, 10**6)
ACROSS = ALONG[:, np.newaxis]
DARK = np.zeros((10**6, 4))
GOLD = {"n1": 0.18, "k1": 3.4, "n2": 0.18, "k2": 3.4}
MANY = GOLD | {"delta": ACROSS, "phi": ALONG}
SIX = {
    name: np.linspace(0.1, 1.4, 100).reshape(-1, *[1] * axis)
    for axis, name in enumerate(["delta", "rho", "phi", "n1", "k1", "n2"])
}
POINTS = np.tile(CORNER, (10**5, 1, 1, 1))


def plan(**options):
    return op.Composer(**options).compose(NPGR026)


def chain():
    angles = op.VerticesByAngles((op.Parameter("a"), op.Parameter("b")), (0.3,))
    return op.path_from_vertices(angles, [1.5, 1.5])


def of_fields():
    path = op.Source() >> op.Interface(1.5, ACROSS) >> op.Interface(1.5, ALONG)
    return path >> op.Detector()


def tiled(*values):
    return [np.tile(value, (10**6, *[1] * (1 + axis))) for axis, value in enumerate(values)]


@pytest.mark.parametrize("engine", ["numpy", "numba", "jax"])
def test_a_batch_too_large_for_the_machine_is_refused_with_the_cure(engine):
    pytest.importorskip(engine)
    of_engine = plan(engine=engine, dtype="float32") if engine == "jax" else plan(engine=engine)
    for values in (MANY, {"k2": 1.0} | SIX):
        cure = "give fewer values" if engine == "jax" else "plan.stream"
        for use in (of_engine.run, of_engine.run_all):
            with pytest.raises(op.errors.ParameterError, match=rf"1e\+12 paths, .* GB; .*{cure}"):
                use(**values)
        for use in (of_engine.mueller, of_engine.certificate, of_engine.paths):
            with pytest.raises(op.errors.ParameterError, match=r"1e\+12 paths, .* GB; give fewer"):
                use(**values)


@rows(
    "use",
    [
        *(lambda: plan(keep="all").run_all(**MANY), lambda: plan(tolerance=0.1).run(**MANY)),
        lambda: plan(dtype="longdouble").run(**MANY),
        *(lambda: next(plan().stream(10**12, **MANY)), lambda: op.polarization(NPGR026, **MANY)),
        *(lambda: of_fields().trace(), lambda: of_fields().mueller()),
        lambda: op.Interface(1.5 + ACROSS, ALONG).mueller(),
        lambda: chain().trace(a=ACROSS, b=ALONG),
        lambda: op.vertices_from_angles([ACROSS, ALONG], [0.1]),
        lambda: op.Light(np.ones((10**6, 1, 4)), physical=False).in_frame(op.Frame().turned(ALONG)),
        lambda: op.Light(DARK[:, np.newaxis]) + op.Light(DARK),
        lambda: op.Mueller(np.ones((10**5, 1, 4, 4))) @ op.Mueller(np.ones((10**5, 4, 4))),
        lambda: op.Frame(*tiled([0.0, 1.0, 0.0], [1.0, 0.0, 0.0]), [0.0, 0.0, -1.0]),
        lambda: op.Frame.from_direction(*tiled([0.0, 0.0, 1.0], [1.0, 0.0, 0.0])),
        lambda: op.plane_of_incidence(*tiled([0.0, 1.0, 1.0], [0.0, 0.0, 1.0])),
        lambda: op.CosSin(np.cos(ACROSS), np.sin(ALONG)),
        lambda: op.fresnel_reflection(1.5 + ACROSS, np.cos(ALONG), np.sin(ALONG)),
        lambda: op.refraction_angle(1.5 + ACROSS, ALONG),
        lambda: op.intensity_bounds(ACROSS / 2.0, [ALONG / 2.0]),
        lambda: op.path_from_vertices(POINTS, [1.5], np.tile([[0.0, 1.0, 1.0]], (10**5, 1, 1))),
    ],
)
def test_no_way_in_makes_what_does_not_fit(use):
    with pytest.raises(op.OptipathError, match=r"1e\+1\d paths, .* GB of memory or more, and this"):
        use()


def test_a_batch_too_large_is_taken_part_by_part_and_counted():
    part = next(plan().stream(1000, **MANY))
    expected = plan().run(**GOLD, delta=ACROSS[0], phi=ALONG[:1000])
    np.testing.assert_array_equal(part.light.stokes, expected.stokes)
    assert plan().evaluations(**MANY)["X1.reflected"] == 10**6
    assert "none, since a batch of 1e+12 paths" in of_fields().compose().explain()
    frame = next(chain().compose().stream(100, a=ACROSS, b=ALONG)).light.frame
    assert frame == chain().trace(a=ACROSS[0], b=ALONG[:100]).frame
    thousand = np.linspace(0.1, 1.4, 1000)
    values = {name: thousand.reshape(-1, *given.shape[1:]) for name, given in SIX.items()}
    with pytest.raises(op.errors.ParameterError, match=r"9e\+15 paths at most, not 1e\+18"):
        next(plan().stream(10, k2=1.0, **values))


def test_memory_is_asked_of_the_machine_and_told_where_it_does_not_tell_or_runs_out(monkeypatch):
    assert memory.memory() > 2**28
    told = pytest.raises(
        op.errors.ShapeError, match=r"a batch of 12 paths, of shape \(3, 4\), takes"
    )
    with told, memory.enough_for((3, 4), 32):
        raise MemoryError
    monkeypatch.delattr("os.sysconf")
    assert memory.memory() == 16 * 2**30
    with pytest.raises(op.errors.ParameterError, match=r"and this machine has 17.2 GB"):
        plan().run(**MANY)
    # Few paths of which much is kept.
    path = op.Source(op.Parameter("power"))
    for _ in range(300):
        path = path >> op.Attenuator(0.999)
    monkeypatch.setattr(memory, "memory", lambda: 2**27)
    with pytest.raises(op.errors.ParameterError, match=r"of shape \(8000,\), takes 0.2 GB"):
        op.Composer(keep="all").compose(path >> op.Detector()).run_all(power=np.ones(8000))


def test_a_batch_has_thirty_axes_at_most():
    for axes in (31, 64):
        many = np.full((1,) * axes, 0.1)
        for use in (plan().run, plan().mueller, plan().certificate, plan().paths):
            with pytest.raises(
                op.errors.ParameterError, match=f"delta has {axes} axes, .* 30 at most"
            ):
                use(**GOLD, delta=many)
        with pytest.raises(op.errors.PathError, match="30 at most"):
            op.Rotator(many).mueller()
    several = np.linspace(0.1, 0.2, 3).reshape((1,) * 29 + (3,))
    assert plan().run(**GOLD, delta=several).stokes.shape == (*several.shape, 4)
    assert plan().mueller(**GOLD, delta=several).matrix.shape == (*several.shape, 4, 4)
    found = plan(engine="numpy").run(**GOLD, delta=ACROSS[:300], phi=ALONG[:300])
    assert found.stokes.shape == (300, 300, 4)
