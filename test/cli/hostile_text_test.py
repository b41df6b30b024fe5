"""Texts that nobody writes: refused in a short line that says what is allowed, and links are not followed."""
import os
import subprocess

import pytest

import conftest

LAW = '{force: "%s", unit: "N"}'
MEGABYTE = "x" * 1_000_000
SHORT = 600  # characters of a message


def refused(program, *arguments):
    result = program(*arguments)
    assert result.returncode == 2, result.stderr
    assert len(result.stderr) < SHORT and result.stderr.count("\n") == 1, result.stderr[:2000]
    return result.stderr


@pytest.mark.parametrize("text, words", [
    ("rate: 50\n---\nrate: 100\n", ["line 3", "a second document begins, must be one"]),
    (f"scenario: {MEGABYTE[:900_000]}\n", ["scenario", "900000 characters", "must be one of"]),
    (f"{MEGABYTE[:900]}: 1\n", ["900 characters", "must be at most 200"]),
    ("rate: 1" + "0" * 1000 + "\n", ["rate", "must be in [0.1, 20000]"])],
    ids=["two documents", "a long value", "a long name", "a long number"])
def test_settings(program, tmp_path, text, words):
    path = tmp_path / "settings.yaml"
    path.write_text(text)
    message = refused(program, "simulate", "--config", path, "--duration", "1", "-o", tmp_path / "out.bag")
    for word in words:
        assert word in message
    assert os.listdir(tmp_path) == ["settings.yaml"]


@pytest.mark.parametrize("name, law, words", [
    ("own", LAW % r"v\0 + d", ["effects/own/force", "no text at 2"]),
    ("own", LAW % ("v + " * 500 + "v"), ["effects/own/force", "2001 characters", "must be at most 1000"]),
    ("own", LAW % ("q" * 900), ["effects/own/force", "900 characters"]),
    ("own" * 30, LAW % "v", ["effects/own", "must be at most 64 characters"]),
    ("own", '{force: "v", unit: "%s"}' % ("N" * 300), ["must be at most 200 characters"])],
    ids=["NUL", "a long law", "a long word", "a long name", "a long unit"])
def test_laws(program, tmp_path, name, law, words):
    path = tmp_path / "laws.yaml"
    path.write_text("effects: {%s: %s}\n" % (name, law))
    message = refused(program, "effects", "--effects-file", path)
    for word in words:
        assert word in message


def test_numbers_of_any_size_stay_short(program, tmp_path):
    for value in ("1e300", "-1e300", "1e13"):
        message = refused(program, "horizon", "--damping-to-mass", value, "--stiffness-to-mass", "60")
        assert "damping_to_mass = " in message and "must be above 0 and at most 1000000000000" in message
    message = refused(program, "simulate", "--set", "rate=1e300", "-o", tmp_path / "out.bag")
    assert "rate = " in message and "must be in" in message


def test_a_link_in_the_place_of_the_unfinished_file_is_not_followed(program, tmp_path):
    victim = tmp_path / "victim"
    victim.write_text("precious")

    def plant():
        os.symlink(victim, tmp_path / f"out.bag.part{os.getpid()}")

    process = subprocess.run([program.path, "simulate", "--duration", "1", "-o", tmp_path / "out.bag"],
                             preexec_fn=plant, stderr=subprocess.PIPE, timeout=conftest.HANGS)
    assert process.returncode == 3
    assert b".part" in process.stderr and b"cannot be written: File exists" in process.stderr
    assert victim.read_text() == "precious" and not (tmp_path / "out.bag").exists()
