"""suspension_fleet: the command line."""
import argparse
import contextlib
import os
import signal
import sys

from . import interruptions, needs, report, scan_command, show, simulate_command
from .errors import FleetError
from .options import not_empty
from .wording import plain

COMMANDS = {"scan": scan_command, "show": show, "report": report, "simulate": simulate_command}
EPILOG = "doc/fleet.md tells more. Exit status: 0 done, 2 wrong usage, 3 unreadable or wrong input."


def parser():
    result = argparse.ArgumentParser(prog="suspension_fleet", epilog=EPILOG, allow_abbrev=False,
                                     description="Many bags, many vehicles: their struts over months.")
    commands = result.add_subparsers(dest="command", metavar="COMMAND", required=True)
    for name, module in COMMANDS.items():
        command = commands.add_parser(name, help=module.HELP, description=module.HELP, epilog=EPILOG, allow_abbrev=False)
        command.register("type", None, not_empty)
        module.add_options(command)
        command.set_defaults(run=module.run)
    return result


_SIGNALS = {**interruptions.NUMBERS, BrokenPipeError: signal.SIGPIPE}


def _say(words):
    """On standard output. :raises BrokenPipeError: nobody listens any more. FleetError: it takes no more."""
    with contextlib.suppress(AttributeError):  # another stream, or none
        sys.stdout.reconfigure(errors="backslashreplace")  # as standard error is: not every terminal has a plus-minus
    try:
        print(words, end="", flush=True)
    except BrokenPipeError:
        raise
    except OSError as error:
        sys.stdout = None  # the interpreter would try again
        raise FleetError(f"standard output: {error.strerror}") from error


def main(arguments=None):
    """:returns: exit status. Ctrl-C, and SIGTERM, end it as whoever waits for it expects, with a good database."""
    options = parser().parse_args(arguments)
    try:
        interruptions.hear()
        return _run(options)
    except tuple(_SIGNALS) as interruption:
        number = _SIGNALS[type(interruption)]
    signal.signal(number, signal.SIG_DFL)
    if number != signal.SIGPIPE:
        _complain(options, f"ended by {number.name}")
    os.kill(os.getpid(), number)


def _run(options):
    try:
        _say(options.run(options))
    except FleetError as error:
        _complain(options, error)
        return error.status
    except ModuleNotFoundError as error:
        _complain(options, needs.missing(error))
        return FleetError.status
    return 0


def _complain(options, words):
    print(plain(f"suspension_fleet {options.command}: {words}"), file=sys.stderr)
