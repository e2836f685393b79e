"""The public interface as a user's code sees it; checked by mypy, and run."""

from typing import Any

import numpy as np

import optipath as op


class HalfWavePlate(op.Element, kind="typed-half-wave-plate"):
    angle: op.Angle = 0.0

    @staticmethod
    def mueller_rows(xp: Any, angle: Any) -> Any:
        c, s = xp.cos(4 * angle), xp.sin(4 * angle)
        return (1, 0, 0, 0), (0, c, s, 0), (0, s, -c, 0), (0, 0, 0, -1)


path = op.PathGraph("typed")
lamp = path.add("lamp", op.Source(intensity=100.0, stokes=[1, 0, 0, 0]))
glass = path.add("glass", op.Interface(index=1.5 + 0.1j, incidence=op.Parameter("theta")))
metal = path.add("metal", op.Interface(op.Material(0.6, 2.1), np.linspace(0, 1, 5), azimuth=0.1))
plate = path.add("plate", HalfWavePlate(angle=-op.Parameter("angle")))
lamp >> glass >> metal >> plate >> path.add("eye", op.Detector(reads="linear"))
light: op.Light = path.trace(theta=0.1, angle=[[0.1], [0.2]])
lights: dict[str, op.Light] = path.trace_all(theta=0.1, angle=0.2)
matrix: op.Mueller = path.mueller(theta=0.1, angle=0.2) @ op.Polarizer(0.1).mueller()
attenuated: op.Light = matrix @ light
plan: op.Plan = op.Composer(method="textbook").compose(path)
quick: op.Light = (
    op.Composer(engine="numpy", threads=2).compose(path).run(theta=op.CosSin(1.0, 0.0), angle=0.2)
)
parts: list[op.Light] = [part.light for part in plan.stream(9, theta=0.1, angle=0.2)]
engines: tuple[str, str] = plan.engine, plan.engine_for(1_000)
text: str = plan.explain() + path.to_toml()
preset: op.PathGraph = op.load_preset("npgr026", case="7", filter="horizontal")
A, B, C, S = op.fresnel_reflection(1.5, 1.0, 0.0)
chain = op.VerticesByAngles(incidences=(0.3, op.Parameter("delta")), turns=(-0.5,))
in_space: op.Frame = op.path_from_vertices(chain, materials=[1.5, 1.5]).trace(delta=0.1).frame
corner = op.SpecularVertex(1.5, op.vertices_from_angles([0.3]), place=1)
