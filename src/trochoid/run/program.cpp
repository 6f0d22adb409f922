#include <trochoid/run/commands.h>

#include <fmt/core.h>

#include <algorithm>

namespace trochoid::run {

namespace {

bool is_fed(const program::Move& move) noexcept {
  using enum program::MoveKind;
  return move.kind == line || move.kind == arc || move.kind == chord;
}

}  // namespace

results::ProgramResult program(const cases::Case& given) {
  const files::ProgramFile& file = given.nc.program->text.get();
  results::ProgramResult r{.heading = heading_of(given), .program = file.program};
  base::add(r.heading.warnings, file.notes);
  const auto fed = std::ranges::count_if(r.program.moves, is_fed);
  r.heading.ok = fed > 0;
  if (!r.heading.ok) {
    r.heading.message = "The program has no feed move: nothing is cut.";
    return r;
  }
  double time = 0.0;
  for (const program::Move& move : r.program.moves) time += move.time;
  r.heading.message = fmt::format("{} moves, {} of them fed, in {:.4g} s.",
                                  r.program.moves.size(), fed, time);
  return r;
}

}  // namespace trochoid::run
