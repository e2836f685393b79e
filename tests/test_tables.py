import pytest

from tables import rows


def test_every_row_is_looked_at_and_every_row_that_fails_is_reported():
    seen = []

    @rows("a, b", [(1, 1), (1, 2), (3, 3), (3, 4)])
    def equal(a, b):
        seen.append((a, b))
        assert a == b

    with pytest.raises(BaseExceptionGroup, match="2 of 4 rows fail") as caught:
        equal()
    assert seen == [(1, 1), (1, 2), (3, 3), (3, 4)]
    notes = [fault.__notes__ for fault in caught.value.exceptions]
    assert notes == [["row 1: {'a': 1, 'b': 2}"], ["row 3: {'a': 3, 'b': 4}"]]


@rows("power", [0, 1, 2])
@rows(("base", "product"), [(2, [1, 2, 4]), (3, [1, 3, 9])])
def test_tables_multiply_and_leave_fixtures_to_pytest(base, product, power, tmp_path):
    assert base**power == product[power]
    assert tmp_path.is_dir()


def test_a_test_is_skipped_where_all_of_its_rows_are():
    seen = []

    def even(number):
        if number % 2:
            pytest.skip("odd")
        seen.append(number)

    rows("number", [0, 1, 2])(even)()
    assert seen == [0, 2]
    with pytest.raises(pytest.skip.Exception, match="odd"):
        rows("number", [1, 3])(even)()


def test_a_row_in_which_nothing_is_refused_fails():
    @rows("text", ["1", "one"])
    def refused(text):
        with pytest.raises(ValueError, match="invalid"):
            int(text)

    with pytest.raises(BaseExceptionGroup, match="1 of 2 rows fail"):
        refused()
