"""What help() tells of an attribute of a result: the text that stands behind it in _core.pyi."""
import pathlib
import re

from . import _core


def install():
    """Gives the attributes of the compiled classes their texts."""
    for line in pathlib.Path(__file__).with_name("_core.pyi").read_text().splitlines():
        found = re.match(r"class (\w+):|    (\w+): .*?  # (.*)", line)
        if found and found[1]:
            attributes = vars(getattr(_core, found[1]))
        elif found:
            attributes[found[2]].__doc__ = found[3]
