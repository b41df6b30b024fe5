"""How healthy is a suspension, and is its model right? From accelerations of body and wheel carrier.

    import suspension_health_monitor as shm
    found = shm.diagnose(stamps, body, wheel)     # arrays, Series, a DataFrame, or the path of a bag
    print(found.summary)

identify, compare, diagnose, health: of recorded drives; read_csv reads one from a CSV file. StrutMonitor,
VehicleMonitor: to push readings into as they come. effects, simulate: the catalogue, and drives to try things with.
doc/python.md leads through it.

Signs and units: SI; z up; readings are those along the strut, up positive, with or without gravity; travel is
compression positive. Wrong use raises ValueError in the words of the command line.

Messages and services of the ROS package are in suspension_health_monitor.msg and .srv. Whoever imports only these does
not load the rest: it comes with the first name that is asked for.
"""
from pkgutil import extend_path
from typing import TYPE_CHECKING

# In a catkin devel space the compiled parts are in another folder, which processes that this one spawns have to find.
__path__ = extend_path(__path__, __name__)

__all__ = [
    "Baseline", "Comparison", "Diagnosis", "Effect", "Health", "Identification", "Recording", "Simulation",
    "StrutModel", "StrutMonitor", "VehicleMonitor", "compare", "diagnose", "effects", "health", "identify", "read_csv",
    "simulate", "to_dict",
]

if TYPE_CHECKING:
    from ._api import (Baseline, Comparison, Diagnosis, Effect, Health, Identification, Recording, Simulation,
                       StrutModel, StrutMonitor, VehicleMonitor, compare, diagnose, effects, health, identify, read_csv,
                       simulate, to_dict)


def __getattr__(name):
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from . import _api
    for each in __all__:
        globals()[each] = getattr(_api, each)
    return globals()[name]


def __dir__():
    return sorted({*globals(), *__all__})
