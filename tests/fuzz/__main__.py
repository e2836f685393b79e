"""Attack the library with what nobody means to give it, for as long as is wanted.

python -m tests.fuzz --minutes 5
python -m tests.fuzz --minutes 1 --only presets --seed 7
python -m tests.fuzz --again presets-7-123
"""

import random
import sys
import time

import click
from tests.fuzz import files, makers
from tests.fuzz.attack import fault_of

_MAKERS = {
    "presets": files.a_preset,
    "values": makers.values,
    "calls": makers.a_call,
    "command-lines": makers.a_command_line,
    "options": makers.options,
    "samples": files.a_sample,
    "experiments": files.an_experiment,
}


@click.command()
@click.option("--minutes", type=float, default=1.0, show_default=True, help="How long.")
@click.option("--seed", type=int, default=0, show_default=True, help="Other attacks by another.")
@click.option("--only", type=click.Choice([*_MAKERS]), help="One kind alone.")
@click.option("--again", metavar="NAME", help="One attack alone, by its name.")
@click.option("--most", type=int, default=5, show_default=True, help="Faults after which to stop.")
def main(minutes, seed, only, again, most):
    """Attack the library with random files, values, command lines and options."""
    end, number, faults = time.monotonic() + 60.0 * minutes, 0, 0
    kinds = [only] if only else [*_MAKERS]
    while again or (time.monotonic() < end and faults < most):
        name = again or f"{kinds[number % len(kinds)]}-{seed}-{number}"
        attack = _MAKERS[name.rsplit("-", 2)[0]](random.Random(name))  # noqa: S311 - no secrets
        fault, number = fault_of(attack), number + 1
        if fault:
            faults += 1
            click.echo(f"== {name}\n{attack.shown[:1000]}\n-- {fault[-2000:]}\n")
        if again:
            break
    click.echo(f"{number} attacks, {faults} faults")
    sys.exit(1 if faults else 0)


main()
