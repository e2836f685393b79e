"""One path of plain floats: its first runs, step after step, and the later ones, compiled."""

import numpy as np
import pytest

import optipath as op
from paths import chain
from random_paths import Draw

EXTREME = (5e-324, 1e-310, 1e-150, 1e-20, 1.0, 1e20, 1e150)


def runs(path, values, times=5):
    """Return the light at every end, run by run, or the words in which a run is refused."""
    plan, found = op.Composer().compose(path), []
    for _ in range(times):
        try:
            found.append(dict(plan.run_all(**values)))
        except op.OptipathError as fault:
            found.append(str(fault))
    return found


def assert_alike(found):
    first, *others = found
    for other in others:
        assert type(other) is type(first), (first, other)
        if isinstance(first, str):
            assert other == first
            continue
        for end, light in first.items():
            power = other[end].exponent - light.exponent
            mantissa = np.ldexp(other[end].mantissa, power)
            size = max(abs(light.mantissa[0]), 5e-324)
            np.testing.assert_allclose(mantissa / size, light.mantissa / size, atol=1e-13)


@pytest.mark.parametrize("name", op.preset_names())
def test_the_later_runs_of_every_preset_are_the_first(name):
    assert_alike(runs(op.load_preset(name), {}))


@pytest.mark.parametrize("seed", range(40))
def test_the_later_runs_of_random_paths_with_several_detectors_are_the_first(seed):
    draw = Draw(seed)
    path = draw.path(loops=seed % 3 == 0)
    values = {n: v if np.ndim(v) == 0 else v.flat[0] for n, v in draw.values.items()}
    values = {n: v.item() if isinstance(v, np.generic) else v for n, v in values.items()}
    values = {name: value for name, value in values.items() if name in path.parameters}
    if any(light.stokes.ndim > 1 for light in path_lights(path, values)):
        return
    assert_alike(runs(path, values))


def path_lights(path, values):
    return op.Composer().compose(path).run_all(**values).values()


VALUE = op.Parameter("v")
ELEMENTS = {
    "reflection": op.Interface(VALUE, 0.7),
    "metal": op.Interface(op.Material(1.2, VALUE), 0.7),
    "outside": op.Interface(1.5, 0.7, outside=VALUE),
    "layer": op.LayerStack([1.0, VALUE, 1.5], 0.7),
    "medium": op.Medium(VALUE, 1e-3, rotation=2.0),
    "absorption": op.Medium(1e-3, VALUE, retardance=2.0, angle=0.3),
    "rotation": op.Medium(1e-3, 1.0, rotation=VALUE),
    "retardance": op.Retarder(VALUE, 0.4),
    "transmittance": op.Attenuator(VALUE),
    "leakage": op.Polarizer(0.4, leakage=VALUE),
    "amplitude": op.Mirror(VALUE, 0.5),
    "depolarization": op.Depolarizer(VALUE),
}


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize("value", EXTREME)
def test_the_later_runs_of_extreme_values_are_the_first(element, value):
    state = (1.0, 0.5, 0.3, 0.4)
    assert_alike(runs(chain([ELEMENTS[element]], state), {"v": value}))


@pytest.mark.parametrize("intensity", EXTREME)
def test_the_later_runs_of_any_intensity_are_the_first(intensity):
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(op.Parameter("v"), [1.0, 0.5, 0.3, 0.4]))
    lamp >> path.add("metal", op.Interface(0.2 + 3j, 0.7)) >> path.add("eye", op.Detector())
    assert_alike(runs(path, {"v": intensity}))
