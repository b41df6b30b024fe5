"""Runs the examples of doc/python.md; as a program in a folder of its own: python_page.py PAGE."""
import doctest
import os
import pathlib
import re
import sys
import tempfile


def blocks(page):
    return re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)


def run(page):
    """@return how many examples there are, and what is said of those that fail."""
    test = doctest.DocTestParser().get_doctest("\n".join(blocks(page)), {}, page.name, str(page), 0)
    said = []
    doctest.DocTestRunner(optionflags=doctest.ELLIPSIS).run(test, out=said.append)
    return len(test.examples), "".join(said)


if __name__ == "__main__":
    its_page = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as scratch:
        os.chdir(scratch)
        failures = run(its_page)[1]
        os.chdir("/")
    sys.exit(failures or None)
