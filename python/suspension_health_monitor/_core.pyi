"""The classes of the results. They cannot be changed; help() tells what stands behind an attribute here."""
from typing import Any, Dict, List, Optional, Tuple

import numpy as np

Numbers = np.ndarray

def __getattr__(name: str) -> Any: ...  # what only the wrapper calls

class Baseline:
    def __init__(self, damping_to_mass: Optional[float] = ..., stiffness_to_mass: Optional[float] = ...) -> None: ...
    damping_scatter: float  # of healthy windows beyond that [1/s]
    damping_to_mass: Optional[float]  # b1 [1/s], or None
    damping_to_mass_stddev: float  # [1/s]; 0 of a given value
    friction: Optional[DryFriction]  # when it was learned, or None: not known
    learned: bool  # from a drive
    learned_from: float  # stamp of its begin [s]
    learned_to: float  # stamp of its end [s]
    stiffness_scatter: float  # [1/s^2]
    stiffness_to_mass: Optional[float]  # b0 [1/s^2], or None
    stiffness_to_mass_stddev: float  # [1/s^2]
    temperature: Optional[DamperTemperature]  # how damping goes with the damper's, or None: not known

class ComparedSegment:
    added_force: Numbers  # the effects' part of the model [m/s^2]
    drive: int  # which of the drives, from 0
    measured: Numbers  # z'' less the mean w'' [m/s^2]
    missing_force: Numbers  # what the model lacks, per unit mass [m/s^2]
    period: float  # T [s]
    predicted: Numbers  # by the free run [m/s^2]
    time: Numbers  # since the start of the drive [s]
    travel: Numbers  # of the free run, compression positive [m]
    travel_rate: Numbers  # [m/s]
    wheel: Numbers  # w'' less its mean [m/s^2]

class Comparison:
    fitted: bool
    free_run: PredictionError  # z'' predicted from w'' alone
    held_out_rmse: Optional[float]  # on blocks that no fit has seen [m/s^2], or None
    horizon_samples: int  # L of these rows
    model: StrutModel  # as it was compared
    noise_floor: float  # what sensor noise alone leaves [m/s^2]
    one_step: Optional[PredictionError]  # rows of the regression with the same numbers, or None
    segments: List[ComparedSegment]  # for plots over time
    stddev: List[float]  # of its numbers, in their order; empty if they were given
    structured_share: float  # share of the error that is not noise
    views: ResidualViews
    where: List[FailureRegion]  # worst first
    def plot(self, axes: Any = ...) -> Any: ...
    def _repr_html_(self) -> str: ...

class ComparisonReport:
    base_fit_percent: float
    base_rmse: float  # of the model without effects [m/s^2]
    fit_percent: float
    measured: float  # z'' [m/s^2]
    predicted: Optional[float]  # [m/s^2], or None until the free run has settled
    rmse: float  # over comparison_window [m/s^2]

class Course:
    damping_to_mass: Numbers  # of estimate [1/s]
    damping_to_mass_stddev: Numbers  # [1/s]
    fit_percent: Numbers  # of the free run
    la_damping_to_mass: Numbers  # of la [1/s]
    la_stiffness_to_mass: Numbers  # of la [1/s^2]
    level: Numbers  # 0 OK, 1 WARN, 2 ERROR, 3 STALE
    ls_damping_to_mass: Numbers  # of ls [1/s]
    ls_stiffness_to_mass: Numbers  # of ls [1/s^2]
    rmse: Numbers  # of the free run [m/s^2]
    stiffness_to_mass: Numbers  # of estimate [1/s^2]
    stiffness_to_mass_stddev: Numbers  # [1/s^2]
    time: Numbers  # [s]
    valid: Numbers  # of estimate

class DamperTemperature:
    celsius: float  # at which the baseline's damping holds
    per_kelvin: float  # change of ln damping [1/K]
    per_kelvin_stddev: float  # [1/K]

class TravelDirection:
    largest: float  # [m] or [m/s]
    mean: float
    share: float  # of the time

class TimeHistogram:
    compression: TravelDirection
    edges: Numbers  # [m] or [m/s], compression above 0
    rebound: TravelDirection
    shares: Numbers  # of the time, by bin

class StopUse:
    effect: str
    gap: float  # [m]
    hits: int
    near: float  # share of the time in the last tenth of the gap or beyond it

class Travel:
    stops: List[StopUse]  # of the model
    travel: TimeHistogram
    travel_rate: TimeHistogram

class Diagnosis:
    base: RankedModel  # the model that the search started with, fitted
    base_fit_percent: float
    change: str  # against nominal values, in a sentence; empty: none are given
    costs: List[Dict[str, Any]]  # by effect found what leaving it out does to b1 and b0, as --json has it
    damper_curve: Dict[str, Numbers]  # velocity [m/s], compression above 0; force, stddev over the body's mass [m/s^2]
    explained_share: float  # of the structure, by the effects named
    extended: Optional[RankedModel]  # the model with what was found, as judged, or None
    extended_fit_percent: float
    final_fit: Optional[FittedModel]  # the same fitted to all samples, or None
    indistinguishable: List[List[str]]  # groups that these drives cannot tell apart
    model: StrutModel  # to go on with: final_fit's, or the base's
    noise_floor: float  # [m/s^2]
    not_tried: List[Tuple[str, str]]  # (name, why) of candidates that these drives cannot tell
    ranking: List[RankedModel]  # single effects, best first
    remainder: str  # what a suspect leaves, in a sentence
    selected: List[str]  # names of what is to be added to the model
    spring_curve: Dict[str, Numbers]  # travel [m], compression above 0; force, stddev over the body's mass [m/s^2]
    structured_share: float  # of the base's error that is not noise
    suggested_drive: str  # what to record next
    summary: str  # the verdict in a sentence
    surface_share: float  # that a force over travel and rate would take
    travel: Travel  # by the model's free run
    verdict: str  # effect_found, suspect, nothing_missing or unexplained
    def plot(self, axes: Any = ...) -> Any: ...
    def plot_curves(self, axes: Any = ...) -> Any: ...
    def _repr_html_(self) -> str: ...

class DirectionLoop:
    area: float  # [m^2/s^2]
    compressing: ResidualBins
    extending: ResidualBins
    gap: float  # [m/s^2]
    gap_standard_error: float  # [m/s^2]

class DryFriction:
    damping_covariance: float  # of the errors of b1 and force [m/s^3]
    damping_gain: float  # what 1 m/s^2 of it acts as of b1 on this road [s/m]
    force: float  # over the body's mass [m/s^2]
    stddev: float  # [m/s^2]

class Effect:
    advice: str  # whether that is design or wear, and what to check
    coefficients: List[Tuple[str, str]]  # (name, unit) of each
    finding: str  # what a workshop would find
    kind: str  # force, or reading: a fault of the body's IMU
    law: str  # the formula, coefficient c included
    name: str
    shapes: List[Tuple[str, str]]  # (name, unit) of each number inside the law

class FailureRegion:
    mean: float  # missing force in the region [m/s^2]
    region: str  # in a few words
    rmse: float  # [m/s^2]
    rmse_elsewhere: float  # [m/s^2]; 0 if the region is everything
    sentence: str  # where, how often, how much, compared with elsewhere
    share: float  # of the samples

class FittedModel:
    all_samples: bool  # False: fitted to two thirds of them
    model: StrutModel
    stddev: List[float]  # of its numbers, in their order

class ForceSurface:
    count: Numbers  # samples in each cell; where 0, the others say nothing
    explained_share: float
    mean: Numbers  # [m/s^2], (rows, columns)
    rate_edges: Numbers  # [m/s], one more than columns
    rms: Numbers  # of the residual [m/s^2]
    standard_error: Numbers  # of the mean [m/s^2]
    travel_edges: Numbers  # [m], one more than rows

class Health:
    baseline: Baseline  # the same; of no use if nothing was given or learned
    counts: Dict[str, int]  # changes to each level
    course: Course  # estimates and level over time
    early_warnings: List[HealthMoment]  # when one began
    end: HealthMoment  # what is said at the end
    estimate: StrutEstimate  # at the end, what the strut is judged by
    events: List[HealthMoment]  # changes of level, in the order of time
    la: StrutEstimate  # estimates at the end
    ls: StrutEstimate  # estimates at the end
    reference: str  # what the strut was judged by at the end, in words
    rejected: Dict[str, int]  # readings that were kept out, by reason
    seconds: Dict[str, float]  # how long each level held [s]
    def plot(self, axes: Any = ...) -> Any: ...
    def _repr_html_(self) -> str: ...

class HealthMoment:
    elapsed: float  # time that the recordings have covered until then [s]
    level: str  # OK, WARN, ERROR or STALE
    message: str  # why
    time: float  # its stamp [s]

class HealthReport:
    damping_change: Optional[float]  # relative to the healthy strut, or None
    early_warning: bool
    learning: Optional[float]  # progress 0 .. 1 of learning the baseline, or None
    level: str  # OK, WARN, ERROR or STALE
    message: str  # in one sentence
    payload_change: Optional[float]  # of the body's mass
    stiffness_change: Optional[float]

class Identification:
    alignment: str  # how readings became samples, in words
    bridged: int  # samples made of readings around a gap
    change: str  # against nominal values, in a sentence; empty: none are given
    clock_jumps: int
    course: Course  # estimates over time
    estimate: StrutEstimate  # over the whole drive: what to trust
    gaps: int
    horizon_samples: int  # L of the integral filter
    iv: StrutEstimate  # estimate, by its former name, until the next version
    la: StrutEstimate  # the same by the least sum of absolute values
    ls: StrutEstimate  # at the end of the drive, by least squares
    mean_period: float  # of uninterrupted samples [s]
    now: StrutEstimate  # the same at the end of the drive, as the live monitor has it
    rejected: Dict[str, int]  # readings that were kept out, by reason
    rows: int  # regression rows that they gave
    sample_period: float  # T [s]
    samples: int  # taken in
    sprung_mass: Optional[float]  # [kg], as it was given, or None
    tyre: Optional[Tyre]  # of a recording with a road sensor, else None
    warnings: List[str]  # of sensors and stamps, in words
    def plot(self, axes: Any = ...) -> Any: ...
    def _repr_html_(self) -> str: ...

class InputStatus:
    clock_jumps: int
    gaps: int
    mean_period: float  # [s]
    period_fits: bool
    unit_fits: bool
    rows: int
    samples: int

class ModelNumber:
    effect: str  # whose it is; empty for those of the linear strut
    name: str  # damping_to_mass, bump_stop (its coefficient), bump_stop/g (a shape)
    symbol: str
    unit: str
    value: float

class MonitorReport:
    comparison: ComparisonReport
    estimate: StrutEstimate  # of the newest blocks: what to trust, and health goes by
    health: HealthReport
    la: StrutEstimate  # by the least sum of absolute values
    ls: StrutEstimate  # by least squares
    stamp: float  # [s]

class PredictionError:
    fit_percent: float  # 100 is perfect, 0 no better than a constant
    rmse: float  # [m/s^2]

class RankedModel:
    effects: List[str]  # names of all that is in it
    error_removed_percent: float  # of the mean square before
    failure: str  # why there is no such model; empty if there is
    fitted: bool  # False: by the linear response only
    held_out_rmse: float  # [m/s^2]
    model: StrutModel
    significance: float  # t of the improvement
    significant: bool

class ResidualBins:
    def __len__(self) -> int: ...
    count: Numbers
    from_: Numbers
    mean: Numbers
    rms: Numbers
    standard_error: Numbers
    to: Numbers

class ResidualCorrelation:
    lag: Numbers  # [s]
    lower: Numbers  # end of the 95 % band
    share_outside: float  # of the lags
    upper: Numbers  # end of the 95 % band
    value: Numbers  # -1 .. 1
    within: bool  # no more lags outside than chance puts there

class ResidualSpectrum:
    coherence: Numbers  # of residual and w'', 0 .. 1
    coherence_threshold: float
    frequency: Numbers  # [Hz]
    measured: Numbers  # of z'' [(m/s^2)^2/Hz]
    noise: Numbers  # what the sensors' noise leaves [(m/s^2)^2/Hz]
    residual: Numbers  # [(m/s^2)^2/Hz]

class ResidualViews:
    cross_correlation: ResidualCorrelation  # residual against w''
    direction: DirectionLoop
    num_samples: int
    offset: float  # mean residual, taken off in all views [m/s^2]
    offset_standard_error: float  # [m/s^2]
    rms: float  # of what is left [m/s^2]
    spectrum: Optional[ResidualSpectrum]  # None if no segment is long enough
    surface: ForceSurface
    time: TimeBins
    travel: ResidualBins
    travel_rate: ResidualBins
    whiteness: ResidualCorrelation  # residual against itself

class Simulation:
    across: Numbers  # a_x, a_y [m/s^2], w_x, w_y [rad/s] of the body's IMU, (readings, 4); NaN: it has none
    body: Numbers  # what it reads up along the strut, gravity included [m/s^2]
    damping_to_mass: Numbers  # b1 [1/s]
    road: Numbers  # what it reads up along the strut, gravity included [m/s^2]
    road_height: Numbers  # [m]
    stamps_body: Numbers  # [s], one per reading
    stamps_road: Numbers  # [s], one per reading
    stamps_wheel: Numbers  # [s], one per reading
    stiffness_to_mass: Numbers  # b0 [1/s^2]
    time: Numbers  # of the truth [s]
    travel: Numbers  # compression positive [m]
    travel_rate: Numbers  # [m/s]
    wheel: Numbers  # what it reads up along the strut, gravity included [m/s^2]
    def plot(self, axes: Any = ...) -> Any: ...
    def _repr_html_(self) -> str: ...

class StrutEstimate:
    age: float  # of the data behind estimate, on average [s]; else NaN
    coefficients: Numbers  # of the effects in the model, in their order
    correlation: float  # of the errors of b1 and b0 [-]; of estimate
    damping_ratio: float  # [-]
    damping_to_mass: float  # b1 = damping/mass [1/s]
    damping_to_mass_stddev: float  # [1/s]
    delay: float  # by which the wheel carrier's readings are stamped late [s]; of estimate, else NaN
    delay_stddev: float  # [s]
    explained: float  # share of the body's motion that the strut explains
    friction: Optional[DryFriction]  # of estimate without other effects, or None
    gain: float  # of the body's sensor over that of the wheel's, less 1 [-]
    gain_stddev: float  # [-]
    known_to: float  # half the width of the 95 % interval of b1 or b0, over its size: the larger one [-]
    natural_frequency: float  # undamped [Hz]
    offset: float  # of the wheel carrier's reading against the body's [m/s^2]; of ls and la, else NaN
    reason: str  # why it is not valid; empty if it is
    rows: float  # of estimate blocks, else regression rows in the memory
    stiffness_to_mass: float  # b0 = stiffness/mass [1/s^2]
    stiffness_to_mass_stddev: float  # [1/s^2]
    valid: bool
    window: float  # time that they span [s]; else NaN

class StrutModel:
    damping_to_mass: float  # b1 [1/s]
    effects: List[str]  # Names of the effects in it.
    numbers: List[ModelNumber]  # All numbers: b1, b0, then effect by effect.
    settings: Dict[str, Any]  # As a dict, which model= takes as well.
    stiffness_to_mass: float  # b0 [1/s^2]
    def yaml(self) -> str: ...
    def _repr_html_(self) -> str: ...

class TimeBins:
    def __len__(self) -> int: ...
    count: Numbers
    damping_error: Numbers  # to be added to b1 [1/s]
    damping_error_stddev: Numbers  # [1/s]
    drive: Numbers  # which of the drives, from 0
    from_: Numbers
    mean: Numbers
    rms: Numbers
    standard_error: Numbers
    stiffness_error: Numbers  # to be added to b0 [1/s^2]
    stiffness_error_stddev: Numbers  # [1/s^2]
    to: Numbers

class Tyre:
    la: WheelEstimate
    ls: WheelEstimate

class WheelEstimate:
    damping_to_wheel_mass: float  # [1/s]
    damping_to_wheel_mass_stddev: float  # [1/s]
    stiffness_to_wheel_mass: float  # [1/s^2]
    stiffness_to_wheel_mass_stddev: float  # [1/s^2]
    tyre_to_wheel_mass: float  # [1/s^2]
    tyre_to_wheel_mass_stddev: float  # [1/s^2]
    valid: bool
    wheel_hop_frequency: float  # [Hz]
