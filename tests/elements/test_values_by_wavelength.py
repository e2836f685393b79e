"""Every number that an element takes may follow from the wavelength of the run."""

import re
from dataclasses import replace

import numpy as np

import optipath as op
from dispersive import GRID, line, on_line
from optipath.elements.known_elements import STANDARD
from tables import rows

POINTS = np.array([[0, 0, 0], [0, 0, 2.0], [0.1, 0.2, 4], [0.5, -1.0, 2.2]])
GENERAL = op.Medium(
    0.1,
    9.0,
    2.0,
    7.0,
    0.3,
    0.2,
    dichroism=4.0,
    dichroic_angle=0.8,
    circular_dichroism=-3.0,
    depolarization=5.0,
)
TINTED = op.LayerStack(
    [1.0, op.Material(1.5, 1e-6), 1.7], 0.7, 0.2, lengths=[1e-3], wavelength=5e-7
)

ELEMENTS = [
    op.Attenuator(0.3),
    op.BeamSplitter(0.3, 0.2),
    op.CircularDiattenuator(0.8, 0.3),
    op.CircularPolarizer("left", 0.9, 0.1),
    op.Depolarizer(0.3),
    op.Diattenuator(0.8, 0.3, 0.4, 0.2),
    op.EllipticalRetarder(0.4, -0.7, 1.1, 0.2),
    op.FaradayRotator(0.4),
    op.FaradayRotator(verdet=-134.0, field=-0.2, length=0.02),
    op.Interface(1.5, 1.1, 1.2, 0.3),
    op.Interface(op.Material(3.0, 0.2), 1.1, 1.3),
    op.Interface(1.5, 1.1, op.Material(1.2, 0.01), incidence_in=1.0),
    op.LayerStack([1.0, 1.5, 1.7], 0.7),
    TINTED,
    GENERAL,
    replace(GENERAL, rotation=0.0, dextrorotation=2.0),
    op.Medium(0.1, 2.0),
    op.Medium(0.1, retardance=2.0),
    op.Medium(0.1, rotation=2.0),
    op.Mirror(-0.9, 0.8, 0.2),
    op.Polarizer(0.3, 0.2, 0.9, 0.2),
    op.PolarizingBeamSplitter(1000.0, 20.0, 0.2),
    op.RefractingVertex(1.5, POINTS, 1),
    op.Retarder(0.4, 0.3, 0.2),
    op.Rotator(0.3),
    op.Source(2.0),
    op.SpecularVertex(op.Material(0.2, 3.0), POINTS, 1),
    op.SpecularVertex(0.2, op.VerticesByAngles((0.3, 0.7), (0.4,)), 1),
    op.Vertex(op.Material(1.5, 0.0), POINTS, 1, 1.1, events=[0, 0]),
    op.Waveplate(1e-5, 0.009, 5.89e-7, 0.3, 0.2),
]

WITHOUT = {op.Combiner, op.Detector, op.Dump, op.MuellerElement}
"""Those that take no number, or several in one."""


def with_value(whole, place, value):
    """Put a value at a place such as ``indices[1].n`` of an element."""
    if not place:
        return value
    name, number, rest = re.fullmatch(r"\.?(\w*)(?:\[(\d+)\])?(.*)", place).groups()
    if not name:
        several = list(whole)
        several[int(number)] = with_value(several[int(number)], rest, value)
        return several
    inner = f"[{number}]{rest}" if number else rest
    return replace(whole, **{name: with_value(getattr(whole, name), inner, value)})


def places():
    for element in ELEMENTS:
        for name, value, domain in element.quantities():
            if isinstance(value, float) and value and not domain.tail:
                yield element, name, value, domain


def path_of(element, way):
    if isinstance(element, op.Source):
        return element >> op.Detector()
    path = op.PathGraph()
    path.add("lamp", op.Source(2.0, [1.0, 0.3, -0.4, 0.5]))
    path.add("it", element)
    path.add("eye", op.Detector())
    path.connect("lamp", f"it.{way.enters}")
    path.connect(f"it.{way.leaves}", "eye")
    return path


def ways(element):
    return element.couplings() or (None,)


def test_every_element_that_takes_a_number_is_looked_at():
    assert {type(element) for element in ELEMENTS} | WITHOUT == {*STANDARD}


@rows("element, name, value, domain", [*places()])
def test_light_is_that_of_the_numbers_at_each_wavelength(element, name, value, domain):
    # Some numbers may not grow, others may not shrink.
    last = next(v for v in (0.98 * value, 1.02 * value) if np.all(domain.allows(np.asarray(v))))
    dispersive = with_value(element, name, line(value, last))
    for way in ways(element):
        numbers = on_line(value, last, GRID)
        expected = [
            path_of(with_value(element, name, float(number)), way).trace().stokes
            for number in numbers
        ]
        path = path_of(dispersive, way)
        alone = [path.trace(wavelength=float(one)).stokes for one in GRID]
        np.testing.assert_allclose(alone, expected, rtol=1e-14, atol=4e-16)
        batch = op.Composer(engine="numpy").compose(path).run(wavelength=GRID).stokes
        np.testing.assert_allclose(batch, expected, rtol=1e-13, atol=1e-15)
