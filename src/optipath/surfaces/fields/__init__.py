"""What a rough surface is: heights over a plane, drawn at random, measured, or all the same."""
