"""How hypothesis searches: the same examples every time, or, asked for, many new ones.

HYPOTHESIS_PROFILE=search pytest
"""

import os

from hypothesis import settings

settings.register_profile("same", derandomize=True, deadline=None)
settings.register_profile("search", max_examples=2000, deadline=None)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "same"))
