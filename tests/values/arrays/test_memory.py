"""What a batch takes is estimated before anything of it is made."""

import numpy as np
import pytest

import optipath as op
from optipath.values.arrays import memory
from tables import rows

NPGR026 = op.load_preset("npgr026")
ALONG = np.linspace(0.0, 1.5, 10**6)
ACROSS = ALONG[:, np.newaxis]
DARK = np.zeros((10**6, 4))
GOLD = {"n1": 0.18, "k1": 3.4, "n2": 0.18, "k2": 3.4}
WIDE = GOLD | {"delta": ACROSS, "phi": ALONG}
SIX = {
    name: np.linspace(0.1, 1.4, 100).reshape(-1, *[1] * axis)
    for axis, name in enumerate(["delta", "rho", "phi", "n1", "k1", "n2"])
}
CORNER = np.array([[0.0, 0.0, 3.0], [0.0, 0.0, 0.0], [0.0, 4.0, 0.0]])
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
    for values in (WIDE, {"k2": 1.0} | SIX):
        cure = "give fewer values" if engine == "jax" else "plan.stream"
        for use in (of_engine.run, of_engine.run_all):
            with pytest.raises(op.ParameterError, match=rf"1e\+12 paths, .* GB; .*{cure}"):
                use(**values)
        for use in (of_engine.mueller, of_engine.certificate, of_engine.paths):
            with pytest.raises(op.ParameterError, match=r"1e\+12 paths, .* GB; give fewer"):
                use(**values)


@rows(
    "use",
    [
        *(lambda: plan(keep="all").run_all(**WIDE), lambda: plan(tolerance=0.1).run(**WIDE)),
        lambda: plan(dtype="longdouble").run(**WIDE),
        *(lambda: next(plan().stream(10**12, **WIDE)), lambda: op.polarization(NPGR026, **WIDE)),
        *(lambda: of_fields().trace(), lambda: of_fields().mueller()),
        lambda: op.Interface(1.5 + ACROSS, ALONG).mueller(),
        lambda: chain().trace(a=ACROSS, b=ALONG),
        lambda: op.vertices_from_angles([ACROSS, ALONG], [0.1]),
        lambda: op.Light(np.ones((10**6, 1, 4)), exponent=np.zeros(10**6, int)),
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
    part = next(plan().stream(1000, **WIDE))
    expected = plan().run(**GOLD, delta=ACROSS[0], phi=ALONG[:1000])
    np.testing.assert_array_equal(part.light.stokes, expected.stokes)
    assert plan().evaluations(**WIDE)["X1.reflected"] == 10**6
    assert "none, since a batch of 1e+12 paths" in of_fields().compose().explain()
    frame = next(chain().compose().stream(100, a=ACROSS, b=ALONG)).light.frame
    assert frame == chain().trace(a=ACROSS[0], b=ALONG[:100]).frame
    thousand = np.linspace(0.1, 1.4, 1000)
    values = {name: thousand.reshape(-1, *given.shape[1:]) for name, given in SIX.items()}
    with pytest.raises(op.ParameterError, match=r"9e\+15 paths at most, not 1e\+18"):
        next(plan().stream(10, k2=1.0, **values))


def test_memory_is_asked_of_the_machine_and_told_where_it_does_not_tell_or_runs_out(monkeypatch):
    assert memory.memory() > 2**28
    told = pytest.raises(op.ShapeError, match=r"a batch of 12 paths, of shape \(3, 4\), takes")
    with told, memory.enough_for((3, 4), 32):
        raise MemoryError
    monkeypatch.delattr("os.sysconf")
    assert memory.memory() == 16 * 2**30
    with pytest.raises(op.ParameterError, match=r"and this machine has 17.2 GB"):
        plan().run(**WIDE)
    # Few paths of which much is kept.
    path = op.Source(op.Parameter("power"))
    for _ in range(300):
        path = path >> op.Attenuator(0.999)
    monkeypatch.setattr(memory, "memory", lambda: 2**27)
    with pytest.raises(op.ParameterError, match=r"of shape \(8000,\), takes 0.2 GB"):
        op.Composer(keep="all").compose(path >> op.Detector()).run_all(power=np.ones(8000))


def test_a_batch_has_thirty_axes_at_most():
    for axes in (31, 64):
        many = np.full((1,) * axes, 0.1)
        for use in (plan().run, plan().mueller, plan().certificate, plan().paths):
            with pytest.raises(op.ParameterError, match=f"delta has {axes} axes, .* 30 at most"):
                use(**GOLD, delta=many)
        with pytest.raises(op.PathError, match="30 at most"):
            op.Rotator(many).mueller()
    several = np.linspace(0.1, 0.2, 3).reshape((1,) * 29 + (3,))
    assert plan().run(**GOLD, delta=several).stokes.shape == (*several.shape, 4)
    assert plan().mueller(**GOLD, delta=several).matrix.shape == (*several.shape, 4, 4)
    found = plan(engine="numpy").run(**GOLD, delta=ACROSS[:300], phi=ALONG[:300])
    assert found.stokes.shape == (300, 300, 4)
