"""Presets: set-ups that stand ready, and files of one's own."""
