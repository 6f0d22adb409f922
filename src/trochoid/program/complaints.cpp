#include <trochoid/program/complaints.h>

#include <algorithm>

namespace trochoid::program {

std::string_view advice_on(Fault fault) noexcept {
  switch (fault) {
    case Fault::compensation:
      return "let the CAM program compute the path of the center, or say "
             "compensation = \"wear_zero\" in [program] where the program already has "
             "that path";
    case Fault::subprogram:
      return "post the program as one text without subprograms";
    case Fault::variable:
      return "post the program with numbers only";
    case Fault::loop:
      return "post the program without jumps and loops";
    case Fault::cycle:
      return "post the cycle as single moves";
    case Fault::coordinates:
      return "post the program in one frame";
    case Fault::rotary:
      return "three axes are read; post the operation for a table that stands";
    case Fault::spindle_left:
      return "a cutter that cuts turning to the right is computed: M3";
    case Fault::comment:
      return "close it in its line";
    case Fault::dialect:
      return "post the program as G code (ISO)";
    case Fault::unused:
      return "nothing in this block takes it";
    case Fault::order:
    case Fault::feed:
    case Fault::arc:
    case Fault::plane:
    case Fault::unknown_position:
    case Fault::number:
    case Fault::group:
    case Fault::unknown:
      return "";
  }
  return "";
}

namespace {

/// Bytes of the character of UTF-8 that begins there; 1 where it is none.
std::size_t character_length(std::string_view line, std::size_t at) noexcept {
  const auto first = static_cast<unsigned char>(line[at]);
  const std::size_t length = first >= 0xF0   ? 4
                             : first >= 0xE0 ? 3
                             : first >= 0xC0 ? 2
                                             : 1;
  if (at + length > line.size()) return 1;
  const std::string_view rest = line.substr(at + 1, length - 1);
  const bool whole = std::ranges::all_of(
      rest, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; });
  return whole ? length : 1;
}

}  // namespace

std::uint32_t column_of(std::string_view line, std::size_t at) noexcept {
  std::uint32_t column = 1;
  for (std::size_t i = 0; i < at && i < line.size(); ++column) {
    i += character_length(line, i);
  }
  return column;
}

void remark(Complaints& all, std::string_view code, Place place, std::string text) {
  const bool told =
      std::ranges::any_of(all.remarks, [&](const Remark& r) { return r.code == code; });
  if (!told) all.remarks.push_back({code, place, std::move(text)});
}

}  // namespace trochoid::program
