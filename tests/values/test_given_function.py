from optipath.values.given_function import no_function


def test_functions_and_none_are_let_through():
    assert no_function("progress", print, "") == no_function("progress", None, "") == []


def test_what_is_no_function_is_told_with_its_cure():
    assert no_function("progress", 3, "numbers") == ["progress is 3; give a function of numbers"]
