"""Faults that the user can mend: a message and an exit code instead of a traceback."""
import sys

EXIT_USAGE = 2
EXIT_FILES = 4


class PictureError(Exception):
    """Something about the input is wrong; the text says what was expected."""

    def __init__(self, message, code=EXIT_FILES):
        super().__init__(message)
        self.code = code


def run(main):
    """Calls main() and ends the program with its code; a PictureError becomes one line on standard error."""
    try:
        sys.exit(main())
    except PictureError as error:
        print(f"error: {error}", file=sys.stderr)
        sys.exit(error.code)
    except BrokenPipeError:
        sys.exit(0)
