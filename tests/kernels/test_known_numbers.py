"""What kernels declare of their numbers is what they compute."""

import numpy as np

from optipath.kernels import catalog
from optipath.kernels.kernel import Kernel, KernelFamily
from optipath.kernels.primitives import NUMPY
from tables import rows

STACKS = [
    (catalog.stack(wanted, measured, absorbing), 6 + 3 * len(absorbing) + (measured == "before"))
    for wanted in ("reflected", "transmitted")
    for measured in ("in front", "behind", "before")
    for absorbing in ((), (1,))
]
COUNTS = {
    "matrix": 16,
    "turn between world frames": 2,
    "polarized light": 5,
    "dichroism and retardance along the way": 7,
    "dichroism and depolarisation along the way": 8,
}
NOT_DECLARED = {
    "elliptical retarder": {1, 2, 3, 4, 8, 12},
    "Fresnel transmission from behind (amplitude, lossless)": {4},
    "Fresnel transmission from behind (textbook, lossless)": {4},
}
"""Numbers that are 0, but by which no path has been reduced so far."""


def kernels():
    """Return every kernel of the catalog, with how many arguments it is given."""
    several = [v for v in vars(catalog).values() if isinstance(v, (Kernel, KernelFamily))]
    waiting = [(family, COUNTS.get(family.name)) for family in several] + STACKS
    results = {}
    while waiting:
        one, count = waiting.pop()
        if isinstance(one, KernelFamily):
            waiting += [(kernel, count) for kernel in one.methods.values()]
        elif one is not None and (one.name, count) not in results:
            results[one.name, count] = one, count
            cheaper = [entry[-1] for entry in (one.without, one.denser) if entry]
            waiting += [(kernel, None) for kernel in cheaper]
    return list(results.values())


def arguments(kernel, count, zeros, seed):
    """Draw arguments: two indices, numbers, and an angle of incidence."""
    draw = np.random.default_rng(seed)
    second = (1.3, 1.6) if "rarer side" in kernel.name else (0.4, 1.6)
    numbers = np.array([draw.uniform(1.0, 1.3), draw.uniform(*second), *draw.random(count)])
    if "dichroism" in kernel.name:
        numbers[0] *= (-1.0) ** seed if kernel.name.startswith("dichroism") else 2.0
    if "reflection or transmission" in kernel.name:
        numbers = np.array([float(seed % 2), *numbers])
    numbers = numbers[:count]
    if kernel.name.startswith(("Fresnel", "stack")):
        sin = draw.uniform(0.1, 0.9)
        numbers[-2:] = np.sqrt(1.0 - sin**2), sin
    for place in zeros:
        numbers[place] = 0.0
        if kernel.name.startswith(("Fresnel", "stack")) and place in (-1, -2):
            numbers[-3 - place] = 1.0
    return tuple(numbers)


def evaluated(kernel, count, zeros=()):
    """Return the numbers at several points, and at how many arguments; a row a point."""
    function = kernel.made_for(NUMPY)
    for given in (count,) if count else range(1, 20):
        try:
            with np.errstate(all="ignore"):
                return given, np.array(
                    [function(*arguments(kernel, given, zeros, seed)) for seed in range(12)]
                )
        except (TypeError, ValueError, IndexError):
            continue
    raise AssertionError(kernel.name)


@rows("kernel, count", kernels())
def test_what_a_kernel_declares_is_what_it_computes(kernel, count):
    for signs, *zeros in kernel.known:
        _, several = evaluated(kernel, count, zeros)
        for sign, found in zip(signs.replace(" ", ""), several.T, strict=True):
            assert sign == "." or np.all(found == float(sign)), (signs, zeros)


@rows("kernel, count", kernels())
def test_what_is_the_same_for_all_arguments_is_declared(kernel, count):
    if kernel.structure is None and not kernel.known:
        return
    given, several = evaluated(kernel, count)
    declared = kernel.known_numbers((), given) or (None,) * several.shape[1]
    found = {place for place, n in enumerate(several.T) if np.all(n == n[0]) and n[0] in (0.0, 1.0)}
    found -= NOT_DECLARED.get(kernel.name, set())
    assert found == {place for place, number in enumerate(declared) if number is not None}
