"""Common to the Python tools: wrong usage gives one line on stderr and exit code 2."""
import argparse
import csv
import os
import sys


class Parser(argparse.ArgumentParser):
    def __init__(self, description):
        super().__init__(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)

    def error(self, message):
        fail(2, f"{self.prog}: {message}; see --help")

    def parse_args(self, *words):
        """Refuses an --output that is also an input file, which would be lost."""
        arguments = super().parse_args(*words)
        output = getattr(arguments, "output", None)
        for name, value in vars(arguments).items():
            for file in value if isinstance(value, list) else [value]:
                if (name != "output" and isinstance(file, (str, os.PathLike)) and output and os.path.isfile(output)
                        and os.path.isfile(file) and os.path.samefile(file, output)):
                    self.error(f"--output {output} is also an input: give another name")
        return arguments


def say_in_a_line(kind, error, trace):
    """Reports a file that cannot be read or written in one line, without a traceback."""
    if issubclass(kind, OSError):
        print(f"{os.path.basename(sys.argv[0])}: {error.filename or ''}: {error.strerror or error}", file=sys.stderr)
    elif not issubclass(kind, KeyboardInterrupt):
        sys.__excepthook__(kind, error, trace)


sys.excepthook = say_in_a_line


def fail(code, text):
    print(text, file=sys.stderr)
    sys.exit(code)


def add_overwrite(parser):
    parser.add_argument("--overwrite", action="store_true", help="replaces files that are there already")


def refuse_to_replace(parser, files, overwrite):
    for file in files:
        if os.path.isfile(file) and not overwrite:
            fail(2, f"{parser.prog}: {file} is there already: --overwrite replaces it, or give another name")


def rows_of(file, columns=()):
    """Rows of a csv table, as dicts of text; exits if it lacks one of the columns."""
    with open(file, newline="", encoding="utf-8") as stream:
        table = csv.DictReader(stream)
        missing = [column for column in columns if column not in (table.fieldnames or ())]
        if missing:
            fail(2, f"{file}: has no column {', '.join(missing)}")
        return list(table)
