"""``python -m pestle``."""

import sys

from pestle.cli import main

if __name__ == "__main__":
    sys.exit(main())
