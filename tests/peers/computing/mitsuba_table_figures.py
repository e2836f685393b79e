"""What Mitsuba 3 reads out of a table that optipath has written: pip install mitsuba networkx.

The plugin `measured_polarized` is asked for pairs of directions, some near mirror reflection; the
numbers refer to Mitsuba's own bases of Stokes vectors, which are written beside them. How far
what it reads out of a table of the usual shape is from the formula, over M00, is there, too.
"""

from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

import mitsuba
import numpy as np
import setups

import optipath as op

mitsuba.set_variant("scalar_spectral_polarized")

TABLE = {
    "wavelengths": ["400 nm", "500 nm", "700 nm"],
    "n": [1.6, 0.9, 0.2],
    "k": [1.9, 2.2, 4.0],
    "alpha": 0.35,
    "tabulated": ["450 nm", "550 nm", "650 nm"],
    "shape": [13, 19, 24],
}


def directions():
    rng = np.random.default_rng(5)
    while True:
        z, azimuth = rng.uniform(0.2, 1.0, 2), rng.uniform(0.0, 2.0 * np.pi, 2)
        level = np.sqrt(1.0 - z * z)
        eye, light = np.stack([level * np.cos(azimuth), level * np.sin(azimuth), z], axis=-1)
        if rng.random() < 0.5:
            facet = np.array([*rng.normal(0.0, 0.2, 2), 1.0])
            facet /= np.linalg.norm(facet)
            light = 2.0 * (facet @ eye) * facet - eye
        if light[2] > 0.2:
            yield eye, light


def asked(plugin, eye, light, wavelength):
    interaction = mitsuba.SurfaceInteraction3f()
    interaction.wavelengths = [wavelength] * 4
    interaction.wi = mitsuba.Vector3f(eye)
    to_light = mitsuba.Vector3f(light)
    value = np.array(plugin.eval(mitsuba.BSDFContext(), interaction, to_light))[..., 0]
    into, out = (mitsuba.mueller.stokes_basis(each) for each in (-to_light, interaction.wi))
    bases = {
        "basis_in": np.array(into).ravel().tolist(),
        "basis_out": np.array(out).ravel().tolist(),
    }
    ways = {"eye": eye.tolist(), "light": light.tolist()}
    return {**ways, "wavelength": wavelength, **bases, "mueller": value.tolist()}


def apart(each, brdf):
    """M00 of the BRDF times the cosine, and how far what is read is from it."""
    ways = -np.array(each["light"]), np.array(each["eye"])
    bases = np.array(each["basis_in"]), np.array(each["basis_out"])
    into, out_of = (op.Mueller(np.eye(4), f, f) for f in map(op.Frame.from_direction, ways, bases))
    ours = (out_of @ brdf(*ways) @ into).to("mitsuba") * each["light"][2]
    return ours[0, 0], np.abs(ours - each["mueller"]).max()


def usual_table(folder):
    """How far what is read of a table of the usual shape is from the BRDF, where that is bright."""
    file = Path(folder, "usual.pbsdf")
    brdf = partial(op.surfaces.single_scattering, 0.9 + 2.2j, 0.2)
    op.surfaces.write_measured_polarized(file, brdf)
    read = mitsuba.load_dict({"type": "measured_polarized", "filename": str(file)})
    pairs = zip(directions(), range(400), strict=False)
    bright, far = np.array([apart(asked(read, *pair, 550.0), brdf) for pair, _ in pairs]).T
    seen = bright > 1e-3 * bright.max()
    half, most, all_ = np.quantile((far / bright)[seen], [0.5, 0.9, 1.0]).round(4).tolist()
    of_brightest = round(float(far.max() / bright.max()), 4)
    return {"half": half, "nine in ten": most, "all": all_, "of the brightest": of_brightest}


metal = op.Material.tabulated(TABLE["wavelengths"], TABLE["n"], TABLE["k"])
brdf = partial(op.surfaces.single_scattering, metal, TABLE["alpha"])
with TemporaryDirectory() as folder:
    file = Path(folder, "metal.pbsdf")
    shape = tuple(TABLE["shape"])
    op.surfaces.write_measured_polarized(file, brdf, wavelengths=TABLE["tabulated"], shape=shape)
    read = mitsuba.load_dict({"type": "measured_polarized", "filename": str(file)})
    pairs = zip(directions(), [450.0, 480.0, 550.0, 641.5] * 6, strict=False)
    found = [asked(read, *pair, wavelength) for pair, wavelength in pairs]
    usual = usual_table(folder)
content = {"precision": 2e-5, "table": TABLE, "usual shape": usual, "evaluated": found}
setups.write_file("tables/mitsuba", "mitsuba", __file__, **content)
