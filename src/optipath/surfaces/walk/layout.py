"""How the photon walk counts: what its arrays hold, for those who give them and read them."""

CARRIED = 5
"""Numbers of a light: (weak, S1, S2, S3), and the intensity that it has without polarisation."""

OPAQUE = 0.0
"""The index of a medium that nothing gets into; its own are in an array beside."""

UP, DOWN, SIDEWAYS, STUCK, NEVER = range(5)
"""How a photon ends: above, below, beside the field, on its way; or it has met nothing at all."""

OUTCOME_NAMES = ("up", "down", "sideways", "stuck")
"""What they are called."""

OUTCOMES, MOST_COUNTED = 4, 16
"""How many ends are counted, and up to how many events are told apart."""

COUNT, INTENSITY, INTENSITY_SQUARED, SCALAR, SCALAR_SQUARED, PRODUCT = range(6)
SUMS = 6
"""What is summed up of an end: photons, S0, S0 without polarisation, their squares and product."""

ENDS, AZIMUTH, END_K, END_X, END_LIGHTS = 9, 2, 3, 6, 9
"""Numbers of a photon's end without its lights: outcome, events, azimuth, direction and x."""

RECORD = 24
"""Numbers of an event that is recorded; the end of the photon takes as many before them."""

LAYER, COLUMN, LINE, FACET, SIDE, REFLECTED = range(6)
COS, SIN, COS_2A, SIN_2A, SHARE, N1, N2 = range(6, 13)
POINT, NORMAL, DIRECTION = 13, 16, 19
"""The places of an event's numbers; vectors take three, and the direction is that before it."""

OUTCOME, EVENTS, FIRST_K, FIRST_X, LAST_K, LAST_X = 0, 1, 2, 5, 8, 11
"""The places of the numbers of the end; vectors take three."""

WHOLES, NUMBERS = 24, 4
"""How many whole numbers, and how many others, there are of a mesh."""

HEIGHTS, CELLS_X, CELLS_Y, LEVELS, PERIODIC, PYRAMID = range(6)
"""The places of the whole numbers: where heights begin, and from the last, where levels do."""

CELL_X, CELL_Y, LOW, HIGH = range(NUMBERS)
"""The places of the others."""

ENDED, SHIFTED, IN_REGISTER = range(3)
"""How a mesh ends: at its border; periodic, shifted at random by photon; or periodic and fixed."""

SHIFT = 2
"""Blocks are 2^SHIFT blocks of the level below wide."""
