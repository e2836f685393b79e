"""Every command and every feature that may need an extra, run with the extras that are here.

As a script, it needs neither pytest nor more of optipath than is installed: ``python every_extra.py
[--quick] [EXTRA ...]`` runs all and tells what ends in any other way than well, or with one
sentence that names an extra. The packages of extras that are not named are hidden, unless it is
``--installed`` that is named.
"""

import contextlib
import io
import os
import shlex
import struct
import sys
import tempfile
import traceback
from pathlib import Path

import optipath as op
from optipath.cli import main
from optipath.errors import OptipathError
from optipath.explorer.answers import PageAnswers
from optipath.explorer.paths import ExploredPresets
from optipath.explorer.server import PageServer
from optipath.extras import EXTRAS

COMMANDS = """
--help
--version
accuracy --help
accuracy --samples 1
bench malus --help
cache
cache --json
chart --help
chart malus --quick --out m.svg --data m.json
chart --from chart.json --out again.pdf
chart --interface --near brewster --out near.png
explain npgr026
explain malus --json
explore --no-browser
materials
materials gold
materials gold --at "516 nm" --json
materials gold --at "2.4 eV" --page Johnson --incidence 30
plot --help
plot malus --kind ellipse --out e.svg
plot malus --kind poincare --x angle --out p.png
plot malus --kind stokes --out s.pdf
plot malus --kind geometry --out g.svg
plot malus --kind bench --out b.svg
plot malus --kind curve --x angle --out c.svg
plot npgr026 --kind curve --x delta --y S0,DoP --out two.svg
plot malus --kind mueller --out u.svg
plot two-panes --kind energy --out n.svg
plot npgr026 --n1 gold --wavelength "516 nm" --kind ellipse --out gold.svg
polarization npgr026 --case 7
presets
run malus
run malus --angle 0:90:4 --json
run malus --angle 0:90:10000 --digits 3
run npgr026 --case all
run npgr026 --method compensated
run npgr026 --method textbook --model full --reads linear
run npgr026 --n1 gold --wavelength "516 nm"
run copper-gold-spectrum --wavelength "400 nm:700 nm:4"
run lyot-depolarizer
run ellipsometer-rough
show npgr026
show npgr026 --svg graph.svg
surface
surface --help
surface glass-rough --incidence 60 --photons 100
surface glass-rough --incidence 0:80:3 --photons 100 --json
surface glass-rough --incidence 60 --photons 100 --tolerance 0.5
surface glass-on-glass --decide --incidence 60 --photons 100
surface gold-rough --incidence 60 --photons 100 --wavelength "516 nm"
surface glass-rough --incidence 60 --photons 100 --map DoP --out sky.png
surface glass-rough --incidence 60 --photons 100 --map S0 --side transmitted --out below.svg
surface picture.toml --incidence 60 --photons 100
surface reproduce --help
surface reproduce --list
surface reproduce wang-2017-simulation-04 --photons 20000
surface reproduce wang-2017-table-1 --photons 100 --json
sweep malus --angle 0:90:4
sweep malus --angle 0:90:4 --json
sweep malus --angle 0:90:4 --out a.csv
sweep malus --angle 0:90:4 --out a.json
sweep malus --angle 0:90:4 --out a.nc
sweep malus --angle 0:90:4 --out a.zarr
sweep malus --angle 0:90:4 --chunks 2 --out b.nc
sweep malus --angle 0:90:4 --chunks 2 --scheduler synchronous --out b.zarr
sweep malus --angle 0:90:4 --chunks 2 --scheduler threads --out c.zarr
sweep npgr026 --delta 0:80:3 --phi 0:80:3 --zip delta,phi
sweep npgr026 --n1 gold --wavelength "400 nm:700 nm:3"
"""
"""A command line each, all of which are right: with every extra, each ends with status 0."""

SLOW = """
bench malus --largest 1
bench malus --largest 1 --engine numba
bench malus --largest 1 --engine jax
chart --interface --quick --out i.png
"""
"""Those that take a second and more, for the script alone."""

FEATURES = """
op.plots.ellipse(light)
op.plots.curve(op.load_preset("malus"), "angle")
op.plots.poincare(light)
light.plot()
light.plot("poincare")
op.load_preset("malus").mueller().plot()
op.Composer(engine="numba").compose(path).run()
op.Composer(engine="jax").compose(path).run()
op.Composer(method="compensated").compose(path).run()
op.Composer(loops="sum").compose(op.load_preset("two-panes")).run()
op.load_preset("malus").sweep(angle=[0.1, 0.2])
op.load_preset("malus").sweep(angle=[0.1, 0.2], chunks={"angle": 1}).compute()
op.load_preset("malus").sweep(angle=[0.1, 0.2], chunks={"angle": 1}, store="kept.zarr")
op.load_preset("malus").propagate(angle=(0.5, 0.01))
op.load_preset("malus").propagate(angle=(0.5, 0.01), method="gradients")
op.load_preset("malus").propagate(angle=(0.5, 0.01), method="monte-carlo", samples=10)
op.load_preset("npgr026", n1=op.Material.named("gold")).trace(wavelength="516 nm")
op.Material.named("silver").at("516 nm")
op.Material.from_yaml("own.yml").at("516 nm")
op.Spectrum.illuminant("D65")
op.measure(rough, "60 deg", 100, sensor=8).adm(noise=None)
op.measure(rough, "60 deg", 100, sensor=8, store="photons.zarr")
op.measure(rough, "60 deg", 100, sensor=8).save("saved.zarr")
op.measure(rough, "60 deg", 100, sensor=8).save("a.exr", side="reflected")
[op.measure(rough, "60 deg", 100, sensor=8).save("a.nc"), op.load_hemisphere("a.nc")]
op.surfaces.energy(rough, "60 deg", photons=100)
op.surfaces.photon_ends(rough, "60 deg", photons=100)
op.surfaces.HeightField.from_file("heights.tif", size=1.0)
op.polarization(path)
answers.open({"preset": "npgr026"})
answers.trace({"preset": "npgr026", "values": {"n1": "gold", "wavelength": "516 nm"}})
"""
"""An expression of Python each; `answers` are those of the page."""


FILES = {
    "own.yml": "DATA: [{type: tabulated nk, data: '0.4 1.5 0.0\n\n0.7 1.6 0.0'}]",
    "picture.toml": """
format = 1
description = "A measured face of glass"
layers = [{ index = 1.5, heights = "heights.tif", size = 1.0 }]
""",
}
"""What commands and features read, besides a picture and a measured chart."""
CHART = Path(__file__).resolve().parents[1] / "docs" / "chart.json"


def picture():
    """A TIFF of 3 x 3 heights in single precision, made without tifffile."""
    tags = {256: 3, 257: 3, 258: 32, 259: 1, 262: 1, 273: 8, 277: 1, 278: 3, 279: 36, 339: 3}
    entries = [struct.pack("<HHII", tag, 4, 1, value) for tag, value in tags.items()]
    head = struct.pack("<2sHI9fH", b"II", 42, 44, *map((0.01).__mul__, range(9)), len(tags))
    return b"".join([head, *entries, bytes(4)])


def of_command(line):
    """How a command ends: its status and what it says on standard error."""
    said = io.StringIO()
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(said):
        status = main(shlex.split(line))
    return status, said.getvalue()


def of_feature(line):
    """How an expression ends, as a command would."""
    path, rough = op.load_preset("npgr026"), op.Sample([(1.5, 0.3)])
    names = {"op": op, "path": path, "light": path.trace(), "rough": rough}
    names["answers"] = PageAnswers(ExploredPresets("npgr026"))
    try:
        eval(line, names)  # noqa: S307 - of the table above
    except OptipathError as missing:
        return 2, f"{missing}\n"
    return 0, ""


def faults(rows, *, whole):
    """What ends in another way than it may: well, or with a sentence where something is missing."""
    for line, ending in rows:
        try:
            status, said = ending(line)
        except BaseException:  # noqa: BLE001 - whatever ends a command
            yield f"{line}\n{traceback.format_exc()}"
            continue
        named = said.count("\n") == 1 and 'pip install "optipath[' in said
        if status and (whole or status != 2 or not named):
            yield f"{line}\nstatus {status}: {said}"


def run_all(extras, *, quick):
    """Return what ends in another way than it may, with the packages of some extras alone."""
    for extra, packages in EXTRAS.items():
        if not {extra, "--installed"} & extras:
            sys.modules.update(dict.fromkeys(packages))
    PageServer.serve_forever = lambda _: None
    os.environ.setdefault("MPLBACKEND", "agg")
    commands = COMMANDS if quick else COMMANDS + SLOW
    rows = [(line, of_command) for line in commands.split("\n") if line]
    rows += [(line, of_feature) for line in FEATURES.split("\n") if line]
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        Path("heights.tif").write_bytes(picture())
        Path("chart.json").write_bytes(CHART.read_bytes())
        for name, text in FILES.items():
            Path(name).write_text(text, "utf-8")
        return list(faults(rows, whole={*EXTRAS} <= extras))


if __name__ == "__main__":
    named = {*sys.argv[1:]}
    sys.exit("\n".join(run_all(named, quick="--quick" in named)) or None)
