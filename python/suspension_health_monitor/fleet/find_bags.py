"""The bags that paths and patterns name, and the vehicle that each is of."""
import fnmatch
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
        if next(iter(_named(path)), None) is None:
            raise FleetError(f"{path}: no such file or folder, and no pattern that one matches")
    return itertools.chain.from_iterable(map(_below, itertools.chain.from_iterable(map(_named, paths))))


def _named(path):
    parts = path.split("/")
    if os.path.lexists(path):
        return [path]
    return _deep(parts, parts.index("**")) if "**" in parts else glob.iglob(path)


def _deep(parts, place):
    """Files that a pattern with ** matches: glob would follow links, in a circle, too, and tell what is in a folder twice."""
    names = [part for part in parts[place:] if part]
    while names and names[-1] == "**":
        names.pop()
    for base in glob.iglob("/".join([*parts[:place], ""]) or "./"):
        yield from _below(base, lambda path: _matches(path[len(base):].split("/"), names, path.endswith(".bag")))


def _matches(path, pattern, below):
    """Names against patterns, one by one. below: also of what is in a folder that matches."""
    if not pattern:
        return below or not path
    if pattern[0] == "**":
        return any(_matches(path[count:], pattern[1:], below) for count in range(len(path) + 1))
    return bool(path) and fnmatch.fnmatchcase(path[0], pattern[0]) and _matches(path[1:], pattern[1:], below)


def _below(path, wanted=lambda path: path.endswith(".bag")):
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
                yield from _below(entry.path, wanted)
            elif wanted(entry.path) and not os.path.isdir(entry.path):
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
