"""What a user gets: frames, light and its state of polarisation, Mueller matrices."""
