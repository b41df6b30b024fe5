"""Where a person types commands: a folder, and a ROS master of its own."""
import contextlib
import os
import re
import signal
import socket
import subprocess

from conftest import HANGS, wait_until

PROGRAMS = ("rosrun", "roslaunch", "rosservice", "rostopic", "rosbag", "rqt_plot", "suspension_bag", "scripts/",
            "source", "cp")


def commands_of(text):
    """The commands of every block without a language, or of a shell; without their comments."""
    for language, block in re.findall(r"^```(\w*)\n(.*?)^```$", text, re.DOTALL | re.MULTILINE):
        if language not in ("", "sh"):
            continue
        lines = [re.sub(r"\s+#.*$", "", line) for line in block.replace("\\\n", " ").splitlines()]
        yield [line for line in lines if line.startswith(PROGRAMS)]


def require_no_error(told):
    """@param told  by roslaunch. A line that begins so is its own; a monitor's, what it waits for, has a time."""
    assert not re.search(r"Traceback|RLException|has died|^(\x1b\[\d+m)*ERROR: ", told, re.MULTILINE), told


def launch_and_look(terminal, command, fields=()):
    """Runs a launch file until its monitor is there and has published these fields, such as /monitor/estimate/valid."""
    with terminal.start(command, "launch.txt") as launched:
        terminal.wait_for_master()
        terminal.wait_for_words("launch.txt", "process[", launched)
        for topic in ["/diagnostics/status", *fields]:
            topic, _, field = topic.rpartition("/")
            assert f"{field}: " in terminal.run(f"timeout 120 rostopic echo -n 1 {topic}"), topic
        assert launched.poll() is None, "it goes on"
    require_no_error((terminal.folder / "launch.txt").read_text(errors="replace"))


class Terminal:
    """A folder, and a ROS master of its own."""

    def __init__(self, folder, port, environment=os.environ):
        self.folder = folder
        self.port = port
        self.environment = dict(environment, ROS_MASTER_URI=f"http://localhost:{self.port}", ROS_HOSTNAME="localhost",
                                ROS_HOME=str(folder / "ros_home"), ROSCONSOLE_STDOUT_LINE_BUFFERED="1",
                                PYTHONUNBUFFERED="1")  # what a process says is there when it says it, as on a terminal

    def shell(self):
        return {"shell": True, "executable": "/bin/bash", "cwd": self.folder, "env": self.environment}

    def run(self, command):
        result = subprocess.run(command, **self.shell(), timeout=HANGS, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                encoding="utf-8")
        assert result.returncode == 0, result.stderr
        return result.stdout

    @contextlib.contextmanager
    def start(self, command, output):
        """Runs it in another terminal until the end of the context."""
        with open(self.folder / output, "w", encoding="utf-8") as stream:
            process = subprocess.Popen(command, **self.shell(), stdout=stream, stderr=subprocess.STDOUT,
                                       start_new_session=True)
        try:
            yield process
        finally:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGINT)
            try:
                process.wait(HANGS)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()

    def wait_for_master(self):
        def is_there():
            with contextlib.suppress(OSError), socket.create_connection(("localhost", self.port)):
                return True
            return False

        wait_until(is_there, "a ROS master")

    def wait_for_words(self, output, words, process=None):
        """Waits until a process that was started has written them."""
        path = self.folder / output
        wait_until(lambda: words in path.read_text(errors="replace") or (process and process.poll() is not None),
                   f"{words!r} in {path}")
        assert words in path.read_text(errors="replace"), path.read_text(errors="replace")
