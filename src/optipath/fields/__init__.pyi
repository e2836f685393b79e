# The public names, each from the module that defines it; read when one is first used.

from optipath.materials.quantities import Absorption as Absorption
from optipath.materials.quantities import Amplitude as Amplitude
from optipath.materials.quantities import Angle as Angle
from optipath.materials.quantities import AnglePerLength as AnglePerLength
from optipath.materials.quantities import Axis as Axis
from optipath.materials.quantities import Fraction as Fraction
from optipath.materials.quantities import Incidence as Incidence
from optipath.materials.quantities import Index as Index
from optipath.materials.quantities import Length as Length
from optipath.materials.quantities import MuellerMatrix as MuellerMatrix
from optipath.materials.quantities import NonNegative as NonNegative
from optipath.materials.quantities import Real as Real
from optipath.materials.quantities import StokesState as StokesState
from optipath.materials.quantities import YesOrNo as YesOrNo
from optipath.values.domains import Within as Within
