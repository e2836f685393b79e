"""The results as Markdown, and their place in a page."""

from contenders.optipath_engines import REFERENCE
from optipath.lab.bench import processor, software

BEGIN = "<!-- peers: python benchmarks/peers/race.py --write docs/performance.md -->"
END = "<!-- end of peers -->"
PACKAGES = (
    "numpy",
    "numba",
    "jax",
    "jaxlib",
    "drjit",
    "mitsuba",
    "pypolar",
    "py_pol",
    "tmm",
    "katsu",
)
NOTES = """\
- error: the largest |found - exact| / S0 of any component of 200 of the paths, exact in 50 digits
  at the float64 angles that were drawn, so that float32 answers for its rounded angles
- fused: by hand, the same formulas for all (benchmarks/peers/formulas.py), without matrices, and
  for this path only: behind a horizontal filter nothing but F_s of X2 counts"""
HEADER = "| contender | paths | ns a path, least | median | to optipath, numba | error / S0 | how |"
RULE = "| --- | ---: | ---: | ---: | ---: | ---: | --- |"


def markdown(contests, machine):
    """Return the tables, what was left out and why, and on what it ran."""
    tables, absent = [], {}
    for materials, (results, missing) in contests.items():
        tables.append(f"npgr026, horizontal filter, {materials} materials\n\n{table(results)}")
        absent |= missing
    notes = [NOTES]
    notes += [f"- left out: {name} ({reason})" for name, reason in absent.items()]
    versions = ", ".join(f"{name} {number}" for name, number in machine["software"].items())
    notes.append(f"- one thread of {machine['processor']}; {versions}")
    return "\n\n".join((*tables, "\n".join(notes)))


def table(results):
    base = next((r.least for r in results if r.contender == REFERENCE), float("nan"))
    rows = [
        f"| {r.contender} | {r.paths:,} | {short(r.least)} | {short(r.median)} "
        f"| {short(r.least / base)} | {r.error:.1e} | {r.how} |"
        for r in sorted(results, key=lambda result: result.least)
    ]
    return "\n".join((HEADER, RULE, *rows))


def short(number):
    return f"{number:,.0f}" if number >= 100.0 else f"{number:.3g}"


def machine():
    """Return the processor, and what has run in which version."""
    return {"processor": processor(), "software": software(PACKAGES)}


def has_place(page):
    return page.count(BEGIN) == page.count(END) == 1 and page.index(BEGIN) < page.index(END)


def put(page, text):
    """Return a page with the text between the two lines that mark its place."""
    before, rest = page.split(BEGIN)
    return f"{before}{BEGIN}\n\n{text}\n\n{END}{rest.split(END)[1]}"
