"""Which model of light a rough sample needs."""
