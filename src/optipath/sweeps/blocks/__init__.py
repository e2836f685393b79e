"""Blocks: a large job cut up, handed to a scheduler, and kept in a store as it is done."""
