"""Words that stand where nothing takes them are told where they belong."""

import shlex

from optipath.cli import main
from tables import rows


@rows(
    "line, told",
    [
        (
            "run npgr026 --filter 30 deg",
            "'deg' is cut off from its number; quote them: --filter '30 deg'",
        ),
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
        ("run npgr026 --delta '30,5 deg'", "write '30.5 deg' for one, and '30 deg, 5 deg' for two"),
    ],
)
def test_a_word_without_a_place_is_told_what_it_was_meant_for(capsys, line, told):
    assert main(shlex.split(line)) == 2
    error = capsys.readouterr().err
    assert error.startswith("optipath: ")
    assert told in error
