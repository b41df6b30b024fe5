"""Where a person types commands: a folder, and a ROS master of its own."""
import contextlib
import os
import signal
import socket
import subprocess

from conftest import HANGS, wait_until


class Terminal:
    """A folder, and a ROS master of its own."""

    def __init__(self, folder, port):
        self.folder = folder
        self.port = port
        self.environment = dict(os.environ, ROS_MASTER_URI=f"http://localhost:{self.port}", ROS_HOSTNAME="localhost",
                                ROS_HOME=str(folder / "ros_home"), ROSCONSOLE_STDOUT_LINE_BUFFERED="1",
                                PYTHONUNBUFFERED="1")  # what a process says is there when it says it, as on a terminal

    def run(self, command):
        result = subprocess.run(command, shell=True, cwd=self.folder, env=self.environment, timeout=HANGS,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8")
        assert result.returncode == 0, result.stderr
        return result.stdout

    @contextlib.contextmanager
    def start(self, command, output):
        """Runs it in another terminal until the end of the context."""
        with open(self.folder / output, "w", encoding="utf-8") as stream:
            process = subprocess.Popen(command, shell=True, cwd=self.folder, env=self.environment, stdout=stream,
                                       stderr=subprocess.STDOUT, start_new_session=True)
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
