"""Bags to rows: what is not known yet is read on the cluster, and written as it comes."""
import collections
import hashlib
import os
import sys

from . import database
from .bag_key import bag_key
from .cluster import read_bags
from .drive import UNREAD, Drive
from .wording import plain

KNOWN = "known"


class Scan:
    """One scan: how bags are read, and what has become of them so far."""

    def __init__(self, engine, work, options, vehicle_of, again, progress):
        """:param options: a hash of all options. :param progress: of progress.bar()."""
        self._engine, self._work, self._options, self._again = engine, work, options, again
        self._vehicle_of, self._progress = vehicle_of, progress
        self.counts = collections.Counter()  # {status, or KNOWN: how many bags}

    def unknown(self, paths):
        """The bags that are to be read."""
        for path in paths:
            bag, doubt = self._bag(os.path.abspath(path))
            if not self._again and database.is_known(self._engine, bag):
                self._count(KNOWN)
            elif doubt:
                self._write(bag, Drive(UNREAD, doubt))
            else:
                yield bag

    def read(self, client, bags):
        """Reads bags on a cluster, and writes what they say as it comes."""
        for bag, drive in read_bags(client, bags, self._work):
            if drive is None:
                self._count(KNOWN)
            else:
                self._write(bag, drive)

    def _bag(self, path):
        """(Bag, why it is not read, if it is not). One that cannot be opened is known by its path for the time being."""
        vehicle, doubt = self._vehicle_of(path), None
        if vehicle is None:
            doubt = "--vehicle-pattern does not match its path"
        try:
            key = bag_key(path)
        except OSError as error:
            key, doubt = hashlib.sha256(os.fsencode(path)).hexdigest(), error.strerror
        readable = os.fsencode(path).decode("utf-8", "backslashreplace")  # no database takes other bytes
        if readable != path:
            path, vehicle, doubt = readable, None, "its name is no UTF-8 text: give it another one"
        return database.Bag(key, path, vehicle, self._options, self._work.diagnose), doubt

    def _write(self, bag, drive):
        written = database.write(self._engine, bag, drive, self._again)
        self._count(drive.status if written else KNOWN)
        if drive.reason:
            stays = "" if written else "; what is known of it stays"
            self._progress.write(plain(f"{bag.path}: {drive.reason}{stays}"), file=sys.stderr)

    def _count(self, what):
        self.counts[what] += 1
        self._progress.update()
