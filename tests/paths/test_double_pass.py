"""There and back: what a mirror sends light through twice."""

import numpy as np
import pytest

import optipath as op
from tables import rows

QUARTER = np.pi / 2
LINEAR = (1, 1, 0, 0)


def twice(*elements, stokes=LINEAR):
    path = op.Source(stokes=stokes) >> op.there_and_back(*elements, op.Mirror()) >> op.Detector()
    return path.trace()


def test_a_double_pass_doubles_what_plates_do_and_turns_back_at_glass():
    light = twice(op.Retarder(QUARTER, np.pi / 8)).stokes
    np.testing.assert_allclose(light, [1, 0, -1, 0], atol=1e-15)
    # At 45 degrees behind a polariser, nothing comes back through it.
    path = (
        op.Source()
        >> op.Polarizer(0.0)
        >> op.there_and_back(op.Retarder(QUARTER, np.pi / 4), op.Mirror())
    )
    assert (path >> op.Polarizer(0.0) >> op.Detector()).trace().intensity < 1e-30
    path = op.Source() >> op.there_and_back(op.Attenuator(0.5), op.Interface(1.5, 0.0))
    assert (path >> op.Detector()).trace().intensity == pytest.approx(0.25 * 0.04)
    # A double pass is its own way back.
    plate, foil = op.Retarder(1.0, 0.2, 0.4), op.Diattenuator(0.9, 0.2, 0.7)
    path = op.Source() >> op.there_and_back(plate, foil, op.Mirror(-0.9, 0.8)) >> op.Detector()
    found, expected = path.reversed().mueller().matrix, path.mueller().reversed().matrix
    assert found.shape == (4, 4)
    np.testing.assert_allclose(found, expected)


@rows("retardance", [0.3, 1.0, 2.5])
@rows("angle", [0.0, 0.4, -1.3])
def test_a_wave_plate_retards_by_twice_as_much(retardance, angle):
    # Chipman, Lam & Young, table 6.5, of twice the retardance; then y and z are turned over.
    c, s = np.cos(2 * angle), np.sin(2 * angle)
    cd, sd = np.cos(2 * retardance), np.sin(2 * retardance)
    expected = [1, c * c + s * s * cd, -c * s * (1 - cd), s * sd]
    np.testing.assert_allclose(twice(op.Retarder(retardance, angle)).stokes, expected, atol=2e-15)


@rows("angle", [0.1, 0.7, -0.4])
def test_natural_rotation_is_undone_and_faradays_doubled(angle):
    assert twice(op.Rotator(angle)).aop == pytest.approx(0.0, abs=1e-15)
    # Seen in the frame that is turned over.
    assert twice(op.FaradayRotator(angle)).aop == pytest.approx(-2 * angle)
    sugar = op.Medium("1 dm", absorption=3.0, dextrorotation=angle * 10)
    np.testing.assert_allclose(twice(sugar).stokes, np.exp(-0.6) * np.array(LINEAR), atol=1e-15)


def test_azimuths_and_parameters_are_the_same_on_both_ways():
    # The same in angles from the frame of the lamp alone.
    stokes = (1, 0.3, -0.2, 0.5)
    foil = op.Diattenuator(0.9, 0.2, 0.1, azimuth=0.5)
    turned = twice(op.Retarder(1.0, 0.2, azimuth=0.3), foil, stokes=stokes)
    plate, foil = op.Retarder(1.0, 0.5), op.Diattenuator(0.9, 0.2, 0.9)
    plain = twice(plate, foil, stokes=stokes).in_frame(op.Frame().turned(-0.3))
    np.testing.assert_allclose(turned.stokes, plain.stokes, atol=1e-15)
    first, second = op.Retarder(1.0, 0.2), op.Diattenuator(0.9, 0.2, 0.7)
    turned = op.there_and_back(first, second, op.Mirror(azimuth=op.Parameter("a")))
    path = op.Source(stokes=LINEAR) >> turned >> op.Detector()
    expected = np.broadcast_to(twice(first, second).stokes, (2, 4))
    np.testing.assert_allclose(path.trace(a=[0.4, -1.0]).stokes, expected, atol=1e-15)
    plate = op.Retarder(op.Parameter("retardance"), op.Parameter("angle")).named("plate")
    path = op.Source(stokes=LINEAR).named("lamp") >> op.there_and_back(plate, op.Mirror())
    path = path >> op.Detector().named("eye")
    light = path.trace(retardance=[QUARTER, 1.0], angle=[np.pi / 8, 0.4]).stokes
    np.testing.assert_allclose(light[0], [1, 0, -1, 0], atol=1e-15)
    np.testing.assert_allclose(light[1], twice(op.Retarder(1.0, 0.4)).stokes, atol=1e-15)
    preset = op.load_preset("double-pass-waveplate")
    assert list(path) == list(preset)
    for case in preset.cases.values():
        published = case.published["eye"]
        np.testing.assert_allclose(path.trace(**case.values).stokes, published, atol=1e-15)


def test_nodes_are_named_a_folding_mirror_is_met_again_and_choices_are_refused():
    plate = op.Retarder(1.0).named("plate")
    path = op.there_and_back(plate, op.Retarder(2.0), op.Rotator(0.1), op.Mirror())
    assert list(path) == [
        "plate", "retarder", "rotator", "mirror", "rotator-2", "retarder-2", "plate-back"
    ]  # fmt: skip
    assert list(op.there_and_back(op.Mirror())) == ["mirror"]
    first, second = op.Retarder(1.0, 0.2, 0.3), op.Polarizer(0.7, 0.1)
    one, other = op.there_and_back(first >> second, op.Mirror()), (first, second, op.Mirror())
    assert one == op.there_and_back(*other)
    fold = op.Interface(0.2 + 3j, 0.8)
    path = op.Source(stokes=LINEAR) >> op.there_and_back(op.Retarder(1.0, 0.3), fold, op.Mirror())
    matrix = fold.mueller().matrix
    plate, back = op.Retarder(1.0, 0.3).mueller().matrix, op.Retarder(1.0, -0.3).mueller().matrix
    expected = back @ matrix @ op.Mirror().mueller().matrix @ matrix @ plate @ LINEAR
    np.testing.assert_allclose((path >> op.Detector()).trace().stokes, expected, atol=1e-15)
    piece = op.Polarizer() >> op.Retarder(1.0) >> op.Rotator(0.1)
    piece.offer("place", "retarder", {"first": "polarizer.out"})
    with pytest.raises(op.PathError, match="choice 'place' moves a node on the way there alone"):
        op.there_and_back(piece, op.Mirror())


@rows(
    "elements, sentence",
    [
        ((), "is given no element; give those that light meets, and last where it turns back"),
        ((op.Retarder(1.0),), "light does not turn back at 'retarder', which is given last"),
        ((op.Retarder(1.0), op.BeamSplitter()), "light does not turn back at 'beam-splitter'"),
        ((op.Mirror() >> op.Mirror(),), "light turns back at one element, and <PathGraph: mirror "),
        ((op.Interface(1.5, 0.3),), "give it an incidence of 0.0, not 0.3"),
        ((op.Interface(1.5, op.Parameter("t")),), "give it an incidence of 0.0, not parameter 't'"),
        ((op.Interface(1.5, op.FOLLOWS),), "give it an incidence of 0.0, not FOLLOWS"),
        ((op.Source(), op.Mirror()), "light begins at 'source'; let op.there_and_back"),
        ((op.Combiner(), op.Mirror()), "'combiner': combiner adds up light without loss"),
        ((op.Mirror,), "Mirror is a class"),
        (("mirror",), "a chain is made of elements"),
    ],
)
def test_what_does_not_go_there_and_back_is_refused(elements, sentence):
    with pytest.raises(op.PathError, match=sentence):
        op.there_and_back(*elements)
