"""What the documents name exists: files, tests, identifiers; and no equation of the paper is left out."""
import functools
import itertools
import pathlib
import re

import pytest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
DOCUMENTS = sorted([REPOSITORY / "README.md", REPOSITORY / "CONTRIBUTING.md", *(REPOSITORY / "doc").glob("*.md")])
PAGES = [path for path in DOCUMENTS if path.parent.name == "doc"]
FOLDERS = sorted(path.name for path in REPOSITORY.iterdir() if path.is_dir()
                 and path.name not in ("build", "build_core", "devel", "install", "demo_out", ".git"))
PATH_IN_FOLDER = re.compile(rf"(?<![\w./$-])(?:{'|'.join(map(re.escape, FOLDERS))})/[\w.*/-]*\w")
FILE_NAME = re.compile(
    r"(?<![\w/$~-])[\w*][\w*/.-]*\.(?:h|cpp|py|yaml|launch|msg|srv|test|md|rst|txt|xml|csv)\b(?![\w/])")
MADE_BY_USERS = {"my_strut.yaml", "simulated.yaml", "models.yaml", "estimates.csv", "drive.csv",
                 "my_laws.yaml", "model.yaml", "my_vehicle.yaml", "vehicle.yaml", "fleet/vehicle.yaml",
                 "my_tricycle.yaml"}
NUM_EQUATIONS = 32


def name(path):
    return str(path.relative_to(REPOSITORY))


@functools.lru_cache(maxsize=None)
def files():
    """All files of the repository, without what builds and programs put there."""
    paths = itertools.chain(REPOSITORY.glob("*"), *((REPOSITORY / folder).rglob("*") for folder in FOLDERS))
    return [name(path) for path in paths if path.is_file()]


@functools.lru_cache(maxsize=None)
def words_of_code():
    """All words of the code and its interfaces."""
    folders = ("include", "src", "msg", "config", "launch", "fuzz", "test/core/reference")
    text = " ".join((REPOSITORY / file).read_text(errors="replace") for file in files() if file.startswith(folders))
    return set(re.findall(r"\w+", text))


@functools.lru_cache(maxsize=None)
def gtests():
    """Suite.Name of every gtest."""
    found = set()
    for path in (REPOSITORY / "test" / "core").glob("*_test.cpp"):
        found |= {".".join(match) for match in re.findall(r"^TEST(?:_F|_P)?\((\w+),\s*(\w+)\)", path.read_text(), re.M)}
    return found


def exists(path):
    """Whether a file's path ends with `path`, or a folder has it; * and words in capitals stand for anything."""
    pattern = re.sub(r"\\\*|\b[A-Z]{3,}\b(?!\\\.(?:md|rst|txt))", "[^/]*", re.escape(path))
    return any(re.search(rf"(^|/){pattern}($|/)", file) for file in files())


def named_files(text):
    text = re.sub(r"\w+://\S+", "", text)
    return (set(PATH_IN_FOLDER.findall(text)) | set(FILE_NAME.findall(text))) - MADE_BY_USERS


def named_tests(text):
    return set(re.findall(r"`([A-Z]\w+\.[A-Z]\w+)`", text))


def named_identifiers(text):
    """Words in backticks that only code can have: with a small letter before a capital one."""
    text = re.sub(r"```.*?```", "", text, flags=re.DOTALL)
    marked = " ".join(mark for mark in re.findall(r"`([^`\n]+)`", text) if mark not in named_tests(text))
    marked = FILE_NAME.sub("", marked)
    return set(re.findall(r"\b\w*[a-z][A-Z]\w*\b", marked))


def test_rules_see_what_is_missing():
    assert named_files("see src/core/none, `no_such.h` and x/y.yaml") == {"src/core/none", "no_such.h", "x/y.yaml"}
    assert not exists("src/core/none") and not exists("no_such.h") and not exists("orner_sample.h")
    assert exists("corner_sample.h") and exists("test/ros/NAME.test") and exists("src/core/identification")
    assert named_tests("`Suite.Name`") == {"Suite.Name"}
    assert named_identifiers("`noSuchName()` in `NoSuchClass::thing`, `lambda`") == {"noSuchName", "NoSuchClass"}


@pytest.mark.parametrize("document", DOCUMENTS, ids=name)
def test_named_files_exist(document):
    assert sorted(file for file in named_files(document.read_text()) if not exists(file)) == []


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_named_tests_and_identifiers_exist(page):
    text = page.read_text()
    assert sorted(named_tests(text) - gtests()) == []
    assert sorted(named_identifiers(text) - words_of_code()) == []


def test_every_equation_has_its_line():
    text = (REPOSITORY / "doc" / "equations.md").read_text()
    numbers = []
    for first, last in re.findall(r"^\| \((\d+)\)(?:-\((\d+)\))? \|", text, re.MULTILINE):
        numbers += range(int(first), int(last or first) + 1)
    assert numbers == list(range(1, NUM_EQUATIONS + 1))
