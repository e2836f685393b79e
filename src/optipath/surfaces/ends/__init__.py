"""Where each photon has gone, and with which polarisation."""
