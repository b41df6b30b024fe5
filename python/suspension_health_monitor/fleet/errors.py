"""What ends a command, in words. The exit statuses are those of suspension_bag."""
import contextlib


class FleetError(Exception):
    """Something that the user has to put right."""
    status = 3  # unreadable or wrong input


class UsageError(FleetError):
    """A wrong option."""
    status = 2


@contextlib.contextmanager
def naming(what):
    """:raises FleetError: of what the system refuses, which by itself does not say where the disk is full."""
    try:
        yield
    except OSError as error:
        raise FleetError(f"{what}: {error.strerror or error}") from error
