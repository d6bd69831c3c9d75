"""The program ``gumption``: the same command line as in the Rust program."""

from __future__ import annotations

import sys


def main() -> int:
    """Run the command line with the arguments of the process, and return its exit code."""
    # nothing else is imported: the program starts at once, and no library has started threads yet,
    # which would take signals away from it
    from gumption import _gumption

    return _gumption.main(["gumption", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
