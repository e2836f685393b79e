"""The nine published cases of the assignment geometry.

Published digits: the assignment's table of results, as printed. Exact values: 50-digit
arithmetic with the conventions of docs/conventions.md, to 20 digits. Two misprints of
the table are settled by the exact values: case 3's S1 lost its sign, and cases 4 to 6
were computed with n = 1/1.5105, not the 0.666 that is printed.
"""

GLASS = {"n1": 1.33, "k1": 0.0, "n2": 1.5, "k2": 0.0, "delta": 53.0, "rho": 0.0, "phi": 56.0}
METAL = {"n1": 1.12, "k1": 2.16, "n2": 0.608, "k2": 2.12, "delta": 48.0, "rho": 34.0, "phi": 20.0}
RHOMB = dict.fromkeys(("n1", "n2"), 1 / 1.5105) | dict.fromkeys(("k1", "k2", "rho"), 0.0)
RHOMB |= {"delta": 48.0, "phi": 54.6}

VALUES = {
    "1": GLASS | {"filter": "none"},
    "2": GLASS | {"filter": "horizontal"},
    "3": GLASS | {"filter": "vertical"},
    "4": RHOMB | {"filter": "horizontal"},
    "5": RHOMB | {"filter": "vertical"},
    "6": RHOMB | {"filter": "diagonal"},
    "7": METAL | {"filter": "none"},
    "8": METAL | {"filter": "horizontal"},
    "9": METAL | {"filter": "vertical"},
}


def stokes_of_cases(table):
    """The four numbers of each case, by its name, as they are printed."""
    return {str(case): tuple(row.split()) for case, row in enumerate(table.splitlines(), start=1)}


PUBLISHED = stokes_of_cases("""\
0.560409 0.560409 0.0 0.0
0.560409 0.560409 0.0 0.0
1.2E-10 1.2E-10 0.0 0.0
50.0 50.0 0.0 0.0
50.0 -50.0 0.0 0.0
50.0 0.0 0.408533 -49.9983
33.9959 9.01647 -0.75875 -0.507946
19.1245 10.9873 -13.0076 -8.70795
14.8714 -1.97081 12.2488 8.2
""")

EXACT = stokes_of_cases("""\
0.56040891922094629539 0.56040891897749713454 0.0 0.0
0.56040891909922171497 0.56040891909922171497 0.0 0.0
1.2172458042503107183e-10 -1.2172458042503107183e-10 0.0 0.0
50.0 50.0 0.0 0.0
50.0 -50.0 0.0 0.0
50.0 0.0 0.40853336070085654284 -49.998330977075569416
33.995885147643275958 9.0164665771514565639 -0.75875041166117796023 -0.50794609833211584389
19.124491848170461536 10.98727842076817269 -13.007596625125844265 -8.70794645098804172
14.871393299472814422 -1.9708118436167161264 12.248846213464666305 8.2000003526559258761
""")
