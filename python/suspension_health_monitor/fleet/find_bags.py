"""The bags that paths and patterns name, and the vehicle that each is of."""
import glob
import itertools
import os
import re

from .errors import FleetError, UsageError

FOLDER_OF_THE_BAG = r"([^/]+)/[^/]+$"


def find_bags(paths):
    """Every file that is named and every *.bag below folders, except what is hidden, as they are come across: never all
    of them in memory.

    :raises FleetError: a path or pattern that names nothing.
    """
    for path in paths:
        if not os.path.lexists(path) and next(glob.iglob(path, recursive=True), None) is None:
            raise FleetError(f"{path}: no such file or folder, and no pattern that one matches")
    return itertools.chain.from_iterable(map(_below, itertools.chain.from_iterable(map(_named, paths))))


def _named(path):
    return [path] if os.path.lexists(path) else glob.iglob(path, recursive=True)


def _below(path):
    try:
        entries = os.scandir(path)
    except OSError:  # it is a file; or a folder that may not be listed, which then is told as a bag that cannot be read
        yield path
        return
    with entries:
        for entry in entries:
            if entry.name.startswith("."):  # not for everybody's eyes, such as what a simulation is writing
                continue
            if entry.is_dir(follow_symlinks=False):
                yield from _below(entry.path)
            elif entry.name.endswith(".bag"):
                yield entry.path


def vehicle_pattern(text):
    """:returns: a function that tells a path's vehicle, None where the pattern does not match or finds an empty name.
    :raises UsageError: no regular expression, or one without a group."""
    try:
        pattern = re.compile(text)
    except re.error as error:
        raise UsageError(f"--vehicle-pattern {text}: {error}, must be a regular expression") from error
    if pattern.groups == 0:
        raise UsageError(f"--vehicle-pattern {text} has no group, must have one around the vehicle's name: "
                         f"{FOLDER_OF_THE_BAG}")
    group = "vehicle" if "vehicle" in pattern.groupindex else 1

    def vehicle_of(path):
        found = pattern.search(os.path.abspath(path))
        return found and found.group(group) or None
    return vehicle_of
