"""The functions of the module. Each takes arrays, recordings or bags, and options by the names of doc/settings.md."""
import os
from typing import Any, Dict, List, Optional, Union, overload

from . import _core, _docs, _html, _plain, _plots
from ._core import Baseline, Comparison, Diagnosis, Effect, Health, Identification, Simulation, StrutModel
from ._csv import read_csv
from ._models import healthy_strut, library, model_file, to_model
from ._monitors import StrutMonitor, VehicleMonitor
from ._plain import to_dict
from ._progress import callback
from ._recording import Recording, is_path, to_source
from ._settings import array_keywords, assignments, files, simulator_keywords
from ._tables import NAMES
from ._types import Model, Option, Path, Progress

__all__ = ["Baseline", "Comparison", "Diagnosis", "Effect", "Health", "Identification", "Recording", "Simulation",
           "StrutModel", "StrutMonitor", "VehicleMonitor", "compare", "diagnose", "effects", "health", "identify",
           "read_csv", "simulate", "to_dict"]

_OF_BAGS = ("sprung_topic", "unsprung_topic", "road_topic", "start", "end", "vehicle", "strut")


@overload
def identify(*drives: Any, vehicle: Path, **options: Any) -> Dict[str, Identification]: ...
@overload
def identify(*drives: Any, vehicle: None = None, model: Model = None, effects_file: Optional[Path] = None,
             progress: Progress = None, **options: Option) -> Identification: ...
def identify(*drives: Any, vehicle: Optional[Path] = None, model: Model = None, effects_file: Optional[Path] = None,
             progress: Progress = None, **options: Option) -> Any:
    """Damping/mass b1 [1/s] and stiffness/mass b0 [1/s^2] of a strut from recorded drives.

    :param drives: arrays, as Recording takes them, in order or by name: stamps (n,), body (n,), wheel (n,), or
        stamps_body, body, stamps_wheel, wheel; or Recordings or DataFrames; or paths of bags, which bag= takes as well.
        All of one strut, taken one after the other.
    :param vehicle: of bags the path of the YAML file with the IMUs of a whole vehicle, instead of topics.
    :param model: with effects that are in the model of ls and la; a StrutModel, a dict or a model file.
    :param effects_file: path of a YAML file with laws of your own, which the model may have.
    :param progress: called with the share that is done, 0 .. 1; True: a bar.
    :param options: of doc/settings.md, with _ for /: sample_period [s], integration_horizon [s], memory [s],
        sprung_mass [kg] ... config: path of a YAML file with such; of arrays those of messages in it say nothing:
        axes, frames, ranges, rates and what is published. Of bags also sprung_topic, unsprung_topic,
        road_topic, start [s], end [s]. Left out: the period is measured, the horizon proposed from the data.
        strut: of the vehicle, the only one that is wanted.
    :returns: an Identification: .estimate, .ls, .la with .damping_to_mass, .stiffness_to_mass, their _stddev, .valid ...;
        .change, a sentence, where nominal values are given; of a vehicle a dict of them by strut.
    :raises ValueError: wrong option, array or file; or too little data, saying what would be enough.
    """
    call = _Call("identify", drives, vehicle, options, ["model", "effects_file"], progress)
    if not call.is_of_bags:
        return call.of_arrays(_core.identify, to_model(model, effects_file))
    if call.is_of_vehicle and (model is not None or effects_file is not None):
        raise ValueError("model and effects_file beside vehicle, must be left out: config names the models of its struts")
    with model_file(model, effects_file) as file:
        settings = {"effects_file": effects_file, "model_file": file}
        return call.of_bags("identify", settings={k: v for k, v in settings.items() if v is not None})


@overload
def compare(*drives: Any, vehicle: Path, **options: Any) -> Dict[str, Comparison]: ...
@overload
def compare(*drives: Any, vehicle: None = None, model: Model = None, effects_file: Optional[Path] = None,
            progress: Progress = None, **options: Option) -> Comparison: ...
def compare(*drives: Any, vehicle: Optional[Path] = None, model: Model = None, effects_file: Optional[Path] = None,
            progress: Progress = None, **options: Option) -> Any:
    """How far a model is from the measurement, and where it fails.

    :param drives, vehicle: as of identify().
    :param model: whose numbers are judged as they are: a StrutModel, such as Diagnosis.model, a dict of settings or
        the path of a model file, of a vehicle one with its struts. None: the linear strut, fitted.
    :param effects_file, progress, options: as of identify().
    :returns: a Comparison: .free_run.rmse [m/s^2], .where (sentences, worst first), .views, .segments ...; of a
        vehicle a dict of them by strut.
    :raises ValueError: as identify().
    """
    call = _Call("compare", drives, vehicle, options, ["model", "effects_file"], progress)
    if not call.is_of_bags:
        return call.of_arrays(_core.compare, to_model(model, effects_file))
    with model_file(model, effects_file) as file:
        return call.of_bags("compare", model=file, effects_file=effects_file)


@overload
def diagnose(*drives: Any, vehicle: Path, **options: Any) -> Dict[str, Diagnosis]: ...
@overload
def diagnose(*drives: Any, vehicle: None = None, model: Model = None, effects_file: Optional[Path] = None,
             threads: Optional[int] = None, progress: Progress = None, **options: Option) -> Diagnosis: ...
def diagnose(*drives: Any, vehicle: Optional[Path] = None, model: Model = None, effects_file: Optional[Path] = None,
             threads: Optional[int] = None, progress: Progress = None, **options: Option) -> Any:
    """Which physical effect the model misses, and how sure that is.

    :param drives, vehicle: as of identify(); two minutes on a road are enough for most effects.
    :param model: to start with: the search is for what is missing beside its effects.
    :param effects_file: path of a YAML file with laws of your own, tried beside the catalogue.
    :param threads: processor cores to use, 1 or more; None: all. The result is the same for any number.
    :param progress, options: as of identify().
    :returns: a Diagnosis: .verdict, .summary (a sentence), .selected (names), .model, .ranking ...; of a
        vehicle a dict of them by strut.
    :raises ValueError: as identify().
    """
    call = _Call("diagnose", drives, vehicle, options, ["model", "effects_file", "threads"], progress)
    threads = os.cpu_count() or 1 if threads is None else threads
    if not isinstance(threads, int) or isinstance(threads, bool):
        raise ValueError(f"threads = {threads!r}, must be a whole number")
    if not call.is_of_bags:
        return call.of_arrays(_core.diagnose, to_model(model, effects_file), library(effects_file), threads)
    with model_file(model, effects_file) as file:
        return call.of_bags("diagnose", threads, model=file, effects_file=effects_file)


@overload
def health(*drives: Any, vehicle: Path, **options: Any) -> Dict[str, Health]: ...
@overload
def health(*drives: Any, vehicle: None = None, baseline: Optional[Union[Baseline, Path]] = None,
           progress: Progress = None, **options: Option) -> Health: ...
def health(*drives: Any, vehicle: Optional[Path] = None, baseline: Optional[Union[Baseline, Path]] = None,
           progress: Progress = None, **options: Option) -> Any:
    """What the monitor would have said over recorded drives, and when.

    :param drives, vehicle: as of identify().
    :param baseline: the healthy strut: a Baseline, such as Health.baseline of an earlier drive, or the path of a file
        that the monitor has written, or of settings with nominal values. None: the nominal values among the options, or
        what the drive itself teaches. Of a vehicle the path of such a file with its struts.
    :param progress: as of identify().
    :param options: as of identify(), such as nominal_damping_to_mass [1/s], health_damping_warn, input_timeout [s].
    :returns: a Health: .events (changes of level with their reasons), .end, .seconds by level, .course ...;
        of a vehicle a dict of them by strut.
    :raises ValueError: as identify().
    """
    call = _Call("health", drives, vehicle, options, ["baseline"], progress)
    if call.is_of_vehicle:
        if not (baseline is None or is_path(baseline)):
            raise ValueError("baseline of a vehicle, must be the path of a file with its struts")
        return call.of_bags("health", None, "", baseline=baseline)
    healthy, file = healthy_strut(baseline)
    return call.of_bags("health", healthy, file) if call.is_of_bags else call.of_arrays(_core.health, healthy, file)


def effects(effects_file: Optional[Path] = None) -> List[Effect]:
    """The physical effects that diagnose() and simulate() know, as a list of Effect.

    :param effects_file: path of a YAML file with laws of your own, listed too.
    :raises ValueError: naming the file and what is wrong in it.
    """
    return _html.EffectList(library(effects_file).effects)


def simulate(output: Optional[Path] = None, *, effect: Optional[Union[str, List[str]]] = None,
             effects_file: Optional[Path] = None, progress: Progress = None, **options: Option) -> Optional[Simulation]:
    """A simulated drive of one strut, for trying things and for tests; the same for the same options and seed.

    :param output: path of a bag to write instead; whole vehicles (vehicle_model) only so.
    :param effect: to hide in strut or sensor: "NAME=COEFFICIENT[,SHAPE=VALUE]...", or a list of such.
    :param effects_file: path of a YAML file with laws of your own, for effect.
    :param progress: as of identify().
    :param options: of doc/settings.md, the simulator's: scenario, vehicle, duration [s], rate [Hz], noise [m/s^2],
        seed ... config: path of a YAML file with such.
    :returns: a Simulation: .stamps_body (n,), .body (n,), .stamps_wheel (m,), .wheel (m,) and the truth; a bag: None.
    :raises ValueError: naming option, value and what is allowed.
    """
    if effect is not None:
        options["hidden"] = effect if isinstance(effect, str) else "; ".join(effect)
    with callback(progress, "simulate") as told:
        if output is None:
            if options.get("vehicle_model") is not None:
                raise ValueError("vehicle_model is of a bag: output is not given, must be its path")
            return _core.simulate(simulator_keywords(options, False), library(effects_file), told)
        of_vehicle = options.get("vehicle_model") is not None
        files().simulate(os.fspath(output), simulator_keywords({**options, "effects_file": effects_file}, of_vehicle), told)
    return None


class _Call:
    """One call of a function: what it is about, and its options."""

    def __init__(self, name, drives, vehicle, options, arguments, progress):
        self._name, self._progress = name, progress
        bags = options.pop("bag", ())
        named = {key: options.pop(key) for key in list(options) if key in NAMES}
        kind, self._source = to_source((*drives, *((bags,) if is_path(bags) else bags)), named)
        self.is_of_bags = kind == "bags"
        self._of_bags = {key: options.pop(key) for key in _OF_BAGS if key in options}
        self.is_of_vehicle = vehicle is not None
        if self.is_of_vehicle:
            self._of_bags["vehicle"] = vehicle
        if self._of_bags and not self.is_of_bags:
            raise ValueError(f"{next(iter(self._of_bags))} is an option of bags, must not come with arrays")
        self._config = options.pop("config", None)
        self._keywords = array_keywords(options, None if self.is_of_bags else self._config,
                                        [*_OF_BAGS, "bag", "config", "progress", *arguments])

    def of_bags(self, name, *more, settings=(), **flags):
        paths = [f"./{path}" if path.startswith("-") else path for path in self._source]
        given = assignments(self._keywords) + assignments(dict(settings))
        with callback(self._progress, self._name) as told:
            found = getattr(files(), name)(paths + _flags(**self._of_bags, config=self._config, **flags)
                                           + [f"--set={each}" for each in given], *more, told)
        return found if self.is_of_vehicle else found[""]

    def of_arrays(self, function, *more):
        readings = [recording._readings() for recording in self._source]
        with callback(self._progress, self._name) as told:
            return function(readings, self._keywords, *more, told)


def _flags(**values):
    return [f"--{name.replace('_', '-')}={os.fspath(value) if is_path(value) else repr(value)}"
            for name, value in values.items() if value is not None]


_docs.install()
_html.install()
_plots.install()
_plain.install()
