"""The program ``plumbline``: ``python -m plumbline`` is the same."""

import signal
import sys

from plumbline import _plumbline


def main() -> int:
    """Run the program with the command line of this process and return its exit code."""
    # The program ends at Ctrl-C, or listens to it itself; Python's handler would wait for its end.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _plumbline.main(sys.argv)


if __name__ == "__main__":
    sys.exit(main())
