"""Values that nobody means to give, as the texts of Python expressions, and for files and lines."""

import decimal
import fractions
import inspect
import warnings
from contextlib import suppress

import numpy as np

import optipath as op

NAMES = {"np": np, "op": op, "inf": np.inf, "nan": np.nan}
NAMES |= {"Decimal": decimal.Decimal, "Fraction": fractions.Fraction}


def parted(text):
    """Return the parts of a text between bars."""
    return text.split(" | ")


def one_of(rng, text):
    """Return one of the parts of a text between bars."""
    return rng.choice(parted(text))


SIZES = parted("0 | 1 | 2 | 3 | 2, 1 | 1, 2 | 2, 3 | 0, 2 | 1, 1, 1, 1")
KINDS = parted("f2 | f4 | f8 | g | >f8 | c8 | c16 | i1 | u8 | ? | U3 | O | M8[s] | S2")
TEXTS = ["", " ", "\x1b[2J", "\x00", "\u202e", "9" * 5000, "1+" * 500]
TEXTS += parted("deg | 45 deg | 45deg | 45 ° | 0.3 rad | 0.5 turns | 90 mm | none | nan deg | inf")
TEXTS += parted("1e999 | -0 deg | 1e-400 deg | 0x10 | 1_000 | ٣ | 1,5 | 1+2i | 1.5+3j | j | $x")
TEXTS += parted("horizontal | é | 🙂 | [red]x[/red]")


def a_number(rng):
    """Return the text of a float, often one next to a place where methods fail."""
    match rng.randrange(5):
        case 0:
            return repr(rng.uniform(-2.0, 2.0))
        case 1:
            return one_of(rng, "0.0 | -0.0 | 1.0 | np.pi / 2 | np.pi | -1.0 | 1.5 | 2.0 | 1e5 | 48")
        case 2:
            place = one_of(rng, "np.pi / 2 | np.arctan(1.5) | np.arcsin(1 / 1.5) | 1.0")
            return f"{place} {rng.choice('+-')} {10.0 ** rng.uniform(-17, -1)!r}"
        case 3:
            return repr(rng.choice([1, -1]) * 10.0 ** rng.uniform(-320, 308))
    return one_of(rng, "nan | inf | -inf | 5e-324 | 1.7976931348623157e308 | 2**200 | 10**400")


ODD = parted("None | True | b'1' | {} | set() | object() | float | [[1], [1, 2]] | range(3) | ...")
ODD += parted("Decimal('0.5') | Fraction(1, 3) | 'x' * 10**5 | np.ma.masked_array([1.0], [True])")
ODD += parted("np.matrix([[1.0]]) | op.Material(1.5, 2) | op.Parameter('x') | (i for i in [1])")
ODD += parted("np.zeros((1,) * 40) | np.array([None]) | [None] | slice(1) | {'n': 1}")


def a_value(rng):
    """Return the text of anything that might be given for a number."""
    number = a_number(rng)
    match rng.randrange(12):
        case 0 | 1 | 2 | 3:
            return number
        case 4:
            kind = one_of(rng, "float32 | float64 | longdouble | float16 | complex128")
            return f"np.{kind}({number})"
        case 5:
            return f"[{number}, {a_number(rng)}]"
        case 6:
            return f"np.full(({rng.choice(SIZES)},), {number})"
        case 7:
            return f"np.zeros(({rng.choice(SIZES)},), {rng.choice(KINDS)!r})"
        case 8:
            return repr(rng.choice(TEXTS))
        case 9:
            return f"op.CosSin({number}, {a_number(rng)})"
        case 10:
            return f"complex({number}, {a_number(rng)})"
    return rng.choice(ODD)


def toml_value(rng, depth=0):
    """Return the text of any value that a TOML file may have."""
    match rng.randrange(9 if depth < 3 else 6):
        case 0:
            return one_of(rng, "0 | 1 | -1 | 1.5 | 45 | -0.0 | 1e308 | 1e999999 | inf | nan")
        case 1:
            return one_of(rng, f"true | false | 0x10 | {'9' * 5000} | 1979-05-27 | 07:32:00 | 1_0")
        case 2 | 3:
            plain = " +-.$[]/"
            letters = (
                c if c.isalnum() or c in plain else f"\\u{ord(c) & 0xD7FF:04x}"
                for c in rng.choice(TEXTS)
            )
            return f'"{"".join(letters)}"'
        case 4:
            return one_of(rng, '"$theta" | "-$theta" | "$" | "0 deg" | "1e-3 mm" | [] | {}')
        case 5:
            return repr(rng.choice([1, -1]) * 10.0 ** rng.uniform(-320, 308))
        case 6 | 7:
            several = (toml_value(rng, depth + 1) for _ in range(rng.randrange(4)))
            return f"[{', '.join(several)}]"
    keys = rng.sample(parted("n | k | re | im | cos | sin | parameter | x"), rng.randrange(3))
    return "{ " + ", ".join(f"{key} = {toml_value(rng, depth + 1)}" for key in keys) + " }"


def taken(rng, function, share):
    """Return the names of what a function must be given, and of some that it may be."""
    return [
        name
        for name, p in inspect.signature(function).parameters.items()
        if p.kind not in (p.VAR_KEYWORD, p.VAR_POSITIONAL)
        and (p.default is p.empty or rng.random() < share)
    ]


def given(rng, names, value=a_value):
    """Return a value for each name, and the texts of all, to be given again."""
    texts, values = {}, {}
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        for name in names:
            while name not in values:
                texts[name] = value(rng)
                with suppress(ArithmeticError, ValueError, TypeError, op.OptipathError):
                    # Some make no value, such as an integer that no float holds.
                    values[name] = eval(texts[name], dict(NAMES))  # noqa: S307 - made above
    return ", ".join(f"{name}={text}" for name, text in texts.items()), values
