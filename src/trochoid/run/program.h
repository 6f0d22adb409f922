#pragma once

#include <trochoid/cases/case.h>
#include <trochoid/engagement/chatter.h>
#include <trochoid/engagement/feed.h>
#include <trochoid/results/program.h>
#include <trochoid/run/progress.h>

#include <optional>
#include <span>
#include <vector>

/// The parts of what `program` answers beside its forces.
namespace trochoid::run {

/// Whether a move is fed.
bool is_fed(const program::Move& move) noexcept;

/// The tools of a program, or why there are no forces.
struct ProgramTools {
  std::vector<engagement::Tool> tools;            ///< shape (program.tools), or one
  std::vector<engagement::Vibration> vibrations;  ///< the same
  std::vector<std::size_t> own;                   ///< places of the tool of the case
  std::vector<base::Warning> why_not;
  std::vector<base::Warning> notes;  ///< of their measured responses
};
ProgramTools tools_of(const cases::Case& given, const program::Program& program);

/// @brief What is not known of the tools of a program, and what is left out.
void warn_of_tools(const cases::Case& given, const program::Program& program,
                   const ProgramTools& tools, std::vector<base::Warning>& warnings);

/// @brief Tools of the case that the program does not have.
void warn_of_other_tools(const cases::NcProgram& nc, const program::Program& program,
                         std::vector<base::Warning>& warnings);

/// @brief The limits of a case, the power of its spindle too.
engagement::Limits limits_of(const cases::ProgramTables& nc);

/// @brief The program of `[feed]` write has a name that no file of the answer has.
/// @throws base::InputError else
void check_name_of_program(const cases::Case& given);

/// @brief The feeds of `[feed]`, the program with them, and its forces and time.
/// @param forces  of the program as it is
/// @return nothing where the time was up
std::optional<results::NewFeeds> new_feeds(const engagement::Job& job,
                                           const cases::Case& given,
                                           const results::ProgramForces& forces,
                                           const Progress& progress);

/// @brief Intervals of the largest values of a program, from `[program] covariance`.
/// @param own  places of the tools of the job that are the tool of this case
/// @return nothing where the case names none
/// @throws base::InputError where it is of another tool, or cannot be read
std::optional<results::PeakErrors> peak_errors(const engagement::Job& job,
                                               const cases::Case& given,
                                               std::span<const std::size_t> own,
                                               const engagement::Totals& totals,
                                               std::vector<base::Warning>& warnings);

/// @brief Errors of the walls that stay when the program is done.
/// @param steps  rows, in their order
/// @return nothing where no tool has a body
std::optional<results::ProgramWalls> walls_of(const engagement::Job& job,
                                              std::span<const engagement::Step> steps,
                                              const Progress& progress);

/// @brief The record of [[measurement]] laid over a program, and the coefficients of the
/// tool of the case from it.
/// @param own    places of the tools of the job that are the tool of this case
/// @param steps  rows, in their order
/// @return nothing where there is none, or it is of something else
/// @throws base::InputError where it cannot be read, or has no times or too few channels
std::optional<results::ProgramRecord> record_of(const engagement::Job& job,
                                                const cases::Case& given,
                                                std::span<const std::size_t> own,
                                                std::span<const engagement::Step> steps,
                                                std::vector<base::Warning>& warnings);

/// @brief What vibrates with a tool, from its case: the modes, else those of the measured
/// responses.
/// @param[out] warnings  what a reader should know of the measurement
engagement::Vibration vibration_of(const cases::Case& given,
                                   std::vector<base::Warning>& warnings);

/// @brief Where the cuts of a program chatter.
/// @param steps        rows, in their order
/// @param vibrations   of the tools, shape (tools)
/// @return nothing where no case has a mode
std::optional<results::ProgramChatter> chatter_of(
    std::span<const engagement::Step> steps, std::span<const engagement::Tool> tools,
    std::span<const engagement::Vibration> vibrations, const Progress& progress,
    const base::Stop& stop);

/// What an engineer should know of it.
void warn_of_chatter(const results::ProgramChatter& chatter,
                     std::vector<base::Warning>& warnings);

}  // namespace trochoid::run
