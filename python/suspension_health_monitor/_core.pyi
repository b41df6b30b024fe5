"""The classes of the results. They cannot be changed; what an attribute is, and its unit, help() tells."""
from typing import Any, Dict, List, Optional, Tuple

import numpy as np

Numbers = np.ndarray

def __getattr__(name: str) -> Any: ...  # what only the wrapper calls

class Baseline:
    def __init__(self, damping_to_mass: Optional[float] = ..., stiffness_to_mass: Optional[float] = ...) -> None: ...
    damping_scatter: float
    damping_to_mass: Optional[float]
    damping_to_mass_stddev: float
    friction: Optional[DryFriction]
    learned: bool
    learned_from: float
    learned_to: float
    stiffness_scatter: float
    stiffness_to_mass: Optional[float]
    stiffness_to_mass_stddev: float
    temperature: Optional[DamperTemperature]

class ComparedSegment:
    added_force: Numbers
    drive: int
    measured: Numbers
    missing_force: Numbers
    period: float
    predicted: Numbers
    time: Numbers
    travel: Numbers
    travel_rate: Numbers
    wheel: Numbers

class Comparison:
    fitted: bool
    free_run: PredictionError
    held_out_rmse: Optional[float]
    horizon_samples: int
    model: StrutModel
    noise_floor: float
    one_step: Optional[PredictionError]
    segments: List[ComparedSegment]
    stddev: List[float]
    structured_share: float
    views: ResidualViews
    where: List[FailureRegion]
    def plot(self, axes: Any = ...) -> Any: ...
    def _repr_html_(self) -> str: ...

class ComparisonReport:
    base_fit_percent: float
    base_rmse: float
    fit_percent: float
    measured: float
    predicted: Optional[float]
    rmse: float

class Course:
    damping_to_mass: Numbers
    damping_to_mass_stddev: Numbers
    fit_percent: Numbers
    la_damping_to_mass: Numbers
    la_stiffness_to_mass: Numbers
    level: Numbers
    ls_damping_to_mass: Numbers
    ls_stiffness_to_mass: Numbers
    rmse: Numbers
    stiffness_to_mass: Numbers
    stiffness_to_mass_stddev: Numbers
    time: Numbers
    valid: Numbers

class DamperTemperature:
    celsius: float
    per_kelvin: float
    per_kelvin_stddev: float

class Diagnosis:
    base: RankedModel
    base_fit_percent: float
    change: str
    explained_share: float
    extended: Optional[RankedModel]
    extended_fit_percent: float
    final_fit: Optional[FittedModel]
    indistinguishable: List[List[str]]
    model: StrutModel
    noise_floor: float
    not_tried: List[Tuple[str, str]]
    ranking: List[RankedModel]
    remainder: str
    selected: List[str]
    structured_share: float
    suggested_drive: str
    summary: str
    surface_share: float
    verdict: str
    def plot(self, axes: Any = ...) -> Any: ...
    def _repr_html_(self) -> str: ...

class DirectionLoop:
    area: float
    compressing: ResidualBins
    extending: ResidualBins
    gap: float
    gap_standard_error: float

class DryFriction:
    damping_covariance: float
    damping_gain: float
    force: float
    stddev: float

class Effect:
    coefficients: List[Tuple[str, str]]
    finding: str
    kind: str
    law: str
    name: str
    shapes: List[Tuple[str, str]]

class FailureRegion:
    mean: float
    region: str
    rmse: float
    rmse_elsewhere: float
    sentence: str
    share: float

class FittedModel:
    all_samples: bool
    model: StrutModel
    stddev: List[float]

class ForceSurface:
    count: Numbers
    explained_share: float
    mean: Numbers
    rate_edges: Numbers
    rms: Numbers
    standard_error: Numbers
    travel_edges: Numbers

class Health:
    baseline: Baseline
    counts: Dict[str, int]
    course: Course
    early_warnings: List[HealthMoment]
    end: HealthMoment
    estimate: StrutEstimate
    events: List[HealthMoment]
    la: StrutEstimate
    ls: StrutEstimate
    reference: str
    rejected: Dict[str, int]
    seconds: Dict[str, float]
    def plot(self, axes: Any = ...) -> Any: ...
    def _repr_html_(self) -> str: ...

class HealthMoment:
    elapsed: float
    level: str
    message: str
    time: float

class HealthReport:
    damping_change: Optional[float]
    early_warning: bool
    learning: Optional[float]
    level: str
    message: str
    payload_change: Optional[float]
    stiffness_change: Optional[float]

class Identification:
    alignment: str
    bridged: int
    change: str
    clock_jumps: int
    course: Course
    estimate: IdentifiedStrut
    gaps: int
    horizon_samples: int
    iv: IdentifiedStrut
    la: IdentifiedStrut
    ls: IdentifiedStrut
    mean_period: float
    now: IdentifiedStrut
    rejected: Dict[str, int]
    rows: int
    sample_period: float
    samples: int
    sprung_mass: Optional[float]
    tyre: Optional[Tyre]
    warnings: List[str]
    def plot(self, axes: Any = ...) -> Any: ...
    def _repr_html_(self) -> str: ...

class IdentifiedStrut:
    age: float
    damping_ratio: float
    damping_to_mass: float
    damping_to_mass_stddev: float
    explained: float
    natural_frequency: float
    reason: str
    rows: float
    stiffness_to_mass: float
    stiffness_to_mass_stddev: float
    valid: bool

class InputStatus:
    clock_jumps: int
    gaps: int
    mean_period: float
    period_fits: bool
    unit_fits: bool
    rows: int
    samples: int

class ModelNumber:
    effect: str
    name: str
    symbol: str
    unit: str
    value: float

class MonitorReport:
    comparison: ComparisonReport
    estimate: StrutEstimate
    health: HealthReport
    la: StrutEstimate
    ls: StrutEstimate
    stamp: float

class PredictionError:
    fit_percent: float
    rmse: float

class RankedModel:
    effects: List[str]
    error_removed_percent: float
    failure: str
    fitted: bool
    held_out_rmse: float
    model: StrutModel
    significance: float
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
    lag: Numbers
    lower: Numbers
    share_outside: float
    upper: Numbers
    value: Numbers
    within: bool

class ResidualSpectrum:
    coherence: Numbers
    coherence_threshold: float
    frequency: Numbers
    measured: Numbers
    noise: Numbers
    residual: Numbers

class ResidualViews:
    cross_correlation: ResidualCorrelation
    direction: DirectionLoop
    num_samples: int
    offset: float
    offset_standard_error: float
    rms: float
    spectrum: Optional[ResidualSpectrum]
    surface: ForceSurface
    time: TimeBins
    travel: ResidualBins
    travel_rate: ResidualBins
    whiteness: ResidualCorrelation

class Simulation:
    across: Numbers
    body: Numbers
    damping_to_mass: Numbers
    road: Numbers
    road_height: Numbers
    stamps_body: Numbers
    stamps_road: Numbers
    stamps_wheel: Numbers
    stiffness_to_mass: Numbers
    time: Numbers
    travel: Numbers
    travel_rate: Numbers
    wheel: Numbers
    def plot(self, axes: Any = ...) -> Any: ...
    def _repr_html_(self) -> str: ...

class StrutEstimate:
    age: float
    coefficients: Numbers
    correlation: float
    damping_ratio: float
    damping_to_mass: float
    damping_to_mass_stddev: float
    delay: float
    delay_stddev: float
    explained: float
    friction: Optional[DryFriction]
    gain: float
    gain_stddev: float
    natural_frequency: float
    offset: float
    reason: str
    rows: float
    stiffness_to_mass: float
    stiffness_to_mass_stddev: float
    valid: bool
    window: float

class StrutModel:
    damping_to_mass: float
    effects: List[str]
    numbers: List[ModelNumber]
    settings: Dict[str, Any]
    stiffness_to_mass: float
    def yaml(self) -> str: ...
    def _repr_html_(self) -> str: ...

class TimeBins:
    def __len__(self) -> int: ...
    count: Numbers
    damping_error: Numbers
    damping_error_stddev: Numbers
    drive: Numbers
    from_: Numbers
    mean: Numbers
    rms: Numbers
    standard_error: Numbers
    stiffness_error: Numbers
    stiffness_error_stddev: Numbers
    to: Numbers

class Tyre:
    la: WheelEstimate
    ls: WheelEstimate

class WheelEstimate:
    damping_to_wheel_mass: float
    stiffness_to_wheel_mass: float
    tyre_to_wheel_mass: float
    valid: bool
    wheel_hop_frequency: float
