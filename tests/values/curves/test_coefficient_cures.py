"""What a curve comes to that nothing has is told with the coefficients that are to blame."""

import numpy as np
import pytest

import optipath as op
from tables import rows

P = op.Parameter


def path_of(material):
    return op.Source() >> op.Interface(material, 0.3) >> op.Detector()


def told(path, **given):
    with pytest.raises(op.ParameterError) as fault:
        path.trace(wavelength="500 nm", **given)
    return str(fault.value)


def test_a_broadening_above_its_limit_is_told_once_with_both_parameters():
    film = op.Material.tauc_lorentz([[90, 3.4, 2.0, 1.2], [100, P("E0"), P("C"), 1.2]])
    assert told(path_of(film), E0=3.0, C=6.5) == (
        "oscillators[1] of a Tauc-Lorentz model has the broadening 6.5 (parameter 'C') and the "
        "energy 3 (parameter 'E0'); the formula holds for a broadening below twice the energy, "
        "which is 6 (in a fit, give the optimiser bounds=)"
    )


def test_of_a_batch_it_is_told_with_the_path():
    film = op.Material.tauc_lorentz([[100, 3.0, P("C"), 1.2]])
    words = told(path_of(film), C=np.array([1.0, 2.0, 6.5, 7.0]))
    assert "the broadening 6.5 (parameter 'C') and the energy 3;" in words
    assert words.endswith("which is 6 (at 2, of 4 paths)")


def test_what_is_bound_and_what_stands_in_a_sum_is_told_alike():
    film = op.Material.tauc_lorentz([[100, P("E0"), P("C"), 1.2]])
    for path in (path_of(film), path_of(op.Material(film.n - 0.1 * film.k, 0.0))):
        words = told(path.bind(E0=3.0, C=7.0))
        assert words.startswith("oscillators[0] of a Tauc-Lorentz model has the broadening 7")
        assert "bounds=" not in words


def test_a_formula_below_0_names_its_coefficients_besides_the_wavelength():
    path = path_of(op.Material.cauchy([P("a"), 2 * P("b")]))
    assert told(path, a=-3.0, b=0.005) == (
        "n of a Cauchy formula at 500 nm is -2.96, and interface.index.n takes a real index of "
        "refraction above 0 where k is 0; give other coefficients (a is -3, 2 * b is 0.01), or "
        "another wavelength (in a fit, give the optimiser bounds=)"
    )
    words = told(path, a=np.array([1.5, -3.0]), b=0.005)
    assert "is -2.96 (at 1, of 2 paths), and" in words
    assert "bounds=" not in words


@rows("a", [1.5 + 1j, np.array([1.5 + 1j, 1.5]), "1.5+1j"])
def test_a_complex_coefficient_is_refused_before_anything_is_made_of_it(a):
    path = path_of(op.Material.cauchy([P("a"), 0.004]))
    wanted = "parameter 'a' (at interface.index.n.coefficients[0]) is complex; give a real"
    assert told(path, a=a).startswith(wanted)
    with pytest.raises(op.ParameterError, match="is complex; give a real coefficient"):
        path.bind(a=a, wavelength="500 nm")


def test_a_default_that_is_no_coefficient_is_refused_where_the_formula_is_made():
    with pytest.raises(op.ValueFault) as fault:
        op.Material.drude_lorentz(P("wp", default=1j), P("g", default=-1.0))
    assert fault.value.faults[0] == (
        "parameter 'wp' (at plasma of a Drude-Lorentz model) is complex; give a real coefficient "
        "of 0 or more"
    )
    assert "'g' (at damping of a Drude-Lorentz model) is -1" in fault.value.faults[1]


def test_a_complex_k_beside_a_formula_is_told_whose_n_stands_there():
    words = told(path_of(op.Material.cauchy([1.5], k=P("k"))), k=1j)
    assert words.endswith("; n is that of a Cauchy formula; give k alone, a real number")
