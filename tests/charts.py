"""Charts as they could have been measured, and what is drawn over what in their pictures."""

from itertools import product

import numpy as np
from hypothesis import strategies as st

REGIONS = ("generic", "grazing", "near the normal", "extreme magnitudes")
EPS = {"float64": 2.2e-16, "float32": 1.2e-7, "longdouble": 1.1e-19, "float128": 2.2e-16}
MARKS = ("o", "s", "D", "^", "v", "p", "h")
KINDS = ("componentwise", "normwise")


@st.composite
def charts(draw):
    """Charts of any methods, times and errors; failing, holding, and with odd names."""
    sizes = st.floats(0.0, 1e17) | st.just(np.inf)
    times = st.floats(1.0, 1e7)
    methods = draw(st.lists(st.sampled_from(["stable", "textbook", "m" * 40, "x"]), min_size=1))
    dtypes = draw(st.lists(st.sampled_from(sorted(EPS)), min_size=1, max_size=3, unique=True))
    engines = draw(st.lists(st.sampled_from(["numpy", "numba", "jax"]), min_size=1, unique=True))
    found = []
    for method, dtype, engine in product(dict.fromkeys(methods), dtypes, engines):
        worst = {kind: zip(REGIONS, draw(st.tuples(*[sizes] * 4)), strict=True) for kind in KINDS}
        errors = {
            kind: {region: {"worst": size, "median": min(size, 1.0)} for region, size in several}
            for kind, several in worst.items()
        }
        way = {"method": method, "dtype": dtype, "engine": engine, "eps": EPS[dtype]}
        way["composing"] = draw(st.sampled_from(["stokes", "jones"]))
        found.append({**way, "errors": errors, "ns": {"least": draw(times)}})
    limits = draw(st.dictionaries(st.sampled_from(["memory", "sqrt and division"]), times))
    title = draw(st.sampled_from(["npgr026", "long title " * 20, r"$\frac{$"]))
    told = {"format": 1, "title": title, "fails_above": 1000.0, "regions": {"measured": 3, "of": 4}}
    return {**told, "contenders": found, "limits_ns": limits}


def texts_over_marks(figure, texts):
    """The texts that a mark of some panel lies under, with where it is."""
    faults = []
    for ax in figure.axes:
        for line in ax.get_lines():
            if line.get_marker() not in MARKS:
                continue
            half = line.get_markersize() / 2 * figure.dpi / 72
            for x, y in line.get_transform().transform(np.column_stack(line.get_data())):
                for text in texts:
                    box = text.get_window_extent().padded(half - 1)
                    if box.contains(x, y):
                        faults.append((text.get_text(), x, y))
    return faults
