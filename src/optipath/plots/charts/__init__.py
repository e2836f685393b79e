"""Charts of what the lab has measured: speed against accuracy, and where methods fail."""
