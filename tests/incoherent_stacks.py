"""Stacks of thick layers in 50 digits, written for nothing else: linear systems of intensities.

Fresnel's equations as S. J. Byrnes has them (arXiv:1603.02720, the text of the program tmm) for
waves in media that absorb, and for (S2, S3) the product t_s conj(t_p) scaled to the power.
"""

from typing import NamedTuple

import mpmath
import numpy as np


class Exact(NamedTuple):
    reflected: tuple
    transmitted: tuple
    absorbed: list


def waves(media, y):
    found = [mpmath.sqrt(m * m - y * y) for m in media]
    return [-g if g.imag < 0 or (g.imag == 0 and g.real < 0) else g for g in found]


def fresnel(m1, m2, g1, g2):
    """What is reflected and let through of s, of p, and of E_s conj(E_p)."""
    rs = (g1 - g2) / (g1 + g2)
    rp = (m2 * m2 * g1 - m1 * m1 * g2) / (m2 * m2 * g1 + m1 * m1 * g2)
    reflected = abs(rs) ** 2, abs(rp) ** 2, rs * mpmath.conj(rp)
    if g1.real == 0:
        return reflected, (mpmath.mpf(0), mpmath.mpf(0), mpmath.mpc(0))
    ts = 2 * g1 / (g1 + g2)
    tp = 2 * m1 * m2 * g1 / (m2 * m2 * g1 + m1 * m1 * g2)
    cos1, cos2 = g1 / m1, g2 / m2
    Ts = abs(ts) ** 2 * g2.real / g1.real
    Tp = abs(tp) ** 2 * (m2 * mpmath.conj(cos2)).real / (m1 * mpmath.conj(cos1)).real
    both = ts * mpmath.conj(tp)
    both = mpmath.sqrt(Ts * Tp) * both / abs(both) if both else both
    return reflected, (Ts, Tp, both)


def exact_stack(
    indices, lengths, wavelength, incidence, n0=None, *, back=False, scalar=False, digits=60
):
    """What a stack reflects, lets through, and absorbs of s and of p in each layer.

    With `scalar`, each boundary does to both what it does to unpolarised light.
    """
    with mpmath.workdps(digits):
        media = [mpmath.mpc(mpmath.mpmathify(index)) for index in indices]
        y = mpmath.mpf(n0 if n0 is not None else media[0].real) * mpmath.sin(mpmath.mpf(incidence))
        lengths = [mpmath.mpf(length) for length in lengths]
        if back:
            media, lengths = media[::-1], lengths[::-1]
        g, inner = waves(media, y), range(1, len(media) - 1)
        # A layer without absorption has no light where it reflects all.
        depths = [
            4 * mpmath.pi * g[place].imag * lengths[place - 1] / mpmath.mpf(wavelength)
            if media[place].imag
            else mpmath.mpf(0)
            for place in inner
        ]
        pairs = list(zip(media, media[1:], g, g[1:], strict=False))
        down = [fresnel(*pair) for pair in pairs]
        up = [fresnel(m2, m1, g2, g1) for m1, m2, g1, g2 in pairs]
        if scalar:
            down, up = ([tuple(map(_by_mean, way)) for way in side] for side in (down, up))
        parts = [_part(down, up, depths, part) for part in range(3)]
        shares = list(zip(parts[0][2], parts[1][2], strict=True))
        reflected, transmitted = (tuple(part[way] for part in parts) for way in (0, 1))
        return Exact(reflected, transmitted, shares[::-1] if back else shares)


def _by_mean(parts):
    s, p, both = parts
    return (s + p) / 2, (s + p) / 2, both


def _part(down, up, depths, part):
    count, left = len(depths), [mpmath.exp(-depth) for depth in depths]
    if not count:
        return down[0][0][part], down[0][1][part], []
    system, arriving = mpmath.eye(2 * count), mpmath.zeros(2 * count, 1)
    arriving[0] = down[0][1][part]
    for layer in range(count):
        begins_down, begins_up = 2 * layer, 2 * layer + 1
        system[begins_down, begins_up] -= up[layer][0][part] * left[layer]
        system[begins_up, begins_down] -= down[layer + 1][0][part] * left[layer]
        if layer:
            system[begins_down, begins_down - 2] -= down[layer][1][part] * left[layer - 1]
        if layer + 1 < count:
            system[begins_up, begins_up + 2] -= up[layer + 1][1][part] * left[layer + 1]
    light = mpmath.lu_solve(system, arriving)
    shares = []
    for layer in range(count):
        stays = -mpmath.expm1(-depths[layer])
        beside = [
            1 - face[0][part] - face[1][part] if depths[layer] else 0
            for face in (down[layer + 1], up[layer])
        ]
        shares.append(
            sum(
                light[2 * layer + way] * (stays + left[layer] * beside[way])
                for way in ((0, 1) if part < 2 else ())
            )
        )
    reflected = down[0][0][part] + up[0][1][part] * left[0] * light[1]
    return reflected, down[count][1][part] * left[-1] * light[2 * count - 2], shares


def mueller_of(parts):
    """The Mueller matrix of what becomes of s, of p, and of E_s conj(E_p)."""
    s, p, both = (complex(part) for part in parts)
    A, B, C, S = ((s + p) / 2).real, float((parts[0] - parts[1]) / 2), both.real, both.imag
    return np.array([[A, B, 0, 0], [B, A, 0, 0], [0, 0, C, S], [0, 0, -S, C]])
