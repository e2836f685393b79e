"""From Fresnel's amplitudes to light and to matrices, for peers that give the amplitudes only."""

import numpy as np

from work import INTENSITY


def power(amplitude):
    return amplitude.real**2 + amplitude.imag**2


def light(rs1, rp1, rs2, rho):
    """Return the light behind X1; a horizontal filter leaves only r_s of X2 to be known."""
    A, B, C, S = parts(rs1, rp1)
    I, cos2, sin2 = 0.5 * INTENSITY * power(rs2), np.cos(2.0 * rho), np.sin(2.0 * rho)
    return np.stack((A + B * cos2, B + A * cos2, C * sin2, -S * sin2), -1) * I[:, np.newaxis]


def mueller(rs, rp):
    """Return matrices of shape (N, 4, 4)."""
    A, B, C, S = parts(rs, rp)
    matrices = np.zeros((*rs.shape, 4, 4))
    matrices[:, 0, 0] = matrices[:, 1, 1] = A
    matrices[:, 0, 1] = matrices[:, 1, 0] = B
    matrices[:, 2, 2] = matrices[:, 3, 3] = C
    matrices[:, 2, 3], matrices[:, 3, 2] = S, -S
    return matrices


def parts(rs, rp):
    Fs, Fp, cross = power(rs), power(rp), rs * rp.conj()
    return 0.5 * (Fs + Fp), 0.5 * (Fs - Fp), cross.real, cross.imag


def fresnel(n, k, angles):
    """Return r_s and r_p; real, and twice as fast, where the material is lossless."""
    m = n if k == 0.0 and n >= 1.0 else complex(n, k)
    c = np.cos(angles)
    g = np.sqrt(m * m - (1.0 - c * c))
    return (c - g) / (c + g), (m * m * c - g) / (m * m * c + g)
