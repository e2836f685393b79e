"""pypolar: its amplitudes, and the light from them by hand in NumPy."""

import numpy as np
from pypolar.fresnel import r_par_amplitude, r_per_amplitude

from amplitudes import light
from work import Contender


def prepare(delta, rho, phi, materials):
    n1, k1, n2, k2 = materials

    def run():
        rs1, rp1 = r_per_amplitude(complex(n1, k1), delta), r_par_amplitude(complex(n1, k1), delta)
        # Its index is n - ik: the amplitudes are the conjugates.
        return light(np.conj(rs1), np.conj(rp1), r_per_amplitude(complex(n2, k2), phi), rho)

    return run


CONTENDERS = (
    Contender("pypolar, amplitudes", prepare, "the light by hand in NumPy; conjugated amplitudes"),
)
