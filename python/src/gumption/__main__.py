"""``python -m gumption`` is the command line."""

import sys

from gumption._command_line import main

if __name__ == "__main__":
    sys.exit(main())
