"""Tables of flights as `fly` writes them, and the statistics of rates; used by plot_miss, plot_gusts and plot_flight."""
import csv
import math
import os

CONTACTS = ("COLLISION", "FALSE_INGRESS")
NUMBERS = ("seed", "offset_y_m", "offset_z_m", "predicted_miss_m")
GIVE = "give a folder or flights.csv that 'fly --output' has written"


class DataError(ValueError):
    """One line: the file, what is wrong with it, and what to do."""


def table_of(file, give):
    """(rows, names of the columns) of a csv file; raises DataError, which ends with `give`."""
    try:
        with open(file, newline="", encoding="utf-8") as stream:
            reader = csv.DictReader(stream, strict=True)
            return list(reader), reader.fieldnames or []
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        reason = error.strerror if isinstance(error, OSError) else f"cannot be read as csv: {error}"
        raise DataError(f"{file}: {reason}; {give}") from error


def need_columns(file, needed, there, give):
    missing = [name for name in needed if name not in there]
    if missing:
        raise DataError(f"{file}: no column {', '.join(missing)}; {give}")


def read_flights(place, columns):
    """Rows of one flights.csv, or of the one in a folder; NUMBERS as floats, NaN if empty."""
    file = os.path.join(place, "flights.csv") if os.path.isdir(place) else place
    rows, there = table_of(file, GIVE)
    need_columns(file, columns, there, GIVE)
    if not rows:
        raise DataError(f"{file}: no flights in it; was the campaign broken off?")
    for i, row in enumerate(rows):
        row.update({name: number(file, i + 2, row, name) for name in NUMBERS if name in there})
    return rows


def number(file, line, row, name):
    text = row[name]
    try:
        return float(text) if text else math.nan
    except (TypeError, ValueError) as error:
        raise DataError(f"{file}:{line}: '{text}' in column {name} is no number; was the table cut off?") from error


def miss_of(row):
    """The larger offset at the crossing [m]; NaN if the plane was never crossed."""
    return max(abs(row["offset_y_m"]), abs(row["offset_z_m"]))


def wilson95(successes, trials):
    """Score interval of a rate; 0 to 1 without trials."""
    if trials == 0:
        return 0.0, 1.0
    z = 1.96
    rate, spread = successes / trials, z * z / trials
    centre = rate + spread / 2
    half = z * math.sqrt(rate * (1 - rate) / trials + spread / (4 * trials))
    return max(0.0, (centre - half) / (1 + spread)), min(1.0, (centre + half) / (1 + spread))
