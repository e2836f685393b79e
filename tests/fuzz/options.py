"""Random paths, composed in every way: whatever is chosen, the light is the same."""

import numpy as np
from tests.fuzz.attack import Attack, check_light
from tests.random_paths import Draw

import optipath as op

# Compiling takes seconds.
_ENGINES = ["auto"] * 9 + ["numpy"] * 10 + ["numba"]


def make(rng):
    """Make one path and one way to compose and run it."""
    seed, loops = rng.randrange(2**32), rng.random() < 0.4
    options = {"engine": rng.choice(_ENGINES)}
    for name, choices in {
        "model": ["auto", "full"],
        "composing": ["stokes", "jones"],
        "keep": ["ends", "all"],
        "method": ["stable", "compensated", "amplitude"],
    }.items():
        if rng.random() < 0.3:
            options[name] = rng.choice(choices)
    times = rng.choice([1, 5])
    shown = f"Draw({seed}).path(loops={loops}), {options}, {times} times"
    return Attack(shown, lambda: _compared(seed, loops=loops, options=options, times=times), 60.0)


def _compared(seed, *, loops, options, times):
    draw = Draw(seed)
    path = draw.path(loops=loops)
    expected = op.Composer(model="full", engine="numpy").compose(path).run_all(**draw.values)
    plan = op.Composer(**options).compose(path)
    emitted = sum(
        float(np.max(path.element(name).intensity)) for name in path.graph if name.startswith("s")
    )
    for _ in range(times):
        found = plan.run_all(**draw.values)
        for name, light in expected.items():
            check_light(found[name])
            read = ~np.isnan(found[name].stokes)
            error = np.abs(found[name].stokes - light.stokes)[read]
            assert (error <= 1e-11 * emitted).all(), f"{name} is off by {error.max():g}"
