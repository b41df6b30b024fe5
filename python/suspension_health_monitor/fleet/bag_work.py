"""One bag: identify, health and diagnose, each in a process of its own, and what they say as rows of the database.

What crashes, or is killed for want of memory, is such a process; the worker that has started it tells so and lives on.
"""
import dataclasses
import json
import os
import signal
import subprocess
import sys
import tempfile
from typing import Optional, Tuple

from .drive import CRASHED, ESTIMATOR, OK, POOR, UNREADABLE, Drive
from .errors import FleetError, UsageError

ONLY_STRUT = "strut"  # the name of a strut that is judged alone
_WRONG_USAGE, _WRONG_INPUT, _TOO_POOR = 2, 3, 4
_NO_PROGRAM = (126, 127)  # setpriv says so
# suspension_bag waits until its files are on the disk: those that are deleted at once need not be there.
_MEMORY = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
# A worker that is killed takes its processes along.
_WITH_PARENT = ["setpriv", "--pdeathsig", "KILL"]


@dataclasses.dataclass(frozen=True)
class Work:
    """What is done with every bag. Paths are absolute, and the same on every machine."""
    program: str                             # suspension_bag
    options: Tuple[str, ...] = ()            # of all its commands: --vehicle FILE, --config FILE ...
    baseline: Optional[str] = None           # file of a healthy vehicle or strut
    files: Tuple[str, ...] = ()              # all that are named above
    diagnose: bool = False
    pages: Optional[str] = None              # folder for the pages of diagnose
    temperature_topic: Optional[str] = None  # {strut} in it stands for the strut's name
    time_limit: float = 3600.0               # [s] for each command


class _Failed(Exception):
    """(status, reason) of the drive."""


def read_bag(path, key, work):
    """:returns: a Drive. :raises FleetError: what is no matter of this bag, such as a wrong option."""
    struts, events, findings, diagnosed = {}, [], [], False
    status, reason = OK, None
    with tempfile.TemporaryDirectory(prefix="suspension_fleet.", dir=_MEMORY) as folder:
        try:
            found = _run("identify", path, folder, work)
            struts = {name: _strut_row(name, strut) for name, strut in _by_strut(found).items()}
            said = _run("health", path, folder, work)
            for name, strut in _by_strut(said).items():
                _add_health(struts.get(name), strut)
                events += [dict(strut=name, **event) for event in strut["events"]]
            if work.diagnose:
                page = work.pages and os.path.join(work.pages, key)
                diagnosed = True
                findings = [_finding(name, strut, page) for name, strut in _by_strut(
                    _run("diagnose", path, folder, work, page)).items()]
            if not any(row["valid"] for row in struts.values()):
                status, reason = POOR, "; ".join(sorted({row["reason"] for row in struts.values()}))
        except _Failed as failure:
            status, reason = failure.args
        if work.temperature_topic and struts:
            _add_temperatures(path, struts, work)
    start, duration = _span(path) if status != UNREADABLE else (None, None)
    return Drive(status, reason, start, duration, diagnosed, list(struts.values()), events, findings)


def _run(command, path, folder, work, page=None):
    """:returns: the JSON that a command of suspension_bag has written, {} where the drive is too poor for any."""
    output = os.path.join(folder, command + ".json")
    arguments = [work.program, command, path, *work.options, "--json", output, "--threads", "1"]  # a core for each worker
    if command == "diagnose":
        arguments += ["--report", page] if page else []
    elif work.baseline:
        arguments += ["--baseline", work.baseline]
    status, message = _run_process(arguments, work.time_limit)
    message = message.replace(f"suspension_bag {command}: ", "", 1)
    if status == _WRONG_USAGE or (status == _WRONG_INPUT and message.startswith(work.files)):
        raise UsageError(message)
    if status in _NO_PROGRAM:
        raise FleetError(message)
    if status == _TOO_POOR and command == "identify" and not os.path.exists(output):
        raise _Failed(POOR, message)
    if status == _WRONG_INPUT:
        raise _Failed(UNREADABLE, message.replace(f"{path}: ", "", 1))
    if status not in (0, _TOO_POOR):
        raise _Failed(CRASHED, f"suspension_bag {command} {describe(status)}")
    if not os.path.exists(output):
        return {}
    with open(output) as file:
        return json.load(file)


def _run_process(arguments, time_limit, heard="stderr"):
    """:returns: exit status (below 0 a signal, None the time was up) and the last line of what is heard."""
    streams = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, heard: subprocess.PIPE}
    try:
        done = subprocess.run(_WITH_PARENT + arguments, stdin=subprocess.DEVNULL, timeout=time_limit, encoding="utf-8",
                              errors="replace", start_new_session=True, **streams)
    except subprocess.TimeoutExpired:
        return None, ""
    except OSError as error:
        raise FleetError(f"{_WITH_PARENT[0]}: {error.strerror}") from error
    lines = getattr(done, heard).strip().splitlines()
    return done.returncode, lines[-1] if lines else ""


def describe(status):
    if status is None:
        return "took longer than --time-limit"
    if status >= 0:
        return f"ended with status {status}"
    name = signal.Signals(-status).name
    return f"was ended by {name}" + (", as for want of memory" if -status == signal.SIGKILL else "")


def _by_strut(result):
    """{name: what is said of it}."""
    if "struts" in result:
        return result["struts"]
    return {ONLY_STRUT: result} if result else {}


def _strut_row(name, found):
    """Of the estimate over the whole drive."""
    estimate = found[ESTIMATOR]
    valid = estimate["valid"]
    numbers = ("damping_to_mass", "damping_to_mass_stddev", "stiffness_to_mass", "stiffness_to_mass_stddev")
    return dict(strut=name, estimator=ESTIMATOR if valid else None,
                **{number: estimate[number] if valid else None for number in numbers}, offset=None, temperature=None,
                valid=valid, reason=None if valid else estimate["reason"])


def _add_health(row, said):
    if row is not None:
        row["offset"] = said["la"]["offset"]


def _finding(name, found, page):
    if page:
        page = os.path.join(page, *([] if name == ONLY_STRUT else [name]), "report.html")
    return dict(strut=name, verdict=found["verdict"], effects=" ".join(found["selected"]), page=page)


def _add_temperatures(path, struts, work):
    """Read in a process of their own, too: a broken bag is broken for them as well."""
    topics = {name: work.temperature_topic.replace("{strut}", name) for name in struts}
    status, output = _run_process([sys.executable, "-m", "suspension_health_monitor.fleet.temperature", path,
                                   *sorted(set(topics.values()))], work.time_limit, "stdout")
    means = json.loads(output) if status == 0 else {}
    for name, row in struts.items():
        row["temperature"] = means.get(topics[name])


def _span(path):
    """(first stamp, seconds to the last one) by the bag's index, None where it has none."""
    import rosbag  # slow to import: only workers do
    try:
        with rosbag.Bag(path, skip_index=True) as bag:
            start = bag.get_start_time()
            return start, bag.get_end_time() - start
    except Exception:  # rosbag raises whatever its parsing comes across
        return None, None
