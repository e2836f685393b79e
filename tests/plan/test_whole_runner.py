import pytest

import optipath as op
from paths import chain


def test_deep_extinction_and_pure_matrices_stay_within_their_certificates():
    crossed = chain([op.Polarizer(0.0, leakage=1e-12)], [1.0, -1.0, 0.0, 0.0], reads="intensity")
    found = crossed.compose().certificate()
    assert found.lower * found.scalar <= crossed.trace().intensity <= found.upper * found.scalar
    turned = op.Retarder(0.4, 0.3).mueller().matrix
    assert chain([op.MuellerElement(turned)]).compose().certificate().error < 1e-12


def test_long_paths_whose_plan_is_short_have_matrices_without_waiting():
    plates = [op.Retarder(op.Parameter("d"), op.Parameter(f"t{i % 5}")) for i in range(100)]
    path = chain([*plates, op.Polarizer(0.1)], reads="intensity")
    plan = path.compose()
    assert len(plan.program.steps) < 64 < len(plan.whole.steps)
    assert plan.engine_for(70_000) != plan.answers.whole.engine_for(70_000)


def test_certificates_of_traced_values_are_refused_in_words():
    jax = pytest.importorskip("jax")
    path = chain([op.Interface(1.5, op.Parameter("a")), op.Polarizer(0.3)], reads="intensity")
    plan = path.compose()
    for what in (lambda a: plan.certificate(a=a).error, lambda a: plan.evaluations(a=a)):
        with pytest.raises(op.ParameterError, match="not of values that JAX traces"):
            jax.jit(what)(0.3)


def test_plans_of_traced_constants_are_explained_and_have_matrices():
    jax = pytest.importorskip("jax")

    def entry(retardance):
        elements = [op.Attenuator(0.5), op.Retarder(retardance)]
        plan = op.Composer(dtype="float32").compose(chain(elements, reads="intensity"))
        assert "values that JAX traces" in plan.explain()
        return plan.mueller().matrix[0, 0]

    assert jax.grad(entry)(0.3) == 0.0
