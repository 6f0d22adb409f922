#pragma once

#include <trochoid/engagement/causes.h>
#include <trochoid/engagement/contact.h>
#include <trochoid/engagement/steps.h>
#include <trochoid/engagement/turn.h>
#include <trochoid/stock/drives.h>
#include <trochoid/stock/swept.h>

#include <cstdint>
#include <span>
#include <vector>

namespace trochoid::engagement {

/// A step to be looked at.
struct Ask {
  std::uint32_t piece = 0;
  double u = 0.0;      ///< place of its middle on the piece
  double share = 0.0;  ///< of the piece that it is
  std::int64_t number = 0;
  std::uint32_t move = 0;
};

/// What was found of it.
struct Found {
  Step step;
  StepTraits traits;
  Turn turn;
};

/// Steps of a piece; 0: it is a rapid.
std::int64_t count_of(const stock::Piece& piece, double step_turns) noexcept;

/// The move of a piece at a distance from its start.
std::uint32_t move_at(const stock::Path& path, const stock::Piece& piece,
                      double s) noexcept;

/// @brief The k-th of the n steps of a piece.
Ask ask_of(const stock::Path& path, std::uint32_t piece, std::int64_t k,
           std::int64_t n);

/// Finds steps by their numbers, which ascend.
class StepFinder {
 public:
  StepFinder(const stock::Path& path, double step_turns) noexcept
      : path_(path), step_turns_(step_turns) {}

  /// @pre the step exists, and its number is not below the last one asked for
  Ask find(std::int64_t number);

 private:
  const stock::Path& path_;
  double step_turns_;
  std::uint32_t piece_ = 0;
  std::int64_t first_ = 0;  ///< step of the piece
  std::int64_t count_ = 0;  ///< steps of the piece
};

/// @brief The path of a program in its stock, for looks at any place of it.
class Look {
 public:
  /// @throws std::invalid_argument for a move with a tool that is not given
  explicit Look(const Job& job);

  [[nodiscard]] const stock::Swept& swept() const noexcept { return swept_; }
  [[nodiscard]] const stock::Path& path() const noexcept { return swept_.path(); }
  [[nodiscard]] std::span<const Kink> all_kinks() const noexcept { return kinks_; }
  /// Path of feed moves up to where a piece begins [m].
  [[nodiscard]] double along(std::uint32_t piece) const { return lengths_[piece]; }

  /// @brief Have the stock ready up to a moment: looks at later moments are then quick.
  void sweep_to(double turns) { swept_.sweep_to(turns); }
  /// When a step is in its middle, in turns of the spindle.
  [[nodiscard]] double turns_of(const Ask& ask) const noexcept {
    const stock::Piece& piece = path().pieces[ask.piece];
    return piece.turns_from + ask.u * (piece.turns_to - piece.turns_from);
  }

  /// A step without its forces.
  /// @param heights  above the tip [m]: arcs at these instead of layers; may be empty
  [[nodiscard]] Found at(const Ask& ask, std::span<const double> heights = {}) const;

  /// Place, direction and time where `along` of a step says.
  void put(Step& step, std::uint32_t piece) const;

 private:
  [[nodiscard]] Step bare_step(const Ask& ask) const;
  void describe(const Contact& contact, const Tool& tool, Found& out) const;

  const Job& job_;
  std::vector<stock::Speed> speeds_;  // before swept_, which is made with it
  stock::Swept swept_;
  std::vector<Kink> kinks_;
  std::vector<double> lengths_;
};

}  // namespace trochoid::engagement
