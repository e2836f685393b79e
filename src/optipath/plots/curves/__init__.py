"""Pictures of quantities against parameters, and of what a boundary reflects."""
