"""What checkers refuse before it runs: each line is an error, or its comment is one."""

import optipath as op


def of_words(path: op.PathGraph, light: op.Light) -> None:
    op.Composer(engine="numab")  # type: ignore[arg-type]
    op.Composer(method="stabel")  # type: ignore[arg-type]
    op.Composer(model="ful")  # type: ignore[arg-type]
    op.Composer(dtype="float46")  # type: ignore[arg-type]
    op.Composer(composing="jone")  # type: ignore[arg-type]
    op.Composer(loops="summ")  # type: ignore[arg-type]
    op.Composer(keep="each")  # type: ignore[arg-type]
    op.PathGraph(loops="summ")  # type: ignore[arg-type]
    op.Detector(reads="intensty")  # type: ignore[arg-type]
    op.CircularPolarizer("lefft")  # type: ignore[arg-type]
    op.Polarizer(0.1).mueller(method="stabel")  # type: ignore[arg-type]
    op.fresnel_reflection(1.5, 1.0, 0.0, "stabel")  # type: ignore[arg-type]
    op.path_from_vertices([[0.0, 0.0, 1.0]], [1.5], bad="masked")  # type: ignore[arg-type]
    op.Spectrum.illuminant("D56")  # type: ignore[arg-type]
    op.Material.tabulated([5e-7], [1.5], interpolation="cubic")  # type: ignore[arg-type]
    path.trace(keep="each")  # type: ignore[call-overload]
    path.reading("intensty")  # type: ignore[arg-type]
    path.propagate(method="monte")  # type: ignore[arg-type]
    light.to("mitsubba")  # type: ignore[arg-type]
    light.plot("stoke")  # type: ignore[arg-type]
    light.to_srgb(out_of_gamut="clipp")  # type: ignore[arg-type]
    light.to_xyz(observer="CIE 1964")  # type: ignore[arg-type]


def of_chains(path: op.PathGraph, light: op.Light) -> list[object]:
    return [
        op.Source() >> light,  # type: ignore[operator]
        op.Source() >> path["detector"],  # type: ignore[operator]
        3 >> op.Polarizer(),  # type: ignore[operator]
        op.Source >> op.Detector(),  # type: ignore[operator]
        light @ op.Polarizer(),  # type: ignore[operator]
        op.Polarizer() @ 3,  # type: ignore[operator]
        light + 3,  # type: ignore[operator]
    ]


def of_names(light: op.Light) -> list[object]:
    return [
        light.stoks,  # type: ignore[attr-defined]
        op.Sorce,  # type: ignore[attr-defined]
        op.PathError,  # type: ignore[attr-defined]
        op.errors.PathEror,  # type: ignore[attr-defined]
    ]
