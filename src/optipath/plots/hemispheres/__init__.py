"""Pictures of what rough samples send into all directions."""
