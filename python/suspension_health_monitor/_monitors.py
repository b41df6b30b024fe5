"""Monitors to push readings into as they come."""
from typing import Any, Callable, Dict, Iterable, Optional, Sequence, Tuple, Union

import numpy as np

from . import _core
from ._models import healthy_strut, to_model
from ._arrays import as_array, check_lengths, to_readings, to_stamps
from ._recording import Recording
from ._settings import array_keywords
from ._tables import in_order, stacked
from ._types import Array, Model, Option, Path

_OF_IMU = ("a_x", "a_y", "a_z", "w_x", "w_y", "w_z")


class StrutMonitor:
    """Watches one strut live: readings of two accelerometers in; estimates, comparison and health out.

    It is all that the nodelet does, without messages. Several threads may use it; one pushes at a time.

    :param model: with effects that the model has: a StrutModel or a model file.
    :param baseline: the healthy strut: a Baseline, or the path of a file that the monitor has written.
    :param on_report: called with a MonitorReport after every `every`-th sample; what it raises comes out of push().
    :param tyre: there is a third sensor, where the tyre touches the road.
    :param options: as of identify(): sample_period, integration_horizon, memory, nominal_damping_to_mass ...
    :raises ValueError: naming the option, its value and what is allowed.
    """

    def __init__(self, *, model: Model = None, baseline: Optional[Union[_core.Baseline, Path]] = None,
                 on_report: Optional[Callable[[_core.MonitorReport], Any]] = None, every: int = 1, tyre: bool = False,
                 config: Optional[Path] = None, **options: Option) -> None:
        if on_report is not None and not callable(on_report):
            raise ValueError(f"on_report = {on_report!r}, must be a function or None")
        arguments = ["model", "baseline", "on_report", "every", "tyre", "config"]
        self._core = _core.StrutMonitor(array_keywords(options, config, arguments), tyre, on_report, every)
        if model is not None:
            self.set_model(model)
        if baseline is not None:
            self.set_baseline(baseline)

    def push(self, *readings: Array, stamps_road: Optional[Array] = None, road: Optional[Array] = None,
             **named: Array) -> None:
        """Takes in readings: push(stamps, body, wheel) or push(stamps_body, body, stamps_wheel, wheel), as of Recording,
        each an array (n,) or a single reading. What comes later goes on from there.
        Long arrays cost what they cost in C++, and let other threads run meanwhile.

        :raises ValueError: as Recording; or once, if the options do not fit the sample period that was measured.
        """
        arrays = [np.atleast_1d(as_array(each)) for each in in_order(readings, named)]
        if road is not None:
            stamps_road, road = np.atleast_1d(as_array(stamps_road)), np.atleast_1d(as_array(road))
        self._core.push(Recording(*arrays, stamps_road=stamps_road, road=road)._readings())

    def set_model(self, model: Model) -> None:
        """Has the effects of this model from now on; None: the plain strut. Estimates carry over."""
        self._core.set_model(to_model(model))

    def set_baseline(self, baseline: Union[_core.Baseline, Path]) -> None:
        """Judges health by this from now on."""
        self._core.set_baseline(healthy_strut(baseline)[0])

    @property
    def report(self) -> _core.MonitorReport:
        """What is known after the newest sample: a MonitorReport with .estimate, .ls, .la, .comparison, .health."""
        return self._core.report

    @property
    def baseline(self) -> _core.Baseline:
        """What health is judged by; its values are None as long as nothing was given or learned."""
        return self._core.baseline

    @property
    def tyre(self) -> Optional[_core.Tyre]:
        """What is known of the tyre; None without tyre=True."""
        return self._core.tyre

    @property
    def input(self) -> _core.InputStatus:
        """How the input has been so far: .samples, .rows, .gaps, .clock_jumps ..."""
        return self._core.input

    @property
    def rejected(self) -> Dict[str, int]:
        """Readings that were kept out so far, by reason."""
        return self._core.rejected

    @property
    def sample_period(self) -> Optional[float]:
        """T [s]; None while it is being measured."""
        return self._core.sample_period

    def __repr__(self):
        return f"<StrutMonitor: {self.input.samples} samples, {self.report!r}>"


class VehicleMonitor:
    """Watches all struts of a vehicle: one strut moves the tops of all others, so they are judged together.

    :param struts: names, if every strut has an accelerometer of its own at its top; or a dict of name to position
        (x, y, z) [m] of the strut's top from the body's IMU, in its axes (None: it has one of its own).
    :param sample_period: T [s] of all sensors.
    :param options: as of identify(), of every strut.
    :raises ValueError: naming the option, its value and what is allowed; no strut, or a name that is none.
    """

    def __init__(self, struts: Union[Iterable[str], Dict[str, Optional[Sequence[float]]]], *, sample_period: float,
                 config: Optional[Path] = None, **options: Option) -> None:
        names = [] if isinstance(struts, str) else list(struts)
        if not names or len(set(names)) < len(names) or not all(isinstance(name, str) and name for name in names):
            raise ValueError(f"struts = {struts!r}, must be names, each once, or a dict of name to position")
        positions = dict(struts) if isinstance(struts, dict) else dict.fromkeys(names)
        its = [(name, None if at is None else tuple(to_readings(f"position of {name}", at, (3,))))
               for name, at in positions.items()]
        self.struts: Tuple[str, ...] = tuple(positions)
        self._columns = (_OF_IMU if any(at is not None for _, at in its) else ()) + \
            tuple(name for name, at in its if at is None)
        keywords = array_keywords({**options, "sample_period": sample_period}, config, ["config", "struts"])
        self._core = _core.VehicleMonitor(its, keywords)

    def push(self, stamps: Array, body: Array, wheel: Array) -> None:
        """Takes in readings of all sensors at the same instants.

        :param stamps: (n,) as of Recording.
        :param body: (n, columns) up along the strut [m/s^2] of every strut with an IMU of its own, in their order;
            before these, if struts have positions, the six of the body's IMU: a_x, a_y, a_z [m/s^2], w_x, w_y, w_z
            [rad/s].
        :param wheel: (n, struts) of the wheel carriers [m/s^2].

        Of a DataFrame the columns of these names are taken: of struts, and a_x, a_y, a_z, w_x, w_y, w_z.
        """
        top = to_readings("body", stacked("body", body, self._columns), ("n", len(self._columns)))
        carrier = to_readings("wheel", stacked("wheel", wheel, self.struts), ("n", len(self.struts)))
        nanoseconds = check_lengths("stamps", to_stamps("stamps", stamps), "body", top)
        self._core.push(check_lengths("stamps", nanoseconds, "wheel", carrier), top, carrier)

    @property
    def is_coupled(self) -> bool:
        """True once it is known how the struts move one another; until then there are no estimates."""
        return self._core.is_coupled

    @property
    def reports(self) -> Dict[str, _core.MonitorReport]:
        """By strut's name what is known after the newest sample, a MonitorReport."""
        return dict(zip(self.struts, self._core.reports))

    def __repr__(self):
        return f"<VehicleMonitor: {', '.join(self.struts)}{'' if self.is_coupled else ', coupling not known yet'}>"
