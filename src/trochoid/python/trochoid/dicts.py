"""Types of ``to_dict()`` of an answer, for editors and type checkers.

A key that is NotRequired is not in every answer. None: the number cannot be known.
The types hold for answers with ``ok``; one without may lack keys and numbers.
Made by tests/golden/answer_types_test.py --renew: it keeps the types that stand here.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Optional, TypedDict, Union

if sys.version_info >= (3, 11):
    from typing import NotRequired
elif TYPE_CHECKING:
    from typing_extensions import NotRequired


class Fit(TypedDict):
    chip_model: str
    lookback: str
    ok: bool
    message: str
    coefficients: dict[str, Optional[Estimate]]
    runout: Optional[Runout]
    phase_deg: Optional[Union[float, list[Optional[float]]]]
    phase_se_deg: Optional[Union[float, list[Optional[float]]]]
    channel_offsets: NotRequired[list[list[ChannelOffset]]]
    rms_N: Optional[float]
    rms_axis_N: Optional[list[Optional[float]]]
    rms_meaning: str
    condition: Optional[float]
    rank: Optional[int]
    degrees_of_freedom: Optional[float]
    band_harmonics: Optional[int]
    interval_factor: Optional[float]
    residual_correlation: Optional[float]
    interval_widening: Optional[float]
    unexplained_in_band: Optional[float]
    unexplained: Optional[float]
    outside_band: Optional[float]
    resonances: NotRequired[dict[str, Optional[Resonance]]]
    identifiable: dict[str, Union[bool, str]]
    combination: NotRequired[list[Combination]]
    prior: NotRequired[dict[str, IdentifyPrior]]
    data_alone: NotRequired[dict[str, Optional[Estimate]]]
    sensor_deg: NotRequired[float]
    sensor_se_deg: NotRequired[Optional[float]]
    rank_with_prior: NotRequired[int]
    weighted_rss: NotRequired[float]
    variance_factor: NotRequired[float]
    channels: NotRequired[list[Channel]]
    groups: NotRequired[list[Group]]


class Estimate(TypedDict):
    value: float
    se: float
    low: float
    high: float


class Runout(TypedDict):
    radial_offsets_mm: list[Optional[float]]
    radial_offsets_se_mm: list[Optional[float]]
    eccentricity_mm: Optional[float]
    eccentricity_se_mm: Optional[float]
    angle_deg: Optional[float]
    angle_se_deg: Optional[float]
    axial_offsets_mm: NotRequired[list[Optional[float]]]
    axial_offsets_se_mm: NotRequired[list[Optional[float]]]
    tilt_deg: NotRequired[Optional[float]]
    tilt_se_deg: NotRequired[Optional[float]]
    tilt_angle_deg: NotRequired[Optional[float]]
    tilt_angle_se_deg: NotRequired[Optional[float]]


class ChannelOffset(TypedDict):
    constant_N: Optional[float]
    slope_N: Optional[float]


class Resonance(TypedDict):
    frequency_Hz: float
    frequency_se_Hz: Optional[float]
    damping_ratio: float
    damping_ratio_se: Optional[float]


class Combination(TypedDict):
    weights: dict[str, float]
    value: float
    se: float


class IdentifyPrior(TypedDict):
    mean: float
    sd: float


class Channel(TypedDict):
    axis: str
    unit: str
    rms: float
    sd: float


class Group(TypedDict):
    group: Optional[str]
    coefficients: dict[str, Optional[Estimate]]
    covariance: Optional[Covariance]
    files: list[str]


class Covariance(TypedDict):
    law: NotRequired[str]
    chip_model: NotRequired[str]
    teeth: NotRequired[int]
    modes: NotRequired[list[CovarianceMode]]
    names: list[str]
    found: list[float]
    interval_factors: list[float]
    matrix: list[list[float]]
    not_found: list[NotFound]


class CovarianceMode(TypedDict):
    body: str
    axis: str


class NotFound(TypedDict):
    name: str
    why: str


class Simulate(TypedDict):
    mean_N: list[float]
    exact_mean_N: list[float]
    exact_mean_torque_Nm: float
    exact_mean_channels: NotRequired[list[float]]
    min_N: list[float]
    max_N: list[float]
    rms_N: list[float]
    peak_xy_N: float
    closed_form_mean_N: NotRequired[list[float]]
    torque_mean_Nm: float
    torque_peak_Nm: float
    power_W: float
    gauge_length_mm: NotRequired[float]
    bending_peak_Nm: NotRequired[float]
    teeth: list[SimulateTooth]
    teeth_height_mm: float
    heights: NotRequired[list[SimulateHeight]]
    volume_check: SimulateVolumeCheck
    comparison: NotRequired[list[SimulateComparison]]


class SimulateTooth(TypedDict):
    tooth: int
    intervals_deg: list[list[float]]
    peak_chip_mm: float
    lowest_height_mm: float


class SimulateHeight(TypedDict):
    height_mm: float
    intervals_deg: list[list[list[float]]]
    removed_mm2_per_rev: Optional[float]


class SimulateVolumeCheck(TypedDict):
    removed_mm2_per_rev: float
    feed_times_width_mm2: float
    ratio: float


class SimulateComparison(TypedDict):
    file: str
    phase_deg: float
    rms_N: float
    rms_axis_N: list[float]
    measured_rms_N: float
    spindle_rpm: float


class Stability(TypedDict):
    multiplier: Optional[StabilityMultiplier]
    stable: bool
    chip_floor: NotRequired[StabilityChipFloor]
    verdict: str
    judged_by: NotRequired[str]
    limit_depth_mm: Optional[float]
    limit: NotRequired[StabilityLimit]
    better_speed: NotRequired[Optional[StabilityBetterSpeed]]
    greatest_depth_mm: float
    spindle_rpm: float
    axial_depth_mm: float
    modes: Optional[list[StabilityMode]]
    measured_frf: NotRequired[StabilityMeasuredFrf]
    process_damping: NotRequired[StabilityProcessDamping]


class StabilityMultiplier(TypedDict):
    absolute: float
    argument_deg: float
    type: str
    chatter_frequencies_Hz: list[float]
    chatter_shares: list[float]
    period: str
    period_s: float
    error: float


class StabilityChipFloor(TypedDict):
    chip_floor_um: float
    multiplier_at_half: float
    multiplier_at_twice: float


class StabilityLimit(TypedDict):
    type: str
    argument_deg: float
    chatter_frequencies_Hz: list[float]


class StabilityBetterSpeed(TypedDict):
    spindle_rpm: float
    limit_depth_mm: float


class StabilityMode(TypedDict):
    direction: list[float]
    turned_deg: NotRequired[float]
    frequency_Hz: float
    damping_ratio: float
    mass_kg: float
    stiffness_N_per_m: float
    damping_Ns_per_m: float


class StabilityMeasuredFrf(TypedDict):
    band_Hz: list[float]
    zeroth_order: StabilityByFrequency
    multi_frequency: StabilityByFrequency
    multiplier_limit_depth_mm: Optional[float]
    modes_fitted: bool


class StabilityByFrequency(TypedDict):
    limit_depth_mm: Optional[float]
    chatter_frequency_Hz: Optional[float]
    difference_percent: Optional[float]
    median_difference_percent: Optional[float]
    harmonics: NotRequired[int]


class StabilityProcessDamping(TypedDict):
    wear_land_um: float
    indentation_N_per_mm3: float
    flank_friction: float
    limit_depth_without_mm: Optional[float]


class Dynamics(TypedDict):
    verdict: str
    periodic: bool
    chatter: bool
    settles: Optional[bool]
    period: Optional[DynamicsPeriod]
    turns: int
    steps_per_tooth: int
    linear_growth_per_turn: Optional[float]
    growth_per_turn: Optional[float]
    change_N: float
    engagement_deg: list[float]
    flutes: list[DynamicsFlute]
    difference: float
    peak_xy_N: float
    vibration: Optional[DynamicsVibration]
    surface_location: list[DynamicsSurfaceLocation]
    process_damping: NotRequired[DynamicsProcessDamping]


class DynamicsPeriod(TypedDict):
    teeth: int
    turns: float
    teeth_of_cut: int


class DynamicsFlute(TypedDict):
    tooth: int
    enters_deg: float
    peak_Fx_N: float
    peak_Fy_N: float
    chip_area_mm_rad: float
    peak_chip_mm: float


class DynamicsVibration(TypedDict):
    turns: int
    x_um: float
    y_um: float
    chatter_frequency_Hz: Optional[float]
    lines: list[DynamicsLine]


class DynamicsLine(TypedDict):
    frequency_Hz: float
    x_um: float
    y_um: float
    spindle_harmonic: Optional[int]


class DynamicsSurfaceLocation(TypedDict):
    wall: str
    flutes: list[DynamicsSurfaceLocationFlute]
    surface_location_error_um: float


class DynamicsSurfaceLocationFlute(TypedDict):
    tooth: int
    surface_location_error_um: float


class DynamicsProcessDamping(TypedDict):
    wear_land_um: float
    indentation_N_per_mm3: float
    flank_friction: float


class Identify(TypedDict):
    fits: list[Fit]
    chosen: str
    covariance: Optional[Covariance]
    groups: NotRequired[list[Group]]
    signal: NotRequired[IdentifySignal]
    clocking: NotRequired[IdentifyClocking]
    runout_form: NotRequired[IdentifyRunoutForm]
    views: NotRequired[list[IdentifyView]]
    not_in_the_intervals: NotRequired[list[IdentifyNotInTheInterval]]
    curves: str
    verdict: str
    with_care: list[str]
    do_not_use: list[str]


class IdentifySignal(TypedDict):
    files: list[str]
    samples: list[int]
    spindle_rpm: Union[float, list[float]]
    spindle_rpm_se: Optional[Union[float, list[Optional[float]]]]
    stated_rpm: Union[float, list[float]]
    revolutions: NotRequired[list[int]]
    axes: Optional[list[str]]
    matrix: NotRequired[list[list[float]]]
    axes_rms_N: NotRequired[float]
    axes_next_rms_N: NotRequired[float]


class IdentifyClocking(TypedDict):
    total_indicator_reading_um: Estimate
    height_mm: float
    longest_tooth: int
    tool: NotRequired[IdentifyClockingPart]
    holder: NotRequired[IdentifyClockingPart]
    best_turn_deg: NotRequired[float]
    least_eccentricity_mm: NotRequired[float]


class IdentifyClockingPart(TypedDict):
    eccentricity_mm: Estimate
    angle_deg: float
    angle_se_deg: Optional[float]


class IdentifyRunoutForm(TypedDict):
    form: str
    decided_by: str
    better: str
    why: str
    tried: list[IdentifyTried]


class IdentifyTried(TypedDict):
    form: str
    rms_N: float
    excess: float


class IdentifyView(TypedDict):
    band_harmonics: int
    resonance: bool
    unexplained: float
    K_t1_MPa: NotRequired[Optional[Estimate]]
    K_tc_MPa: NotRequired[Optional[Estimate]]


class IdentifyNotInTheInterval(TypedDict):
    what: str
    effect: dict[str, float]


class Surface(TypedDict):
    period_mm: float
    floor: NotRequired[list[SurfaceFloor]]
    model: NotRequired[str]
    feedback: NotRequired[str]
    mean_error_mm: NotRequired[float]
    peak_error_mm: NotRequired[float]
    min_error_mm: NotRequired[float]
    forces: NotRequired[SurfaceForces]
    compliance_mm_per_N: NotRequired[float]
    turns_to_repeat: NotRequired[int]
    heights: NotRequired[list[SurfaceHeight]]
    bent: NotRequired[SurfaceBent]
    passes: NotRequired[list[SurfacePass]]
    also_bends: NotRequired[SurfaceAlsoBends]
    wall_loads: NotRequired[SurfaceWallLoads]


class SurfaceFloor(TypedDict):
    y_mm: float
    mean_mm: float
    lowest_mm: float
    highest_mm: float
    Ra_um: float
    Rq_um: float
    Rz_um: float
    Rt_um: float
    share: list[float]
    filtered: NotRequired[SurfaceFiltered]


class SurfaceFiltered(TypedDict):
    cutoff_mm: float
    Ra_um: float
    Rq_um: float
    Rz_um: float
    Rt_um: float


class SurfaceForces(TypedDict):
    F_normal_mean_N: float
    F_normal_min_N: float
    F_normal_max_N: float
    Fx_mean_N: float
    Fx_min_N: float
    Fx_max_N: float


class SurfaceHeight(TypedDict):
    height_mm: float
    mean_error_mm: float
    min_error_mm: float
    max_error_mm: float
    Ra_um: float
    Rt_um: float
    Rq_um: NotRequired[float]
    Rz_um: NotRequired[float]
    filtered: NotRequired[SurfaceFiltered]
    share: list[float]
    compliance_mm_per_N: float
    once_per_turn_um: NotRequired[float]
    once_per_tooth_um: NotRequired[float]
    operator: NotRequired[SurfaceOperator]


class SurfaceOperator(TypedDict):
    K_tc_mm_per_MPa: float
    K_rc_mm_per_MPa: float


class SurfaceBent(TypedDict):
    angle_deg: float
    F_normal_N: float
    cutter: Optional[SurfaceCutter]
    wall: Optional[SurfaceWall]


class SurfaceCutter(TypedDict):
    diameter_mm: float
    shank_diameter_mm: float
    flute_length_mm: float
    overhang_mm: float


class SurfaceWall(TypedDict):
    height_mm: float
    thickness_mm: float
    edge_height_mm: float


class SurfacePass(TypedDict):
    radial_depth_mm: float
    feed_per_tooth_mm: float
    below_edge_mm: float
    stock_min_mm: float
    stock_mean_mm: float
    stock_max_mm: float
    mean_error_mm: float
    min_error_mm: float
    peak_error_mm: float
    F_normal_mean_N: float
    F_normal_max_N: float
    thickness_before_mm: Optional[float]
    thickness_left_mm: Optional[float]


class SurfaceAlsoBends(TypedDict):
    axes: list[str]
    mean_error_without_mm: float
    peak_error_without_mm: float
    mean_change_um: float
    peak_change_um: float


class SurfaceWallLoads(TypedDict):
    pressure: NotRequired[SurfacePressure]
    edge_load: NotRequired[SurfaceEdgeLoad]
    line_load: NotRequired[SurfaceLineLoad]


class SurfacePressure(TypedDict):
    pressure_kPa: float
    largest_deflection_mm: float
    x_mm: float
    wall_height_mm: float
    coefficient: float
    coefficient_is: str


class SurfaceEdgeLoad(TypedDict):
    edge_load_N_per_mm: float
    largest_deflection_mm: float
    x_mm: float
    wall_height_mm: float
    coefficient: float
    coefficient_is: str


class SurfaceLineLoad(TypedDict):
    line_load_N_per_mm: float
    largest_deflection_mm: float
    x_mm: float
    wall_height_mm: float
    coefficient: float
    coefficient_is: str


class Calibrate(TypedDict):
    model: NotRequired[str]
    feedback: NotRequired[str]
    coefficients: NotRequired[dict[str, Optional[Estimate]]]
    correlation: NotRequired[Optional[float]]
    rank: NotRequired[int]
    condition: NotRequired[float]
    rms_mm: NotRequired[Optional[float]]
    message: NotRequired[str]
    combination: NotRequired[CalibrateCombination]
    covariance: NotRequired[Optional[Covariance]]
    offset_mm: NotRequired[Optional[float]]
    datum: NotRequired[list[CalibrateDatum]]
    noise_mm: NotRequired[float]
    means: NotRequired[int]
    readings: NotRequired[CalibrateReadings]
    answers: NotRequired[list[CalibrateOneAnswer]]
    ten_more_readings: NotRequired[list[CalibrateTenMoreReading]]
    runout: NotRequired[CalibrateRunout]
    with_runout: NotRequired[bool]
    outliers: NotRequired[list[CalibrateOutlier]]
    form: NotRequired[str]
    explanations: NotRequired[list[CalibrateExplanation]]
    scatter: NotRequired[CalibrateScatter]
    finish: NotRequired[list[CalibrateFinish]]


class CalibrateCombination(TypedDict):
    K_tc_weight: float
    K_rc_weight: float
    value_MPa: Estimate


class CalibrateDatum(TypedDict):
    offset_mm: NotRequired[Estimate]
    curvature_mm: NotRequired[Estimate]
    slopes_mm_per_mm: NotRequired[list[Estimate]]


class CalibrateReadings(TypedDict):
    used: int
    skipped: int
    repeats: int
    repeatability_mm: Optional[float]


class CalibrateOneAnswer(TypedDict):
    model: str
    feedback: str
    coefficients: dict[str, Optional[Estimate]]
    correlation: Optional[float]
    rank: int
    condition: float
    rms_mm: Optional[float]
    message: NotRequired[str]
    combination: NotRequired[CalibrateCombination]


class CalibrateTenMoreReading(TypedDict):
    height_mm: float
    se_K_rc_MPa: NotRequired[float]
    se_K_tc_MPa: NotRequired[float]


class CalibrateRunout(TypedDict):
    eccentricity_mm: Optional[float]
    eccentricity_se_mm: NotRequired[float]
    angle_deg: Optional[float]
    identifiable: NotRequired[str]
    angle_se_deg: NotRequired[float]
    angle_known_up_to_deg: NotRequired[Optional[float]]
    coefficients: NotRequired[dict[str, Optional[Estimate]]]
    correlation: NotRequired[float]
    rms_without_mm: NotRequired[float]
    rms_mm: NotRequired[float]
    turn_begins_mm: NotRequired[float]


class CalibrateOutlier(TypedDict):
    reading: int
    x_mm: float
    height_mm: float
    off_mm: float


class CalibrateExplanation(TypedDict):
    form: str
    feedback: str
    weight: float
    coefficients: dict[str, Optional[Estimate]]
    eccentricity_mm: Optional[float]
    rms_mm: float


class CalibrateScatter(TypedDict):
    own_mm: float
    shared_mm: float


class CalibrateFinish(TypedDict):
    file: str
    floor_y_mm: NotRequired[float]
    height_mm: NotRequired[float]
    message: NotRequired[str]
    numbered: NotRequired[bool]
    teeth: NotRequired[list[CalibrateTooth]]
    waves: NotRequired[list[CalibrateWave]]
    feed_mm: NotRequired[Estimate]
    feeds: NotRequired[list[CalibrateFeed]]
    turns: NotRequired[float]
    readings: int
    repeating: NotRequired[float]
    readings_as_one: NotRequired[float]
    rms_um: NotRequired[float]
    waviness_um: NotRequired[float]
    Ra_measured_um: NotRequired[float]
    Ra_um: NotRequired[float]
    Ra_alike_um: NotRequired[float]


class CalibrateTooth(TypedDict):
    tooth: int
    writes: bool
    share: float
    offset_mm: NotRequired[Estimate]
    at_most_mm: NotRequired[float]


class CalibrateWave(TypedDict):
    per_turn: int
    amplitude_mm: Estimate
    phase_deg: Estimate


class CalibrateFeed(TypedDict):
    feed_per_tooth_mm: float
    Ra_um: float
    Ra_alike_um: float


class Modes(TypedDict):
    kind: NotRequired[str]
    modes: list[ModesMode]
    lines: NotRequired[int]
    band_Hz: NotRequired[list[float]]
    covariance: Optional[Covariance]
    explained: NotRequired[float]
    residual_terms: NotRequired[Optional[ModesResidualTerms]]
    terms_outside_Hz: NotRequired[list[float]]
    noise: NotRequired[ModesNoise]
    unresolved: list[ModesUnresolved]
    orders: list[ModesOrder]
    hits: NotRequired[list[ModesHit]]
    block_s: NotRequired[float]
    window_end: NotRequired[float]
    excited_to_Hz: NotRequired[float]
    description: NotRequired[str]
    shapes: NotRequired[str]
    real_modes: NotRequired[list[ModesMode]]
    responses: NotRequired[list[ModesResponse]]
    reciprocity: NotRequired[list[ModesReciprocity]]
    complex_evidence: NotRequired[Optional[float]]
    rms_m_per_N: NotRequired[float]
    rms_m_per_s2_N: NotRequired[float]
    rms_m_per_s_N: NotRequired[float]


class ModesMode(TypedDict):
    frequency_Hz: float
    damping_ratio: float
    mass_kg: float
    stiffness_N_per_m: float
    damping_Ns_per_m: float
    angle_deg: NotRequired[float]
    imaginary_fraction: NotRequired[float]
    se: ModesSe
    shape: NotRequired[list[ModesShape]]
    lines_in_peak: int


class ModesSe(TypedDict):
    frequency_Hz: float
    damping_ratio: float
    mass_kg: float
    stiffness_N_per_m: float
    damping_Ns_per_m: float
    angle_deg: NotRequired[float]
    imaginary_fraction: NotRequired[float]


class ModesShape(TypedDict):
    axis: str
    re_per_sqrt_kg: float
    re_se: float
    im_per_sqrt_kg: NotRequired[float]
    im_se: NotRequired[float]


class ModesResidualTerms(TypedDict):
    above_m_per_N: float
    below_per_kg: float


class ModesNoise(TypedDict):
    magnitude_percent: float
    phase_deg: float
    floor_m_per_N: NotRequired[float]
    floor_m_per_s2_N: NotRequired[float]
    floor_m_per_s_N: NotRequired[float]


class ModesUnresolved(TypedDict):
    frequency_Hz: NotRequired[float]
    why: str


class ModesOrder(TypedDict):
    modes: int
    shapes: NotRequired[str]
    residual_terms: bool
    criterion: float
    frequencies_Hz: list[float]
    damping_ratios: list[float]
    fault: Optional[str]


class ModesHit(TypedDict):
    time_s: float
    peak_N: float
    left_out: Optional[str]


class ModesResponse(TypedDict):
    name: str
    axis: str
    force_axis: str
    kind: str
    lines: int
    band_Hz: NotRequired[list[float]]
    description: NotRequired[str]
    explained: float
    noise: ModesNoise
    residues: list[ModesResidue]
    residual_terms: NotRequired[ModesResidualTerms]
    rms_m_per_N: NotRequired[float]
    rms_m_per_s2_N: NotRequired[float]
    rms_m_per_s_N: NotRequired[float]


class ModesResidue(TypedDict):
    re_per_kg: float
    re_se: float
    im_per_kg: NotRequired[float]
    im_se: NotRequired[float]


class ModesReciprocity(TypedDict):
    response: str
    over: str
    gain: float
    se: float


class Actuator(TypedDict):
    gain: float
    frequency_Hz: float
    damping_ratio: float
    time_constants_s: Optional[list[float]]
    sum_s: float
    product_s2: float
    se: ActuatorSe
    identifiable: ActuatorIdentifiable
    start_s: float
    step_um: float
    half_power_frequency_Hz: float
    low_frequency_delay_s: float
    rise_time_10_90_s: float
    rms_um: float
    explained: float


class ActuatorSe(TypedDict):
    gain: float
    frequency_Hz: float
    damping_ratio: float
    time_constants_s: Optional[list[float]]
    sum_s: float
    product_s2: float
    start_s: float


class ActuatorIdentifiable(TypedDict):
    time_constants_s: NotRequired[str]


class Correct(TypedDict):
    runout: CorrectRunout
    before: CorrectCut
    after: CorrectCut
    reduction: Optional[float]
    command: CorrectCommand
    allowed_difference: float
    max_rpm: dict[str, float]
    max_rpm_cut: str
    axes: CorrectAxes
    spindle_speed: NotRequired[CorrectSpindleSpeed]
    controller: NotRequired[CorrectController]


class CorrectRunout(TypedDict):
    radial_offsets_um: list[float]
    chip_difference_um: list[float]
    designed_for_um: list[float]
    static_fit: NotRequired[CorrectStaticFit]
    ratio_um: NotRequired[Optional[list[float]]]
    ratio_reason: NotRequired[str]
    angle_offset_deg: float


class CorrectStaticFit(TypedDict):
    chip_difference_um: list[CorrectChipDifference]
    rms_N: float
    explained: float


class CorrectChipDifference(TypedDict):
    value: float
    se: float


class CorrectCut(TypedDict):
    flutes: list[CorrectFlute]
    difference: float
    own_difference: float
    area_difference: float
    periodic: bool
    change_N: float
    walls: list[CorrectWall]


class CorrectFlute(TypedDict):
    tooth: int
    peak_Fx_N: float
    peak_Fy_N: float
    own_peak_Fy_N: Optional[float]
    chip_area_mm_rad: float
    peak_chip_mm: float


class CorrectWall(TypedDict):
    theta_deg: float
    peak_to_valley_um: float
    share: list[float]


class CorrectCommand(TypedDict):
    spindle_rpm: float
    peak_to_peak_um: float
    offset_um: float
    motion_peak_to_peak_um: float
    table_deviation_um: float
    lead_s: float
    harmonics: Optional[int]
    transition_deg: Optional[float]
    optimum: Optional[CorrectOptimum]
    within_limits: bool
    limits: list[CorrectLimit]
    stroke_margin_um: NotRequired[float]
    slew_um_per_s: NotRequired[float]
    learning: NotRequired[CorrectLearning]


class CorrectOptimum(TypedDict):
    kind: str
    proven: bool
    starts: int
    agreeing: int


class CorrectLimit(TypedDict):
    what: str
    value: float
    limit: Optional[float]
    margin: Optional[float]
    ok: Optional[bool]
    reason: str


class CorrectLearning(TypedDict):
    iterations: int
    converged: bool
    error_um: list[float]


class CorrectAxes(TypedDict):
    uncorrected_um: float
    one_axis_um: float
    two_axes_um: float
    one_axis_bound_um: float
    two_axes_bound_um: float
    most_teeth_in_cut: int


class CorrectSpindleSpeed(TypedDict):
    difference: float
    part: float
    limit: Optional[str]
    speed_change: float
    torque_Nm: float
    torque_wanted_Nm: Optional[float]
    torque_limit_Nm: float


class CorrectController(TypedDict):
    difference_before: float
    difference_running: Optional[float]
    turns_to_3_percent: Optional[int]
    gain: Optional[float]
    lowest_um: float
    highest_um: float
    fault: Optional[str]
    held_by: Optional[str]
    fault_time_s: Optional[float]
    time_to_safe_s: Optional[float]
    turns: list[CorrectTurn]


class CorrectTurn(TypedDict):
    turn: int
    peaks_Fy_N: list[float]
    difference: float
    gain: float
    wave_um: float
    tool: str
    state: str


class Plan(TypedDict):
    cuts: list[PlanCut]
    before: dict[str, Optional[Estimate]]
    looked_at: int
    left_out: list[PlanLeftOut]
    noise_N: Optional[float]
    channels: list[str]
    mean_sd: list[float]
    noise_from: str
    turns: int
    samples_per_rev: int
    files: list[str]
    group: Optional[str]


class PlanCut(TypedDict):
    engagement: str
    feed_per_tooth_mm: float
    axial_depth_mm: float
    radial_depth_mm: float
    turns: int
    peak_force_N: float
    narrows: Optional[float]
    predicted: dict[str, Optional[Estimate]]


class PlanLeftOut(TypedDict):
    reason: str
    count: int


class Program(TypedDict):
    dialect: str
    moves: int
    tools: list[str]
    time_s: float
    time_in_cut_s: NotRequired[float]
    steps: NotRequired[int]
    distinct_turns: NotRequired[int]
    removed_mm3: NotRequired[float]
    stock_before_mm3: NotRequired[float]
    stock_after_mm3: NotRequired[float]
    peaks: NotRequired[ProgramPeaks]
    limits_broken: NotRequired[list[ProgramLimitsBroken]]
    feed: NotRequired[ProgramFeed]
    chatter: NotRequired[ProgramChatter]
    walls: NotRequired[ProgramWalls]
    record: NotRequired[ProgramRecord]


class ProgramPeaks(TypedDict):
    peak_xy_N: ProgramPeak
    peak_tooth_N: ProgramPeak
    torque_peak_Nm: ProgramPeak
    power_W: ProgramPeak
    moment_peak_Nm: ProgramPeak
    deflection_um: ProgramPeak
    peak_chip_mm: ProgramPeak


class ProgramPeak(TypedDict):
    value: float
    line: int
    x_mm: float
    y_mm: float
    z_mm: float
    cause: str
    low: NotRequired[float]
    high: NotRequired[float]


class ProgramLimitsBroken(TypedDict):
    limit: str
    allowed: float
    worst: float
    lines: list[int]


class ProgramFeed(TypedDict):
    file: str
    before: ProgramTotals
    after: ProgramTotals
    even_peak_N: NotRequired[float]
    not_reachable: list[int]
    rubbing: list[int]


class ProgramTotals(TypedDict):
    time_s: float
    time_in_cut_s: float
    peak_xy_N: float
    peak_tooth_N: float


class ProgramChatter(TypedDict):
    cuts: int
    looked_at: float
    lines: list[ProgramChatterLine]


class ProgramChatterLine(TypedDict):
    line: int
    margin: float
    limit_depth_mm: float
    frequency_Hz: float
    spindle_rpm: float
    better_spindle_rpm: NotRequired[float]


class ProgramWalls(TypedDict):
    most: NotRequired[ProgramWallError]
    least: NotRequired[ProgramWallError]
    lines: list[ProgramWallLine]


class ProgramWallError(TypedDict):
    error_um: float
    line: int
    side: str
    x_mm: float
    y_mm: float
    z_mm: float


class ProgramWallLine(TypedDict):
    line: int
    side: str
    least_um: float
    most_um: float
    mean_um: float


class ProgramRecord(TypedDict):
    file: str
    numbers: Optional[str]
    start_s: float
    stretch: float
    scatter_s: float
    correlation: float
    whole_correlation: float
    covered: float
    reads: str
    steps: int
    mean_ratio: float
    peak_ratio: NotRequired[float]
    fitted_steps: int
    rms_N: NotRequired[float]
    rms_W: NotRequired[float]
    rms_Nm: NotRequired[float]
    coefficients: list[ProgramCoefficient]
    cuts: NotRequired[list[ProgramCut]]
    fit: NotRequired[Fit]


class ProgramCoefficient(TypedDict):
    key: str
    stated: float
    found: NotRequired[float]
    se: NotRequired[float]
    low: NotRequired[float]
    high: NotRequired[float]


class ProgramCut(TypedDict):
    line: int
    turns: float
    spindle_rpm: float
    feed_per_tooth_mm: float


class PlanOfFinish(TypedDict):
    of: str
    largest_Ra_um: Optional[float]
    inserts_within_um: float
    lines: list[PlanOfFinishLine]
    cutoff_mm: Optional[float]
    largest_feed: PlanOfFinishLargestFeed
    feeds: list[PlanOfFinishFeed]


class PlanOfFinishLine(TypedDict):
    floor_y_mm: NotRequired[float]
    height_mm: NotRequired[float]


class PlanOfFinishLargestFeed(TypedDict):
    as_is_mm: Optional[float]
    within_mm: Optional[float]
    alike_mm: Optional[float]


class PlanOfFinishFeed(TypedDict):
    feed_per_tooth_mm: float
    Ra_um: Optional[float]
    Ra_within_um: Optional[float]
    Ra_alike_um: Optional[float]


class PlanOfWall(TypedDict):
    of: str
    chosen: Optional[PlanOfWallDesign]
    so_far: Optional[PlanOfWallPredicted]
    readings_so_far: int
    files: list[str]
    designs: list[PlanOfWallDesign]
    ten_more_readings: list[PlanOfWallTenMoreReading]
    changes: list[PlanOfWallChange]
    cutting: PlanOfWallCutting
    form: str
    noise_um: float
    noise_from: str
    wanted_percent: float
    wanted_um: float
    runout: Optional[str]


class PlanOfWallDesign(TypedDict):
    heights: int
    readings_per_height: int
    spread: float
    readings: int
    heights_mm: list[float]
    enough: bool
    predicted: Optional[PlanOfWallPredicted]


class PlanOfWallPredicted(TypedDict):
    angle_se_deg: Optional[float]
    correlation: float
    condition: float
    K_rc_MPa: NotRequired[Estimate]
    K_tc_MPa: NotRequired[Estimate]
    eccentricity_mm: NotRequired[Estimate]


class PlanOfWallTenMoreReading(TypedDict):
    height_mm: float
    predicted: Optional[PlanOfWallPredicted]


class PlanOfWallChange(TypedDict):
    key: str
    value_mm: float
    predicted: Optional[PlanOfWallPredicted]


class PlanOfWallCutting(TypedDict):
    limited: str
    largest_error_um: Optional[float]
    stated: PlanOfWallCut
    best: Optional[PlanOfWallCut]
    thickness_mm: Optional[float]
    thinnest_wall: Optional[PlanOfWallThinnestWall]
    feed_limits: list[PlanOfWallFeedLimit]


class PlanOfWallCut(TypedDict):
    feed_per_tooth_mm: float
    radial_depth_mm: float
    peak_error_um: Optional[float]
    mean_error_um: Optional[float]
    removal_rate_mm3_per_min: float


class PlanOfWallThinnestWall(TypedDict):
    thickness_mm: Optional[float]
    error_um: Optional[float]
    thinner_too: bool


class PlanOfWallFeedLimit(TypedDict):
    radial_depth_mm: float
    feed_per_tooth_mm: Optional[float]


class Sweep(TypedDict):
    command: str
    method: str
    rows: int
    failed: int
    keys: list[str]
    draws: int
    drawn: list[str]
    quantities: list[SweepQuantity]


class SweepQuantity(TypedDict):
    take: str
    answers: int
    min: NotRequired[float]
    median: NotRequired[float]
    max: NotRequired[float]
    mean: NotRequired[float]
    sd: NotRequired[float]
    low: NotRequired[float]
    high: NotRequired[float]
    low_between: NotRequired[Optional[list[float]]]
    high_between: NotRequired[Optional[list[float]]]
    without_answer: NotRequired[float]
