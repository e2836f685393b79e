"""The whole path by hand, without matrices, for any library that has sin, cos and sqrt.

A horizontal filter in front of X2 lies along its s, so that of X2 only F_s is needed.
"""

from work import INTENSITY


def fused(xp, materials):
    """Make (delta, rho, phi) -> (S0, S1, S2, S3), the cheaper one where nothing absorbs."""
    n1, k1, n2, k2 = materials
    if k1 == k2 == 0.0 and min(n1, n2) >= 1.0:
        return lossless(xp, n1, n2)
    return absorbing(xp, *materials)


def absorbing(xp, n1, k1, n2, k2):
    sin, cos, sqrt = xp.sin, xp.cos, xp.sqrt
    re1, im1 = n1 * n1 - k1 * k1, (2.0 * n1 * k1) ** 2
    re2, im2 = n2 * n2 - k2 * k2, (2.0 * n2 * k2) ** 2

    def stokes(delta, rho, phi):
        # With g = a + ib: w = |g|^2 and |c -+ g|^2 = c^2 + w -+ 2ca.
        c = cos(phi)
        D = re2 - (1.0 - c * c)
        w = sqrt(D * D + im2)
        t, u = c * c + w, c * sqrt(2.0 * (w + D))
        I = 0.5 * INTENSITY * (t - u) / (t + u)

        c = cos(delta)
        z = 1.0 - c * c
        D = re1 - z
        w = sqrt(D * D + im1)
        t, u = c * c + w, c * sqrt(2.0 * (w + D))
        Fs = I * (t - u) / (t + u)
        # r_p / r_s = (z - c g) / (z + c g), z = sin^2.
        zz, gg, zu = z * z, c * c * w, z * u
        q = zz + gg + zu
        f = Fs / q
        Fp = f * (zz + gg - zu)
        A, B = 0.5 * (Fs + Fp), 0.5 * (Fs - Fp)
        C, S = f * (zz - gg), f * z * c * sqrt(2.0 * (w - D))

        cos2, sin2 = cos(2.0 * rho), sin(2.0 * rho)
        return A + B * cos2, B + A * cos2, C * sin2, -S * sin2

    return stokes


def lossless(xp, n1, n2):
    sin, cos, sqrt = xp.sin, xp.cos, xp.sqrt
    m1, m2 = n1 * n1 - 1.0, n2 * n2 - 1.0

    def stokes(delta, rho, phi):
        c = cos(phi)
        g = sqrt(m2 + c * c)
        rs2 = (c - g) / (c + g)

        c = cos(delta)
        z, g = 1.0 - c * c, sqrt(m1 + c * c)
        rs, ratio = rs2 * (c - g) / (c + g), (z - c * g) / (z + c * g)
        Fs = 0.5 * INTENSITY * rs * rs
        C = Fs * ratio
        Fp = C * ratio
        A, B = 0.5 * (Fs + Fp), 0.5 * (Fs - Fp)

        cos2, sin2 = cos(2.0 * rho), sin(2.0 * rho)
        return A + B * cos2, B + A * cos2, C * sin2, 0.0

    return stokes
