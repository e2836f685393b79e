"""Chains of light that is reflected and refracted, traced as rays; and a reference without frames.

The reference is the 3 x 3 coherency matrix <E E^+> of the field in the world, which each surface
takes to M J M^+, with M = r_s s s^T + r_p p_out p_in^T, or t with the factor of the power flux.
"""

from itertools import pairwise

import mpmath
import numpy as np

LONG = np.longdouble


def random_histories(seed, events, count, *, steepest=1.3):
    """Points of chains traced from random directions over random surfaces; normals, materials.

    No angle to a normal is more than the steepest, in front or behind.
    """
    rng = np.random.default_rng(seed)
    k, here = _units(rng.normal(size=(count, 3))), rng.normal(size=(count, 3))
    medium = np.ones(count)
    points, normals, materials = [here], [], []
    for event in events:
        here = here + rng.uniform(0.5, 2.0, (count, 1)) * k
        across = _units(np.cross(k, rng.normal(size=(count, 3))))
        n = rng.choice([1.0, 1.2, 1.33, 1.5, 1.77, 2.42], count)
        ratio = np.minimum(n / medium, 1.0) if event == "T" else 1.0
        angle = np.arcsin(np.sin(steepest) * ratio) * rng.uniform(0.0, 1.0, count)
        c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
        normal = s * across - c * k
        if event == "R":
            k = k + 2.0 * c * normal
            # Light reflected at the critical angle has an infinite slope.
            critical = np.abs(np.sin(angle) * medium - n - 0.1) < 0.02
            n = (
                n
                + np.where(critical, 0.2, 0.1)
                + 1j * rng.uniform(0.0, 3.0, count) * (rng.random(count) < 0.5)
            )
        else:
            r = (medium / n)[:, None]
            k = r * k + (r * c - np.sqrt(1.0 - (r * s) ** 2)) * normal
            medium = n
        k = _units(k)
        points.append(here)
        normals.append(normal)
        materials.append(n)
    points.append(here + rng.uniform(0.5, 2.0, (count, 1)) * k)
    return np.stack(points, 1), np.stack(normals, 1), materials


def random_history(seed):
    """One such chain of 1 to 8 events: points, materials, events."""
    rng = np.random.default_rng(seed)
    events = "".join(rng.choice(["R", "T"], rng.integers(1, 9)))
    points, _, materials = random_histories(seed, events, 1)
    return points[0], [n[0] for n in materials], events


def coherency(points, events, materials, outside=1.0, axes=None):
    """The coherency matrix of light of S0 = 1 behind chains, (..., 3, 3), in extended precision.

    On some legs, by number, is a polarizer that passes what is along an axis of the world.
    """
    axes = axes or {}
    legs = np.diff(np.asarray(points, LONG), axis=-2)
    legs = _units(legs)
    medium = np.asarray(outside, LONG)
    first = legs[..., 0, :]
    light = (0.5 * (np.eye(3) - first[..., :, None] * first[..., None, :])).astype(np.clongdouble)
    light = _passed(light, first, axes.get(0))
    for place, (event, material) in enumerate(zip(events, materials, strict=True)):
        before, behind = legs[..., place, :], legs[..., place + 1, :]
        n = np.asarray(material, np.clongdouble)
        front, back = (1.0, 1.0) if event == "R" else (medium, n.real)
        normal = np.asarray(back)[..., None] * behind - np.asarray(front)[..., None] * before
        s = _units(np.cross(normal, before))
        normal = _units(normal)
        cos = np.abs(np.sum(normal * before, -1))
        along = medium * cos
        beyond = np.sqrt((n - medium) * (n + medium) + along * along)
        r_s = (along - beyond) / (along + beyond)
        one, other = n * n * along, medium * medium * beyond
        r_p = (one - other) / (one + other)
        if event == "T":
            flux = np.sqrt(beyond.real / along)
            r_s, r_p = flux * (1.0 + r_s), flux * (1.0 + r_p) * medium / n
            medium = n.real
        p_in, p_out = np.cross(before, s), np.cross(behind, s)
        surface = _dyad(r_s, s, s) + _dyad(r_p, p_out, p_in)
        light = surface @ light @ np.conj(np.swapaxes(surface, -1, -2))
        light = _passed(light, behind, axes.get(place + 1))
    return light


def _passed(light, along, axis):
    """What a polarizer passes, whose axis in the world is seen across the light."""
    if axis is None:
        return light
    across = _units(axis - np.sum(axis * along, axis=-1, keepdims=True) * along)
    projector = _dyad(np.ones(across.shape[:-1], LONG), across, across)
    return projector @ light @ projector


def stokes_in(light, frame):
    """The Stokes vectors of coherency matrices in frames."""
    x, y = (np.asarray(axis, LONG) for axis in (frame.x, frame.y))
    xx, yy, xy = (np.einsum("...i,...ij,...j", a, light, b) for a, b in ((x, x), (y, y), (x, y)))
    # <Ex conj(Ey)>, and S3 = 2 Im <conj(Ex) Ey>.
    parts = (xx + yy).real, (xx - yy).real, 2.0 * xy.real, -2.0 * xy.imag
    return np.stack(parts, axis=-1).astype(np.float64)


def exact_coherency(points, events, materials, outside=1.0):
    """The same of one chain in 50 digits, as a matrix of mpmath."""
    with mpmath.workdps(50):
        points = [mpmath.matrix([mpmath.mpf(float(c)) for c in point]) for point in points]
        legs = [_exact_unit(b - a) for a, b in pairwise(points)]
        medium = mpmath.mpf(float(outside))
        light = (mpmath.eye(3) - legs[0] * legs[0].T) / 2
        for place, (event, material) in enumerate(zip(events, materials, strict=True)):
            before, behind, n = legs[place], legs[place + 1], mpmath.mpmathify(complex(material))
            back, front = (1, 1) if event == "R" else (n.real, medium)
            normal = back * behind - front * before
            s, normal = _exact_unit(_exact_cross(normal, before)), _exact_unit(normal)
            cos = abs((normal.T * before)[0])
            along = medium * cos
            beyond = mpmath.sqrt((n - medium) * (n + medium) + along * along)
            r_s = (along - beyond) / (along + beyond)
            r_p = (n * n * along - medium**2 * beyond) / (n * n * along + medium**2 * beyond)
            if event == "T":
                flux = mpmath.sqrt(beyond.real / along)
                r_s, r_p = flux * (1 + r_s), flux * (1 + r_p) * medium / n
                medium = n.real
            p_in, p_out = _exact_cross(before, s), _exact_cross(behind, s)
            surface = r_s * s * s.T + r_p * p_out * p_in.T
            light = surface * light * surface.H
    return light


def exact_stokes_in(light, frame):
    """The Stokes vector of an exact coherency matrix in a frame, as floats."""
    with mpmath.workdps(50):
        x, y = (mpmath.matrix([mpmath.mpf(float(c)) for c in a]) for a in (frame.x, frame.y))
        xx, yy, xy = ((a.T * light * b)[0] for a, b in ((x, x), (y, y), (x, y)))
        parts = (xx + yy).real, (xx - yy).real, 2 * xy.real, -2 * xy.imag
        return np.array([float(part) for part in parts])


def _units(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def _dyad(number, a, b):
    return number[..., None, None] * a[..., :, None] * b[..., None, :]


def _exact_unit(vector):
    return vector / mpmath.sqrt((vector.T * vector)[0])


def _exact_cross(a, b):
    return mpmath.matrix(
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    )
