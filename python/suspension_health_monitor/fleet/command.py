"""suspension_fleet: the command line."""
import argparse
import os
import signal
import sys

from . import report, scan_command, show, simulate_command
from .errors import FleetError

COMMANDS = {"scan": scan_command, "show": show, "report": report, "simulate": simulate_command}
EPILOG = "doc/fleet.md tells more. Exit status: 0 done, 2 wrong usage, 3 unreadable or wrong input."


def parser():
    result = argparse.ArgumentParser(prog="suspension_fleet", epilog=EPILOG,
                                     description="Many bags, many vehicles: their struts over months.")
    commands = result.add_subparsers(dest="command", metavar="COMMAND", required=True)
    for name, module in COMMANDS.items():
        command = commands.add_parser(name, help=module.HELP, description=module.HELP, epilog=EPILOG)
        module.add_options(command)
        command.set_defaults(run=module.run)
    return result


class _Terminated(BaseException):
    """SIGTERM, as Ctrl-C is KeyboardInterrupt."""


def _terminate(*_):
    raise _Terminated


def main(arguments=None):
    """:returns: exit status. Ctrl-C, and SIGTERM, end it as whoever waits for it expects, with a good database."""
    options = parser().parse_args(arguments)
    signal.signal(signal.SIGTERM, _terminate)
    try:
        options.run(options)
    except FleetError as error:
        print(f"suspension_fleet {options.command}: {error}", file=sys.stderr)
        return error.status
    except (KeyboardInterrupt, _Terminated) as interruption:
        number = signal.SIGINT if isinstance(interruption, KeyboardInterrupt) else signal.SIGTERM
        signal.signal(number, signal.SIG_DFL)
        os.kill(os.getpid(), number)
    return 0
