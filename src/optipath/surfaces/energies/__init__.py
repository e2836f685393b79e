"""What share of light a sample sends back, and lets through, by number of events."""
