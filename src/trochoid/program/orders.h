#pragma once

#include <trochoid/program/codes.h>
#include <trochoid/program/words.h>

#include <array>
#include <string>
#include <vector>

namespace trochoid::program {

/// @brief What is asked of the reader beside the text.
struct Habits {
  Dialect dialect = Dialect::iso;
  bool wear_zero = false;                  ///< G41 and G42 change nothing
  std::vector<std::string> ignored_words;  ///< that may be unknown: M10
};

/// Whether lengths are written with a decimal point somewhere.
struct Points {
  bool any = false;
  Place first = {0, 0};  ///< of a length; line 0: there is none
};

/// @brief The words of a block, sorted by what they do.
struct Orders {
  std::array<const Code*, group_count> code{};
  std::array<std::uint32_t, group_count> at{};
  std::array<const Word*, 26> letter{};
  std::uint32_t taken = 0;       ///< letters, a bit each
  const Word* radius = nullptr;  ///< CR=
  const Word* turns = nullptr;   ///< TURN=
  bool arc_names_taken = false;  ///< both of them
  bool cancels = false;          ///< G80 beside G0 to G3
  bool tool_change = false;
  std::int32_t number = -1;

  [[nodiscard]] const Word* find(char c) const noexcept {
    return letter[static_cast<std::size_t>(c - 'A')];
  }
  /// The word of a letter, which now has its use.
  const Word* take(char c) noexcept {
    taken |= 1U << static_cast<unsigned>(c - 'A');
    return find(c);
  }
  void take_all(std::string_view letters) noexcept {
    for (const char c : letters) static_cast<void>(take(c));
  }
  [[nodiscard]] bool is_taken(char c) const noexcept {
    return (taken >> static_cast<unsigned>(c - 'A') & 1U) != 0;
  }
  [[nodiscard]] Action of(Group group) const noexcept {
    const Code* c = code[static_cast<std::size_t>(group)];
    return c == nullptr ? Action::nothing : c->action;
  }
  [[nodiscard]] bool has(Group group) const noexcept {
    return code[static_cast<std::size_t>(group)] != nullptr;
  }
  [[nodiscard]] std::uint32_t place_of(Group group) const noexcept {
    return at[static_cast<std::size_t>(group)];
  }
};

/// @brief Sort the words of a block. What is refused, not known or there twice is told.
Orders sort_words(Block& block, const Habits& habits, Complaints& complaints);

/// @brief Tell the letters that nothing took.
void tell_unused(Block& block, const Orders& orders, Complaints& complaints);

/// @brief Note how the lengths of a block are written.
void note_points(const Block& block, Points& points);

}  // namespace trochoid::program
