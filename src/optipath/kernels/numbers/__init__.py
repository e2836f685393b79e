"""Numbers that kernels compute with: primitives, trigonometry, twice the digits, elimination."""
