"""What sources emit, and what filters, stretches of a medium and turns of frames do to light."""
