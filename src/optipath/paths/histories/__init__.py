"""Chains that differ in media, in lengths and in what happens along them, as they are given."""
