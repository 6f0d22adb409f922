#pragma once

#include <trochoid/engagement/chatter.h>
#include <trochoid/engagement/feed.h>
#include <trochoid/engagement/record.h>
#include <trochoid/engagement/record_fit.h>
#include <trochoid/engagement/steps.h>
#include <trochoid/engagement/walls.h>
#include <trochoid/program/move.h>
#include <trochoid/results/answer.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trochoid::results {

/// A limit of the case that lines go beyond.
struct BrokenLimit {
  std::string_view limit;  ///< its key under [limits], or power_curve_W
  double allowed = 0.0;    ///< in the unit of the key
  double worst = 0.0;      ///< in the unit of the key
  std::vector<std::uint32_t> lines;
};

/// What a program comes to when it is run.
struct FeedTotals {
  double time = 0.0;         ///< [s]
  double time_in_cut = 0.0;  ///< [s]
  double peak_xy = 0.0;      ///< [N]
  double peak_tooth = 0.0;   ///< [N]
};

/// The feeds of `[feed]`, and the program with them.
struct NewFeeds {
  std::string file;  ///< name of the new program; empty: none is written
  std::string text;  ///< the new program
  FeedTotals before;
  FeedTotals after;                           ///< of the new program
  std::optional<double> even_peak;            ///< that `even` aims at [N]
  std::vector<engagement::WantedFeed> steps;  ///< of the program as it is
  std::vector<std::uint32_t> not_reachable;  ///< lines that no feed keeps within limits
  bool keeps_limits = false;  ///< the new program does, but for the lines below
  std::vector<std::uint32_t> rubbing;  ///< lines with chips below the least one
};

/// A line in which a cut chatters.
struct ChatteringLine {
  std::uint32_t line = 0;
  double margin = 0.0;       ///< the least: limit depth over axial depth
  double limit_depth = 0.0;  ///< there [m]
  double frequency = 0.0;    ///< of the chatter [Hz]
  double spindle = 0.0;      ///< [rad/s]
  std::optional<double>
      better_spindle;  ///< nearest at which that cut is stable [rad/s]
};

/// Chatter along a program.
struct ProgramChatter {
  std::vector<engagement::SharedCut> cuts;
  std::vector<engagement::ChatterLimit> limits;  ///< shape (cuts)
  std::vector<std::int32_t> cut_of;              ///< of each row of steps; -1: none
  double looked_at = 0.0;                        ///< part of the time in cut
  std::vector<ChatteringLine> lines;             ///< ascending
};

/// A coefficient as a record of the program tells it.
struct RecordCoefficient {
  std::string_view key;      ///< of [force]
  double unit = 1.0;         ///< of the key
  double stated = 0.0;       ///< by the case [SI]
  double found = 0.0;        ///< [SI]; as stated where it is not told
  std::optional<double> se;  ///< [SI]; nothing: the record does not tell it
};

/// A record made while the program ran, and what it says.
struct ProgramRecord {
  std::string file;
  std::optional<engagement::LineNumbers> numbers;  ///< that the record has
  engagement::Alignment alignment;
  engagement::RecordedSteps recorded;
  engagement::Reads reads = engagement::Reads::forces;
  std::size_t covered = 0;  ///< rows in cut that the record has
  double mean_ratio = 0.0;  ///< of the measured to the computed mean
  double peak_ratio = 0.0;  ///< the same of the largest force of a turn
  double factor = 2.0;      ///< of the 95 % intervals
  std::size_t fitted_steps = 0;
  double rms = 0.0;  ///< that the fit leaves [N], of power [W], of torque [N m]
  std::vector<RecordCoefficient> coefficients;  ///< empty: too few steady steps
  std::vector<engagement::SteadyCut> cuts;      ///< whose forces are fitted
  std::optional<identification::Fit> fit;       ///< of these; nothing: there are none
  force::EdgeLength edge_length = force::EdgeLength::true_length;
};

/// A wall that a line leaves.
struct LineWall {
  std::uint32_t line = 0;
  bool left = false;  ///< of the feed; else right
  engagement::WallError error;
};

/// The largest error of a wall, and where.
struct WallExtreme {
  double error = 0.0;  ///< positive: material left [m]
  std::uint32_t line = 0;
  bool left = false;
  std::array<double, 3> place{};  ///< of the tip [m]
};

/// Errors of the walls that stay.
struct ProgramWalls {
  std::vector<engagement::StepWalls> of_steps;  ///< of each row of steps
  std::vector<LineWall> lines;                  ///< ascending, the left one first
  std::optional<WallExtreme> most;              ///< material left
  std::optional<WallExtreme> least;             ///< cut too deep
};

/// Half of the 95 % interval of each largest value; nothing where it is of a tool of which
/// nothing is known.
struct PeakErrors {
  std::optional<double> peak_xy;     ///< [N]
  std::optional<double> peak_tooth;  ///< [N]
  std::optional<double> torque;      ///< [N m]
  std::optional<double> power;       ///< [W]
  std::optional<double> moment;      ///< [N m]
  std::optional<double> deflection;  ///< [m]
  std::optional<double> chip;        ///< [m]
};

/// Forces along a program.
struct ProgramForces {
  std::size_t teeth = 0;                     ///< of the tool that has most
  std::vector<engagement::Step> steps;       ///< rows, in their order
  std::size_t rows = 0;                      ///< that there are; not all may be kept
  std::vector<engagement::Step> places;      ///< as asked for
  std::vector<std::array<double, 2>> asked;  ///< line and fraction of each place
  engagement::Summary summary;
  std::optional<PeakErrors> errors;  ///< nothing: the case names no covariance
  std::vector<BrokenLimit> broken;
  std::vector<std::string> texts;         ///< of the lines of the summary
  std::optional<NewFeeds> feed;           ///< nothing: the case has no [feed]
  std::optional<ProgramChatter> chatter;  ///< nothing: the case has no [[mode]]
  std::optional<ProgramRecord> record;    ///< nothing: the case has no [[measurement]]
  std::optional<ProgramWalls> walls;      ///< nothing: no tool has a [cutter_body]
};

/// @brief What `program` answers: the moves of a whole NC program, and its forces.
struct ProgramResult {
  Heading heading;
  program::Program program;
  bool all_moves = false;  ///< in moves.csv, even where they are more than a million
  std::optional<ProgramForces> forces;  ///< nothing: not computed for these tools
};

Answer answer_of(const ProgramResult& result);

}  // namespace trochoid::results
