"""The state of the page as lines of Python, which run as they are and print the same numbers."""

from __future__ import annotations

from keyword import iskeyword
from typing import TYPE_CHECKING, Any

from optipath.values.materials import Material
from optipath.values.named_materials import extinction_beside

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.explorer.read_values import ReadState

_OF_LOADING = ("case",)
"""What `load_preset` takes for itself, and a parameter may be called, too."""

_PRINTED = """\
lights = path.trace_all()
for name in {ends}:
    light = lights[name]
    print(name, *["0" if abs(each) < light.noise else f"{{each:.6g}}" for each in light.stokes])
"""


def python_lines(state: ReadState, source: str) -> str:
    """Return lines of Python for a state."""
    given = {name: repr(word) for name, word in state.asked.places.items()}
    given |= {name: _value(state, name, value) for name, value in state.given.items()}
    own = {name: text for name, text in given.items() if name in _OF_LOADING}
    arguments = [repr(source)]
    if state.asked.case is not None:
        arguments.append(f"case={state.asked.case!r}")
    arguments += _by_name({name: text for name, text in given.items() if name not in own})
    loaded = f"path = op.load_preset({', '.join(arguments)})"
    if len(loaded) > 88:
        inner = "".join(f"    {each},\n" for each in arguments)
        loaded = f"path = op.load_preset(\n{inner})"
    if own:
        loaded += f".bind({', '.join(_by_name(own))})"
    ends = repr([*state.explored.detectors])
    return f"import optipath as op\n\n{loaded}\n{_PRINTED.format(ends=ends)}"


def _by_name(given: Mapping[str, str]) -> list[str]:
    """Return arguments; in one mapping those whose names Python keeps for itself."""
    kept = [f"{name!r}: {text}" for name, text in given.items() if iskeyword(name)]
    plain = [f"{name}={text}" for name, text in given.items() if not iskeyword(name)]
    return [*plain, f"**{{{', '.join(kept)}}}"] if kept else plain


def _value(state: ReadState, name: str, value: Any) -> str:
    if isinstance(value, Material):
        return _material(state, name)
    parameter = state.explored.parameters[name]
    if isinstance(value, float) and not parameter.unit:
        return repr(value)
    return repr(parameter.text(value) if isinstance(value, float | complex | str) else value)


def _material(state: ReadState, name: str) -> str:
    """Return a material by its name, with the k that is given beside it."""
    texts = state.asked.values
    own = extinction_beside(state.base.uses, name)
    k = f", k={float(texts[own])!r}" if own in texts else ""
    return f"op.Material.named({texts[name].strip()!r}{k})"
