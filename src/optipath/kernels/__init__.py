"""The physics, elementwise, each piece written once.

A kernel is made for any `Primitives`; `catalogue` binds each to the structure of what it returns.
"""
