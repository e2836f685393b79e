"""The public interface as a user's code sees it; checked by mypy, and run."""

import functools
from typing import Annotated, Any

import numpy as np

import optipath as op
from optipath.surfaces import single_scattering, write_measured_polarized


class HalfWavePlate(op.Element, kind="typed-half-wave-plate"):
    angle: op.fields.Angle = 0.0

    @staticmethod
    def mueller_rows(xp: Any, angle: Any) -> Any:
        c, s = xp.cos(4 * angle), xp.sin(4 * angle)
        return (1, 0, 0, 0), (0, c, s, 0), (0, s, -c, 0), (0, 0, 0, -1)


class Grid(op.Element, kind="typed-grid"):
    leakage: Annotated[op.fields.Real, op.fields.Within(0, "0.1")] = 0.01

    @staticmethod
    def jones_rows(xp: Any, leakage: Any) -> Any:
        return (1, 0), (0, (xp.sqrt(leakage), 0.0))


mirrors = op.path_from_vertices([[0, 0, 1], [0, 0, 0], [0, 1, 0]], materials=[0.6 + 2.1j])
along = op.Frame.from_direction(z=(0, 1, 0), x=(1, 0, 1))
mirrors.insert("grid", Grid(op.Parameter("leakage")), "vertex1", frames={"in": along})
path = op.PathGraph("typed")
lamp = path.add("lamp", op.Source(intensity=100.0, stokes=[1, 0, 0, 0]))
glass = path.add("glass", op.Interface(index=1.5 + 0.1j, incidence=op.Parameter("theta")))
tinted = op.Interface(1.0, 0.3, outside=1.5 + 0.01j, incidence_in=1.0)
pane = op.LayerStack([1.0, 1.5 + 1e-6j, 1.0], 0.3, lengths=["4 mm"], wavelength="550 nm")
stays: np.ndarray = pane.absorbed(op.Light([1.0, 0.5, 0.0, 0.0]), "in")
metal = path.add("metal", op.Interface(op.Material(0.6, 2.1), np.linspace(0, 1, 5), azimuth=0.1))
plate = path.add("plate", HalfWavePlate(angle=-op.Parameter("angle")))
mirror = path.add("mirror", op.Mirror(r_s=-0.97 + 0.12j, r_p=op.Parameter("r", 0.9)))
partial = path.add("partial", op.Diattenuator(maximum=0.9, minimum=0.2, angle=0.1))
ground = path.add("ground", op.Depolarizer(depolarization=[0.1, 0.2, 0.3, 0.4, 0.5]))
dyed = path.add("dyed", op.Medium(0.1, 9.0, dichroism=op.Parameter("d", 4.0), retardance=2.0))
ellipse = path.add("ellipse", op.EllipticalRetarder(s1=0.1, s2=op.Parameter("s2", 0.2), s3=[0.3]))
handed = path.add("handed", op.CircularDiattenuator(right=0.9, left="0.2"))
sugar = path.add("sugar", op.Medium(length=0.1, rotation=2.0))
ink = path.add("ink", op.Medium.from_extinction(1e-6, k=0.1, wavelength=500e-9))
rod = path.add("rod", op.FaradayRotator(verdet="-134 rad/(T m)", field=-0.2, length="2 cm"))
circular = path.add("circular", op.CircularPolarizer("left", leakage=op.Parameter("l", 0.1)))
crystal: op.Crystal = op.Crystal.named("quartz")
half: op.Waveplate = op.Waveplate.half("550 nm", crystal, order=1, angle=0.3)
green: op.Parameter = op.tabulated(["500 nm", "600 nm"], [0.2, 0.8], label="green glass")
verdet: op.Parameter = op.drude_rotation([-41.72], [0.08909], unit="rad/(T m)")
quartz = path.add("quartz", op.Waveplate("2 mm", 0.0091, op.Parameter("w", 5e-7), angle=0.1))
lamp >> rod >> circular >> quartz >> glass
glass >> metal >> mirror >> partial >> ground >> sugar >> ink >> plate
plate >> dyed >> ellipse >> handed
handed >> path.add("eye", op.Detector(reads="linear"))
cube: op.Mueller = op.PolarizingBeamSplitter("1000:1", 50.0).mueller("in", "reflected")
chained: op.PathGraph = op.Source(100.0) >> op.Polarizer(0.3).named("analyser") >> op.Detector()
doubled_pass: op.PathGraph = op.there_and_back(op.Retarder(1.0, 0.3).named("plate"), op.Mirror())
there_again: op.PathGraph = (op.Source() >> doubled_pass >> op.Detector()).reversed(op.Source(2.0))
gold: op.Material = op.Material.tabulated(["500 nm", "600 nm"], [0.9, 0.3], [1.8, 2.8], name="gold")
flint: op.Material = op.Material.sellmeier(
    [op.Parameter("b", 1.2)], c=[0.01], span=("0.3 um", 2e-6)
)
gold_there: op.Material = gold.at(["516 nm", 5.2e-7])
shortest: float = gold.span[0]
rough: op.surfaces.HeightField = op.surfaces.HeightField.beckmann(0.3, 0.4, size=(100.0, 80.0))
varnished: op.Sample = op.Sample([(1.5, 0.1), (1.6, (0.1, 0.2)), (op.Material(0.2, 3.4), rough)])
drawn: tuple[op.surfaces.HeightField, ...] = varnished.fields(3)
base_n: np.ndarray = op.load_sample("gold-rough").indices(["500 nm", 6e-7]).n
replayed: op.surfaces.Photon = varnished.photon(3, "30 deg", azimuth=0.2, most_events=100)
replayed_way: op.PathGraph = replayed.path()
met_at: float = replayed.events[0].incidence
smoothed: op.LayerStack = varnished.smooth("30 deg")
ready: list[str] = op.sample_names()
as_file: str = op.load_sample("glass-rough").to_toml()
scanned = op.surfaces.HeightField.from_heights([[0.0, 1.0, 0.0]] * 3, size=2.0, periodic=False)
steepness: tuple[float, float] = scanned.mean_square_slopes
film: op.Light = (
    op.Source()
    >> op.Interface(op.Material.tauc_lorentz([(122.0, 3.45, 2.54, 1.2)]), 0.3)
    >> op.Interface(op.Material.drude_lorentz(9.0, 0.02, oscillators=[(0.3, 3.0, 0.5)]), 0.3)
    >> op.Interface(op.Material.cauchy([1.5, 0.004], wavelength="500 nm"), 0.3)
    >> op.Detector()
).trace(wavelength="550 nm")
plate_back: op.Retarder = op.Retarder(1.0, 0.3).reversed()
longer: op.PathGraph = op.PathGraph() >> op.Source() >> op.Polarizer() >> op.Detector()
of_networkx: op.PathGraph = op.PathGraph.from_networkx(chained.to_networkx())
texts: Any = chained.to_networkx(text=True)
kinds: list[str] = [data["element"].kind for data in chained.nodes.values()]
links: list[Any] = [*chained.edges(keys=True, data=True)]
at_plate: dict[str, op.Frame] = chained["analyser"].frames
turn_there: Any = chained.frames().turns["source.out -> analyser.in"]
by_graph: op.Plan = op.Composer().compose(chained.to_networkx())
light: op.Light = path.trace(theta=0.1, angle=[[0.1], [0.2]])
lights: dict[str, op.Light] = path.trace_all(theta=0.1, angle=0.2)
matrix: op.Mueller = path.mueller(theta=0.1, angle=0.2) @ op.Polarizer(0.1).mueller()
attenuated: op.Light = matrix @ light
matrix_back: op.Mueller = matrix.reversed()
frame_back: op.Frame = light.frame.reversed()
brighter: op.Light = 2 * light[0] / 3 + op.Polarizer(0.1) @ light[..., 0, :1]
single: list[float] = [float(each.S0.max()) for each in light.reshape(-1)]
noisy: op.Light = op.Light([1, 1, 1, 1], physical=False).nearest_physical()
parts_of_matrix: op.LuChipman = matrix.lu_chipman()
again: op.Mueller = parts_of_matrix.depolarizer @ parts_of_matrix.retarder
theirs: op.Light = op.Light.from_("mitsuba", light.to("mitsuba"), light.frame)
their_matrix: op.Mueller = op.Mueller.from_("hecht", matrix.to("ellipsometry"))
psi_and_delta: tuple[Any, Any] = matrix.ellipsometric_angles("tmm")
physical: bool = bool(matrix.nearest_physical().is_physical(tolerance=1e-9).all())
angles: list[Any] = [light.psi, light.aop, matrix.delta, parts_of_matrix.retardance]
plan: op.Plan = op.Composer(method="textbook").compose(path)
quick: op.Light = (
    op.Composer(engine="numpy", threads=2).compose(path).run(theta=op.CosSin(1.0, 0.0), angle=0.2)
)
swept: Any = op.load_preset("malus").sweep(angle="0 deg:90 deg:91", composer=op.Composer())
parts: list[op.Light] = [part.light for part in plan.stream(9, theta=0.1, angle=0.2)]
engines: tuple[str, str] = plan.engine, plan.engine_for(1_000)
text: str = plan.explain() + path.to_toml()
doubled: op.Parameter = 2 * op.Parameter("theta") - "10 deg"
turned: op.Element = op.Rotator(0.1 - op.Parameter("theta") / 2)
malus: op.PathGraph = op.load_preset("malus")
together = {("angle", "intensity"): 0.1}
uncertain: op.Propagation = malus.propagate(
    angle=(["30 deg", "40 deg"], "0.1 deg"), intensity=(1.0, 0.1), correlation=together
)
spread: np.ndarray = uncertain.covariance + uncertain.uncertainty_of("dop")[..., None, None]
shares: dict[str, Any] = uncertain.contributions | uncertain.contributions_to("S0")
in_samples: np.ndarray = malus.propagate(
    angle=(0.3, 0.01), method="monte-carlo", samples=100, seed=3, composer=op.Composer()
).is_doubtful("intensity")
varied: op.Light = op.load_preset("npgr026", case=8).trace(delta=[0.1, 0.2])
started: op.PathGraph = malus.with_defaults(angle=0.3)
in_singles: op.Composer = op.Composer(dtype=np.float32)
preset: op.PathGraph = op.load_preset("npgr026", case="7", filter="horizontal")
A, B, C, S = op.fresnel_reflection(1.5, 1.0, 0.0)
amplitudes: op.FresnelAmplitudes = op.fresnel_amplitudes(op.Material(0.6, 2.1), 0.8, 0.6, 1.3)
r_s, r_p, t_s, t_p = amplitudes
brdf: op.Mueller = single_scattering(
    op.Material(0.6, 2.1), [0.1, 0.2, 0.3], (0.6, 0.0, -0.8), (0.6, 0.0, 0.8), masking="separate"
)
fading: op.EffectiveIndex = op.effective_index(0.6 + 2.1j, op.CosSin(0.8, 0.6), outside=1.3)
chain = op.VerticesByAngles(incidences=(0.3, op.Parameter("delta")), turns=(-0.5,))
in_space: op.Frame = op.path_from_vertices(chain, materials=[1.5, 1.5]).trace(delta=0.1).frame
down = [[0, 0, 1], [0, 0, 0], [0, 0, -1]]
through: op.PathGraph = op.path_from_vertices(down, [1.5], events="T", outside=1.0)
water: op.Element = op.RefractingVertex(1.33, down, place=1, count=1)
ended = op.path_from_vertices(
    np.zeros((2, 4, 3)), [1.5, 1.0], ids=[[0, 1], [1, 1]], events=["TT", "R"], bad="mask"
)
later = op.path_from_vertices(
    op.Parameter("points"),
    [1.5, 1.0],
    ids=op.Parameter("ids"),
    events=op.Parameter("events"),
    lengths=op.Parameter("lengths"),
    count=2,
)
corner = op.SpecularVertex(1.5, op.vertices_from_angles([0.3]), place=1)
lamp_spectrum: op.Spectrum = 2 * op.Spectrum.black_body(2856) + op.Spectrum.line("633 nm", 0.1)
measured: op.Spectrum = op.Spectrum.sampled(["4e-7 m", "5e-7 m"], [1.0, 2.0], outside=0.0, name="x")
grid = op.wavelengths("380 nm", 7e-7, "40 nm")
bins: op.Spectrum = measured.rebin([4e-7, 4.5e-7, 5e-7], outside="drop")
power: float = bins.power() + bins.powers.sum() + measured.values.sum()
lit: op.PathGraph = op.Source(spectrum=lamp_spectrum) >> op.Detector(response=measured / measured)
probe: op.Element = op.Detector(response=measured.at(op.Wavelength("probe")))
spectral: op.Light = op.Light([[1, 0, 0, 0]] * 81).at_wavelengths(np.linspace(380e-9, 780e-9, 81))
same_spectral = op.Light([[1, 0, 0, 0]] * 3, wavelength=["400 nm", "500 nm", "600 nm"])
known_wavelengths: np.ndarray | None = spectral.wavelength
summed: op.Light = spectral.integrate(response=np.ones(81))
in_bins: op.Light = same_spectral.integrate(edges=["350 nm", "450 nm", "550 nm", "650 nm"])
tristimulus: np.ndarray = spectral.to_xyz(white=op.Spectrum.illuminant("D65"), outside="nearest")
displayed: op.Srgb = spectral.to_srgb(white=spectral, adapt=True, out_of_gamut="clip")
too_colourful: np.ndarray = displayed.outside


def of_pages() -> tuple[op.Material, op.Material]:
    gold = op.Material.named("gold", page="Johnson", wavelength="516 nm")
    return gold, op.Material.from_yaml("mine.yml", k=0.0, extrapolate="nearest")


def of_pictures(found: op.Hemisphere) -> None:
    drawn = op.plots.hemisphere(found, "ADM", source=[1, 0, 0, 0], mask={"noise": None})
    titles: list[str] = [drawn.get_title(), op.plots.in_plane({"a": found}, "S1").get_title()]
    op.plots.save(op.plots.differences(found, wavelength="550 nm"), titles[0], dots_per_inch=80)


def of_light(light: op.Light) -> list[str]:
    beside = op.plots.stokes({"eye": light}, published={"eye": [1, 0, 0, 0]})
    drawn = op.plots.ellipse(light, beside, labels=["a", "b"])
    sphere = op.plots.poincare(light, by=[0.0, 1.0], label="delta (deg)")
    op.plots.poincare_path(path, sphere, theta="45 deg")
    op.plots.save(op.plots.mueller(op.Mueller(np.eye(4))), "a.png")
    return [drawn.get_title(), light.plot("stokes", published=[1, 0, 0, 0]).get_title()]


def of_files() -> op.Hemisphere:
    found = op.load_hemisphere("a.nc", sample=varnished)
    found.save("a.exr", source=[1.0, 1.0, 0.0, 0.0], side="reflected")
    brdf = functools.partial(single_scattering, 1.5, 0.3)
    write_measured_polarized("a.pbsdf", brdf, wavelengths=["450 nm"], shape=(9, 9, 9))
    write_measured_polarized("b.pbsdf", [found, found])
    return found
