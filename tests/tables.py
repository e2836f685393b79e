"""Tables inside one test: every row is looked at, and every row that fails is reported."""

import functools
import inspect

import pytest

FAULTS = (Exception, BaseExceptionGroup, pytest.fail.Exception)


def rows(names, table):
    """Call a test once for each row of a table, as ``pytest.mark.parametrize`` does, in one item.

    The test fails with all rows that fail, each with its values. Rows share their fixtures: those
    that need a folder, a patch or captured output of their own stay with ``parametrize``, as those
    that a mark skips do. A test is skipped where all of its rows are.
    """
    keys = [name.strip() for name in names.split(",")] if isinstance(names, str) else list(names)
    table = list(table)
    assert table, "a table without a row tests nothing"

    def over_rows(test):
        @functools.wraps(test)
        def tabled(**fixtures):
            failed, skipped = [], []
            for number, row in enumerate(table):
                values = (row,) if len(keys) == 1 else row
                given = dict(zip(keys, values, strict=True))
                try:
                    test(**given, **fixtures)
                except pytest.skip.Exception as skip:
                    skipped.append(skip)
                except FAULTS as fault:
                    fault.add_note(f"row {number}: {given}")
                    failed.append(fault)
            if len(skipped) == len(table):
                raise skipped[0]
            if failed:
                raise BaseExceptionGroup(f"{len(failed)} of {len(table)} rows fail", failed)

        signature = inspect.signature(test)
        left = [p for name, p in signature.parameters.items() if name not in keys]
        tabled.__signature__ = signature.replace(parameters=left)
        return tabled

    return over_rows


def slow_except(quick, every):
    """Return the values of ``parametrize``, those that are not among the quick ones marked slow."""
    return [one if one in quick else slow(one) for one in every]


def slow(one):
    """Return a value of ``parametrize``, or a row of values, that is slow."""
    values = one if isinstance(one, tuple) else (one,)
    return pytest.param(*values, marks=pytest.mark.slow)
