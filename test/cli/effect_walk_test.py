"""The five commands of the README, from a bag with a hidden effect to the falling error, as they stand there."""
import csv
import re

import imu_bag
from terminal import Terminal

README = imu_bag.REPOSITORY / "README.md"
EFFECT = "quadratic_damping"


def commands():
    block = re.search(r"<!-- walk -->\n```sh\n(.*?)```\n<!-- end -->", README.read_text(), re.DOTALL).group(1)
    return block.splitlines()


def on_the_robot():
    """The commands of the README that ask a monitor while it runs."""
    return re.findall(r"^rosservice .*$", README.read_text(), re.MULTILINE)


def test_five_commands_of_the_readme(tmp_path, port):
    simulate, compare, diagnose, replay, watch = commands()
    terminal = Terminal(tmp_path, port)
    assert f"--effect {EFFECT}=" in simulate
    terminal.run(simulate)
    terminal.run(compare)
    assert f"Missing from the model: {EFFECT}." in terminal.run(diagnose)
    assert f"  {EFFECT}:\n" in (tmp_path / "model.yaml").read_text()
    with terminal.start(replay, "replay.txt") as replaying:
        terminal.wait_for_master()
        with terminal.start(watch, "comparison.csv"):
            terminal.wait_for_words("replay.txt", "worst level", replaying)
        # The monitor goes on when the bag has ended, and can be asked. New effects need new samples to be saved with.
        for command in sorted(on_the_robot(), key=lambda command: "set_effects" in command):
            assert "success: True" in terminal.run(command), command
    told = (tmp_path / "replay.txt").read_text()
    assert "REQUIRED" not in told and "has died" not in told
    assert re.search(r"/monitor: driven for 1[12]\d\.\d s until the clock stopped, worst level OK \(OK .* s", told)
    assert re.search(r"/monitor: estimate: damping/mass \S+ \+- \S+ 1/s, stiffness/mass \S+ \+- \S+ 1/s\^2", told)
    rows = list(csv.DictReader(line for line in (tmp_path / "comparison.csv").read_text().splitlines()
                               if re.match(r"%time|\d", line)))
    assert len(rows) > 1000
    last = {name: float(rows[-1][f"field.{name}"]) for name in ("rmse", "base_rmse", "fit_percent", "base_fit_percent")}
    assert last["rmse"] < 0.7 * last["base_rmse"]
    assert last["fit_percent"] > last["base_fit_percent"]
