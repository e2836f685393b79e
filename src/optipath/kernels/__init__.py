"""The physics, elementwise, each piece written once.

A kernel is made for any `Primitives`; `catalog` binds each to the structure of what it returns.
"""
