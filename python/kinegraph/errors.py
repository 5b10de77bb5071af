"""What can go wrong, in words. Every exception of the library is an `Error`, which is a `RuntimeError`."""


class Error(RuntimeError):
    """A mistake in a call or a file. The message names the thing, the place and what was expected."""


class ArgumentError(Error, ValueError):
    """An argument has the wrong size, range or kind."""


class ArgumentTypeError(ArgumentError, TypeError):
    """An argument is of another type than expected, is missing, or has a name that there is not."""


class NotFound(Error, LookupError):
    """A name that is not there; the message lists similar ones."""


class FrameNotFound(NotFound):
    """A frame name that is not in the configuration."""


class FrameDeleted(Error):
    """A handle on a frame that has been deleted."""


class FileError(Error, OSError):
    """A file that is missing or cannot be read."""


class RobotFault(Error):
    """A robot that cannot be moved: it reports an error, or a guard has stopped it."""


class ParseError(Error, ValueError):
    """A text that does not follow its grammar, or a scene that makes no sense.

    Attributes:
        file, line, column: where; the line counts from 1, 0 means unknown.
    """

    file: str = ""
    line: int = 0
    column: int = 0


class KinegraphWarning(UserWarning):
    """Something odd that is not an error: an attribute that looks misspelt, an objective that selects nothing."""
