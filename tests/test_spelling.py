from optipath.spelling import closest
from tables import rows


@rows(
    "word, known, meant",
    [
        ("detla", ["delta", "rho"], "delta"),
        ("--FILTER", ["--filter"], "--filter"),
        ("NM", ["nm", "um"], "nm"),
        ("npgr62", ["npgr026", "malus"], "npgr026"),
        ("polariser", ["polarizer", "rotator"], "polarizer"),
        ("ou", ["in", "out"], "out"),
        ("ellips", ["pyelli", "ellipsometry", "elli"], "ellipsometry"),
        ("transmitt", ["transmitted", "strain"], "transmitted"),
    ],
)
def test_a_misspelt_word_has_one_that_was_meant(word, known, meant):
    assert closest(word, known) == meant


@rows(
    "word, known",
    [
        ("--plot", ["--delta"]),
        ("10", ["1", "100", "0"]),
        ("n", ["n1", "nm"]),
        ("n12", ["n1", "n2"]),
        ("S4", ["S0", "S1"]),
        ("vertical", ["horizontal"]),
        ("x" * 1000, ["x" * 999]),
        ("delta", []),
        ("trans", ["transmittance", "transmitted", "strain"]),
        ("arc", ["arcmin", "arcsec", "deg"]),
    ],
)
def test_what_is_no_misspelling_has_no_word_that_was_meant(word, known):
    assert closest(word, known) is None
