import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))


def pytest_configure(config):
    """Take a quarter of a second a case, and at least three rounds, where no option says so."""
    if float(config.option.benchmark_max_time) == 1.0:
        config.option.benchmark_max_time, config.option.benchmark_min_rounds = 0.25, 3
