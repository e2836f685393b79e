"""Elements of a user's own: checks of their classes, fields, matrices and couplings."""

from __future__ import annotations

from dataclasses import dataclass, fields, is_dataclass
from decimal import Decimal
from fractions import Fraction
from functools import cache, partial
from inspect import signature
from typing import TYPE_CHECKING, Any, get_args, get_type_hints

import numpy as np

from optipath.elements.coupling import Coupling, numbers_of
from optipath.errors import PathError, ValueFault, listed, shown
from optipath.kernels.carriers.structures import FULL
from optipath.kernels.kernel import Kernel, KernelFamily, called, guarded
from optipath.kernels.primitives import NUMPY
from optipath.light.decompositions import stacked, tolerance_of
from optipath.light.passive import are_passive, cure_of, gain, problem_of
from optipath.materials.index_domains import RowDomain
from optipath.materials.quantities import REAL, YES_OR_NO
from optipath.values.agreement import is_single
from optipath.values.arrays import as_argument, same
from optipath.values.domains import Domain, StokesDomain
from optipath.values.jax_values import is_traced
from optipath.values.operands import Operand, Operation, ResultOf, operand_of
from optipath.values.parameters import Parameter

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
        open_ones = [operand.value for operand in self.operands if not operand.known]
        return {parameter.name: parameter.unit for parameter in open_ones}

    def are_known(self, arguments: Collection[str] = ()) -> bool:
        """Tell whether all of them are numbers already, with those of parameters that are given."""
        return all(
            not operand.traced and (operand.known or operand.value.name in arguments)
            for operand in self.operands
        )

    def faults(self, read: Callable[[Operand], Any]) -> list[tuple[int, str]]:
        """Return what is wrong with what they do to light: for which path, and in words."""
        rounding = self._rounding(read)
        tolerance = tolerance_of(rounding)
        matrices: list[Array] = []
        results: list[tuple[int, str]] = []
        for coupling in self.couplings:
            with np.errstate(all="ignore"):
                light = self._emitted(coupling, read)
                matrix = self._matrix(coupling, read) if light is None else None
            if light is not None:
                results += self._emission_faults(light.astype(np.float32) if rounding else light)
            if matrix is not None:
                matrices.append(matrix)
                results += self._matrix_faults(matrix.reshape(-1, 4, 4), tolerance)
        return results or self._sum_faults(matrices, tolerance)

    def _rounding(self, read: Callable[[Operand], Any]) -> float:
        """Return that of single precision where a number has been rounded so; else 0."""
        single = any(np.any(is_single(np, read(operand))) for operand in self.operands)
        return float(np.finfo(np.float32).eps) if single else 0.0

    def _emitted(self, coupling: Coupling, read: Callable[[Operand], Any]) -> Any:
        """Return the light that begins here, shape (..., 4); None where none does."""
        if coupling.enters is not None or not coupling.operations:
            return None
        numbers = self._numbers(coupling.operations[0], read)
        return np.stack(np.broadcast_arrays(*numbers), axis=-1).astype(np.float64)

    def _numbers(self, operation: Any, read: Callable[[Operand], Any]) -> tuple[Any, ...]:
        return operation.numbers(NUMPY, lambda a: read(operand_of(a)), self.method)  # type: ignore[no-any-return]

    def _matrix(self, coupling: Coupling, read: Callable[[Operand], Any]) -> Array | None:
        """Return the Mueller matrix of one way; None where it is none."""
        matrix: Any = np.eye(4)
        for operation in coupling.operations:
            structure = operation.kernel.by_method(self.method).structure
            if structure is None:
                return None
            rows = structure.rows(NUMPY, self._numbers(operation, read))
            matrix = stacked(rows) @ matrix
        return matrix  # type: ignore[no-any-return]

    def _matrix_faults(self, several: Array, tolerance: float) -> list[tuple[int, str]]:
        finite = np.isfinite(several).all(axis=(1, 2))
        if not finite.all():
            place = int(np.argmin(finite))
            text = (
                f"{self._with_matrix(several[place])}, which is not finite; keep divisors from 0 "
                f"and roots from negative numbers, as in x / xp.where(d == 0.0, 1.0, d)"
            )
            return [(place, text)]
        if self.element.physical is False or (passive := are_passive(several, tolerance)).all():
            return []
        place = int(np.argmin(passive))
        problem, cure = problem_of(several[place], tolerance), cure_of(several, tolerance)
        text = f"{self._with_matrix(several[place])}, which {problem}; mend its rows, to {cure}"
        return [(place, f"{text} perhaps, or {_TAKEN}")]

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

    def _emission_faults(self, stokes: Array) -> list[tuple[int, str]]:
        if self.element.physical is False:
            return []
        bad = np.flatnonzero(~_EMITTED.allows(stokes.reshape(-1, 4)))
        for place in bad[:1]:
            try:
                _EMITTED.check(f"the light of {self._named()}", stokes.reshape(-1, 4)[place])
            except ValueFault as fault:
                return [(int(place), str(fault))]
        return []

    def _with_matrix(self, matrix: Array) -> str:
        rows = (", ".join(f"{number:.6g}" for number in row) for row in matrix)
        return f"{self._named()} has the Mueller matrix ({'), ('.join(rows)})"

    def _named(self) -> str:
        name, text = type(self.element).__name__, shown(self.element)
        values = f", {text}" if self.are_known() and len(text) <= _LONGEST else ""
        return f"'{self.owner}' (element class {name}{values})"


def is_own(element_class: type[Any]) -> bool:
    """Tell whether a class of elements is a user's own."""
    return not element_class.__module__.startswith("optipath.")


def couplings_of(element: Any) -> tuple[Coupling, ...]:
    """Return the ways through an element."""
    what = f"couplings() of element class {type(element).__name__}"
    results: tuple[Coupling, ...] = called(what, lambda: tuple(element.couplings()))
    if is_own(type(element)) and (faults := list(_faults(what, element, results))):
        raise PathError(*faults)
    return results


def _faults(what: str, element: Any, results: tuple[Any, ...]) -> Iterator[str]:
    known = list[tuple[Any, Any]]()
    for coupling in results:
        if not isinstance(coupling, Coupling):
            yield f"{what} gives {shown(coupling)}; return a tuple of op.Coupling"
            continue
        enters, leaves = way = (coupling.enters, coupling.leaves)
        if enters is not None and enters not in element.inputs:
            yield f"{what} lead from {shown(enters)}; {_ports('inputs', element.inputs, enters)}"
        if leaves not in element.outputs:
            yield f"{what} lead to {shown(leaves)}; {_ports('outputs', element.outputs, leaves)}"
        if way in known:
            yield (
                f"{what} lead from {shown(enters)} to {shown(leaves)} more than once; give one "
                f"op.Coupling for each way"
            )
        known.append(way)
        operations = coupling.operations
        if not isinstance(operations, (tuple, list)) or not all(
            isinstance(operation, Operation) for operation in operations
        ):
            yield (
                f"{what} give the operations {shown(operations)}; give a tuple of op.Operation: "
                f"those of another element are element.couplings()[0].operations"
            )
            continue
        names = {parameter.name for parameter in element.parameters()}
        for operation in operations:
            yield from _operation_faults(what, operation, names)


def _operation_faults(what: str, operation: Operation, names: set[str]) -> Iterator[str]:
    """Say whether an operation has a kernel, and values that this takes."""
    kernel, values = operation.kernel, operation.arguments
    if not isinstance(kernel, (Kernel, KernelFamily)):
        yield (
            f"{what} give op.Operation the kernel {shown(kernel)}; give an "
            f"optipath.kernels.kernel.Kernel: that of another element is "
            f"element.couplings()[0].operations[0].kernel"
        )
        return
    to = f"{what} give kernel '{kernel.name}'"
    if not isinstance(values, (tuple, list)):
        yield f"{to} the values {shown(values)}; give a tuple"
        return
    inner = {id(value.operation): value.operation for value in values if type(value) is ResultOf}
    for behind in inner.values():
        yield from _operation_faults(what, behind, names)
    yield from (f"{to} {fault}" for value in values if (fault := _value_fault(value, names)))
    takes = signature(kernel.by_method("stable").made_for(NUMPY))
    try:
        takes.bind(*values)
    except TypeError:
        yield f"{to} the values {shown(values)}; give as many as it takes, {takes}"


def _value_fault(value: Any, names: set[str]) -> str:
    """Say what is wrong with a value for a kernel, given the parameters of the element."""
    operand = operand_of(value)
    if not operand.known and operand.value.name not in names:
        return f"parameter '{operand.value.name}', which is in no field; give it to one as well"
    if isinstance(value, (float, Parameter, Operand, ResultOf)) or is_traced(value):
        return ""
    if as_argument("a value for a kernel", value, PathError).dtype.kind in "biufc":
        return ""
    return f"{shown(value)}, which is no number; give a number or a parameter"


def _ports(which: str, ports: tuple[str, ...], port: Any) -> str:
    """Say which ports there are, and how another comes to be one."""
    there = f"are {listed([shown(each) for each in ports])}" if ports else "are none"
    return (
        f"its {which} {there}: name one of these in op.Coupling, or say {which} = "
        f"({shown(port)}, ...) in the class (mueller_rows lead from 'in' to 'out')"
    )


TURN = "azimuth"
"""The field that turns the frame, and is no value of a matrix."""

_MEANT = {
    "kind": 'write class Name(op.Element, kind="..."), or ',
    "inputs": "write inputs: ClassVar[tuple[str, ...]], or ",
    "outputs": "write outputs: ClassVar[tuple[str, ...]], or ",
    "natural": "write natural: ClassVar[str], or ",
    "physical": "write physical: ClassVar[bool], or ",
    "straight": "write straight: ClassVar[bool], or ",
    "mirrored": "write mirrored: ClassVar[tuple[str, ...]], or ",
}
"""What is meant by fields that are called like what every element has."""

_OPTIONAL = ("physical", "straight")
"""What each element of a class may be given, with a domain; a class of one kind says it once."""


def _is_name(port: Any) -> bool:
    return isinstance(port, str)


def _are_names(ports: Any) -> bool:
    return isinstance(ports, (tuple, list)) and all(map(_is_name, ports))


_PORTS = (
    ("inputs", "the names of ports, such as ('in',)", _are_names),
    ("outputs", "the names of ports, such as ('out',)", _are_names),
    ("natural", "the name of a port", _is_name),
    ("entry", "the name of a port", _is_name),
)


def class_faults(element_class: type[Any], base: type[Any], kind: Any) -> list[str]:
    """Return what is wrong with a class of elements, a sentence each."""
    return [*_faults_of_class(element_class, base, kind)]


def _faults_of_class(element_class: type[Any], base: type[Any], kind: Any) -> Iterator[str]:
    name = element_class.__name__
    if not isinstance(kind, str):
        yield f"the kind of element class {name} must be a text, not {shown(kind)}"
    own = {field.name: field.type for field in fields(element_class)}
    for field, annotation in own.items():
        if hasattr(base, field) and not (field in _OPTIONAL and annotation not in (bool, "bool")):
            yield (
                f"field '{field}' of element class {name} is called like what every element has; "
                f"{_MEANT.get(field, '')}give it another name"
            )
    for which, what, is_right in _PORTS:
        if which not in own and not is_right(value := getattr(element_class, which)):
            yield f"{which} of element class {name} must be {what}, not {shown(value)}"
    if (said := vars(element_class).get("mirrored")) is not None and "mirrored" not in own:
        yield from _mirrored_faults(name, said, [field for field in own if field != TURN])
    if "mueller_rows" in vars(element_class):
        names = [field for field in own if field != TURN]
        yield from _rows_faults(name, vars(element_class)["mueller_rows"], names)


def _mirrored_faults(owner: str, said: Any, names: list[str]) -> Iterator[str]:
    """Say which of the fields that change their sign on the way back are none."""
    if not _are_names(said):
        yield f"mirrored of element class {owner} must be names of fields, not {shown(said)}"
        return
    for name in (name for name in said if name not in names):
        why = "whose links say how it is turned" if name == TURN else "which is none of its fields"
        yield f"mirrored of element class {owner} names '{name}', {why}; take it out"


def _rows_faults(owner: str, rows: Any, names: list[str]) -> Iterator[str]:
    """Say what is wrong with `mueller_rows` of a class whose fields are called so."""
    what = f"mueller_rows of element class {owner}"
    static = "put @staticmethod before it, and let it take xp and the number of each field"
    function = rows.__func__ if isinstance(rows, (staticmethod, classmethod)) else rows
    if not callable(function):
        yield f"{what} is {shown(rows)}; make it a static method that returns the rows"
        return
    code = getattr(function, "__code__", None)
    first, *taken = code.co_varnames[: code.co_argcount] if code and code.co_argcount else ("",)
    if isinstance(rows, classmethod):
        yield f"{what} is a class method; {static} in place of @classmethod: mueller_rows(xp, ...)"
    elif first == "self":
        yield f"{what} takes self; {static}: mueller_rows(xp, ...)"
    else:
        arguments = [name for name in names if name in taken]
        if arguments != [name for name in taken if name in names]:
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

    def __call__(self, xp: Primitives) -> KernelFunction:
        """Return the function that gives the sixteen numbers of the matrix."""
        what = f"mueller_rows of element class {self.name}"
        return guarded(what, xp, lambda own: partial(self._numbers, what, own))

    def _numbers(self, what: str, xp: Primitives, *values: Any) -> tuple[Any, ...]:
        entries = _entries(what, self.rows_of(xp, *map(_unchanging, values)), values)
        _check_shapes(what, entries, values)
        return entries


def _unchanging(value: Any) -> Any:
    """Return a value that code of a user's own cannot write into; one number as a number."""
    if type(value) is not np.ndarray:
        return value
    if not value.ndim:
        return value[()]
    view = value.view()
    view.flags.writeable = False
    return view


def _check_shapes(what: str, entries: tuple[Any, ...], values: tuple[Any, ...]) -> None:
    """Refuse arrays that are not over the paths that the values are given for."""
    shapes = {entry.shape for entry in entries if getattr(entry, "shape", ())}
    if not shapes:
        return
    paths = np.broadcast_shapes(*(getattr(value, "shape", ()) for value in values))
    wrong = [shape for shape in shapes if not _is_within(shape, paths)]
    if wrong:
        of_paths = f"for paths of shape {paths}" if paths else "for one path"
        raise PathError(
            f"{what} gives an entry of shape {wrong[0]} {of_paths}; compute each entry of its "
            f"arguments alone, elementwise"
        )


def _is_within(shape: tuple[int, ...], paths: tuple[int, ...]) -> bool:
    try:
        return np.broadcast_shapes(shape, paths) == paths
    except ValueError:
        return False


def _entries(what: str, rows: Any, values: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return the sixteen numbers of four rows, which are for the paths of some values."""
    if isinstance(rows, np.ndarray):
        _check_array(what, rows, values, (4, 4))
        rows = np.asarray(rows)
    try:
        results = []
        # Each row before the next, which may be a generator that knows one at a time.
        for row in rows:
            _check_array(what, row, values, (4,))
            results.append(tuple(row))
    except TypeError:
        results = []
    if len(results) != 4 or any(len(row) != 4 for row in results):
        raise PathError(f"{what} must return four rows of four entries, not {shown(rows)}")
    entries = tuple(entry for row in results for entry in row)
    if any(map(_is_complex, entries)):
        return _real(what, entries, _rounding(entries + values))
    for entry in entries:
        if entry is None or isinstance(entry, (str, bytes, list, tuple, dict, Decimal, Fraction)):
            raise PathError(f"{what} gives the entry {shown(entry)}; give numbers")
    return entries


def _check_array(what: str, argument: Any, values: tuple[Any, ...], shape: tuple[int, ...]) -> None:
    """Refuse an array in place of rows, or of a row, that may have paths among its axes."""
    own = getattr(argument, "shape", ())
    many = " for many paths" if any(getattr(value, "shape", ()) for value in values) else ""
    # Of four paths, it may have the right shape all the same.
    if own and (many or own != shape):
        raise PathError(
            f"{what} gives an array of shape {own}{many}; return four rows, tuples of four "
            f"entries each, which may be arrays over paths"
        )


def _is_complex(entry: Any) -> bool:
    if type(entry) is float:
        return False
    kind = getattr(entry, "dtype", None)
    return isinstance(entry, complex) or (kind is not None and kind.kind == "c")


def _rounding(numbers: tuple[Any, ...]) -> float:
    """Return the rounding of the coarsest of numbers; those without a type are doubles."""
    kinds = {np.dtype(getattr(number, "dtype", np.float64)) for number in numbers}
    return max(float(np.finfo(kind).eps) for kind in kinds if kind.kind in "fc")


def _real(what: str, entries: tuple[Any, ...], rounding: float) -> tuple[Any, ...]:
    """Return the real parts of entries whose imaginary parts are 0 to rounding."""
    if not any(map(is_traced, entries)):
        sizes = np.broadcast_arrays(*[np.abs(entry) for entry in entries])
        largest = np.max(sizes, axis=0)
        for place, entry in enumerate(entries):
            if np.any(abs(np.imag(entry)) > _ROUNDINGS * rounding * largest):
                row, column = divmod(place, 4)
                raise PathError(
                    f"{what} gives the complex entry [{row}][{column}] = {shown(entry)}; a Mueller "
                    f"matrix is real: return .real, or abs(z)**2, where that is what is meant"
                )
    return tuple(entry.real if _is_complex(entry) else entry for entry in entries)


def rows_kernel(name: str, class_name: str, rows_of: Any) -> Kernel:
    """Return the kernel of an element that gives the rows of its Mueller matrix."""
    function = rows_of.__func__ if isinstance(rows_of, staticmethod) else rows_of
    return Kernel(name or class_name, FULL, RowsFactory(class_name, function))


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
    plain = {f.name: YES_OR_NO if hints[f.name] is bool else REAL for f in own}
    return {name: next(_annotated(hints[name]), domain) for name, domain in plain.items()}


def _annotated(hint: Any) -> Iterator[Domain]:
    for part in get_args(hint):
        if isinstance(part, Domain):
            yield part
        else:
            yield from _annotated(part)


def same_value(first: Any, second: Any, domain: Domain) -> bool:
    """Tell whether two values of a field are equal, however an index is written."""
    listed = domain.of_entries if isinstance(domain, RowDomain) else None
    if listed is not None and isinstance(first, tuple) and isinstance(second, tuple):
        return len(first) == len(second) and all(
            same_value(one, other, listed) for one, other in zip(first, second, strict=True)
        )
    if same(first, second) or not domain.complex_parts:
        return same(first, second)
    pairs = zip(numbers_of(first, domain), numbers_of(second, domain), strict=True)
    return all(same(one, other) for one, other in pairs)
