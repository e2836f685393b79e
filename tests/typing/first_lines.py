"""What checkers know of a user's first lines, which have no annotations; checked, and run."""

from typing import assert_type

import numpy as np

import optipath as op

path = (
    op.Source(100)
    >> op.Interface(1.5, op.Parameter("theta"))  # a pane of glass
    >> op.Interface(0.17 + 3.15j, "46 deg", azimuth="34 deg")  # gold, in another plane
    >> op.Detector()
)
light = path.trace(theta=["20 deg", "40 deg", "60 deg", "80 deg"])
print(light)
print(light.dop.round(4))

assert_type(path, op.PathGraph)
assert_type(light, op.Light)
assert_type(light[0] + 2 * light[1], op.Light)
assert_type(light.frame, op.Frame)
matrix, polarizer = path.mueller(theta=0.3), op.Polarizer("30 deg")
assert_type(matrix, op.Mueller)
assert_type(matrix @ light, op.Light)
assert_type(polarizer @ matrix, op.Mueller)
assert_type(polarizer @ polarizer, op.Mueller)
assert_type(polarizer @ light, op.Light)
assert_type(op.Source() >> polarizer.named("first"), op.PathGraph)
assert_type(op.Source() >> op.there_and_back(polarizer, op.Mirror()), op.PathGraph)
assert_type(path["detector"].path, op.PathGraph)
assert_type(path.trace(theta=0.3, keep="all"), dict[str, op.Light])
assert_type(path.propagate(theta=(0.3, 0.01)), op.Propagation)
malus = op.load_preset("malus")
assert_type(malus, op.PathGraph)
assert_type(op.Composer(engine="numpy", dtype=np.float32).compose(malus).run(), op.Light)
assert_type(op.fresnel_reflection(1.5, 1.0, 0.0), op.FresnelEntries)
assert_type(op.Spectrum.black_body(3000.0) * 2.0, op.Spectrum)

# Of each of these a checker does not know too little.
names: list[str] = list(path.graph.nodes)
stokes: np.ndarray = light.stokes + matrix.matrix[..., 0]
