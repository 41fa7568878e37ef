"""Tests of the fault matrix record their observations here; dev/fault_matrix shows them."""
import json
import os


def note(row, seen):
    """Appends {"row", "seen"} to the file that FAULT_NOTES names; without it, does nothing."""
    path = os.environ.get("FAULT_NOTES")
    if path:
        with open(path, "a", encoding="utf-8") as file:
            file.write(json.dumps({"row": row, "seen": seen}) + "\n")
