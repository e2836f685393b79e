"""Elements of a user's own: checks of their classes, fields, matrices and couplings."""

from __future__ import annotations

from dataclasses import dataclass, fields, is_dataclass
from functools import cache, partial
from inspect import signature
from typing import TYPE_CHECKING, Any, get_args, get_type_hints

import numpy as np

from optipath.elements.coupling import Coupling, numbers_of
from optipath.errors import OptipathError, PathError, ValueFault
from optipath.faults import listed, shown
from optipath.kernels.carriers.structures import FULL, JONES, mueller_of_jones
from optipath.kernels.kernel import Kernel, KernelFamily, called, guarded
from optipath.kernels.primitives import NUMPY
from optipath.light.decompositions import tolerance_of
from optipath.light.passive import are_passive, cure_of, gain, problem_of
from optipath.materials.index_domains import RowDomain
from optipath.materials.quantities import REAL, YES_OR_NO
from optipath.values.agreement import is_single
from optipath.values.arrays import broadcast_fault, same
from optipath.values.domains import Domain, StokesDomain, Within
from optipath.values.jax_values import is_traced
from optipath.values.operands import Operand, Operation, ResultOf, operand_of

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Iterator

    from optipath.kernels.primitives import KernelFunction, Primitives
    from optipath.values.precision import Array


_LONGEST = 100

_EMITTED = StokesDomain("Stokes vector", tail=(4,))

_TAKEN = "say physical: ClassVar[bool] = False in the class, to take it as it is"


def own_ways(owner: str, element: Any, couplings: Iterable[Coupling], method: str) -> list[OwnWays]:
    """Return the ways through an element that are to be looked at: those of a user's own class."""
    if not is_own(type(element)):
        return []
    ports: dict[str | None, list[Coupling]] = {}
    for coupling in couplings:
        ports.setdefault(coupling.enters, []).append(coupling)
    return [OwnWays(owner, element, tuple(each), method) for each in ports.values()]


@dataclass(frozen=True, eq=False)
class OwnWays:
    """The ways from one port through an element of a user's own, which no proof stands behind."""

    owner: str
    element: Any
    couplings: tuple[Coupling, ...]
    method: str = "stable"

    @property
    def operands(self) -> list[Operand]:
        """The numbers that they are made of, such as are given and such as are known."""
        operations = [one for coupling in self.couplings for one in coupling.operations]
        return [operand for operation in operations for operand in operation.operands()]

    @property
    def units(self) -> dict[str, str]:
        """The unit of each parameter among them that is given when a path runs."""
        return {o.value.name: o.value.unit for o in self.operands if not o.known}

    def are_known(self, arguments: Collection[str] = ()) -> bool:
        """Tell whether all of them are numbers already, with those of parameters that are given."""
        return all(
            not operand.traced and (operand.known or operand.value.name in arguments)
            for operand in self.operands
        )

    def faults(self, read: Callable[[Operand], Any]) -> list[tuple[int, str]]:
        """Return what is wrong with what they do to light: for which path, and in words."""
        single = any(np.any(is_single(np, read(operand))) for operand in self.operands)
        tolerance = tolerance_of(float(np.finfo(np.float32).eps) if single else 0.0)
        with np.errstate(all="ignore"):
            if self.couplings[0].enters is None:
                kind = np.float32 if single else np.float64
                begun = [c.operations[0] for c in self.couplings if c.operations]
                return [one for each in begun for one in self._emission_faults(each, read, kind)]
            matrices = [coupling.matrix(self.method, read) for coupling in self.couplings]
            results = [one for m in matrices for one in self._matrix_faults(m, tolerance)]
            return results or self._sum_faults(matrices, tolerance)

    def _matrix_faults(self, matrices: Array, tolerance: float) -> list[tuple[int, str]]:
        several = matrices.reshape(-1, 4, 4)
        fine = np.isfinite(several).all(axis=(1, 2))
        problem = (
            "is not finite; keep divisors from 0 and roots from negative numbers, as in "
            "x / xp.where(d == 0.0, 1.0, d)"
        )
        if fine.all():
            if self.element.physical is False or (fine := are_passive(several, tolerance)).all():
                return []
            cure = f"mend its rows, to {cure_of(several, tolerance)} perhaps, or {_TAKEN}"
            problem = f"{problem_of(several[np.argmin(fine)], tolerance)}; {cure}"
        place = int(np.argmin(fine))
        rows = (", ".join(f"{number:.6g}" for number in row) for row in several[place])
        text = f"{self._named()} has the Mueller matrix ({'), ('.join(rows)}), which {problem}"
        return [(place, text)]

    def _sum_faults(self, matrices: list[Array], tolerance: float) -> list[tuple[int, str]]:
        """Say that several ways, of which each is one, let out more light than comes in."""
        if len(matrices) < 2 or self.element.physical is False:
            return []
        times = np.ravel(gain(sum(np.broadcast_arrays(*matrices), np.zeros((4, 4)))))
        if not np.any(times > 1.0 + tolerance):
            return []
        place = int(np.argmax(times))
        ports = listed([f"'{coupling.leaves}'" for coupling in self.couplings])
        text = (
            f"{self._named()} lets out up to {times[place]:.6g} times the light that comes in at "
            f"'{self.couplings[0].enters}', at {ports} together (M00 + |(M01, M02, M03)| of the "
            f"sum), as no passive element does; part it among them, or {_TAKEN}"
        )
        return [(place, text)]

    def _emission_faults(
        self, operation: Any, read: Callable[[Operand], Any], kind: Any
    ) -> list[tuple[int, str]]:
        if self.element.physical is False:
            return []
        numbers = operation.numbers(NUMPY, lambda a: read(operand_of(a)), self.method)
        lights = np.stack(np.broadcast_arrays(*numbers), axis=-1).reshape(-1, 4).astype(kind)
        faults: list[str] = []
        bad = np.flatnonzero(~_EMITTED.allows(lights))[:1].tolist()
        for place in bad:
            with ValueFault.collecting(faults):
                _EMITTED.check(f"the light of {self._named()}", lights[place])
        return [(place, fault) for place, fault in zip(bad, faults, strict=False)]

    def _named(self) -> str:
        name, text = type(self.element).__name__, shown(self.element)
        values = f", {text}" if self.are_known() and len(text) <= _LONGEST else ""
        return f"'{self.owner}' (element class {name}{values})"


def is_own(element_class: type[Any]) -> bool:
    """Tell whether a class of elements is a user's own."""
    return not element_class.__module__.startswith("optipath.")


def couplings_of(element: Any) -> tuple[Coupling, ...]:
    """Return the ways through an element."""
    if not is_own(type(element)):
        return tuple(element.couplings())
    what = f"couplings() of element class {type(element).__name__}"
    results: tuple[Coupling, ...] = called(what, lambda: tuple(element.couplings()))
    PathError.raise_for(_faults(what, element, results))
    return results


def _faults(what: str, element: Any, results: tuple[Any, ...]) -> Iterator[str]:
    if odd := [thing for coupling in results for thing in _misfits(coupling)]:
        yield (
            f"{what} gives {shown(odd[0])}; return a tuple of op.Coupling, each with a tuple of "
            f"op.Operation(kernel, (value, ...))"
        )
        return
    known = list[tuple[Any, Any]]()
    names = {parameter.name for parameter in element.parameters()}
    for coupling in results:
        way = enters, leaves = coupling.enters, coupling.leaves
        for word, port, which in (("from", enters, "inputs"), ("to", leaves, "outputs")):
            ports = getattr(element, which)
            if port not in ports and not (which == "inputs" and port is None):
                yield (
                    f"{what} lead {word} {shown(port)}; its {which} are "
                    f"{listed([shown(one) for one in ports]) or 'none'}, and mueller_rows lead "
                    f"from 'in' to 'out'; name one of these"
                )
        if way in known:
            yield f"{what} lead from {shown(enters)} to {shown(leaves)} more than once"
        known.append(way)
        for operation in coupling.operations:
            yield from _operation_faults(what, operation, names)


def _misfits(coupling: Any) -> Iterator[Any]:
    """Yield what is no coupling, operation or kernel, and stands where one must."""
    operations = coupling.operations if isinstance(coupling, Coupling) else None
    if not isinstance(operations, (tuple, list)):
        yield coupling if operations is None else operations
        return
    for operation in operations:
        if not isinstance(operation, Operation):
            yield operation
        elif not isinstance(operation.kernel, (Kernel, KernelFamily)):
            yield operation.kernel
        elif not isinstance(operation.arguments, (tuple, list)):
            yield operation.arguments


def _operation_faults(what: str, operation: Operation, names: set[str]) -> Iterator[str]:
    """Say whether an operation has values that its kernel takes."""
    kernel, values = operation.kernel, operation.arguments
    to = f"{what} give kernel '{kernel.name}'"
    inner = {id(value.operation): value.operation for value in values if type(value) is ResultOf}
    for behind in inner.values():
        yield from _operation_faults(what, behind, names)
    for value in values:
        operand = operand_of(value)
        if not operand.known and operand.value.name not in names:
            name = operand.value.name
            yield f"{to} parameter '{name}', which is in no field; give it to one as well"
        elif isinstance(value, (str, bytes)) or value is None:
            yield f"{to} {shown(value)}, which is no number; give a number or a parameter"
    takes = signature(kernel.by_method("stable").made_for(NUMPY))
    try:
        takes.bind(*values)
    except TypeError:
        yield f"{to} the values {shown(values)}; give as many as it takes, {takes}"


TURN = "azimuth"
"""The field that turns the frame, and is no value of a matrix."""

_OPTIONAL = ("physical", "straight")
"""What each element of a class may be given, with a domain; a class of one kind says it once."""


def class_faults(element_class: type[Any], base: type[Any], kind: Any) -> Iterator[str]:
    """Yield what is wrong with a class of elements of a user's own, a sentence each."""
    name = element_class.__name__
    if not isinstance(kind, str):
        yield f"the kind of element class {name} must be a text, not {shown(kind)}"
    own = {field.name: field.type for field in fields(element_class)}
    for field, annotation in own.items():
        if hasattr(base, field) and not (field in _OPTIONAL and annotation not in (bool, "bool")):
            what = "class Name(op.Element, kind=...)" if field == "kind" else f"{field}: ClassVar"
            yield (
                f"field '{field}' of element class {name} is called like what every element has; "
                f"write {what} where that is meant, or give it another name"
            )
    ports: list[str] = []
    for which in ("inputs", "outputs", "mirrored"):
        names, what = getattr(element_class, which), "fields" if which == "mirrored" else "ports"
        if which in own or (names is None and which == "mirrored"):
            continue
        if not isinstance(names, (tuple, list)) or not all(isinstance(n, str) for n in names):
            yield f"{which} of element class {name} must be names of {what}, not {shown(names)}"
        elif which != "mirrored":
            ports += names
        elif odd := [n for n in names if n == TURN or n not in own]:
            is_turn = odd[0] == TURN
            why = "whose links say how it is turned" if is_turn else "which is no field of it"
            yield f"mirrored of element class {name} names '{odd[0]}', {why}; take it out"
    for port in dict.fromkeys(port for port in ports if ports.count(port) > 1):
        yield f"element class {name} has several ports '{port}'; give each a name of its own"
    said = [which for which in ROWS if which in vars(element_class)]
    for which in said:
        values = [field for field in own if field != TURN]
        yield from _rows_faults(name, which, vars(element_class)[which], values)
    if len(said) > 1:
        yield f"element class {name} has {listed(said)}; take out mueller_rows, which follow"


ROWS = {"mueller_rows": 4, "jones_rows": 2}
"""What a class may say of its matrix, and how many rows that has."""


def _rows_faults(owner: str, which: str, rows: Any, names: list[str]) -> Iterator[str]:
    """Say what is wrong with the rows of a class whose fields are called so."""
    what = f"{which} of element class {owner}"
    function = rows.__func__ if isinstance(rows, staticmethod) else rows
    code = getattr(function, "__code__", None)
    first, *taken = code.co_varnames[: code.co_argcount] if code and code.co_argcount else ("",)
    if not callable(function) or isinstance(rows, classmethod) or first == "self":
        yield (
            f"{what} must be a static method that returns the rows; put @staticmethod before it, "
            f"and let it take xp and the number of each field: {which}(xp, ...)"
        )
    elif [name for name in names if name in taken] != [name for name in taken if name in names]:
        yield (
            f"{what} takes {listed(taken)}, but values come in the order of the fields, "
            f"{listed(names)}; take them in that order"
        )


_ROUNDINGS = 256.0
"""How many roundings of the largest entry an imaginary part may be that is taken for 0."""


@dataclass(frozen=True)
class RowsFactory:
    """Makes the function of a kernel; a class, so that plans can be pickled."""

    name: str
    rows_of: Callable[..., Any]
    which: str = "mueller_rows"

    def __call__(self, xp: Primitives) -> KernelFunction:
        """Return the function that gives the numbers of the matrix as its structure has them."""
        what = f"{self.which} of element class {self.name}"
        return guarded(what, lambda own: partial(self._numbers, what, own), xp)

    def _numbers(self, what: str, xp: Primitives, *values: Any) -> tuple[Any, ...]:
        paths = np.broadcast_shapes(*map(_shape, values))
        rows, count = self.rows_of(xp, *map(_unchanging, values)), ROWS[self.which]
        entries = _entries(what, rows, paths, count)
        if count == 2:
            entries = tuple(part for entry in entries for part in _parts(entry))
        for entry in entries:
            if entry is None or isinstance(entry, (str, bytes, list, tuple, dict)):
                raise PathError(f"{what} gives the entry {shown(entry)}; give numbers")
        if any(map(_is_complex, entries)):
            entries = _real(what, entries, values)
        for shape in filter(None, map(_shape, entries)):
            if len(shape) > len(paths) or broadcast_fault({"": shape, "paths": paths}):
                raise PathError(
                    f"{what} gives an entry of shape {shape} for paths of shape {paths}; compute "
                    f"each entry of its arguments alone, elementwise"
                )
        return (*mueller_of_jones(entries), *entries) if count == 2 else entries


def _parts(entry: Any) -> tuple[Any, ...]:
    """Return the real and the imaginary part of an entry, which may be given as such."""
    if isinstance(entry, (tuple, list)) and len(entry) == 2 and not any(map(_is_complex, entry)):
        return tuple(entry)
    return (entry.real, entry.imag) if _is_complex(entry) else (entry, 0.0)


def _unchanging(value: Any) -> Any:
    """Return a value that code of a user's own cannot write into; one number as a number."""
    if type(value) is not np.ndarray:
        return value
    if not value.ndim:
        return value[()]
    view = value.view()
    view.flags.writeable = False
    return view


def _shape(value: Any) -> tuple[int, ...]:
    return getattr(value, "shape", ())


def _entries(what: str, rows: Any, paths: tuple[int, ...], count: int) -> tuple[Any, ...]:
    """Return the entries of so many rows, which are for paths of a shape."""
    results = []
    if isinstance(rows, np.ndarray):
        _check_array(what, rows, paths, (count, count))
        rows = np.asarray(rows)
    try:
        # Each row before the next, which may be a generator that knows one at a time.
        for row in rows:
            _check_array(what, row, paths, (count,))
            results.append(tuple(row))
    except TypeError:
        results = []
    if [len(row) for row in results] != [count] * count:
        rule = f"{what} must return {_OF[count].format('rows of')}"
        raise PathError(f"{rule}, not {shown(rows)}")
    return tuple(entry for row in results for entry in row)


def _check_array(what: str, argument: Any, paths: tuple[int, ...], shape: tuple[int, ...]) -> None:
    """Refuse an array in place of rows, or of a row, that may have paths among its axes."""
    own = _shape(argument)
    # Of four paths, it may have the right shape all the same.
    if own and (paths or own != shape):
        raise PathError(
            f"{what} gives an array of shape {own}{' for many paths' if paths else ''}; return "
            f"{_OF[shape[0]].format('rows, tuples of')} each, which may be arrays over paths"
        )


_OF = {2: "two {} two entries", 4: "four {} four entries"}


def _is_complex(entry: Any) -> bool:
    kind = getattr(entry, "dtype", None)
    return isinstance(entry, complex) or (kind is not None and kind.kind == "c")


def _real(what: str, entries: tuple[Any, ...], values: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return the real parts of entries whose imaginary parts are 0 to rounding."""
    if not any(map(is_traced, entries)):
        kinds = {np.dtype(getattr(n, "dtype", np.float64)) for n in (*entries, *values)}
        rounding = max(float(np.finfo(kind).eps) for kind in kinds if kind.kind in "fc")
        numbers = np.array(np.broadcast_arrays(*entries), complex)
        off = np.abs(numbers.imag) > _ROUNDINGS * rounding * np.abs(numbers).max(axis=0)
        if off.any():
            place = int(np.nonzero(off)[0][0])
            raise PathError(
                f"{what} gives the complex entry [{place // 4}][{place % 4}] = "
                f"{shown(entries[place])}; a Mueller matrix is real: return .real, or abs(z)**2, "
                f"where that is what is meant"
            )
    return tuple(entry.real if _is_complex(entry) else entry for entry in entries)


def rows_kernel(element_class: type[Any], which: str) -> Kernel:
    """Return the kernel of an element that gives the rows of its Mueller or Jones matrix."""
    name, rows_of = element_class.__name__, vars(element_class)[which]
    function = rows_of.__func__ if isinstance(rows_of, staticmethod) else rows_of
    structure = JONES if which == "jones_rows" else FULL
    return Kernel(element_class.kind or name, structure, RowsFactory(name, function, which))


def coupling_by_rows(element: Any, kernel: Kernel) -> Coupling:
    """Return the way from ``in`` to ``out`` of an element that gives its rows."""
    fields = [(getattr(element, name), d) for name, d in element.domains().items() if name != TURN]
    numbers = tuple(number for value, domain in fields for number in numbers_of(value, domain))
    return Coupling("in", "out", (Operation(kernel, numbers),))


@cache
def domains_of(element_class: type[Any]) -> dict[str, Domain]:
    """Return the annotated domain of each field in order; by default a real number, or a bool."""
    try:
        hints = get_type_hints(element_class, include_extras=True)
    except NameError as error:
        raise PathError(
            f"the annotations of element class {element_class.__name__} cannot be read: {error}; "
            f"import it where the module runs, not for type checking alone"
        ) from None
    # The base of all elements is no dataclass, and has no fields.
    own = fields(element_class) if is_dataclass(element_class) else ()
    results: dict[str, Domain] = {}
    faults: list[str] = []
    for name in [field.name for field in own]:
        with OptipathError.collecting(
            faults, about=f"field '{name}' of element class {element_class.__name__}"
        ):
            results[name] = _domain(hints[name])
    PathError.raise_for(faults)
    return results


def _domain(hint: Any) -> Domain:
    """Return the domain that an annotation says, narrowed by ranges."""
    parts = list(_annotations(hint))
    usual = YES_OR_NO if getattr(hint, "__origin__", hint) is bool else REAL
    domain = next((part for part in parts if isinstance(part, Domain)), usual)
    for part in parts:
        if isinstance(part, Within):
            domain = part.narrowed(domain)
        elif _is_meant_as_range(part):
            what = "Within" if part is Within else shown(part)
            raise ValueFault(f"{what} says no range; write op.fields.Within(least, most)")
    return domain


def _annotations(hint: Any) -> Iterator[Any]:
    yield hint
    for part in get_args(hint):
        yield from _annotations(part)


def _is_meant_as_range(part: Any) -> bool:
    """Tell whether something beside a type is meant as a range, as those of others may be."""
    ends = [end for end in ("ge", "gt", "le", "lt") if getattr(part, end, None) is not None]
    return part is Within or isinstance(part, (range, slice, tuple, list)) or bool(ends)


def same_value(first: Any, second: Any, domain: Domain) -> bool:
    """Tell whether two values of a field are equal, however an index is written."""
    each = domain.of_entries if isinstance(domain, RowDomain) else None
    if each is not None and isinstance(first, tuple) and isinstance(second, tuple):
        pairs = zip(first, second, strict=False)
        return len(first) == len(second) and all(same_value(*pair, each) for pair in pairs)
    if same(first, second) or not domain.complex_parts:
        return same(first, second)
    pairs = zip(numbers_of(first, domain), numbers_of(second, domain), strict=True)
    return all(same(*pair) for pair in pairs)
