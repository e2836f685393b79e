"""Files of hemispheres, and polarized BRDFs for other software."""
