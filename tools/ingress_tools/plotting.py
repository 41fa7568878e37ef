"""Matplotlib without a display."""
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402, F401  (the backend must be chosen first; the plot tools import it)

from .command_line import fail  # noqa: E402


def save(tool, figure, file):
    """Writes the picture, and its folder if it is missing; exits with code 1 if that fails."""
    try:
        os.makedirs(os.path.dirname(file) or ".", exist_ok=True)
        figure.savefig(file, dpi=80)
    except (OSError, ValueError) as error:
        fail(1, f"{tool}: {file}: cannot write: {error}")
    print(f"{tool}: see {file}", file=sys.stderr)
