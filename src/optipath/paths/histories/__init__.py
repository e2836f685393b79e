"""What is told of chains of points: media, lengths, and what happens at each vertex."""
