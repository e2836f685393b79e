"""``python -m optipath`` is the command ``optipath``."""

import sys

from optipath.cli import main

sys.exit(main())
