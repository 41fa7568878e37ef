"""What the tools in Python share: wrong usage is one line on stderr, and exit code 2."""
import argparse
import os
import sys


class Parser(argparse.ArgumentParser):
    def __init__(self, description):
        super().__init__(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)

    def error(self, message):
        fail(2, f"{self.prog}: {message}; see --help")


def fail(code, text):
    print(text, file=sys.stderr)
    sys.exit(code)


def save(tool, figure, file):
    """Writes the picture, and its folder if it is missing; ends the program with code 1 if that cannot be done."""
    try:
        os.makedirs(os.path.dirname(file) or ".", exist_ok=True)
        figure.savefig(file, dpi=80)
    except (OSError, ValueError) as error:
        fail(1, f"{tool}: {file}: cannot write: {error}")
    print(f"{tool}: see {file}", file=sys.stderr)
