"""What a light tells of itself besides its Stokes vector."""

STATE = ["dolp", "docp", "aop", "ellipticity", "ellipticity_angle", "handedness", "psi", "delta"]
FIGURES = ["intensity", "log10_intensity", "normalized", "dop", *STATE]
