import json

import numpy as np
import pytest

import optipath as op
from paths import chain
from tables import rows, slow_except


def long_path(count):
    path = op.PathGraph()
    node = path.add("lamp", op.Source())
    for number in range(count):
        angle = op.Parameter(f"a{number}")
        node = node >> path.add(f"e{number}", op.Interface(1.5, angle, azimuth=0.1))
    node >> path.add("eye", op.Detector())
    return path


def test_the_explanation_is_short_and_tells_what_is_left_out():
    assert len(long_path(500).compose().explain().splitlines()) < 120
    path = chain([op.Retarder(op.Parameter("r")), op.Interface(1.5, 0.7)], reads="intensity")
    text = path.compose().explain()
    assert "left out, since it changes nothing alive: retarder at 'e0.out'" in text
    assert "cheaper at 'e1.reflected'" in text
    assert "certificate" in chain([op.Attenuator(np.ones(0))]).compose().explain()


def test_live_components_and_operations_fewer_than_those_of_the_full_composition_are_told():
    path = chain([op.Polarizer(0.3), op.Retarder(1.0), op.Polarizer(op.Parameter("a"))])
    found = path.compose().explanation()
    live = {step.label: step.live for step in found.steps}
    assert live["lamp.out"] == ("S0",)
    # S3 is made by the retarder, and nothing behind it asks for it.
    assert all("S3" not in components for components in live.values())
    assert found.manner["model"] == "linear"
    glass = {"n1": 1.5, "k1": 0.0, "n2": 1.5, "k2": 0.0, "filter": "none"}
    plan = op.load_preset("npgr026", **glass).reading("intensity").compose()
    counts = plan.explanation().operations
    assert counts["plan"]["all"] < 0.6 * counts["full"]["all"]
    assert counts["plan"]["divide"] < counts["full"]["divide"]
    full = op.Composer(model="full").compose(op.load_preset("npgr026")).explanation().operations
    assert full["plan"] == full["full"]


def test_the_certificate_stands_there_where_all_values_are_known():
    path = chain([op.Interface(1.5, 0.7), op.Interface(1.5, 0.7)], reads="intensity")
    bounds = path.compose().explanation().certificate["bounds"]["eye"]
    A, B, _, _ = op.fresnel_reflection(1.5, np.cos(0.7), np.sin(0.7))
    assert bounds["upper"] == pytest.approx(1 + (B / A) ** 2)
    assert bounds["lower"] == pytest.approx(1 - (B / A) ** 2)
    opened = chain([op.Interface(1.5, op.Parameter("a"))]).compose().explain()
    assert "certificate: depends on a" in opened


# Light that goes round, or through a stack, has no one Jones vector; a medium that does several
# things at once and a rough sample have no Jones matrix here.
STACKS = {"coated-metal", "pile-of-plates", "absorbing-pile", "sky-and-window"}
WITHOUT_JONES = {"glass-slab", "dichroic-sheet", "ellipsometer-rough", *STACKS}
WITH_JONES = sorted({*op.preset_names()} - WITHOUT_JONES)


EXPLAINED = [(name, options) for name in op.preset_names() for options in ({}, {"model": "full"})]
EXPLAINED += [(name, {"composing": "jones"}) for name in sorted(WITH_JONES)]


@pytest.mark.parametrize(("name", "options"), slow_except(EXPLAINED[::5], EXPLAINED))
def test_every_preset_is_explained_as_json_too(name, options):
    found = op.Composer(**options).compose(op.load_preset(name)).explanation()
    text = json.dumps(found.as_dict(), allow_nan=False)
    assert json.loads(text)["counts"]["step"] == len(found.steps)
    assert len(str(found).splitlines()) < 60


@rows("name", sorted(WITHOUT_JONES))
def test_presets_without_a_jones_vector_are_refused_one(name):
    with pytest.raises(op.ComposerError, match=r"no Jones .*compose with composing='stokes'"):
        op.Composer(composing="jones").compose(op.load_preset(name))


@rows("intensity", [0.0, 1e-300])
def test_light_however_faint_is_bounded(intensity):
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(intensity))
    lamp >> path.add("grey", op.Attenuator(1e-100)) >> path.add("eye", op.Detector())
    found = path.compose().explanation()
    assert found.certificate["bounds"]["eye"]["upper"] == pytest.approx(1.0)
    json.dumps(found.as_dict(), allow_nan=False)


def test_matrices_that_cannot_be_leave_the_explanation_json():
    path = chain([op.MuellerElement(np.diag([1.0, 3.0, 1.0, 1.0]), physical=False)])
    found = path.compose().explanation()
    assert "none, since the Mueller matrix of 'e0' is unphysical" in str(found)
    json.dumps(found.as_dict(), allow_nan=False)


@rows(
    "reads, model, words",
    [
        (
            "stokes",
            "auto",
            "certificates are for intensities, and more is read by eye",
        ),
        ("intensity", "linear", "not needed, since model linear is exact"),
        ("intensity", "auto", "model scalar where its certificate is within it, sp elsewhere"),
    ],
)
def test_what_becomes_of_a_tolerance_is_told(reads, model, words):
    path = op.load_preset("malus").reading(reads)
    assert words in op.Composer(model=model, tolerance=0.1).compose(path).explain()
