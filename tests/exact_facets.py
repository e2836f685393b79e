"""The single-scattering model in 50 digits: amplitudes of a facet, between axes in the world."""

import mpmath as mp

PAULI = [
    mp.matrix(rows)
    for rows in ([[1, 0], [0, 1]], [[1, 0], [0, -1]], [[0, 1], [1, 0]], [[0, -1j], [1j, 0]])
]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def cross(a, b):
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def unit(vector):
    numbers = [mp.mpf(x) for x in vector]
    return [x / mp.sqrt(dot(numbers, numbers)) for x in numbers]


def meridional_axes(k):
    """x = z cross k, or y where light goes along the normal, and y = k cross x."""
    x = unit([-k[1], k[0], 0]) if k[0] or k[1] else [0, 1, 0]
    return x, cross(k, x)


def exact_lambda(a):
    """Smith's Lambda of Beckmann's slopes."""
    return (mp.erf(a) - 1) / 2 + mp.exp(-a * a) / (2 * a * mp.sqrt(mp.pi))


def exact_matrix(index, outside, k_in, k_out):
    """The Mueller matrix of the facet, by its Jones matrix and Pauli's."""
    h = unit([b - a for a, b in zip(k_in, k_out, strict=True)])
    c, m = dot(k_out, h), mp.mpmathify(index) / mp.mpmathify(outside)
    g = mp.sqrt(m * m - 1 + c * c)
    r_s, r_p = (c - g) / (c + g), (m * m * c - g) / (m * m * c + g)
    axes_in, axes_out = meridional_axes(k_in), meridional_axes(k_out)
    across = cross(k_out, k_in)
    s = unit(across) if any(across) else axes_in[0]
    p_in, p_out = cross(k_in, s), cross(k_out, s)
    jones = mp.matrix(2, 2)
    for i, a in enumerate(axes_out):
        for j, b in enumerate(axes_in):
            jones[i, j] = r_s * dot(a, s) * dot(s, b) + r_p * dot(a, p_out) * dot(p_in, b)
    found = mp.matrix(4, 4)
    for i, left in enumerate(PAULI):
        for j, right in enumerate(PAULI):
            product = left * jones * right * jones.H
            found[i, j] = mp.re(product[0, 0] + product[1, 1]) / 2
    return found


def exact_share(k_in, k_out, alphas, masking):
    """The density of facets, masked, over 4 cos cos; and the exponent in it."""
    h = unit([b - a for a, b in zip(k_in, k_out, strict=True)])
    exponent = sum((h[i] / h[2] / mp.mpf(alphas[i])) ** 2 for i in range(2))
    density = mp.exp(-exponent) / (mp.pi * mp.mpf(alphas[0]) * mp.mpf(alphas[1]) * h[2] ** 4)
    masked = []
    for k in (k_in, k_out):
        spread = mp.sqrt(sum((mp.mpf(alphas[i]) * k[i]) ** 2 for i in range(2)))
        masked.append(exact_lambda(abs(k[2]) / spread) if spread else mp.mpf(0))
    seen = {
        "none": mp.mpf(1),
        "separate": (1 + masked[0]) * (1 + masked[1]),
        "smith": 1 + masked[0] + masked[1],
    }[masking]
    return density / (4 * abs(k_in[2]) * k_out[2] * seen), exponent


def exact_scattering(index, alphas, incoming, outgoing, masking="smith", outside=1):
    """The polarised BRDF, and the exponent of the density."""
    with mp.workdps(50):
        k_in, k_out = unit(incoming), unit(outgoing)
        share, exponent = exact_share(k_in, k_out, alphas, masking)
        return share * exact_matrix(index, outside, k_in, k_out), exponent
