"""The package does not grow unnoticed: size.yaml beside this file has the most of everything that makes it hard to read.

Who has to raise a number says why in the commit; who has made something smaller lowers it.
"""
import pathlib
import re

import pytest
import yaml

HERE = pathlib.Path(__file__).resolve().parent
REPOSITORY = HERE.parents[1]
CONSTANT = re.compile(r"\bconstexpr\s+[\w:<>, ]+?\s+k[A-Z]\w*|^constexpr .*?, k[A-Z]\w* =", re.M)
CLASS = re.compile(r"^(?:class|struct) \w+", re.M)


def sources(*folders):
    """@return the texts of all C++ files below folders."""
    return [path.read_text() for folder in folders for path in (REPOSITORY / folder).rglob("*")
            if path.suffix in (".h", ".cpp")]


def code_lines(text):
    """@return lines that are neither blank nor only a comment."""
    text = re.sub(r"/\*.*?\*/", lambda match: "\n" * match.group(0).count("\n"), text, flags=re.S)
    return sum(1 for line in text.splitlines() if line.strip() and not line.strip().startswith("//"))


def words(*paths):
    return sum(len(path.read_text().split()) for path in paths)


def sizes():
    core, readme = sources("include", "src/core"), REPOSITORY / "README.md"
    return {
        "code_lines": sum(map(code_lines, sources("include", "src"))),
        "constants_of_core": sum(len(CONSTANT.findall(text)) for text in core),
        "classes_of_core": sum(len(CLASS.findall(text)) for text in core),
        "words_of_readme": words(readme),
        "words_of_documents": words(readme, REPOSITORY / "CONTRIBUTING.md", *(REPOSITORY / "doc").glob("*.md")),
    }


@pytest.mark.parametrize("text, lines", [
    ("int a;\n\n  // why\n", 1), ("/* of\ntwo lines */\nint a;  // why\n", 1), ("/* why */ int a;\n", 1), ("", 0)])
def test_blank_lines_and_comments_are_no_code(text, lines):
    assert code_lines(text) == lines


def test_every_line_with_named_constants_counts_once():
    text = "constexpr double kA = 1.0, kB = 2.0;\ninline constexpr int kC = 3;\nconst double kD = 4.0;\n"
    assert len(CONSTANT.findall(text)) == 2


@pytest.mark.parametrize("what", sorted(sizes()))
def test_nothing_has_grown(what):
    most = yaml.safe_load((HERE / "size.yaml").read_text())
    assert sorted(most) == sorted(sizes())
    assert sizes()[what] <= most[what], f"{what}: raise it in test/cli/size.yaml, and say why, or make it smaller"
