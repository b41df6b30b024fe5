"""Every command that stands in a block of the README or of doc/ is run, in the order of its document.

Those of the README's walk and on the robot are run by effect_walk_test.py; scripts/demo by demo_page_test.py, but for
installing and building; scripts/test is what runs all tests. cmake builds, as scripts/test does.
"""
import re
import shutil
import subprocess

import pytest
import rosbag

import imu_bag
from conftest import HANGS
from terminal import Terminal

DOCUMENTS = ["README.md", *sorted(str(path.relative_to(imu_bag.REPOSITORY))
                                  for path in (imu_bag.REPOSITORY / "doc").glob("*.md"))]
PROGRAMS = ("rosrun", "roslaunch", "rosservice", "rostopic", "rqt_plot", "suspension_bag", "scripts/", "source", "cp")
RUN_ELSEWHERE = ("scripts/demo", "scripts/test", "source ", "rosservice ", "rostopic echo -p /monitor/comparison")
# What the README's vehicle has that none of the shipped ones has: three struts, the rear one alone with an IMU of its own.
TRICYCLE = """mass: 100
pitch_inertia: 20
roll_inertia: 10
speed: 3
iso_class: C
body_imu: {x: 0, y: 0, z: 0}
struts:
  front_left: {x: 0.4, y: 0.3, z: 0.1, damping: 150, stiffness: 5000, wheel_mass: 3, tyre_stiffness: 30000}
  front_right: {x: 0.4, y: -0.3, z: 0.1, damping: 150, stiffness: 5000, wheel_mass: 3, tyre_stiffness: 30000}
  rear: {x: -0.4, y: 0, z: 0.1, damping: 150, stiffness: 5000, wheel_mass: 3, tyre_stiffness: 30000}
"""


def without_comment(line):
    return re.sub(r"\s+#.*$", "", line)


def commands_of(text):
    """(block, its commands) of every block without a language, or of a shell."""
    for language, block in re.findall(r"^```(\w*)\n(.*?)^```$", text, re.DOTALL | re.MULTILINE):
        if language not in ("", "sh"):
            continue
        lines = [without_comment(line) for line in block.replace("\\\n", " ").splitlines()]
        yield [line for line in lines if line.startswith(PROGRAMS)]


def documents_with_commands():
    for document in DOCUMENTS:
        text = (imu_bag.REPOSITORY / document).read_text()
        walk = re.search(r"<!-- walk -->.*?<!-- end -->", text, re.DOTALL)
        text = text.replace(walk.group(0), "") if walk else text
        commands = [command for block in commands_of(text) for command in block if not command.startswith(RUN_ELSEWHERE)]
        commands += re.findall(r"`(roslaunch suspension_health_monitor [^`]+)`", re.sub(r"```.*?```", "", text, flags=re.DOTALL))
        if commands:
            yield pytest.param(document, commands, id=document)


def renamed(source, target, topics):
    """The bag with some topics, by other names."""
    with rosbag.Bag(str(source)) as bag, rosbag.Bag(str(target), "w") as copy:
        for topic, message, time in bag.read_messages(topics=list(topics)):
            copy.write(topics[topic], message, time)


def record(program, folder, topics, *arguments):
    program.succeed("simulate", *arguments, "-o", folder / "recorded.bag")
    renamed(folder / "recorded.bag", folder / "drive.bag", topics)


def prepare(program, folder, document, command):
    """What the reader has by then: a recorded drive of a robot, or of a vehicle with its file."""
    text = (imu_bag.REPOSITORY / document).read_text()
    if document == "README.md" and " check drive.bag" in command:
        record(program, folder, {"/sprung/imu": "/body/imu", "/unsprung/imu": "/front_left/imu"}, "--scenario", "iso_road",
               "--vehicle", "ugv", "--rate", "100")
    if "my_vehicle.yaml" in command and document == "README.md" and not (folder / "my_vehicle.yaml").exists():
        (folder / "my_vehicle.yaml").write_text(re.search(r"```yaml\n(# my_vehicle.yaml\n.*?)```", text, re.DOTALL)[1])
        (folder / "tricycle.yaml").write_text(TRICYCLE)
        topics = {"/imu/data": "/imu/data", "/rear/sprung/imu": "/rear/imu",
                  **{f"/{strut}/unsprung/imu": f"/wheel/{strut}/imu" for strut in ("front_left", "front_right", "rear")}}
        record(program, folder, topics, "--vehicle-model", folder / "tricycle.yaml", "--set", "sprung_imus=rear")


def launch_and_look(terminal, command, number, plotted):
    """Runs a launch file until its monitor is there, and what is plotted of it is published."""
    output = f"launch_{number}.txt"
    with terminal.start(command, output) as launched:
        terminal.wait_for_master()
        terminal.wait_for_words(output, "process[", launched)
        terminal.run("timeout 120 rostopic echo -n 1 /diagnostics")
        for topic in plotted:
            fields = topic.strip("/").split("/")
            message = terminal.run(f"timeout 120 rostopic echo -n 1 /{'/'.join(fields[:2])}")
            assert f"{fields[2]}: " in message, topic
        assert launched.poll() is None, "it goes on"
    told = (terminal.folder / output).read_text(errors="replace")
    # A line that begins so is roslaunch's; the monitor's own tells with time and level what it waits for.
    assert not re.search(r"Traceback|RLException|has died|^(\x1b\[\d+m)*ERROR: ", told, re.MULTILINE), told


def test_the_rules_see_commands():
    text = "```sh\nrosrun a b --c \\\n  d   # why\nno command\n```\n```yaml\ncp: x\n```\n"
    assert list(commands_of(text)) == [["rosrun a b --c    d"]]


@pytest.mark.parametrize("document, commands", documents_with_commands())
def test_commands_of_a_document(program, tmp_path, port, document, commands):
    terminal = Terminal(tmp_path, port)
    terminal.environment["PATH"] = f"{program.path.rpartition('/')[0]}:{terminal.environment['PATH']}"
    for number, command in enumerate(commands):
        prepare(program, tmp_path, document, command)
        if command.startswith("rqt_plot"):
            continue  # looked at while the launch before it ran
        if command.startswith("roslaunch"):
            following = commands[number + 1] if number + 1 < len(commands) else ""
            launch_and_look(Terminal(tmp_path, port), command, number, following.split()[1:] if "rqt_plot" in following else [])
        else:
            terminal.run(command)


def test_scripts_of_the_readme_are_there():
    text = (imu_bag.REPOSITORY / "README.md").read_text()
    for script in re.findall(r"^scripts/\w+", text, re.MULTILINE):
        assert shutil.which(str(imu_bag.REPOSITORY / script)), script


def test_pictures_are_small():
    assert sum(path.stat().st_size for path in (imu_bag.REPOSITORY / "doc").glob("*.png")) <= 300_000


def test_readme_is_short():
    assert len((imu_bag.REPOSITORY / "README.md").read_text().splitlines()) <= 170


def test_demo_tells_its_options():
    told = subprocess.run([imu_bag.REPOSITORY / "scripts/demo", "--help"], check=True, stdout=subprocess.PIPE, text=True,
                          timeout=HANGS).stdout
    assert "--no-install" in told and "--quick" in told
