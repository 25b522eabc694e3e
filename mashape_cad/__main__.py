"""``python -m mashape_cad`` is ``mashape-cad``."""

import sys

from mashape_cad.cli.main import main

if __name__ == "__main__":
    sys.exit(main())
