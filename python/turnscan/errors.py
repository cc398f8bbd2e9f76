"""What goes wrong."""


class Error(Exception):
    """A call failed. `code` is a stable lower-case name ("not-found", "format", "cancelled", ...),
    `path` the file concerned, which may be empty; the text says what is wrong and what to do."""

    def __init__(self, message, code="library", path=""):
        super().__init__(message)
        self.code = code
        self.path = path


class OptionError(Error, ValueError):
    """An option does not exist, is outside its range, or contradicts another."""
