"""Words and options without a place are told where they belong."""

from tables import rows

AT_THE_END = "unknown here; write it at the end: optipath"
KNOWN = "is unknown; there are: --version, --import, --help, -h"


@rows(
    "line, told",
    [
        ("run npgr026 --filter 30 deg", "'deg' is cut off from its number; quote them: --filter "),
        ("run npgr026 --filter 30 deg", "quote them: --filter '30 deg'"),
        ("run npgr026 --filter=30 degrees", "quote them: --filter '30 deg'"),
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
        ("run npgr026 --delta '30,5 deg'", "'30.5 deg' for one, and '30 deg, 5 deg' for two"),
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
        ("run npgr026 --version", "unknown here; it stands alone: optipath --version"),
        ("run --version", "unknown here; it stands alone: optipath --version"),
        ("chart npgr026 --interface", "unknown here; it stands alone: optipath chart --interface"),
        ("chart npgr026 --from a.json", "it stands alone: optipath chart --from a.json"),
    ],
)
def test_a_word_or_an_option_without_a_place_is_told_where_it_belongs(refused, line, told):
    error = refused(line)
    assert told in f"{error}\n"
    if "unknown" in told or "stands alone" in told:
        assert error.startswith("option ")


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
