"""Every public class: pickled, copied, or copied deeply, it is what it was."""

import copy
import inspect
import pickle

import numpy as np

import optipath as op
from tables import rows

CORNER = np.array([[0.0, 0.0, 3.0], [0.0, 0.0, 0.0], [0.0, 4.0, 0.0]])
PATH = op.load_preset("npgr026")
CHAIN = op.path_from_vertices(op.VerticesByAngles((op.Parameter("a"),)), [1.5])
GIVEN = {
    "Attenuator": (0.5,),
    "BeamSplitter": (0.3,),
    "Case": ({"a": [1.0, 2.0]},),
    "CosSin": (0.6, 0.8),
    "CircularDiattenuator": (0.9, [0.1, 0.2]),
    "Depolarizer": (0.2,),
    "Diattenuator": (0.5, 0.2),
    "EllipticalRetarder": (0.1, 0.2, [0.3, 0.4]),
    "FaradayRotator": (None, -134.0, [0.1, 0.2], 0.02),
    "Interface": (1.5, [0.1, 0.2]),
    "LayerStack": ([1.0, 1.3, 1.5], 0.1),
    "Light": ([1.0, 0.2, 0.0, 0.0],),
    "Material": (1.5, np.array([0.1, 0.2])),
    "Medium": (1.0, 0.1),
    "Mueller": (np.eye(4),),
    "MuellerElement": (np.eye(4),),
    "Parameter": ("a", np.ones(3, np.float32)),
    "PolarizingBeamSplitter": ("1000:1",),
    "Retarder": (0.1, 0.2),
    "Rotator": (0.1,),
    "RefractingVertex": (1.5, [[0, 0, 1], [0, 0, 0], [0, 0, -1]], 1),
    "SpecularVertex": (1.5, CORNER, 1),
    "Sample": ([(1.5, 0.1), (2.4, (0.1, 0.2))],),
    "Srgb": (np.full(3, 0.2), np.full(3, 0.2)),
    "VerticesByAngles": ((0.1,),),
    "Waveplate": (1e-3, 0.01, [5e-7, 6e-7]),
}
FOUND = {
    "Certificate": lambda: PATH.compose().certificate(),
    "Coupling": lambda: op.Rotator([0.1, 0.2]).couplings()[0],
    "Crystal": lambda: op.Crystal.named("quartz"),
    "EffectiveIndex": lambda: op.effective_index(0.2 + 3.4j, 0.5),
    "Frame": op.Frame,
    "FresnelAmplitudes": lambda: op.fresnel_amplitudes(0.2 + 3.4j, 0.8, 0.6),
    "FresnelEntries": lambda: op.fresnel_reflection(0.2 + 3.4j, 0.8, 0.6),
    "Hemisphere": lambda: op.measure(op.Sample([(1j, 0.3)]), 0.5, photons=1000, sensor=4),
    "LightPath": lambda: PATH.paths()[0],
    "LuChipman": lambda: op.Mueller(np.eye(4)).lu_chipman(),
    "Operation": lambda: op.Retarder(0.1, 0.2).couplings()[0].operations[0],
    "PathGraph": lambda: PATH,
    "Plan": PATH.compose,
    "PlaneOfIncidence": lambda: op.plane_of_incidence((1.0, 0.0, -1.0), (0.0, 0.0, 1.0)),
    "Polarization": lambda: op.polarization(PATH),
    "Propagation": lambda: PATH.propagate(delta=(0.8, 0.001), method="differences"),
    "Spectrum": lambda: op.Spectrum.constant(2.0) + op.Spectrum.line("633 nm"),
    "Vertex": lambda: op.Vertex(1.5, CORNER, 1, events=[0]),
}
CLASSES = [
    name
    for name in op.__all__
    if inspect.isclass(getattr(op, name)) and not issubclass(getattr(op, name), BaseException)
]
COPIES = [lambda made: pickle.loads(pickle.dumps(made)), copy.copy, copy.deepcopy]


@rows("name", CLASSES)
def test_an_object_of_a_public_class_equals_its_copies(name):
    made = FOUND[name]() if name in FOUND else getattr(op, name)(*GIVEN.get(name, ()))
    for copied in COPIES:
        again = copied(made)
        assert type(again) is type(made)
        assert again == made


@rows(
    "light",
    [
        PATH.trace(),
        PATH.trace(delta=[0.1, 0.2]),
        CHAIN.trace(a=0.1),
        CHAIN.trace(a=[0.1, 0.2]),
        op.Light([1.0, 0.5, 0.0, 0.0], wavelength=5e-7),
    ],
)
def test_light_that_was_traced_equals_its_copies(light):
    for copied in COPIES:
        assert copied(light) == light


def test_pairs_of_cosine_and_sine_are_equal_by_their_numbers():
    assert op.CosSin(0.6, 0.8) == op.CosSin(0.6, 0.8)
    assert op.CosSin(0.6, 0.8) != op.CosSin(0.8, 0.6)
    assert op.CosSin(0.6, 0.8) != (0.6, 0.8)


def test_a_path_is_pickled_without_what_follows_from_its_graph():
    path = op.Source() >> op.Polarizer(op.Parameter("a"))
    assert [*path.parameters] == ["a"]
    assert b"path_values" not in pickle.dumps(path)
