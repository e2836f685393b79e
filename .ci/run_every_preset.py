"""Run every preset and every case through an installed command, and the cases against print."""

import json
import subprocess
import sys

import optipath as op
from optipath.surfaces.reproduction import experiment_names, load_experiment


def main(command: str) -> None:
    """Run them all; raise where one fails."""
    done = 0
    for name in op.preset_names():
        for case in (None, *op.load_preset(name).cases):
            options = [] if case is None else ["--case", case]
            output = subprocess.run(
                [command, "run", name, *options, "--json"],
                check=True,
                capture_output=True,
                text=True,
            ).stdout
            detectors = json.loads(output)["detectors"]
            if not all(reading["stokes"] for reading in detectors.values()):
                raise SystemExit(f"{name}, case {case}: no light")
            done += 1
    if not all(op.load_sample(name).fields() for name in op.sample_names()):
        raise SystemExit("a sample without layers")
    if not all(load_experiment(name).measurements for name in experiment_names()):
        raise SystemExit("an experiment without measurements")
    counts = f"{done} runs of {len(op.preset_names())} presets, {len(op.sample_names())} samples"
    print(f"{counts} from {op.__file__}")


main(sys.argv[1])
