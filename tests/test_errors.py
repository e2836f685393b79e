"""Errors: they travel between processes, and quote whatever was given in one short line."""

import copy
import inspect
import pickle
from multiprocessing import get_context

import pytest

import optipath as op
from failing import fails
from optipath import errors
from tables import rows

KINDS = [
    kind
    for kind in vars(errors).values()
    if inspect.isclass(kind) and issubclass(kind, BaseException)
]
COPIES = [lambda error: pickle.loads(pickle.dumps(error)), copy.copy, copy.deepcopy]


class OddError(op.OptipathError):
    """An error that is made of something else than its sentence."""

    def __init__(self, *, number):
        super().__init__(f"number {number} is odd", "give an even one")
        self.number = number


def made(kind):
    # One is made of what is missing, all others of sentences.
    return kind("plots", "matplotlib", "plot")


@rows("error", [*map(made, KINDS), OddError(number=3)])
def test_an_error_is_the_same_after_a_copy(error):
    error.add_note("while it was looked at")
    for copied in COPIES:
        again = copied(error)
        assert type(again) is type(error)
        assert (str(again), again.args) == (str(error), error.args)
        assert again.__dict__ == error.__dict__


def test_an_error_comes_out_of_another_process():
    told = pytest.raises(errors.MissingExtraError, match=r"optipath\[plot\]")
    with get_context("spawn").Pool(1) as pool, told:
        pool.apply_async(fails).get(timeout=60)


class Unprintable:
    def __repr__(self):
        raise RuntimeError("no")


class Colours:
    def __repr__(self):
        return "\x1b[31mred\x1b[0m\nand more\u202e"


def within_itself():
    found = []
    found.append(found)
    return found


def deep():
    found = []
    for _ in range(100_000):
        found = [found]
    return found


@rows(
    "value",
    [
        Unprintable(),
        [Unprintable()] * 1000,
        Colours(),
        "x" * 10**6,
        "\x1b[2J",
        10**5000,
        list(range(10**6)),
        within_itself(),
        deep(),
        {n: n for n in range(1000)},
        b"\x00" * 10**6,
        Unprintable,
        None,
    ],
)
def test_whatever_is_quoted_is_short_and_on_one_line(value):
    text = errors.shown(value)
    assert 0 < len(text) <= 62
    assert text.isprintable()


def test_sentences_quote_60_characters_and_names_of_files_whole():
    assert [errors.shown(v) for v in (1.5, "a", [0.1, None], 1 + 2j)] == [
        "1.5",
        "'a'",
        "[0.1, None]",
        "(1+2j)",
    ]
    for quoted in ("'" + 5000 * "x" + "'", '"' + 900 * "a b " + '"', 5000 * "y"):
        told = str(op.OptipathError(f"word {quoted} is unknown; did you mean 'x'?"))
        first, _, rest = told.removeprefix("word ").partition(" is unknown")
        assert len(first) <= 62
        assert rest == "; did you mean 'x'?"
    told = f"'/home/{100 * 'a'}/b.toml' cannot be read"
    assert str(op.OptipathError(told)) == told
    told = str(op.OptipathError("kind 'so\turce' is \x00unknown\r\n"))
    assert told == r"kind 'so\turce' is \x00unknown\r\n"


def test_20_faults_are_listed_and_others_are_counted():
    error = op.PathError(*[f"fault {number}" for number in range(20_000)])
    first, *listed, last = str(error).splitlines()
    assert first == "20000 faults:"
    assert listed == [f"- fault {number}" for number in range(20)]
    assert last == "and 19,980 more"
    assert len(error.faults) == 20_000
