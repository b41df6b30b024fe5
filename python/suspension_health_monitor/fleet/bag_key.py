"""A bag's identity by what is in it: its size, and a hash of its head, its tail and its index.

The index tells when every chunk begins and ends and what is in it, so that two drives never share it; a bag of an hour
is known after some hundred kilobytes. A bag without an index (cut off, or still being written) has head and tail.
"""
import errno
import hashlib
import os
import re
import stat
import struct

BLOCK = 1 << 16  # [bytes]
_INDEX_POSITION = re.compile(rb"index_pos=(.{8})", re.DOTALL)


def bag_key(path):
    """:returns: 64 hexadecimal digits. :raises OSError: it cannot be opened or read, or is empty."""
    if stat.S_ISFIFO(os.stat(path).st_mode):
        raise OSError(errno.EINVAL, "is a pipe, must be a file", path)  # to open it would wait for a writer
    with open(path, "rb") as bag:
        size = bag.seek(0, os.SEEK_END)
        if size == 0:
            raise OSError(errno.ENODATA, "is empty", path)  # as others are: that is no content to be known by
        bag.seek(0)
        head = bag.read(BLOCK)
        key = hashlib.sha256(struct.pack("<Q", size) + head)
        bag.seek(min(_index_position(head), max(len(head), size - BLOCK), size))
        for block in iter(lambda: bag.read(BLOCK), b""):
            key.update(block)
    return key.hexdigest()


def _index_position(head):
    """Where the index begins; without one, beyond any file."""
    found = _INDEX_POSITION.search(head)
    position = struct.unpack("<Q", found.group(1))[0] if found else 0
    return position or 1 << 63
