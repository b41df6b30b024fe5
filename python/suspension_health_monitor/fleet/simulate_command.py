"""suspension_fleet simulate: the bags of a fleet that wears, and the truth about it."""
import os

from .errors import naming
from .fleet_model import Laws
from .options import above_zero, at_least_one, date, find_program
from .progress import bar
from .simulation import TRUTH_FILE, VEHICLE_FILE, Simulation, read_model

HELP = "write the bags of a fleet that wears, and the truth about it"


def add_options(simulate):
    simulate.add_argument("-o", "--output", metavar="DIR", required=True, help="DIR/VEHICLE/DAY.bag, DIR/vehicle.yaml "
                          "for scan --vehicle-file, DIR/truth.json; bags that are there already stay")
    simulate.add_argument("--vehicles", type=at_least_one, default=3, metavar="N", help="default: %(default)s")
    simulate.add_argument("--vehicle-model", metavar="FILE", help="YAML file as of `suspension_bag simulate`; default: a "
                          "robot of 60 kg on four struts")
    simulate.add_argument("--start", type=date, default="2026-01-05", metavar="YEAR-MONTH-DAY",
                          help="the first day; default: %(default)s")
    simulate.add_argument("--duration", type=above_zero, default=60.0, metavar="S", help="[s] of a drive; default: "
                          "%(default)g")
    simulate.add_argument("--rate", type=above_zero, default=100.0, metavar="HZ", help="default: %(default)g")
    simulate.add_argument("--workers", type=at_least_one, default=os.cpu_count() or 1, metavar="N",
                          help="bags written at once; default: this machine's cores")
    Laws.add_to(simulate, leave_out=["start"])


def run(options):
    program, laws = find_program(), Laws.of(options)
    simulation = Simulation(program, options.output, read_model(program, options.vehicle_model), laws, options.vehicles,
                            options.duration, options.rate)
    drives = simulation.drives()
    with bar(len(drives)) as progress, naming(options.output):
        simulation.write_bags(options.workers, progress.update)
    files = ", ".join(os.path.join(options.output, name) for name in ("*/*.bag", VEHICLE_FILE, TRUTH_FILE))
    return f"{len(drives)} bags of {options.vehicles} vehicles\nwrote {files}\n"
