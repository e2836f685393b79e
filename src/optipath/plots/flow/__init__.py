"""Pictures of the power along a path: what each element takes."""
