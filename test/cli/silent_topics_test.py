"""A topic that ends, or has a hole, while others go on: the struts that need it become STALE and say its name; the other
commands say so in a line, and which part of the drive they have used."""
import csv
import json

import pytest
import rosbag

DURATION, END, AGAIN = 60.0, 30.0, 40.0  # [s]
TIMEOUT = 2.0  # input_timeout
LATE = 2.5  # [s] that what is known of a vehicle's struts may be behind their readings
LEVELS = ("OK", "WARN", "ERROR", "STALE")
VEHICLE = ("--vehicle-model", "half_sedan")


class Drive:
    """A bag with one topic cut, and how to read it."""

    def __init__(self, bag, topic, struts, *arguments):
        self.bag, self.topic, self.struts, self.arguments = bag, topic, struts, arguments
        with rosbag.Bag(str(bag)) as messages:
            self.start = min(message.header.stamp.to_sec() for name, message, _ in messages if name.endswith("imu"))

    def run(self, program, command, folder, *more):
        result = folder / f"{command}.json"
        text = program.succeed(command, self.bag, *self.arguments, "--json", result, *more)
        return text, json.loads(result.read_text())


def cut(whole, path, topic, begin, end):
    """Copies a bag without the messages of a topic from `begin` to `end` [s]."""
    with rosbag.Bag(str(whole)) as messages, rosbag.Bag(str(path), "w") as out:
        first = None
        for name, message, time in messages:
            first = first or time
            if name != topic or not begin < (time - first).to_sec() < end:
                out.write(name, message, time)
    return path


@pytest.fixture(scope="module")
def whole(program, tmp_path_factory):
    """Bags without a hole: a half car with IMUs at the strut tops, one with a body IMU alone, one strut."""
    folder = tmp_path_factory.mktemp("whole")
    simulate = ("simulate", "--duration", DURATION, "--rate", "100", "--seed", "3")
    for name, more in (("tops", ()), ("body", ("--set", "sprung_imus=none"))):
        program.succeed(*simulate, *VEHICLE, *more, "-o", folder / f"{name}.bag", "--vehicle-file",
                        folder / f"{name}.yaml")
    program.succeed(*simulate, "--scenario", "iso_road", "-o", folder / "strut.bag")
    return folder


@pytest.fixture(scope="module", params=["wheel", "body", "strut"])
def dead(request, whole, tmp_path_factory):
    """A drive with a sensor that dies half way."""
    source, topic, struts = {"wheel": ("tops", "/front/unsprung/imu", ("front", "rear")),
                             "body": ("body", "/imu/data", ("front", "rear")),
                             "strut": ("strut", "/unsprung/imu", ())}[request.param]
    bag = cut(whole / f"{source}.bag", tmp_path_factory.mktemp("dead") / "dead.bag", topic, END, DURATION + 1.0)
    return Drive(bag, topic, struts, *(("--vehicle", whole / f"{source}.yaml") if struts else ()))


def healths(drive, result):
    """What `health --json` says of each strut."""
    return list(result["struts"].values()) if drive.struts else [result]


def test_health_is_stale_and_names_the_topic(program, dead, tmp_path):
    text, result = dead.run(program, "health", tmp_path, "--csv", tmp_path / "rows.csv", "--report", tmp_path)
    reason = f"cannot tell: no reading accepted for 30 s, {dead.topic} is silent; before: "
    for said in healths(dead, result):
        assert [event["level"] for event in said["events"]][-2:] == ["OK", "STALE"]
        last = said["events"][-1]
        assert END + TIMEOUT - LATE < last["time"] - dead.start < END + TIMEOUT + 0.1
        assert last["message"].startswith("cannot tell: no reading accepted for ")
        assert f", {dead.topic} is silent; before: " in last["message"]
        assert said["end"]["level"] == "STALE" and dead.topic in said["end"]["message"]
        assert sum(said["seconds"][level] for level in LEVELS) == pytest.approx(DURATION, abs=0.1)
        assert said["seconds"]["STALE"] > DURATION - END - TIMEOUT
    if not dead.struts:
        assert reason in text
    assert text.count(f"{dead.topic} is silent; before: ") == 2 * max(1, len(dead.struts))  # as an event and at the end
    with open(tmp_path / "rows.csv", encoding="utf-8", newline="") as stream:
        rows = [row for row in csv.DictReader(stream) if f"{dead.topic} is silent" in row["message"]]
    assert [row["level"] for row in rows] == ["STALE"] * max(1, len(dead.struts))
    assert sorted(row.get("strut", "") for row in rows) == sorted(dead.struts or [""])
    assert f"{dead.topic} is silent" in (tmp_path / "report.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("command", ["identify", "compare", "diagnose"])
def test_commands_say_what_they_have_used(program, dead, command, tmp_path):
    text, result = dead.run(program, command, tmp_path)
    assert f"dead.bag: {dead.topic} is silent from 30.0 s to 60.0 s, the end\n" in text
    assert "dead.bag: used 0.0 s to 30.0 s of 60.0 s\n" in text
    [silence] = result["silent"]
    assert (silence["bag"], silence["topic"]) == ("dead.bag", dead.topic)
    assert silence["from"] - dead.start == pytest.approx(END, abs=0.02)
    assert silence["to"] - dead.start == pytest.approx(DURATION, abs=0.02)


def test_hole_is_told_and_over_when_the_topic_comes_again(program, whole, tmp_path):
    topic = "/rear/unsprung/imu"
    drive = Drive(cut(whole / "tops.bag", tmp_path / "hole.bag", topic, END, AGAIN), topic, ("front", "rear"),
                  "--vehicle", whole / "tops.yaml")
    text, result = drive.run(program, "identify", tmp_path)
    assert f"hole.bag: {topic} is silent from 30.0 s to 40.0 s\n" in text
    assert "hole.bag: used 0.0 s to 30.0 s and 40.0 s to 60.0 s of 60.0 s\n" in text
    assert len(result["silent"]) == 1
    _, said = drive.run(program, "health", tmp_path)
    for strut in healths(drive, said):
        stale = next(event for event in strut["events"][1:] if event["level"] == "STALE")
        assert f"{topic} is silent" in stale["message"]
        assert strut["end"]["level"] == "OK"


def test_topic_that_begins_late_is_told(program, whole, tmp_path):
    bag = cut(whole / "strut.bag", tmp_path / "late.bag", "/sprung/imu", -1.0, 10.0)
    text, _ = Drive(bag, "/sprung/imu", ()).run(program, "identify", tmp_path)
    assert "late.bag: /sprung/imu is silent from 0.0 s to 10.0 s\nlate.bag: used 10.0 s to 60.0 s of 60.0 s\n" in text


@pytest.mark.parametrize("command", ["identify", "health"])
def test_nothing_is_said_where_nothing_is_silent(program, whole, command, tmp_path):
    for source in ("tops", "strut"):
        drive = Drive(whole / f"{source}.bag", "", (), *(("--vehicle", whole / "tops.yaml") if source == "tops" else ()))
        text, result = drive.run(program, command, tmp_path)
        assert "silent" not in text
        assert result["silent"] == []
