"""Mitsuba's plugin `measured_polarized`, in the words of its source: how it reads and looks up.

After src/bsdfs/measured_polarized.cpp, src/core/tensor.cpp and include/mitsuba/core/distr_2d.h of
Mitsuba 3: arrays with names, interpolated along each axis, for light in frames with x across both
directions.
"""

import struct

import numpy as np

import optipath as op

GOLD = 0.2 + 3.0j
FLIPPED = np.diag([1.0, 1.0, 1.0, -1.0])
TYPES = {1: np.uint8, 3: np.uint16, 10: np.float32}


def read(file):
    """The arrays of a tensor file, by their names."""
    data = file.read_bytes()
    assert data[:14] == b"tensor_file\0\1\0"
    (count,), at, found = struct.unpack_from("<I", data, 14), 18, {}
    for _ in range(count):
        (length,) = struct.unpack_from("<H", data, at)
        name = data[at + 2 : at + 2 + length].decode()
        axes, code, offset = struct.unpack_from("<HBQ", data, at + 2 + length)
        shape = struct.unpack_from(f"<{axes}Q", data, at + 13 + length)
        at += 13 + length + 8 * axes
        size = int(np.prod(shape))
        found[name] = np.frombuffer(data, TYPES[code], size, offset).reshape(shape)
    return found


def angles(light, eye):
    """The angles phi_d, theta_d, theta_h of unit vectors to the light and to the eye."""
    half = (light + eye) / np.linalg.norm(light + eye)
    across = np.cross([0.0, 0.0, 1.0], half)
    across /= np.linalg.norm(across)
    along = np.cross(across, half)
    seen = light - (light @ half) * half
    seen /= np.linalg.norm(seen)
    return np.arctan2(across @ seen, along @ seen), np.arccos(half @ light), np.arccos(half[2])


def look_up(arrays, light, eye, wavelength):
    """The matrix of the table, in frames whose x is light x eye: linear along every axis."""
    axes = [arrays[name][0].astype(float) for name in ("phi_d", "theta_d", "theta_h")]
    axes.append(arrays["wvls"].astype(float))
    corners = []
    for axis, value in zip(axes, (*angles(light, eye), wavelength), strict=True):
        if len(axis) == 1:
            corners.append([(0, 1.0)])
            continue
        place = int(np.clip(np.searchsorted(axis, value) - 1, 0, len(axis) - 2))
        share = (value - axis[place]) / (axis[place + 1] - axis[place])
        corners.append([(place, 1.0 - share), (place + 1, share)])
    total = np.zeros((4, 4))
    for a, wa in corners[0]:
        for b, wb in corners[1]:
            for c, wc in corners[2]:
                for d, wd in corners[3]:
                    total += wa * wb * wc * wd * arrays["M"][a, b, c, d].astype(float)
    return total


def directions(count, lowest=0.3, seed=1):
    """Pairs of directions to the light and to the eye, half of them near mirror reflection."""
    rng = np.random.default_rng(seed)
    found = []
    while len(found) < count:
        z, azimuth = rng.uniform(lowest, 1.0, 2), rng.uniform(0.0, 2.0 * np.pi, 2)
        level = np.sqrt(1.0 - z * z)
        light, eye = np.stack([level * np.cos(azimuth), level * np.sin(azimuth), z], axis=-1)
        if len(found) % 2:
            facet = np.array([*rng.normal(0.0, 0.2, 2), 1.0])
            facet /= np.linalg.norm(facet)
            eye = 2.0 * (facet @ light) * facet - light
        if eye[2] > lowest:
            found.append((light, eye))
    return found


def by_formula(brdf, light, eye):
    """The numbers of a BRDF in frames with x across both directions, with Mitsuba's S3."""
    x = np.cross(light, eye)
    frames = [op.Frame.from_direction(z, x) for z in (-light, eye)]
    into, out_of = (op.Mueller(np.eye(4), frame, frame) for frame in frames)
    return FLIPPED @ (out_of @ brdf(-light, eye) @ into).matrix @ FLIPPED
