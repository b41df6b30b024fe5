#!/usr/bin/env python3
"""Drives the paper's experiments and a hidden effect through the nodelets, and writes DIR/report.html with Figs. 3-7.

Needs a built workspace whose setup.bash is sourced; scripts/demo does both. Exit status: 0 done and every claim held,
1 otherwise.
"""
import report.sourced  # noqa: F401  (ends the script without a sourced setup file)
import argparse
import datetime
import pathlib
import shlex
import sys
import time

from report import fleet, hidden_effect
from report.accuracy import find_program, seed_medians
from report.experiments import DURATION, EXPERIMENTS, RunFailed, paper_drive, read_settings, run_drives
from report.page import page, write_whole
from report.progress import Progress
from report.recording import FIELDS, IncompleteRecording, read_recording, require_complete
from report.sections import Results, report_sections, tables

REPOSITORY = pathlib.Path(__file__).resolve().parents[1]
CONFIG = REPOSITORY / "config"
TITLE = "Suspension health monitor: the paper's experiments"


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("demo_out"), metavar="DIR")
    parser.add_argument("--work", type=pathlib.Path, default=REPOSITORY / "build/demo", metavar="DIR",
                        help="for logs and what is deleted again")
    parser.add_argument("--quick", action="store_true", help="leave out the medians over noise seeds")
    parser.add_argument("--seed", type=int, default=1, help="noise of the drives through the nodelets")
    parser.add_argument("--seeds", type=int, default=20, help="how many noise seeds the medians are over")
    return parser.parse_args()


def hidden_bag(options):
    return options.output.resolve() / f"{hidden_effect.NAME}.bag"


def drive_and_read(options, settings):
    """{scenario: Recording} of all experiments, each with every row from the first regression row on; the drive with a
    hidden effect runs beside them. @throws IncompleteRecording"""
    work = options.work.resolve()
    bags = {each.scenario: options.output.resolve() / f"{each.scenario}.bag" for each in EXPERIMENTS}
    drives = [*(paper_drive(scenario, bag, options.seed) for scenario, bag in bags.items()),
              hidden_effect.drive(hidden_bag(options), options.seed, work)]
    print(f"== driving {len(drives)} drives through the nodelets, side by side, as fast as they go", flush=True)
    with Progress("driving") as progress:
        run_drives(drives, work, progress)
    recordings = {}
    for scenario, bag in bags.items():
        recordings[scenario] = read_recording(bag)
        require_complete(recordings[scenario], scenario, settings.first_row, DURATION, settings.period)
    return recordings


def medians(options, recordings):
    if options.quick:
        return {}
    print(f"== the same with {options.seeds} noise seeds each, by suspension_bag simulate and identify", flush=True)
    with Progress("identifying") as progress:
        return seed_medians(find_program(), CONFIG / "paper.yaml", options.work.resolve() / "seeds", recordings,
                            range(1, options.seeds + 1), progress)


def search_hidden_effect(options):
    print("== searching for the hidden effect", flush=True)
    return hidden_effect.search(hidden_bag(options), options.output, options.work.resolve())


def drive_fleet(options):
    print("== weeks of a small fleet", flush=True)
    return fleet.run(options.output, options.work.resolve(), options.quick)


def origin():
    made = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M:%S UTC")
    return (("made", made), ("command", shlex.join([pathlib.Path(sys.argv[0]).name, *sys.argv[1:]])),
            ("topics", ", ".join(topic for topic, _ in FIELDS.values())))


def main():
    options = parse_arguments()
    start = time.monotonic()
    sys.stdout.reconfigure(errors="replace")  # a terminal without the squares still gets its tables
    options.output.mkdir(parents=True, exist_ok=True)
    try:
        settings = read_settings(CONFIG)
        recordings = drive_and_read(options, settings)
        results = Results(settings, EXPERIMENTS, recordings, medians(options, recordings), options.seed, options.seeds,
                          search_hidden_effect(options), drive_fleet(options))
    except (RunFailed, IncompleteRecording) as error:
        sys.exit(f"error: {error}")
    except KeyboardInterrupt:
        sys.exit("interrupted: the drives are ended, no report is written")
    print("\nb1 = damping/mass, b0 = stiffness/mass; LS least squares, LA least sum of absolute values")
    for table in tables(results):
        print(f"\n{table.to_text()}")
    print(f"\nDrive with a hidden effect ({hidden_effect.EFFECT}): {results.search.sentence}")
    print(hidden_effect.ladder(results.search).to_text())
    report = options.output / "report.html"
    write_whole(report, page(TITLE, report_sections(results), origin()))
    held = [claim[-1] for claim in results.claims()]
    print(f"\n{sum(held)} of {len(held)} claims of the paper held, {time.monotonic() - start:.0f} s; report: {report}")
    return 0 if all(held) else 1


if __name__ == "__main__":
    sys.exit(main())
