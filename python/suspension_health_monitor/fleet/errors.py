"""What ends a command, in words. The exit statuses are those of suspension_bag."""


class FleetError(Exception):
    """Something that the user has to put right."""
    status = 3  # unreadable or wrong input


class UsageError(FleetError):
    """A wrong option."""
    status = 2
