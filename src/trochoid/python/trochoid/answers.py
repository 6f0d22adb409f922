"""Types of answers, for editors and type checkers: every key, its type and its meaning.

The types hold for answers with ``ok``; one without may lack keys and numbers. When a program
runs, an answer is of its class here, and every object in it is ``Values``.
Made by tests/golden/answer_types_test.py --renew from docs/formats/results.md and dicts.py.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Generic, Optional, TypeVar, Union

from ._answer import Answer, Values

if TYPE_CHECKING:
    from . import dicts

T = TypeVar("T")


class Named(Values, Generic[T]):
    """Values of one type; the case decides how they are called."""

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> T: ...

        def __getitem__(self, key: str) -> T: ...


class Fit(Values):
    """one for each entry of `chip_models`, in that order"""

    chip_model: str
    """of this fit"""
    lookback: str
    """of the chip model"""
    ok: bool
    """whether there is an answer"""
    message: str
    """when not, why"""
    coefficients: Named[Optional[Estimate]]
    """each of the law, by its key in `[force]`; `null` with the reason in `identifiable`"""
    runout: Optional[Runout]
    """`null` for model none"""
    phase_deg: Optional[Union[float, tuple[Optional[float], ...]]]
    """true angle of the tip of tooth 1 less the recorded angle; a list in measurement order, of
    one measurement the number alone. Equal pitch: the first within half a pitch of 0, further
    ones within half a turn"""
    phase_se_deg: Optional[Union[float, tuple[Optional[float], ...]]]
    """standard errors of the same"""
    channel_offsets: tuple[tuple[ChannelOffset, ...], ...]
    """where they were fitted: of each channel, for each measurement (not in every answer)"""
    rms_N: Optional[float]
    """sqrt(mean over samples of the squared difference) of the vector (I-5); `null` where the
    channels are not three forces"""
    rms_axis_N: Optional[tuple[Optional[float], ...]]
    """the same of each axis, `null` where that force was not measured"""
    rms_meaning: str
    """both in words"""
    condition: Optional[float]
    """condition number of [D] with columns of length one"""
    rank: Optional[int]
    """of the same"""
    degrees_of_freedom: Optional[float]
    """data less unknowns"""
    band_harmonics: Optional[int]
    """harmonics of the spindle that were fitted; 0: all"""
    interval_factor: Optional[float]
    """half of a 95 % confidence interval over its standard error, for every unknown of the fit:
    what the terminal and the report print behind ± is this times the standard error"""
    residual_correlation: Optional[float]
    """of neighbouring residuals (I-8); 0 with a band limit, where harmonics are counted and not
    samples"""
    interval_widening: Optional[float]
    """by how much the intervals of the coefficients are wider than white noise would make them
    (rms of them), because residuals agree with their neighbours, repeat turn by turn, or
    records disagree (I-13 to I-15): `se`, `low` and `high` include it; 1 with `errors =
    "white"`"""
    unexplained_in_band: Optional[float]
    """what the fit does not explain as a fraction of the force (rms, 0 to 1), within its band
    (I-9)"""
    unexplained: Optional[float]
    """the same of everything"""
    outside_band: Optional[float]
    """fraction of the force (rms) that lies outside of the band"""
    resonances: Named[Optional[Resonance]]
    """of the dynamometer, where its response is in the model: for `x`, `y`, `z` of the tool, or
    `null` where none was found; of a given response the one that was scaled with the fit (I-17,
    I-25) (not in every answer)"""
    identifiable: Named[Union[bool, str]]
    """for each quantity `true`, or the reason why it cannot be determined"""
    combination: tuple[Combination, ...]
    """where coefficients are not told: sums of weights times coefficients that are (not in
    every answer)"""
    prior: Named[IdentifyPrior]
    """what was known beforehand, as in `[prior]` (not in every answer)"""
    data_alone: Named[Optional[Estimate]]
    """the coefficients without the prior; `null` where the data do not tell them (not in every
    answer)"""
    sensor_deg: float
    """angle of u from the tip of tooth 1 towards tooth 2 (not in every answer)"""
    sensor_se_deg: Optional[float]
    """its standard error; `null` where it was given (not in every answer)"""
    rank_with_prior: int
    """rank with the rows of the prior (not in every answer)"""
    weighted_rss: float
    """sum of (residual/sd)^2, of the data without the prior (not in every answer)"""
    variance_factor: float
    """by which variances are larger than the stated ones: 1 where those are known, else
    weighted_rss/(data less unknowns) (not in every answer)"""
    channels: tuple[Channel, ...]
    """each of them (not in every answer)"""
    groups: tuple[Group, ...]
    """where a record names its `group`; the fit's own `coefficients` are for the first group
    (not in every answer)"""


class Estimate(Values):
    """a number that was found, with its 95 % interval"""

    value: float
    """as found, in the unit of its key"""
    se: float
    """one standard error"""
    low: float
    """of the 95 % confidence interval"""
    high: float
    """of the 95 % confidence interval"""


class Runout(Values):
    """`null` for model none"""

    radial_offsets_mm: tuple[Optional[float], ...]
    """of each tooth"""
    radial_offsets_se_mm: tuple[Optional[float], ...]
    """standard errors; `null` where it is given, the gauge, or found where a tooth just starts
    or stops cutting (warning `runout_on_edge`)"""
    eccentricity_mm: Optional[float]
    """of the tool"""
    eccentricity_se_mm: Optional[float]
    """standard error or `null`, as above"""
    angle_deg: Optional[float]
    """of the eccentricity, from the tip of tooth 1 towards tooth 2"""
    angle_se_deg: Optional[float]
    """standard error or `null`, as above"""
    axial_offsets_mm: tuple[Optional[float], ...]
    """of each tooth, positive: it reaches deeper; empty: none (not in every answer)"""
    axial_offsets_se_mm: tuple[Optional[float], ...]
    """standard errors or `null`, as above (not in every answer)"""
    tilt_deg: Optional[float]
    """of the tool axis (not in every answer)"""
    tilt_se_deg: Optional[float]
    """standard error or `null`, as above (not in every answer)"""
    tilt_angle_deg: Optional[float]
    """where its top leans to, from the tip of tooth 1 towards tooth 2 (not in every answer)"""
    tilt_angle_se_deg: Optional[float]
    """standard error or `null`, as above (not in every answer)"""


class ChannelOffset(Values):
    """where they were fitted: of each channel, for each measurement"""

    constant_N: Optional[float]
    """at the middle of the record"""
    slope_N: Optional[float]
    """from its beginning to its end"""


class Resonance(Values):
    """of each axis"""

    frequency_Hz: float
    """natural frequency"""
    frequency_se_Hz: Optional[float]
    """its standard error; `null` where it was not found with the rest"""
    damping_ratio: float
    """of critical damping"""
    damping_ratio_se: Optional[float]
    """its standard error, as above"""


class Combination(Values):
    """where coefficients are not told: sums of weights times coefficients that are"""

    weights: Named[float]
    """by the key of the coefficient; the first is 1"""
    value: float
    """of the sum, in the unit of the first coefficient"""
    se: float
    """one standard error"""


class IdentifyPrior(Values):
    """of this coefficient"""

    mean: float
    """in the unit of its key"""
    sd: float
    """its standard deviation"""


class Channel(Values):
    """each of them"""

    axis: str
    """what it reads, as in `[dynamometer] axes`"""
    unit: str
    """of `rms` and `sd`: `N`, `Nm` or `W`"""
    rms: float
    """residual of the answer"""
    sd: float
    """of one value, as it was weighted"""


class Group(Values):
    """of the chosen fit"""

    group: Optional[str]
    """its name; `null`: records without one"""
    coefficients: Named[Optional[Estimate]]
    """as in the fit"""
    covariance: Optional[Covariance]
    """as below"""
    files: tuple[str, ...]
    """of its records"""


class Covariance(Values):
    """of the chosen fit, the first group: what `[sweep] covariance` draws from"""

    law: str
    """of the coefficients, where there are some (not in every answer)"""
    chip_model: str
    """that they were found with (not in every answer)"""
    teeth: int
    """of the runout, where there is one (not in every answer)"""
    modes: tuple[CovarianceMode, ...]
    """of modes.toml, in its order (not in every answer)"""
    names: tuple[str, ...]
    """keys of a case: `force.K_tc_MPa`, `runout.radial_offsets_mm[2]`, `mode[1].frequency_Hz`,
    `mode[1].damping_ratio`, `mode[1].mass_kg`. An eccentricity stands as `runout.e_x_mm`,
    `runout.e_y_mm`: rho cos(lambda), rho sin(lambda)"""
    found: tuple[float, ...]
    """as found, in the unit of the name"""
    interval_factors: tuple[float, ...]
    """half of each 95 % interval over the square root of its variance"""
    matrix: tuple[tuple[float, ...], ...]
    """covariance that gives the intervals (U-1), row by row"""
    not_found: tuple[NotFound, ...]
    """what was looked for and is not among the names"""


class CovarianceMode(Values):
    """of modes.toml, in its order"""

    body: str
    """that moves"""
    axis: str
    """along which it moves"""


class NotFound(Values):
    """what was looked for and is not among the names"""

    name: str
    """a key of a case"""
    why: str
    """it was not found"""


class SimulateAnswer(Answer):
    """Of ``simulate``. Tables:

    ``forces``: angle_deg, time_s, F*_N, channel*_N, channel*_Nm, channel*_W
    ``chip``: tooth, edge_angle_deg, height_mm, h_mm, mark
    ``chip_curve``: theta_deg, h_tooth*_mm
    ``edges``: tooth, height_mm, there, radius_mm, omega_deg, eps_deg, kappa_deg, ds_dz
    ``fitted``: run, angle_deg, *_measured_N, *_N
    ``residual``: run, angle_deg, *_N
    """

    mean_N: tuple[float, ...]
    """mean force along x, y, z: of whole turns by integrals where the edges allow it (a
    cylinder, no power law), else over the rows of forces.csv"""
    exact_mean_N: tuple[float, ...]
    """mean force along x, y, z over a turn, as an integral along the edges (F-31)"""
    exact_mean_torque_Nm: float
    """mean torque over a turn, as that integral"""
    exact_mean_channels: tuple[float, ...]
    """with a dynamometer whose axes are named: mean of each channel over a turn, in N, Nm or W,
    as that integral (not in every answer)"""
    min_N: tuple[float, ...]
    """smallest of the rows of forces.csv, axis by axis"""
    max_N: tuple[float, ...]
    """largest of them, axis by axis"""
    rms_N: tuple[float, ...]
    """root mean square of them, axis by axis"""
    peak_xy_N: float
    """largest force in the plane of the table"""
    closed_form_mean_N: tuple[float, ...]
    """F-8, where it applies: a slot without runout and without trochoids (not in every
    answer)"""
    torque_mean_Nm: float
    """mean torque (F-6)"""
    torque_peak_Nm: float
    """largest torque"""
    power_W: float
    """mean torque times spindle speed"""
    gauge_length_mm: float
    """of the bending moment, where it is given (not in every answer)"""
    bending_peak_Nm: float
    """largest bending moment there (F-7) (not in every answer)"""
    teeth: tuple[SimulateTooth, ...]
    """what each tooth does in a turn at `teeth_height_mm`"""
    teeth_height_mm: float
    """above the tip"""
    heights: tuple[SimulateHeight, ...]
    """at each of `edge_heights_mm` (not in every answer)"""
    volume_check: SimulateVolumeCheck
    """C-8: whether the chips of a turn are the material there is"""
    comparison: tuple[SimulateComparison, ...]
    """with each measurement (not in every answer)"""

    __slots__ = ()

    if TYPE_CHECKING:

        def to_dict(self) -> dicts.Simulate: ...  # type: ignore[override]


class SimulateTooth(Values):
    """what each tooth does in a turn at `teeth_height_mm`"""

    tooth: int
    """number, from 1"""
    intervals_deg: tuple[tuple[float, ...], ...]
    """where it cuts: pairs of nominal theta, from and to"""
    peak_chip_mm: float
    """thickest chip"""
    lowest_height_mm: float
    """where its edge begins, above the nominal tip"""


class SimulateHeight(Values):
    """at each of `edge_heights_mm`"""

    height_mm: float
    """above the nominal tip, as asked for"""
    intervals_deg: tuple[tuple[tuple[float, ...], ...], ...]
    """of each tooth, where it cuts: pairs of nominal theta, from and to"""
    removed_mm2_per_rev: Optional[float]
    """what the chips of all teeth add up to in a turn (C-8); null but for the trochoidal
    model"""


class SimulateVolumeCheck(Values):
    """C-8: whether the chips of a turn are the material there is"""

    removed_mm2_per_rev: float
    """what the chips of all teeth add up to in a turn"""
    feed_times_width_mm2: float
    """feed per turn times width of cut"""
    ratio: float
    """of both; 1 where the chips are what the feed takes"""


class SimulateComparison(Values):
    """with each measurement"""

    file: str
    """of the record"""
    phase_deg: float
    """true angle of tooth 1 less the recorded angle, as found"""
    rms_N: float
    """of the difference"""
    rms_axis_N: tuple[float, ...]
    """of the difference along each axis"""
    measured_rms_N: float
    """of the measured force"""
    spindle_rpm: float
    """found in the record"""


class StabilityAnswer(Answer):
    """Of ``stability``. Tables:

    ``lobes``: spindle_rpm, axial_depth_mm, multiplier
    ``limit``: spindle_rpm, limit_depth_mm, argument_deg, chatter_frequency_Hz
    ``zeroth_order``: spindle_rpm, limit_depth_mm, chatter_frequency_Hz
    ``multi_frequency``: spindle_rpm, limit_depth_mm, chatter_frequency_Hz
    """

    multiplier: Optional[StabilityMultiplier]
    """Floquet multiplier of the case"""
    stable: bool
    """whether `absolute` is below 1, or as `judged_by` has it"""
    chip_floor: StabilityChipFloor
    """in a power law: the Floquet multiplier at half and twice the floor (not in every
    answer)"""
    verdict: str
    """`stable`, `unstable` or `marginal`: within `margin` of 1, or, in a power law, with
    another answer at half or twice `chip_floor_um`"""
    judged_by: str
    """with `[[measured_frf]]`, what verdict, limit depth, better speed and limit.csv come from:
    `modes`, `complex_modes`, or the measured `response` itself, which modes do not describe
    (`multi_frequency`) (not in every answer)"""
    limit_depth_mm: Optional[float]
    """limit depth: least unstable axial depth at the speed of the case (D-13); `null` if there
    is none up to `greatest_depth_mm`"""
    limit: StabilityLimit
    """how stability is lost there (not in every answer)"""
    better_speed: Optional[StabilityBetterSpeed]
    """`null` where what it allows is not 1.2 times the limit within 2 % of the speed of the
    case; no such key where the time was up before (not in every answer)"""
    greatest_depth_mm: float
    """up to which was looked"""
    spindle_rpm: float
    """of the case"""
    axial_depth_mm: float
    """of the case"""
    modes: Optional[tuple[StabilityMode, ...]]
    """as the chip feels them"""
    measured_frf: StabilityMeasuredFrf
    """with `[[measured_frf]]`. Where no modes could be fitted, `multiplier` and `modes` are
    `null` (not in every answer)"""
    process_damping: StabilityProcessDamping
    """where a flank is worn (not in every answer)"""

    __slots__ = ()

    if TYPE_CHECKING:

        def to_dict(self) -> dicts.Stability: ...  # type: ignore[override]


class StabilityMultiplier(Values):
    """Floquet multiplier of the case"""

    absolute: float
    """of the Floquet multiplier"""
    argument_deg: float
    """of the same"""
    type: str
    """`hopf`, `period_doubling` or `period_one`"""
    chatter_frequencies_Hz: tuple[float, ...]
    """of the vibration that fades or grows (D-12), strongest first"""
    chatter_shares: tuple[float, ...]
    """their amplitudes relative to the first"""
    period: str
    """that it belongs to: `tooth` where all teeth are alike, else `revolution`"""
    period_s: float
    """the same"""
    error: float
    """estimated"""


class StabilityChipFloor(Values):
    """in a power law: the Floquet multiplier at half and twice the floor"""

    chip_floor_um: float
    """of the power law"""
    multiplier_at_half: float
    """at half the floor"""
    multiplier_at_twice: float
    """at twice the floor"""


class StabilityLimit(Values):
    """how stability is lost there"""

    type: str
    """as of the multiplier"""
    argument_deg: float
    """as of the multiplier"""
    chatter_frequencies_Hz: tuple[float, ...]
    """strongest first"""


class StabilityBetterSpeed(Values):
    """`null` where what it allows is not 1.2 times the limit within 2 % of the speed of the
    case; no such key where the time was up before"""

    spindle_rpm: float
    """the speed of the diagram that allows the deepest cut, within 30 % of the speed of the
    case"""
    limit_depth_mm: float
    """depth that it allows within 2 % of that speed, a range inside the diagram"""


class StabilityMode(Values):
    """as the chip feels them"""

    direction: tuple[float, ...]
    """along x and y, as the chip feels it"""
    turned_deg: float
    """by which the residue of a complex mode is turned (M-30) (not in every answer)"""
    frequency_Hz: float
    """natural frequency"""
    damping_ratio: float
    """of critical damping"""
    mass_kg: float
    """modal mass"""
    stiffness_N_per_m: float
    """modal stiffness"""
    damping_Ns_per_m: float
    """modal damping"""


class StabilityMeasuredFrf(Values):
    """with `[[measured_frf]]`. Where no modes could be fitted, `multiplier` and `modes` are
    `null`"""

    band_Hz: tuple[float, ...]
    """of the measured response"""
    zeroth_order: StabilityByFrequency
    """with the mean force (D-22)"""
    multi_frequency: StabilityByFrequency
    """with harmonics of it (D-22)"""
    multiplier_limit_depth_mm: Optional[float]
    """limit depth by the Floquet multiplier of the modes, `null` where there is none"""
    modes_fitted: bool
    """the modes of the multiplier are fitted to the response, and `modes.toml` has them"""


class StabilityByFrequency(Values):
    """with the mean force (D-22)"""

    limit_depth_mm: Optional[float]
    """limit depth, `null` where there is none"""
    chatter_frequency_Hz: Optional[float]
    """there"""
    difference_percent: Optional[float]
    """from the limit of the multiplier"""
    median_difference_percent: Optional[float]
    """median size of the same over the speeds of the diagram"""
    harmonics: int
    """of the force, in `multi_frequency` (not in every answer)"""


class StabilityProcessDamping(Values):
    """where a flank is worn"""

    wear_land_um: float
    """of the flank"""
    indentation_N_per_mm3: float
    """force over the volume that the flank presses aside"""
    flank_friction: float
    """friction over that force"""
    limit_depth_without_mm: Optional[float]
    """the limit depth with sharp edges, `null` where there is none"""


class DynamicsAnswer(Answer):
    """Of ``dynamics``. Tables:

    ``once_per_turn``: turn, x_um, y_um
    ``surface_location``: sigma, height_mm, tooth, error_um
    ``motion``: angle_deg, time_s, x_tool_um, y_tool_um, x_table_um, y_table_um, x_actuator_um,
      command_um
    ``forces``: angle_deg, time_s, F*_N
    ``spectrum``: frequency_Hz, x_um, y_um
    """

    verdict: str
    """`periodic`: the motion repeats; `bounded`: it does not repeat and does not grow;
    `growing`: it grows, or the tool left the cut for good. Growing is status failed and has
    none of the numbers of a turn"""
    periodic: bool
    """whether it repeats"""
    chatter: bool
    """whether the cut feeds a vibration: `growing`, `bounded` unless it settles, and `periodic`
    with a period longer than the cut's. Chatter that does not grow is answered, with the
    warning `chatter`"""
    settles: Optional[bool]
    """of a bounded motion: `true` where transients still die out (warning `not_periodic`),
    `false` where it chatters; else `null`"""
    period: Optional[DynamicsPeriod]
    """of a motion that repeats, else `null`"""
    turns: int
    """how far the motion was followed: at least `revolutions`, more until the steady state"""
    steps_per_tooth: int
    """how finely"""
    linear_growth_per_turn: Optional[float]
    """the Floquet multiplier over a turn: what a turn makes of a small vibration, from the
    linearised cut as in `stability`; `null` where a period of the cut contains more than 400
    vibrations of the fastest mode"""
    growth_per_turn: Optional[float]
    """the same read from the motion (T-11), or `null` where it shows none"""
    change_N: float
    """largest change of a component of the force from the turn before; a steady state (the
    motion repeats) where that is below 1/300 of the peak"""
    engagement_deg: tuple[float, ...]
    """theta at which a tip enters and leaves the stock"""
    flutes: tuple[DynamicsFlute, ...]
    """each in the last turn, of bounded chatter in its last `vibration.turns` (largest peaks,
    mean areas)"""
    difference: float
    """of the largest and smallest `peak_Fy_N`, over the largest"""
    peak_xy_N: float
    """largest force in the plane of the table"""
    vibration: Optional[DynamicsVibration]
    """of bounded chatter, over the last `turns`; else `null`"""
    surface_location: tuple[DynamicsSurfaceLocation, ...]
    """for each finished wall; empty where the motion does not repeat with every turn"""
    process_damping: DynamicsProcessDamping
    """where a flank is worn (not in every answer)"""

    __slots__ = ()

    if TYPE_CHECKING:

        def to_dict(self) -> dicts.Dynamics: ...  # type: ignore[override]


class DynamicsPeriod(Values):
    """of a motion that repeats, else `null`"""

    teeth: int
    """after so many"""
    turns: float
    """the same in turns"""
    teeth_of_cut: int
    """after how many the cut without vibration does (T-15)"""


class DynamicsFlute(Values):
    """each in the last turn, of bounded chatter in its last `vibration.turns` (largest peaks,
    mean areas)"""

    tooth: int
    """number, from 1"""
    enters_deg: float
    """the spindle angle at which its tip enters the stock"""
    peak_Fx_N: float
    """largest |Fx| while its turn lasts"""
    peak_Fy_N: float
    """largest |Fy| while its turn lasts"""
    chip_area_mm_rad: float
    """at the tip"""
    peak_chip_mm: float
    """at the tip"""


class DynamicsVibration(Values):
    """of bounded chatter, over the last `turns`; else `null`"""

    turns: int
    """that were looked at, the last ones"""
    x_um: float
    """half of the range of tool minus work"""
    y_um: float
    """the same along y"""
    chatter_frequency_Hz: Optional[float]
    """the strongest line that is no harmonic of the spindle, or `null`"""
    lines: tuple[DynamicsLine, ...]
    """of spectrum.csv, strongest first (T-13, T-14)"""


class DynamicsLine(Values):
    """of spectrum.csv, strongest first (T-13, T-14)"""

    frequency_Hz: float
    """of the line"""
    x_um: float
    """amplitude"""
    y_um: float
    """amplitude"""
    spindle_harmonic: Optional[int]
    """which it is, or `null`"""


class DynamicsSurfaceLocation(Values):
    """for each finished wall; empty where the motion does not repeat with every turn"""

    wall: str
    """`up`: at y = D/2, `down`: at y = -D/2; a slot has both"""
    flutes: tuple[DynamicsSurfaceLocationFlute, ...]
    """what each would leave at the tip"""
    surface_location_error_um: float
    """the one that remains (T-10)"""


class DynamicsSurfaceLocationFlute(Values):
    """what each would leave at the tip"""

    tooth: int
    """number, from 1"""
    surface_location_error_um: float
    """positive where material is left"""


class DynamicsProcessDamping(Values):
    """where a flank is worn"""

    wear_land_um: float
    """of the flank"""
    indentation_N_per_mm3: float
    """force over the volume that the flank presses aside"""
    flank_friction: float
    """friction over that force"""


class IdentifyAnswer(Answer):
    """Of ``identify``. Tables:

    ``channels``: run, angle_deg, channel*_N, channel*_Nm, channel*_W
    ``overview``: run, time_s, turn, channel*_N, used
    ``folded``: run, angle_deg, *_N
    ``sweep``: offset_um, rms_*_N
    ``fitted``: run, angle_deg, *_measured_N, *_N
    ``residual``: run, angle_deg, *_N
    ``chip_curve``: theta_deg, h_tooth*_mm
    """

    fits: tuple[Fit, ...]
    """one for each entry of `chip_models`, in that order"""
    chosen: str
    """the fit in `material.toml`: the trochoidal one if it was asked for, else the best"""
    covariance: Optional[Covariance]
    """of the chosen fit, the first group: what `[sweep] covariance` draws from"""
    groups: tuple[Group, ...]
    """of the chosen fit (not in every answer)"""
    signal: IdentifySignal
    """what was found in the records before anything was fitted (not in every answer)"""
    clocking: IdentifyClocking
    """of an identified eccentricity (not in every answer)"""
    runout_form: IdentifyRunoutForm
    """how the form of the runout was decided (not in every answer)"""
    views: tuple[IdentifyView, ...]
    """where what a fit leaves repeats turn by turn: the chosen view first, then others (not in
    every answer)"""
    not_in_the_intervals: tuple[IdentifyNotInTheInterval, ...]
    """errors that the record cannot show and no interval includes, and how they would change
    the coefficients (I-24) (not in every answer)"""
    curves: str
    """`whole`, or `mean turn` where the records are long and `fitted.csv`, `residual.csv`
    contain the mean turn of each (`--curves` keeps every sample)"""
    verdict: str
    """`usable`, `usable with care` or `do not use`: the first line printed and the first of the
    report"""
    with_care: tuple[str, ...]
    """why to use the numbers with care, a few words for each; empty: no reason seen, or
    `do_not_use` has some"""
    do_not_use: tuple[str, ...]
    """reasons why the numbers must not be used; empty: none. Then `message`, the table and
    `material.toml` begin with `Do not use these numbers`, and warnings `likely_cause` say what
    to look at"""

    __slots__ = ()

    if TYPE_CHECKING:

        def to_dict(self) -> dicts.Identify: ...  # type: ignore[override]


class IdentifySignal(Values):
    """what was found in the records before anything was fitted"""

    files: tuple[str, ...]
    """the records, in measurement order"""
    samples: tuple[int, ...]
    """of each"""
    spindle_rpm: Union[float, tuple[float, ...]]
    """spindle speed found, of a single record the number alone"""
    spindle_rpm_se: Optional[Union[float, tuple[Optional[float], ...]]]
    """its standard error, or `null`"""
    stated_rpm: Union[float, tuple[float, ...]]
    """spindle speed of the case"""
    revolutions: tuple[int, ...]
    """how many turns of each record were laid over each other (not in every answer)"""
    axes: Optional[tuple[str, ...]]
    """of the dynamometer; `null` where they are no signed permutation"""
    matrix: tuple[tuple[float, ...], ...]
    """of the dynamometer, in that case (not in every answer)"""
    axes_rms_N: float
    """with `axes = "auto"`: what the choice leaves (not in every answer)"""
    axes_next_rms_N: float
    """and what the next one leaves (not in every answer)"""


class IdentifyClocking(Values):
    """of an identified eccentricity"""

    total_indicator_reading_um: Estimate
    """of a dial gauge at the shank"""
    height_mm: float
    """half of the axial depth"""
    longest_tooth: int
    """at that height"""
    tool: IdentifyClockingPart
    """with `previous_clamping`: the part of the tool (not in every answer)"""
    holder: IdentifyClockingPart
    """with `previous_clamping`: the part of the holder (not in every answer)"""
    best_turn_deg: float
    """by which to turn the tool in its holder from now on (not in every answer)"""
    least_eccentricity_mm: float
    """that then remains (not in every answer)"""


class IdentifyClockingPart(Values):
    """with `previous_clamping`: the part of the tool"""

    eccentricity_mm: Estimate
    """of this part"""
    angle_deg: float
    """of the tool from the tip of tooth 1, of the holder from where tooth 1 stood before"""
    angle_se_deg: Optional[float]
    """one standard error, or `null`"""


class IdentifyRunoutForm(Values):
    """how the form of the runout was decided"""

    form: str
    """that was fitted"""
    decided_by: str
    """`case` or `record`"""
    better: str
    """that the records decide for"""
    why: str
    """in words"""
    tried: tuple[IdentifyTried, ...]
    """each form that was tried"""


class IdentifyTried(Values):
    """each form that was tried"""

    form: str
    """as in `[identify] runout`"""
    rms_N: float
    """that it leaves"""
    excess: float
    """how much worse it would foretell further turns than the better one, in what one unknown
    explains by chance (I-18); below 4 it decides nothing"""


class IdentifyView(Values):
    """where what a fit leaves repeats turn by turn: the chosen view first, then others"""

    band_harmonics: int
    """0: all"""
    resonance: bool
    """whether resonances of the dynamometer are in the model"""
    unexplained: float
    """part of the whole force"""
    K_t1_MPa: Optional[Estimate]
    """the first coefficient of the law, by its key (not in every answer)"""
    K_tc_MPa: Optional[Estimate]
    """the first coefficient of the law, by its key (not in every answer)"""


class IdentifyNotInTheInterval(Values):
    """errors that the record cannot show and no interval includes, and how they would change
    the coefficients (I-24)"""

    what: str
    """how much of what was not told"""
    effect: Named[float]
    """by how much the coefficients are then found too large"""


class SurfaceAnswer(Answer):
    """Of ``surface``. Tables:

    ``floor``: y_mm, x_mm, z_mm, tooth
    ``surface``: x_mm, height_mm, error_mm, tooth
    ``forces``: angle_deg, x_mm, F_normal_N, Fx_N, Fy_N
    ``deflection``: angle_deg, height_mm, deflection_mm
    ``influence``: height_mm, load_height_mm, cutter_mm_per_N, wall_mm_per_N
    ``bent``: height_mm, cutter_mm, wall_mm
    ``passes``: pass, radial_depth_mm, feed_per_tooth_mm, below_edge_mm, stock_min_mm,
      stock_mean_mm, stock_max_mm, mean_error_mm, min_error_mm, peak_error_mm, F_normal_mean_N,
      F_normal_max_N, thickness_before_mm, thickness_left_mm
    ``wall_loads``: x_mm, wall_height_mm, *_deflection_mm
    """

    period_mm: float
    """feed of a turn, after which the profiles repeat"""
    floor: tuple[SurfaceFloor, ...]
    """for each of `floor_y_mm` (not in every answer)"""
    model: str
    """as asked for (not in every answer)"""
    feedback: str
    """as asked for (not in every answer)"""
    mean_error_mm: float
    """mean of the heights (not in every answer)"""
    peak_error_mm: float
    """largest of the heights (not in every answer)"""
    min_error_mm: float
    """smallest of the heights (not in every answer)"""
    forces: SurfaceForces
    """over the rows of forces.csv (not in every answer)"""
    compliance_mm_per_N: float
    """at the first of the heights, under the whole force (not in every answer)"""
    turns_to_repeat: int
    """turns until the steady state, in which the deflection repeats (not in every answer)"""
    heights: tuple[SurfaceHeight, ...]
    """for each height (not in every answer)"""
    bent: SurfaceBent
    """the deflected shapes in bent.csv (not in every answer)"""
    passes: tuple[SurfacePass, ...]
    """with `[[pass]]`, for each; everything else is of the last (not in every answer)"""
    also_bends: SurfaceAlsoBends
    """if asked for: mean and peak error without those forces (not in every answer)"""
    wall_loads: SurfaceWallLoads
    """if asked for (not in every answer)"""

    __slots__ = ()

    if TYPE_CHECKING:

        def to_dict(self) -> dicts.Surface: ...  # type: ignore[override]


class SurfaceFloor(Values):
    """for each of `floor_y_mm`"""

    y_mm: float
    """of the line, as asked for"""
    mean_mm: float
    """mean height above the nominal plane of the tips"""
    lowest_mm: float
    """lowest height"""
    highest_mm: float
    """highest"""
    Ra_um: float
    """over one period, no filter (W-1)"""
    Rq_um: float
    """the same"""
    Rz_um: float
    """the same: the sampling length is the period"""
    Rt_um: float
    """the same"""
    share: tuple[float, ...]
    """which fraction of the profile each tooth wrote"""
    filtered: SurfaceFiltered
    """with `cutoff_mm`, behind the Gaussian filter (W-2) (not in every answer)"""


class SurfaceFiltered(Values):
    """with `cutoff_mm`, behind the Gaussian filter (W-2)"""

    cutoff_mm: float
    """of the filter, as asked for"""
    Ra_um: float
    """over five cutoffs"""
    Rq_um: float
    """over five cutoffs"""
    Rz_um: float
    """mean of the Rz of the five"""
    Rt_um: float
    """over five cutoffs"""


class SurfaceForces(Values):
    """over the rows of forces.csv"""

    F_normal_mean_N: float
    """mean"""
    F_normal_min_N: float
    """smallest"""
    F_normal_max_N: float
    """largest"""
    Fx_mean_N: float
    """mean"""
    Fx_min_N: float
    """smallest"""
    Fx_max_N: float
    """largest"""


class SurfaceHeight(Values):
    """for each height"""

    height_mm: float
    """above the tip"""
    mean_error_mm: float
    """mean error"""
    min_error_mm: float
    """smallest"""
    max_error_mm: float
    """largest"""
    Ra_um: float
    """along the feed"""
    Rt_um: float
    """along the feed"""
    Rq_um: float
    """along the feed (not in every answer)"""
    Rz_um: float
    """along the feed: the sampling length is what is computed of it (not in every answer)"""
    filtered: SurfaceFiltered
    """with `cutoff_mm`, behind the Gaussian filter (W-2) (not in every answer)"""
    share: tuple[float, ...]
    """which fraction of the profile each tooth made"""
    compliance_mm_per_N: float
    """under the whole force"""
    once_per_turn_um: float
    """envelope over whole turns: amplitude (not in every answer)"""
    once_per_tooth_um: float
    """the same with the teeth (not in every answer)"""
    operator: SurfaceOperator
    """imprint: the error by each coefficient (not in every answer)"""


class SurfaceOperator(Values):
    """imprint: the error by each coefficient"""

    K_tc_mm_per_MPa: float
    """error by K_tc"""
    K_rc_mm_per_MPa: float
    """error by K_rc"""


class SurfaceBent(Values):
    """the deflected shapes in bent.csv"""

    angle_deg: float
    """spindle angle of the largest force"""
    F_normal_N: float
    """the force there"""
    cutter: Optional[SurfaceCutter]
    """`null` where rigid"""
    wall: Optional[SurfaceWall]
    """`null` where rigid"""


class SurfaceCutter(Values):
    """`null` where rigid"""

    diameter_mm: float
    """of the teeth"""
    shank_diameter_mm: float
    """of the shank"""
    flute_length_mm: float
    """above the tip"""
    overhang_mm: float
    """from the holder to the tip"""


class SurfaceWall(Values):
    """`null` where rigid"""

    height_mm: float
    """up to the last pass"""
    thickness_mm: float
    """before the cut"""
    edge_height_mm: float
    """axial depth of the cut"""


class SurfacePass(Values):
    """with `[[pass]]`, for each; everything else is of the last"""

    radial_depth_mm: float
    """as asked for"""
    feed_per_tooth_mm: float
    """as asked for"""
    below_edge_mm: float
    """how deep below the free edge of the wall"""
    stock_min_mm: float
    """smallest radial depth with what the pass before left, over the heights"""
    stock_mean_mm: float
    """its mean"""
    stock_max_mm: float
    """its largest"""
    mean_error_mm: float
    """error that it leaves"""
    min_error_mm: float
    """the smallest"""
    peak_error_mm: float
    """the largest"""
    F_normal_mean_N: float
    """mean force across the wall"""
    F_normal_max_N: float
    """largest force across the wall"""
    thickness_before_mm: Optional[float]
    """of the wall where it is cut, `null` where it is rigid"""
    thickness_left_mm: Optional[float]
    """after the pass, `null` where it is rigid"""


class SurfaceAlsoBends(Values):
    """if asked for: mean and peak error without those forces"""

    axes: tuple[str, ...]
    """of the forces"""
    mean_error_without_mm: float
    """without them"""
    peak_error_without_mm: float
    """without them"""
    mean_change_um: float
    """by which they change it"""
    peak_change_um: float
    """by which they change it"""


class SurfaceWallLoads(Values):
    """if asked for"""

    pressure: SurfacePressure
    """where it is given (not in every answer)"""
    edge_load: SurfaceEdgeLoad
    """where it is given (not in every answer)"""
    line_load: SurfaceLineLoad
    """where it is given (not in every answer)"""


class SurfacePressure(Values):
    """where it is given"""

    pressure_kPa: float
    """as asked for"""
    largest_deflection_mm: float
    """by size"""
    x_mm: float
    """where that is"""
    wall_height_mm: float
    """above the foot"""
    coefficient: float
    """the number without unit of handbooks (B-11)"""
    coefficient_is: str
    """how it is made, in letters"""


class SurfaceEdgeLoad(Values):
    """where it is given"""

    edge_load_N_per_mm: float
    """as asked for"""
    largest_deflection_mm: float
    """by size"""
    x_mm: float
    """where that is"""
    wall_height_mm: float
    """above the foot"""
    coefficient: float
    """the number without unit of handbooks (B-11)"""
    coefficient_is: str
    """how it is made, in letters"""


class SurfaceLineLoad(Values):
    """where it is given"""

    line_load_N_per_mm: float
    """as asked for"""
    largest_deflection_mm: float
    """by size"""
    x_mm: float
    """where that is"""
    wall_height_mm: float
    """above the foot"""
    coefficient: float
    """the number without unit of handbooks (B-11)"""
    coefficient_is: str
    """how it is made, in letters"""


class CalibrateAnswer(Answer):
    """Of ``calibrate``. Tables:

    ``residual``: x_mm, feed_mm, height_mm, tooth, measured_mm, fitted_mm, residual_mm
    ``fitted``: x_mm, feed_mm, height_mm, readings, mean_mm, *_mm
    ``trace``: measurement, x_mm, measured_mm, fitted_mm, residual_mm
    """

    model: str
    """as in `[surface] model` (not in every answer)"""
    feedback: str
    """as in `[surface] feedback` (not in every answer)"""
    coefficients: Named[Optional[Estimate]]
    """`null` where they are not known (not in every answer)"""
    correlation: Optional[float]
    """of the two (not in every answer)"""
    rank: int
    """of the equations (not in every answer)"""
    condition: float
    """condition number of the same (not in every answer)"""
    rms_mm: Optional[float]
    """that it leaves of the means (not in every answer)"""
    combination: CalibrateCombination
    """where only a sum of the coefficients is known (not in every answer)"""
    covariance: Optional[Covariance]
    """what `[sweep] covariance` draws from (not in every answer)"""
    offset_mm: Optional[float]
    """of the first measurement, where asked for (not in every answer)"""
    datum: tuple[CalibrateDatum, ...]
    """of each measurement, where asked for (not in every answer)"""
    noise_mm: float
    """standard deviation of one reading (not in every answer)"""
    means: int
    """how many there are of the readings (not in every answer)"""
    readings: CalibrateReadings
    """how many there are, and what became of the others (not in every answer)"""
    answers: tuple[CalibrateOneAnswer, ...]
    """every way to read the profile, side by side (not in every answer)"""
    ten_more_readings: tuple[CalibrateTenMoreReading, ...]
    """standard errors with ten more readings at a height, best first (not in every answer)"""
    runout: CalibrateRunout
    """with standard errors, or why it is not known (not in every answer)"""
    with_runout: bool
    """whether `coefficients` are from the fit to all readings together with the runout (not in
    every answer)"""
    outliers: tuple[CalibrateOutlier, ...]
    """readings left out (not in every answer)"""
    form: str
    """where the readings decide: the likeliest form (not in every answer)"""
    explanations: tuple[CalibrateExplanation, ...]
    """every form and feedback tried, likeliest first. The answer is the mean over them. `datum`
    and `residual.csv` are from the likeliest one (not in every answer)"""
    scatter: CalibrateScatter
    """of the readings (not in every answer)"""
    finish: tuple[CalibrateFinish, ...]
    """`of = "finish"`: for each trace (not in every answer)"""

    __slots__ = ()

    if TYPE_CHECKING:

        def to_dict(self) -> dicts.Calibrate: ...  # type: ignore[override]


class CalibrateCombination(Values):
    """where only a sum of the coefficients is known"""

    K_tc_weight: float
    """of K_tc"""
    K_rc_weight: float
    """of K_rc"""
    value_MPa: Estimate
    """of the weighted sum"""


class CalibrateDatum(Values):
    """of each measurement, where asked for"""

    offset_mm: Estimate
    """by which all its readings lie high (not in every answer)"""
    curvature_mm: Estimate
    """over the height (not in every answer)"""
    slopes_mm_per_mm: tuple[Estimate, ...]
    """along the feed, then over the height (not in every answer)"""


class CalibrateReadings(Values):
    """how many there are, and what became of the others"""

    used: int
    """how many"""
    skipped: int
    """rows or points left out, without a value or, of a map, outside the cut"""
    repeats: int
    """readings averaged with another of their place"""
    repeatability_mm: Optional[float]
    """standard deviation of one by its repeats, pooled over places and files, or `null`"""


class CalibrateOneAnswer(Values):
    """every way to read the profile, side by side"""

    model: str
    """as in `[surface] model`"""
    feedback: str
    """as in `[surface] feedback`"""
    coefficients: Named[Optional[Estimate]]
    """`null` where they are not known"""
    correlation: Optional[float]
    """of the two"""
    rank: int
    """of the equations"""
    condition: float
    """condition number of the same"""
    rms_mm: Optional[float]
    """that it leaves of the means"""
    message: str
    """where it could not be fitted, why (not in every answer)"""
    combination: CalibrateCombination
    """where only a sum of the coefficients is known (not in every answer)"""


class CalibrateTenMoreReading(Values):
    """standard errors with ten more readings at a height, best first"""

    height_mm: float
    """above the tip"""
    se_K_rc_MPa: float
    """of either coefficient, by its key (not in every answer)"""
    se_K_tc_MPa: float
    """of either coefficient, by its key (not in every answer)"""


class CalibrateRunout(Values):
    """with standard errors, or why it is not known"""

    eccentricity_mm: Optional[float]
    """`null` where it is not known"""
    eccentricity_se_mm: float
    """standard error (not in every answer)"""
    angle_deg: Optional[float]
    """from the tip of tooth 1 towards tooth 2, or `null`"""
    identifiable: str
    """why it is not known (not in every answer)"""
    angle_se_deg: float
    """standard error (not in every answer)"""
    angle_known_up_to_deg: Optional[float]
    """where teeth are not numbered, else `null` (not in every answer)"""
    coefficients: Named[Optional[Estimate]]
    """found with the runout (not in every answer)"""
    correlation: float
    """of them (not in every answer)"""
    rms_without_mm: float
    """that is left of all readings without runout (not in every answer)"""
    rms_mm: float
    """that is left with it (not in every answer)"""
    turn_begins_mm: float
    """envelope: where a turn begins along the wall (not in every answer)"""


class CalibrateOutlier(Values):
    """readings left out"""

    reading: int
    """number, from 1"""
    x_mm: float
    """along the feed"""
    height_mm: float
    """above the tip"""
    off_mm: float
    """from what the others say"""


class CalibrateExplanation(Values):
    """every form and feedback tried, likeliest first. The answer is the mean over them. `datum`
    and `residual.csv` are from the likeliest one"""

    form: str
    """of the readings"""
    feedback: str
    """of the cut"""
    weight: float
    """its probability"""
    coefficients: Named[Optional[Estimate]]
    """by it"""
    eccentricity_mm: Optional[float]
    """by it, or `null`"""
    rms_mm: float
    """that it leaves"""


class CalibrateScatter(Values):
    """of the readings"""

    own_mm: float
    """standard deviation of each reading's own scatter"""
    shared_mm: float
    """of what readings of a height or a place share"""


class CalibrateFinish(Values):
    """`of = "finish"`: for each trace"""

    file: str
    """as the case names it"""
    floor_y_mm: float
    """of a trace on the floor (not in every answer)"""
    height_mm: float
    """of a trace on the wall (not in every answer)"""
    message: str
    """where it could not be fitted, why (not in every answer)"""
    numbered: bool
    """whether an unequal pitch tells which tooth is which; else they are in their order of
    passage, the deepest first (not in every answer)"""
    teeth: tuple[CalibrateTooth, ...]
    """in their order of passage (not in every answer)"""
    waves: tuple[CalibrateWave, ...]
    """of the offsets around the tool, where all teeth write (not in every answer)"""
    feed_mm: Estimate
    """of a turn, as the trace has it (not in every answer)"""
    feeds: tuple[CalibrateFeed, ...]
    """what the same teeth would leave at other feeds (not in every answer)"""
    turns: float
    """of the spindle that the trace spans (not in every answer)"""
    readings: int
    """of the trace"""
    repeating: float
    """share of what the fit leaves that repeats turn by turn (not in every answer)"""
    readings_as_one: float
    """how many readings of what is left count as one (not in every answer)"""
    rms_um: float
    """that the fit leaves (not in every answer)"""
    waviness_um: float
    """longer than the feed of a turn, from its lowest to its highest: taken out before the fit;
    0: hardly any (not in every answer)"""
    Ra_measured_um: float
    """of the trace less its line and its waviness, noise included (not in every answer)"""
    Ra_um: float
    """of the fitted profile, filtered as the trace (not in every answer)"""
    Ra_alike_um: float
    """of the profile with all teeth at one depth (not in every answer)"""


class CalibrateTooth(Values):
    """in their order of passage"""

    tooth: int
    """number, or place in the order of passage"""
    writes: bool
    """whether the trace shows a mark of it"""
    share: float
    """of the trace that it wrote"""
    offset_mm: Estimate
    """against the deepest tooth, negative: shorter; along the axis on the floor, along the
    radius on the wall (not in every answer)"""
    at_most_mm: float
    """of a tooth that writes nothing: its offset is no larger (not in every answer)"""


class CalibrateWave(Values):
    """of the offsets around the tool, where all teeth write"""

    per_turn: int
    """waves in a turn; 1 is what an eccentricity or a tilt does"""
    amplitude_mm: Estimate
    """of the wave"""
    phase_deg: Estimate
    """of its crest, from the first tooth towards the next"""


class CalibrateFeed(Values):
    """what the same teeth would leave at other feeds"""

    feed_per_tooth_mm: float
    """from half the feed of the trace to one and a half"""
    Ra_um: float
    """of the marks of these teeth"""
    Ra_alike_um: float
    """with all teeth at one depth"""


class ModesAnswer(Answer):
    """Of ``modes``. Tables:

    ``fitted``: frequency_Hz, re_*, im_*, fitted_re_*, fitted_im_*, mode_indicator
    ``fitted_*``: frequency_Hz, re_*, im_*, fitted_re_*, fitted_im_*
    ``response``: frequency_Hz, re_*, im_*, coherence
    ``stabilisation``: order, frequency_Hz, damping_ratio, standing
    """

    kind: str
    """`receptance`, `mobility` or `accelerance` (not in every answer)"""
    modes: tuple[ModesMode, ...]
    """by frequency, of all responses together; `null` with status failed"""
    lines: int
    """that were used (not in every answer)"""
    band_Hz: tuple[float, ...]
    """the first of them and the last (not in every answer)"""
    covariance: Optional[Covariance]
    """what `[sweep] covariance` draws from"""
    explained: float
    """1 less the sum of squares of the residual over the sum of squares of the response (not in
    every answer)"""
    residual_terms: Optional[ModesResidualTerms]
    """M-6; `null` where none are needed (not in every answer)"""
    terms_outside_Hz: tuple[float, ...]
    """terms that stand for modes outside of the band (not in every answer)"""
    noise: ModesNoise
    """as standard deviations (M-15) (not in every answer)"""
    unresolved: tuple[ModesUnresolved, ...]
    """resonances in the fit and not among the modes"""
    orders: tuple[ModesOrder, ...]
    """every fit that was tried"""
    hits: tuple[ModesHit, ...]
    """each blow, where the record has hammer blows (not in every answer)"""
    block_s: float
    """length of what is taken of each blow (not in every answer)"""
    window_end: float
    """value of the exponential window at the end of a block; 1: no window (not in every
    answer)"""
    excited_to_Hz: float
    """highest frequency at which the force is within 20 dB of its maximum (not in every
    answer)"""
    description: str
    """what the file says of itself (not in every answer)"""
    shapes: str
    """of several responses: `real` or `complex`; `null` with status failed (not in every
    answer)"""
    real_modes: tuple[ModesMode, ...]
    """where shapes are complex: the real modes that fit best, as in `modes.toml` (not in every
    answer)"""
    responses: tuple[ModesResponse, ...]
    """of several: each of them (not in every answer)"""
    reciprocity: tuple[ModesReciprocity, ...]
    """of several responses, where xy and yx were measured (M-34) (not in every answer)"""
    complex_evidence: Optional[float]
    """of several: criterion of the best real shapes less criterion of the best complex ones;
    `null` where not both were tried (not in every answer)"""
    rms_m_per_N: float
    """of what the fit leaves: `rms_m_per_N`, `rms_m_per_s_N` or `rms_m_per_s2_N` (not in every
    answer)"""
    rms_m_per_s2_N: float
    """of what the fit leaves: `rms_m_per_N`, `rms_m_per_s_N` or `rms_m_per_s2_N` (not in every
    answer)"""
    rms_m_per_s_N: float
    """of what the fit leaves: `rms_m_per_N`, `rms_m_per_s_N` or `rms_m_per_s2_N` (not in every
    answer)"""

    __slots__ = ()

    if TYPE_CHECKING:

        def to_dict(self) -> dicts.Modes: ...  # type: ignore[override]


class ModesMode(Values):
    """by frequency, of all responses together; `null` with status failed"""

    frequency_Hz: float
    """natural frequency"""
    damping_ratio: float
    """of critical damping"""
    mass_kg: float
    """modal mass; of several responses: of motion along the shape"""
    stiffness_N_per_m: float
    """modal stiffness, likewise"""
    damping_Ns_per_m: float
    """modal damping, likewise"""
    angle_deg: float
    """angle of the shape from +x towards +y, where both directions were measured (not in every
    answer)"""
    imaginary_fraction: float
    """share of the imaginary part in a complex shape (M-33) (not in every answer)"""
    se: ModesSe
    """standard errors"""
    shape: tuple[ModesShape, ...]
    """of several responses: the component along each axis, the largest one with a real part
    above 0 (not in every answer)"""
    lines_in_peak: int
    """lines between its half-power points, where they are fewest"""


class ModesSe(Values):
    """standard errors"""

    frequency_Hz: float
    """of the same key"""
    damping_ratio: float
    """of the same key"""
    mass_kg: float
    """of the same key"""
    stiffness_N_per_m: float
    """of the same key"""
    damping_Ns_per_m: float
    """of the same key"""
    angle_deg: float
    """of the same key (not in every answer)"""
    imaginary_fraction: float
    """of the same key (not in every answer)"""


class ModesShape(Values):
    """of several responses: the component along each axis, the largest one with a real part
    above 0"""

    axis: str
    """of the component"""
    re_per_sqrt_kg: float
    """its real part, scaled to a modal mass of 1"""
    re_se: float
    """standard error of it"""
    im_per_sqrt_kg: float
    """its imaginary part, where shapes are complex (not in every answer)"""
    im_se: float
    """standard error of it (not in every answer)"""


class ModesResidualTerms(Values):
    """M-6; `null` where none are needed"""

    above_m_per_N: float
    """U: of modes above the band"""
    below_per_kg: float
    """L: of modes below the band"""


class ModesNoise(Values):
    """as standard deviations (M-15)"""

    magnitude_percent: float
    """in proportion to the response"""
    phase_deg: float
    """of its phase"""
    floor_m_per_N: float
    """of each line: `floor_m_per_N` ... (not in every answer)"""
    floor_m_per_s2_N: float
    """of each line: `floor_m_per_N` ... (not in every answer)"""
    floor_m_per_s_N: float
    """of each line: `floor_m_per_N` ... (not in every answer)"""


class ModesUnresolved(Values):
    """resonances in the fit and not among the modes"""

    frequency_Hz: float
    """of one response: where it is (not in every answer)"""
    why: str
    """why it is no answer"""


class ModesOrder(Values):
    """every fit that was tried"""

    modes: int
    """how many it would answer"""
    shapes: str
    """of several responses: `real` or `complex` (not in every answer)"""
    residual_terms: bool
    """whether it has them"""
    criterion: float
    """above the criterion of the best fit: the less, the better"""
    frequencies_Hz: tuple[float, ...]
    """of all its terms"""
    damping_ratios: tuple[float, ...]
    """of all its terms"""
    fault: Optional[str]
    """why it cannot be the answer, or `null`"""


class ModesHit(Values):
    """each blow, where the record has hammer blows"""

    time_s: float
    """where its pulse begins"""
    peak_N: float
    """of the force"""
    left_out: Optional[str]
    """why it is not used, or `null`"""


class ModesResponse(Values):
    """of several: each of them"""

    name: str
    """motion, then force: `xy`"""
    axis: str
    """of the motion"""
    force_axis: str
    """of the force"""
    kind: str
    """`receptance`, `mobility` or `accelerance`"""
    lines: int
    """that were used"""
    band_Hz: tuple[float, ...]
    """the first of them and the last (not in every answer)"""
    description: str
    """what the file says of it (not in every answer)"""
    explained: float
    """1 less the sum of squares of the residual over the sum of squares of the response"""
    noise: ModesNoise
    """as standard deviations (M-15)"""
    residues: tuple[ModesResidue, ...]
    """of each mode (M-30)"""
    residual_terms: ModesResidualTerms
    """M-30, where they are needed (not in every answer)"""
    rms_m_per_N: float
    """of what the fit leaves: `rms_m_per_N`, `rms_m_per_s_N` or `rms_m_per_s2_N` (not in every
    answer)"""
    rms_m_per_s2_N: float
    """of what the fit leaves: `rms_m_per_N`, `rms_m_per_s_N` or `rms_m_per_s2_N` (not in every
    answer)"""
    rms_m_per_s_N: float
    """of what the fit leaves: `rms_m_per_N`, `rms_m_per_s_N` or `rms_m_per_s2_N` (not in every
    answer)"""


class ModesResidue(Values):
    """of each mode (M-30)"""

    re_per_kg: float
    """its real part"""
    re_se: float
    """standard error of it"""
    im_per_kg: float
    """its imaginary part, where shapes are complex (not in every answer)"""
    im_se: float
    """standard error of it (not in every answer)"""


class ModesReciprocity(Values):
    """of several responses, where xy and yx were measured (M-34)"""

    response: str
    """one of the two"""
    over: str
    """the other"""
    gain: float
    """of the first over the second; 1 where they agree"""
    se: float
    """standard error of it"""


class ActuatorAnswer(Answer):
    """Of ``actuator``. Tables:

    ``fitted``: time_s, command_um, position_um, fitted_um
    """

    gain: float
    """M-8; `null` with status failed"""
    frequency_Hz: float
    """natural frequency"""
    damping_ratio: float
    """of critical damping"""
    time_constants_s: Optional[tuple[float, ...]]
    """the longer one first, or `null` with the reason in `identifiable` (M-14)"""
    sum_s: float
    """of the two time constants, always well determined"""
    product_s2: float
    """of the two, likewise"""
    se: ActuatorSe
    """standard errors of all of these"""
    identifiable: ActuatorIdentifiable
    """empty, or"""
    start_s: float
    """of the step, as fitted, or as given"""
    step_um: float
    """of the command"""
    half_power_frequency_Hz: float
    """bandwidth (-3 dB), by the transfer function"""
    low_frequency_delay_s: float
    """of slow commands"""
    rise_time_10_90_s: float
    """of a step"""
    rms_um: float
    """that the fit leaves"""
    explained: float
    """1 less the sum of squares of the residual over the sum of squares of the motion"""

    __slots__ = ()

    if TYPE_CHECKING:

        def to_dict(self) -> dicts.Actuator: ...  # type: ignore[override]


class ActuatorSe(Values):
    """standard errors of all of these"""

    gain: float
    """of the same key"""
    frequency_Hz: float
    """of the same key"""
    damping_ratio: float
    """of the same key"""
    time_constants_s: Optional[tuple[float, ...]]
    """of the same key, or `null`"""
    sum_s: float
    """of the same key"""
    product_s2: float
    """of the same key"""
    start_s: float
    """of the same key; 0 where it is given"""


class ActuatorIdentifiable(Values):
    """empty, or"""

    time_constants_s: str
    """why there are none (not in every answer)"""


class CorrectAnswer(Answer):
    """Of ``correct``. Tables:

    ``command``: angle_deg, command_um, table_wanted_um
    ``forces``: angle_deg, time_s, *_N, table_before_um, table_after_um
    ``speeds``: spindle_rpm, *
    ``spindle``: angle_deg, spindle_rpm, torque_Nm
    ``estimator``: flute, window_start_turns, wait_turns, *_per_um, tooth*_per_um
    ``controller``: time_s, command_um, table_um, gain, state
    """

    runout: CorrectRunout
    """of what is there, and how it was read"""
    before: CorrectCut
    """on the moving cut, last turn, without the command"""
    after: CorrectCut
    """the same with it"""
    reduction: Optional[float]
    """1 less the ratio of both differences"""
    command: CorrectCommand
    """the feedforward command"""
    allowed_difference: float
    """as asked for"""
    max_rpm: Named[float]
    """highest spindle speed that keeps `allowed_difference`; the last speed looked at where it
    is kept up to there"""
    max_rpm_cut: str
    """the cut that these are of"""
    axes: CorrectAxes
    """root mean square of the chip differences over the cut"""
    spindle_speed: CorrectSpindleSpeed
    """with `[spindle]`: a speed that changes within the turn in place of the table (not in
    every answer)"""
    controller: CorrectController
    """with `--simulate-controller` (not in every answer)"""

    __slots__ = ()

    if TYPE_CHECKING:

        def to_dict(self) -> dicts.Correct: ...  # type: ignore[override]


class CorrectRunout(Values):
    """of what is there, and how it was read"""

    radial_offsets_um: tuple[float, ...]
    """of what is there, mean 0"""
    chip_difference_um: tuple[float, ...]
    """rho_j - rho_(j-1) of the same"""
    designed_for_um: tuple[float, ...]
    """of what the command is made for"""
    static_fit: CorrectStaticFit
    """what a rigid model reads from the forces (R-21) (not in every answer)"""
    ratio_um: Optional[tuple[float, ...]]
    """with a measurement: from the peaks alone, or `null` (not in every answer)"""
    ratio_reason: str
    """why not (not in every answer)"""
    angle_offset_deg: float
    """true angle less the recorded one"""


class CorrectStaticFit(Values):
    """what a rigid model reads from the forces (R-21)"""

    chip_difference_um: tuple[CorrectChipDifference, ...]
    """of each tooth"""
    rms_N: float
    """that it leaves"""
    explained: float
    """1 less the sum of squares of the residual over the sum of squares of the force"""


class CorrectChipDifference(Values):
    """of each tooth"""

    value: float
    """as found"""
    se: float
    """one standard error"""


class CorrectCut(Values):
    """the same with it"""

    flutes: tuple[CorrectFlute, ...]
    """in the last turn"""
    difference: float
    """of the peaks of |Fy|: (largest - smallest)/largest"""
    own_difference: float
    """the same of each tooth alone"""
    area_difference: float
    """the same of the chip areas"""
    periodic: bool
    """whether the motion repeats"""
    change_N: float
    """largest change of the force from the turn before"""
    walls: tuple[CorrectWall, ...]
    """beside the cutter"""


class CorrectFlute(Values):
    """in the last turn"""

    tooth: int
    """number, from 1"""
    peak_Fx_N: float
    """of the whole force while its turn lasts"""
    peak_Fy_N: float
    """of the whole force while a tooth is nearest to the middle of the arc of cut"""
    own_peak_Fy_N: Optional[float]
    """of this tooth alone, or `null`"""
    chip_area_mm_rad: float
    """at the tip"""
    peak_chip_mm: float
    """at the tip"""


class CorrectWall(Values):
    """beside the cutter"""

    theta_deg: float
    """0: where the teeth enter, 180: where they leave"""
    peak_to_valley_um: float
    """depth of the feed marks, for a rigid tool (R-25)"""
    share: tuple[float, ...]
    """fraction of it that each tooth leaves"""


class CorrectCommand(Values):
    """the feedforward command"""

    spindle_rpm: float
    """that it is made for"""
    peak_to_peak_um: float
    """of the command"""
    offset_um: float
    """of its middle"""
    motion_peak_to_peak_um: float
    """of what the table should do"""
    table_deviation_um: float
    """from that at most, while it is cut upon"""
    lead_s: float
    """by which it is early"""
    harmonics: Optional[int]
    """that it has, or `null`"""
    transition_deg: Optional[float]
    """given or chosen, or `null`"""
    optimum: Optional[CorrectOptimum]
    """three teeth and more: whether there is anything better; else `null`"""
    within_limits: bool
    """of all"""
    limits: tuple[CorrectLimit, ...]
    """of the actuator"""
    stroke_margin_um: float
    """of the stroke (not in every answer)"""
    slew_um_per_s: float
    """largest speed of the command (not in every answer)"""
    learning: CorrectLearning
    """with `strategy = "learning"` (not in every answer)"""


class CorrectOptimum(Values):
    """three teeth and more: whether there is anything better; else `null`"""

    kind: str
    """`equal`, `limit_of_one_axis` or `local_minimum`"""
    proven: bool
    """whether nothing better exists"""
    starts: int
    """of the search"""
    agreeing: int
    """how many of them ended alike"""


class CorrectLimit(Values):
    """of the actuator"""

    what: str
    """with its unit"""
    value: float
    """of the command"""
    limit: Optional[float]
    """`null` where it is not known"""
    margin: Optional[float]
    """up to it, or `null`"""
    ok: Optional[bool]
    """whether it is kept, or `null`"""
    reason: str
    """in words"""


class CorrectLearning(Values):
    """with `strategy = "learning"`"""

    iterations: int
    """of iterative learning control"""
    converged: bool
    """whether it did"""
    error_um: tuple[float, ...]
    """before each iteration"""


class CorrectAxes(Values):
    """root mean square of the chip differences over the cut"""

    uncorrected_um: float
    """as it is"""
    one_axis_um: float
    """with one axis at best (R-7)"""
    two_axes_um: float
    """with two (R-8)"""
    one_axis_bound_um: float
    """no motion of these harmonics leaves less (R-30)"""
    two_axes_bound_um: float
    """nor with two axes"""
    most_teeth_in_cut: int
    """at once"""


class CorrectSpindleSpeed(Values):
    """with `[spindle]`: a speed that changes within the turn in place of the table"""

    difference: float
    """of the peaks that a sine of the speed leaves, on a rigid cut"""
    part: float
    """of the sine that the drive gives"""
    limit: Optional[str]
    """why not all of it, or `null`"""
    speed_change: float
    """largest, as a fraction"""
    torque_Nm: float
    """that it takes"""
    torque_wanted_Nm: Optional[float]
    """for all of the sine, or `null`"""
    torque_limit_Nm: float
    """of `[spindle]`"""


class CorrectController(Values):
    """with `--simulate-controller`"""

    difference_before: float
    """of the peaks before it runs"""
    difference_running: Optional[float]
    """while it runs, or `null`"""
    turns_to_3_percent: Optional[int]
    """turns of running until below, or `null`"""
    gain: Optional[float]
    """while it runs, or `null`"""
    lowest_um: float
    """of the command"""
    highest_um: float
    """of the command"""
    fault: Optional[str]
    """or `null`"""
    held_by: Optional[str]
    """where it never runs, what was wrong most often while it waited, or `null`"""
    fault_time_s: Optional[float]
    """of it, or `null`"""
    time_to_safe_s: Optional[float]
    """from there to rest at mid-stroke, or `null`"""
    turns: tuple[CorrectTurn, ...]
    """every turn"""


class CorrectTurn(Values):
    """every turn"""

    turn: int
    """number, from 1"""
    peaks_Fy_N: tuple[float, ...]
    """of the flutes"""
    difference: float
    """of them"""
    gain: float
    """of the command"""
    wave_um: float
    """the largest wave learnt"""
    tool: str
    """what was recognised of it"""
    state: str
    """of the controller"""


class PlanAnswer(Answer):
    """Of ``plan``. Tables:

    ``plan``: engagement, feed_per_tooth_mm, axial_depth_mm, radial_depth_mm, peak_force_N,
      narrows, half_width_*
    """

    cuts: tuple[PlanCut, ...]
    """the best hundred, best first"""
    before: Named[Optional[Estimate]]
    """each quantity as known so far; `null` where it is not"""
    looked_at: int
    """how many cuts"""
    left_out: tuple[PlanLeftOut, ...]
    """those that were not compared"""
    noise_N: Optional[float]
    """of a sample; `null` of means"""
    channels: tuple[str, ...]
    """of which a mean is to be measured; empty: a record of the forces"""
    mean_sd: tuple[float, ...]
    """of the mean of each, in N, Nm or W"""
    noise_from: str
    """whether it is of the `records` (widening of I-13 included), `given`, or `assumed`"""
    turns: int
    """of each cut"""
    samples_per_rev: int
    """of each cut"""
    files: tuple[str, ...]
    """what was measured so far"""
    group: Optional[str]
    """whose coefficients these are, where the records have groups: the last one; else `null`"""

    __slots__ = ()

    if TYPE_CHECKING:

        def to_dict(self) -> dicts.Plan: ...  # type: ignore[override]


class PlanCut(Values):
    """the best hundred, best first"""

    engagement: str
    """`slot`, `up` or `down`"""
    feed_per_tooth_mm: float
    """of the cut"""
    axial_depth_mm: float
    """of the cut"""
    radial_depth_mm: float
    """of a slot the diameter"""
    turns: int
    """to be measured"""
    peak_force_N: float
    """in the plane of the table"""
    narrows: Optional[float]
    """I-21: geometric mean of the factors by which the standard errors of the quantities, taken
    together, become smaller; `null` where they are not all known so far"""
    predicted: Named[Optional[Estimate]]
    """of each quantity once the cut has been measured, together with what is known: the value
    is the present one. `radial_offset_2_mm` is the offset of tooth 2"""


class PlanLeftOut(Values):
    """those that were not compared"""

    reason: str
    """in words"""
    count: int
    """of cuts"""


class ProgramAnswer(Answer):
    """Of ``program``. Tables:

    ``moves``: move, line, block, kind, note, x_mm, y_mm, z_mm, center_x_mm, center_y_mm,
      turn_deg, time_s, feed_mm_per_min, spindle_rpm, tool
    ``lines``: line, text, tool, time_s, time_in_cut_s, steps, peak_xy_N, peak_tooth_N,
      torque_peak_Nm, power_W, deflection_um, removed_mm3, cause, at_x_mm, at_y_mm, at_z_mm,
      broken
    ``steps``: step, line, block, tool, time_s, x_mm, y_mm, z_mm, feed_direction_deg,
      feed_mm_per_min, programmed_feed_mm_per_min, f_z_mm, a_e_mm, a_p_mm, arcs, entry_deg,
      exit_deg, engaged_deg, removed_mm3_per_s, Fx_mean_N, Fy_mean_N, Fz_mean_N, Fx_peak_N,
      Fy_peak_N, Fz_peak_N, peak_xy_N, peak_tooth_*_N, torque_mean_Nm, torque_peak_Nm, power_W,
      moment_peak_Nm, deflection_um, peak_chip_mm, bottom_Fz_N, bottom_torque_Nm, cause, flag,
      limit_depth_mm, chatter_margin, wall_left_least_um, wall_left_most_um,
      wall_right_least_um, wall_right_most_um
    ``arcs``: step, from_mm, to_mm, from_deg, to_deg
    ``measured_steps``: step, line, time_s, record_time_s, Fx_mean_N, Fy_mean_N, Fz_mean_N,
      peak_xy_N, computed_Fx_mean_N, computed_Fy_mean_N, computed_Fz_mean_N, computed_peak_xy_N,
      power_W, computed_power_W, torque_Nm, computed_torque_Nm
    ``feeds``: line, from_mm, to_mm, steps, programmed_feed_mm_per_min, feed_mm_per_min,
      held_by, reachable, rubs
    ``places``: place, line, fraction, tool, time_s, x_mm, y_mm, z_mm, feed_direction_deg,
      feed_mm_per_min, programmed_feed_mm_per_min, f_z_mm, a_e_mm, a_p_mm, arcs, entry_deg,
      exit_deg, engaged_deg, removed_mm3_per_s, Fx_mean_N, Fy_mean_N, Fz_mean_N, Fx_peak_N,
      Fy_peak_N, Fz_peak_N, peak_xy_N, peak_tooth_*_N, torque_mean_Nm, torque_peak_Nm, power_W,
      moment_peak_Nm, deflection_um, peak_chip_mm, bottom_Fz_N, bottom_torque_Nm, cause, flag
    ``place_arcs``: place, from_mm, to_mm, from_deg, to_deg
    """

    dialect: str
    """`iso`, `linuxcnc` or `sinumerik`, as given or as found"""
    moves: int
    """number of moves"""
    tools: tuple[str, ...]
    """numbers or names, in the order of their first use"""
    time_s: float
    """of all moves"""
    time_in_cut_s: float
    """of the steps that cut (not in every answer)"""
    steps: int
    """turns of the spindle that were computed (not in every answer)"""
    distinct_turns: int
    """different ones among them (not in every answer)"""
    removed_mm3: float
    """sum over the steps (not in every answer)"""
    stock_before_mm3: float
    """volume of [stock] (not in every answer)"""
    stock_after_mm3: float
    """what all moves leave of it (not in every answer)"""
    peaks: ProgramPeaks
    """largest values over the program, and where (not in every answer)"""
    limits_broken: tuple[ProgramLimitsBroken, ...]
    """limits that lines go beyond (not in every answer)"""
    feed: ProgramFeed
    """the feeds of [feed] (not in every answer)"""
    chatter: ProgramChatter
    """whether the cuts chatter (not in every answer)"""
    walls: ProgramWalls
    """errors of the walls that stay, of flat tools with a [cutter_body] (not in every
    answer)"""
    record: ProgramRecord
    """the record of [[measurement]], laid over the program (not in every answer)"""

    __slots__ = ()

    if TYPE_CHECKING:

        def to_dict(self) -> dicts.Program: ...  # type: ignore[override]


class ProgramPeaks(Values):
    """largest values over the program, and where"""

    peak_xy_N: ProgramPeak
    """largest force across the axis"""
    peak_tooth_N: ProgramPeak
    """the same of one tooth"""
    torque_peak_Nm: ProgramPeak
    """largest torque"""
    power_W: ProgramPeak
    """largest mean power of a turn"""
    moment_peak_Nm: ProgramPeak
    """largest bending moment"""
    deflection_um: ProgramPeak
    """largest deflection of the tip"""
    peak_chip_mm: ProgramPeak
    """largest uncut chip thickness"""


class ProgramPeak(Values):
    """largest mean power of a turn"""

    value: float
    """in the unit of the key above"""
    line: int
    """of the text"""
    x_mm: float
    """tip there"""
    y_mm: float
    """the same"""
    z_mm: float
    """the same"""
    cause: str
    """as in steps.csv"""
    low: float
    """of the 95 % interval that `[program] covariance` gives (not in every answer)"""
    high: float
    """the same (not in every answer)"""


class ProgramLimitsBroken(Values):
    """limits that lines go beyond"""

    limit: str
    """its key under [limits], or `power_curve_W` of [machine]"""
    allowed: float
    """in the unit of that key"""
    worst: float
    """the same"""
    lines: tuple[int, ...]
    """that go beyond it"""


class ProgramFeed(Values):
    """the feeds of [feed]"""

    file: str
    """the program with the new feeds, in this folder; empty: none is written"""
    before: ProgramTotals
    """the program as it is"""
    after: ProgramTotals
    """the program with the new feeds, read and run again"""
    even_peak_N: float
    """force that `even` makes the others like (not in every answer)"""
    not_reachable: tuple[int, ...]
    """lines where even the lowest feed breaks a limit"""
    rubbing: tuple[int, ...]
    """lines whose largest chip stays below the lower number of `chip_mm`"""


class ProgramTotals(Values):
    """the program with the new feeds, read and run again"""

    time_s: float
    """of all moves"""
    time_in_cut_s: float
    """of the steps that cut"""
    peak_xy_N: float
    """largest force across the axis"""
    peak_tooth_N: float
    """the same of one tooth"""


class ProgramChatter(Values):
    """whether the cuts chatter"""

    cuts: int
    """different ones along the program"""
    looked_at: float
    """part of the time in cut for which the limit is known"""
    lines: tuple[ProgramChatterLine, ...]
    """that chatter"""


class ProgramChatterLine(Values):
    """that chatter"""

    line: int
    """of the text"""
    margin: float
    """the least of its steps: limit depth over axial depth"""
    limit_depth_mm: float
    """of that step"""
    frequency_Hz: float
    """of the chatter"""
    spindle_rpm: float
    """of that step"""
    better_spindle_rpm: float
    """the nearest within 30 % at which that step is stable, with the same feed of a tooth (not
    in every answer)"""


class ProgramWalls(Values):
    """errors of the walls that stay, of flat tools with a [cutter_body]"""

    most: ProgramWallError
    """most material left on a wall that stays (not in every answer)"""
    least: ProgramWallError
    """least, or cut deepest into such a wall (not in every answer)"""
    lines: tuple[ProgramWallLine, ...]
    """that leave a wall that stays"""


class ProgramWallError(Values):
    """most material left on a wall that stays"""

    error_um: float
    """positive: material left"""
    line: int
    """of the text"""
    side: str
    """`left` or `right` of the feed"""
    x_mm: float
    """tip there"""
    y_mm: float
    """the same"""
    z_mm: float
    """the same"""


class ProgramWallLine(Values):
    """that leave a wall that stays"""

    line: int
    """of the text"""
    side: str
    """`left` or `right` of the feed"""
    least_um: float
    """error, over its height and along the line: positive: material left"""
    most_um: float
    """the same"""
    mean_um: float
    """the same"""


class ProgramRecord(Values):
    """the record of [[measurement]], laid over the program"""

    file: str
    """the record"""
    numbers: Optional[str]
    """what `line_column` counts, `line` of the text or `block` (N): the record has the times of
    the program then, and `start_s` and `stretch` are what is left; else `null`"""
    start_s: float
    """of the program, in the time of the record"""
    stretch: float
    """seconds of the record for a second of the program; where feeds were turned, for a second
    of its feed moves"""
    scatter_s: float
    """of parts of the program about that, rms"""
    correlation: float
    """of measured and computed mean forces; 1: alike but for a factor"""
    whole_correlation: float
    """the same of the whole record in short times: before and after the program it should read
    air"""
    covered: float
    """part of the feed moves that the record has"""
    reads: str
    """`forces`, `power` or `torque`"""
    steps: int
    """in cut that the record has"""
    mean_ratio: float
    """measured over computed mean, median of these steps"""
    peak_ratio: float
    """the same of the largest force across the axis (not in every answer)"""
    fitted_steps: int
    """steady ones, from which the coefficients are found; 0: too few"""
    rms_N: float
    """of the mean forces that the coefficients found leave (not in every answer)"""
    rms_W: float
    """the same of a record of power (not in every answer)"""
    rms_Nm: float
    """the same of a record of torque (not in every answer)"""
    coefficients: tuple[ProgramCoefficient, ...]
    """from the means of the steps"""
    cuts: tuple[ProgramCut, ...]
    """steady cuts whose forces tell the runout; none: too few samples (not in every answer)"""
    fit: Fit
    """of the forces in these cuts, as an entry of `fits` of `identify` (not in every answer)"""


class ProgramCoefficient(Values):
    """from the means of the steps"""

    key: str
    """of [force]"""
    stated: float
    """by the case, in the unit of the key"""
    found: float
    """the same, from the record; left out: the record does not tell it (not in every answer)"""
    se: float
    """one standard error (not in every answer)"""
    low: float
    """of the 95 % confidence interval (not in every answer)"""
    high: float
    """the same (not in every answer)"""


class ProgramCut(Values):
    """steady cuts whose forces tell the runout; none: too few samples"""

    line: int
    """of the text"""
    turns: float
    """of the spindle"""
    spindle_rpm: float
    """as found in the record"""
    feed_per_tooth_mm: float
    """that the machine made"""


class PlanOfFinishAnswer(Answer):
    """Of ``plan of a finish``. Tables:

    ``plan``: feed_per_tooth_mm, Ra_um, Ra_within_um, Ra_alike_um
    """

    of: str
    """`finish`: what is planned"""
    largest_Ra_um: Optional[float]
    """the limit, or `null`"""
    inserts_within_um: float
    """tolerance of the sets of inserts"""
    lines: tuple[PlanOfFinishLine, ...]
    """on which Ra counts"""
    cutoff_mm: Optional[float]
    """of the roughness filter, or `null`: none"""
    largest_feed: PlanOfFinishLargestFeed
    """per tooth, up to which Ra keeps the limit; `null` where none does"""
    feeds: tuple[PlanOfFinishFeed, ...]
    """Ra at each feed"""

    __slots__ = ()

    if TYPE_CHECKING:

        def to_dict(self) -> dicts.PlanOfFinish: ...  # type: ignore[override]


class PlanOfFinishLine(Values):
    """on which Ra counts"""

    floor_y_mm: float
    """of a line on the floor (not in every answer)"""
    height_mm: float
    """of a line on the wall (not in every answer)"""


class PlanOfFinishLargestFeed(Values):
    """per tooth, up to which Ra keeps the limit; `null` where none does"""

    as_is_mm: Optional[float]
    """of the teeth as they are"""
    within_mm: Optional[float]
    """of 95 of 100 sets of inserts within the tolerance"""
    alike_mm: Optional[float]
    """of teeth at one depth"""


class PlanOfFinishFeed(Values):
    """Ra at each feed"""

    feed_per_tooth_mm: float
    """of the cut"""
    Ra_um: Optional[float]
    """of the teeth as they are, on the roughest of the lines"""
    Ra_within_um: Optional[float]
    """that 95 of 100 sets of inserts within the tolerance keep, in a spindle that runs true;
    `null` where single teeth would leave material between their marks"""
    Ra_alike_um: Optional[float]
    """of teeth at one depth; `null` likewise"""


class PlanOfWallAnswer(Answer):
    """Of ``plan of a wall``. Tables:

    ``plan``: heights, readings_per_height, spread, readings, enough, half_width_*
    ``error_map``: feed_per_tooth_mm, radial_depth_mm, peak_error_um, mean_error_um,
      removal_rate_mm3_per_min
    """

    of: str
    """`wall`: what is planned"""
    chosen: Optional[PlanOfWallDesign]
    """the design with the fewest readings that is enough; where none is, the one that comes
    nearest"""
    so_far: Optional[PlanOfWallPredicted]
    """the same of the `[[surface_measurement]]` of the case; else `null`"""
    readings_so_far: int
    """how many"""
    files: tuple[str, ...]
    """that they are of"""
    designs: tuple[PlanOfWallDesign, ...]
    """every way to measure"""
    ten_more_readings: tuple[PlanOfWallTenMoreReading, ...]
    """with ten more readings at each height, the best first"""
    changes: tuple[PlanOfWallChange, ...]
    """the chosen readings where the cut or the wall is another"""
    cutting: PlanOfWallCutting
    """which cut and which wall keep an error"""
    form: str
    """that was assumed"""
    noise_um: float
    """of a reading"""
    noise_from: str
    """of the `readings`, `given` or `assumed`"""
    wanted_percent: float
    """of the coefficients"""
    wanted_um: float
    """of the eccentricity"""
    runout: Optional[str]
    """why no readings show the runout; else `null`"""

    __slots__ = ()

    if TYPE_CHECKING:

        def to_dict(self) -> dicts.PlanOfWall: ...  # type: ignore[override]


class PlanOfWallDesign(Values):
    """the design with the fewest readings that is enough; where none is, the one that comes
    nearest"""

    heights: int
    """how many"""
    readings_per_height: int
    """how many"""
    spread: float
    """of the heights over the axial depth"""
    readings: int
    """in all"""
    heights_mm: tuple[float, ...]
    """above the tip"""
    enough: bool
    """every interval that is wanted is kept"""
    predicted: Optional[PlanOfWallPredicted]
    """about what is expected; `null` where they cannot be determined separately"""


class PlanOfWallPredicted(Values):
    """the same of the `[[surface_measurement]]` of the case; else `null`"""

    angle_se_deg: Optional[float]
    """of the eccentricity, or `null`"""
    correlation: float
    """of the coefficients"""
    condition: float
    """of the equations"""
    K_rc_MPa: Estimate
    """of both coefficients and `eccentricity_mm` (E-60) (not in every answer)"""
    K_tc_MPa: Estimate
    """of both coefficients and `eccentricity_mm` (E-60) (not in every answer)"""
    eccentricity_mm: Estimate
    """of both coefficients and `eccentricity_mm` (E-60) (not in every answer)"""


class PlanOfWallTenMoreReading(Values):
    """with ten more readings at each height, the best first"""

    height_mm: float
    """above the tip"""
    predicted: Optional[PlanOfWallPredicted]
    """about what is expected; `null` where they cannot be determined separately"""


class PlanOfWallChange(Values):
    """the chosen readings where the cut or the wall is another"""

    key: str
    """one of `axial_depth_mm, radial_depth_mm, thickness_mm, position_mm` is another"""
    value_mm: float
    """of it"""
    predicted: Optional[PlanOfWallPredicted]
    """about what is expected; `null` where they cannot be determined separately"""


class PlanOfWallCutting(Values):
    """which cut and which wall keep an error"""

    limited: str
    """`peak` or `mean`"""
    largest_error_um: Optional[float]
    """the limit, or `null`"""
    stated: PlanOfWallCut
    """the cut as it stands"""
    best: Optional[PlanOfWallCut]
    """the largest removal rate within the limit, or `null`"""
    thickness_mm: Optional[float]
    """of the wall, or `null`"""
    thinnest_wall: Optional[PlanOfWallThinnestWall]
    """that keeps the limit, or `null`"""
    feed_limits: tuple[PlanOfWallFeedLimit, ...]
    """of each radial depth"""


class PlanOfWallCut(Values):
    """the largest removal rate within the limit, or `null`"""

    feed_per_tooth_mm: float
    """of the cut"""
    radial_depth_mm: float
    """of the cut"""
    peak_error_um: Optional[float]
    """the largest distance from the wall as wanted, either way"""
    mean_error_um: Optional[float]
    """positive: material left"""
    removal_rate_mm3_per_min: float
    """of the cut"""


class PlanOfWallThinnestWall(Values):
    """that keeps the limit, or `null`"""

    thickness_mm: Optional[float]
    """`null` where the cutter alone leaves too much"""
    error_um: Optional[float]
    """that it leaves"""
    thinner_too: bool
    """thinner ones were not looked at"""


class PlanOfWallFeedLimit(Values):
    """of each radial depth"""

    radial_depth_mm: float
    """each"""
    feed_per_tooth_mm: Optional[float]
    """the largest within the limit, or `null`"""


class SweepAnswer(Answer):
    """Of ``sweep``. Tables:

    ``sweep``: *, draw, status, message
    ``bands``: *, median_*, low_*, high_*, sd_*, failed_*
    """

    command: str
    """that answered each row"""
    method: str
    """`grid`, `list` or by chance, as in the case"""
    rows: int
    """how many there are"""
    failed: int
    """rows without an answer"""
    keys: tuple[str, ...]
    """that were swept"""
    draws: int
    """of each point; 0: none"""
    drawn: tuple[str, ...]
    """keys that were drawn"""
    quantities: tuple[SweepQuantity, ...]
    """what was taken from each row. Of draws over a grid the intervals are in bands.csv"""

    __slots__ = ()

    if TYPE_CHECKING:

        def to_dict(self) -> dicts.Sweep: ...  # type: ignore[override]


class SweepQuantity(Values):
    """what was taken from each row. Of draws over a grid the intervals are in bands.csv"""

    take: str
    """path of the quantity in the summary of a row"""
    answers: int
    """how many rows have a number of it"""
    min: float
    """the smallest of these numbers (not in every answer)"""
    median: float
    """half of these numbers are below it (not in every answer)"""
    max: float
    """the largest of these numbers (not in every answer)"""
    mean: float
    """of rows drawn by chance, or of draws of a single case (not in every answer)"""
    sd: float
    """standard deviation, likewise (not in every answer)"""
    low: float
    """lower end of the range in which 95 % of the rows lie, likewise (not in every answer)"""
    high: float
    """upper end of this range (not in every answer)"""
    low_between: Optional[tuple[float, ...]]
    """range in which `low` lies with 95 % (U-7); `null` of fewer than 146 rows (not in every
    answer)"""
    high_between: Optional[tuple[float, ...]]
    """the same of `high` (not in every answer)"""
    without_answer: float
    """fraction of rows without a number, likewise (not in every answer)"""


#: by command, as docs/formats/results.md calls it
BY_COMMAND: dict[str, type[Answer]] = {
    "simulate": SimulateAnswer,
    "stability": StabilityAnswer,
    "dynamics": DynamicsAnswer,
    "identify": IdentifyAnswer,
    "surface": SurfaceAnswer,
    "calibrate": CalibrateAnswer,
    "modes": ModesAnswer,
    "actuator": ActuatorAnswer,
    "correct": CorrectAnswer,
    "plan": PlanAnswer,
    "program": ProgramAnswer,
    "plan of a finish": PlanOfFinishAnswer,
    "plan of a wall": PlanOfWallAnswer,
    "sweep": SweepAnswer,
}
