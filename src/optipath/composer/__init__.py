"""The composer: validate, lower, plan; one stage a file."""
