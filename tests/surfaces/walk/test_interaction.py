"""What compiled code does with light at facets is what the library's kernels do, bit for bit."""

import math

import pytest

import optipath as op

pytest.importorskip("numba")

from optipath.kernels.carriers.carried import carry
from optipath.kernels.carriers.structures import BLOCK, ROTATION
from optipath.kernels.fresnel.stable import (
    lossless_reflection,
    lossless_transmission,
    stable_reflection,
)
from optipath.kernels.geometry.facet import (
    plane_at_facet,
    reflected_at_facet,
    refracted_at_facet,
)
from optipath.kernels.numbers.primitives import FLOAT
from optipath.surfaces.walk import walk_layout as layout
from optipath.surfaces.walk.given_beam import given_beam

ELLIPTICAL = (1.0, 0.3, -0.4, 0.5)
BREWSTER, CRITICAL = math.atan(1.5), math.asin(1 / 1.5)


def vector(record, place):
    return tuple(record[place : place + 3].tolist())


def after_events(record, base):
    """The light of a photon, its direction and x, by kernels of plain floats."""
    light, k, x = carry(FLOAT, ELLIPTICAL), *(vector(record[0], at) for at in (2, 5))
    for event in record[1 : 1 + int(record[0, layout.EVENTS])].tolist():
        normal = tuple(event[layout.NORMAL : layout.NORMAL + 3])
        n1, n2 = event[layout.N1], event[layout.N2]
        cos, sin, x, *turn = plane_at_facet(FLOAT)(k, x, normal)
        assert [cos, sin, *turn] == event[layout.COS : layout.COS + 4]
        numbers, k, share = met(n1, n2, base, cos, sin, k, normal, event)
        light = ROTATION.made_for(FLOAT)(turn, light, 4)
        light = BLOCK.made_for(FLOAT)([1.0 / share * each for each in numbers], light, 4)
    return light, k, x


def met(n1, n2, base, cos, sin, k, normal, event):
    """The numbers of the Mueller matrix of an event, the direction behind, and the share."""
    ahead = reflected_at_facet(k, normal, cos)
    if n2 == layout.OPAQUE:
        return stable_reflection(FLOAT)(n1, *base, cos, sin), ahead, 1.0
    if event[layout.REFLECTED]:
        numbers = lossless_reflection(FLOAT)(n1, n2, cos, sin)
    else:
        numbers = lossless_transmission(FLOAT)(n1, n2, cos, sin)
        ahead = refracted_at_facet(FLOAT)(n1, n2, k, normal, cos, sin)
    share = 0.5 * (numbers[0] + numbers[1])
    assert share == event[layout.SHARE]
    return numbers, ahead, share


def expect_kernels(sample, incidence, photons):
    beam = given_beam(sample, incidence, 0.3, stokes=ELLIPTICAL)
    base = beam.indices.n.item(), beam.indices.k.item()
    ends = set()
    for number in range(photons):
        walked = beam.block(0, wanted=number)
        light, k, x = after_events(walked.record, base)
        assert walked.lights[0, :4].tolist() == list(light)
        assert vector(walked.record[0], layout.LAST_K) == k
        assert vector(walked.record[0], layout.LAST_X) == x
        ends.add(walked.record[0, layout.OUTCOME])
    return ends


@pytest.mark.parametrize("incidence", [0.0, 1e-9, 0.7, BREWSTER, 1.5, math.pi / 2 - 1e-9])
@pytest.mark.parametrize(
    "sample",
    [
        op.Sample([(1.5, 0)]),
        op.Sample([(1.5, 0), (2.4, 0)]),
        op.Sample([(1.5, 0), (0.2 + 3.4j, 0)]),
        op.Sample([(1j, 0)]),
    ],
)
def test_flat_interfaces(sample, incidence):
    expect_kernels(sample, incidence, 20)


@pytest.mark.parametrize("apart", [-0.3, -1e-8, 0.0, 1e-8, 0.3])
def test_about_the_critical_angle(apart):
    ends = expect_kernels(op.Sample([(1.0, 0)], outside=1.5), CRITICAL + apart, 50)
    assert apart <= 0.0 or layout.DOWN not in ends


@pytest.mark.filterwarnings("ignore::optipath.MeshWarning")
@pytest.mark.parametrize(
    "layers",
    [
        [(1.5, 1.0)],
        [(1.5, 0.3), (2.4, (0.2, 0.5)), (1.3, 0.6)],
        [(1.5, 0.5), (0.5 + 2.1j, 0.7)],
        [(1.5, 0.5), (1j, 0.7)],
    ],
)
def test_rough_interfaces(layers):
    expect_kernels(op.Sample(layers, cells=160, surfaces=1), 1.0, 40)
