"""Files that appear whole or not at all."""
import os
import tempfile

from .errors import naming


def write_whole(path, text):
    """Until it is whole it lies in a folder of its own beside its place. :raises FleetError: it cannot be written."""
    with naming(path), tempfile.TemporaryDirectory(prefix=".part.", dir=os.path.dirname(path) or ".") as folder:
        part = os.path.join(folder, "part")
        with open(part, "w", encoding="utf-8") as file:
            file.write(text)
        os.replace(part, path)
