#include <trochoid/program/codes.h>

#include <algorithm>
#include <array>
#include <span>

namespace trochoid::program {

/// The lists of words: their actions are named without `Action::`.
namespace listed {

using enum Action;

constexpr Code refuse(int tenths, Fault fault, std::string_view what,
                      Group group = Group::other) {
  return {tenths, group, refused, {}, fault, what};
}

// Of every dialect.
constexpr std::array common = {
    Code{0, Group::motion, rapid},
    Code{10, Group::motion, line},
    Code{20, Group::motion, clockwise},
    Code{30, Group::motion, counter_clockwise},
    Code{40, Group::once, dwell},
    Code{90, Group::exact_stop, nothing},
    Code{170, Group::plane, plane_xy},
    Code{180, Group::plane, plane_zx},
    Code{190, Group::plane, plane_yz},
    Code{200, Group::unit, inch},
    Code{210, Group::unit, metric},
    refuse(330, Fault::cycle, "a thread", Group::motion),
    Code{400, Group::compensation, nothing},
    Code{410, Group::compensation, compensation},
    Code{420, Group::compensation, compensation},
    Code{530, Group::once, machine_place},
    Code{540, Group::offset, offset},
    Code{550, Group::offset, offset},
    Code{560, Group::offset, offset},
    Code{570, Group::offset, offset},
    Code{580, Group::offset, offset},
    Code{590, Group::offset, offset},
    Code{600, Group::path, nothing},
    Code{640, Group::path, nothing, "PQ"},
    Code{900, Group::distance, absolute},
    Code{910, Group::distance, incremental},
    Code{930, Group::feed_mode, inverse_time},
    Code{940, Group::feed_mode, per_minute},
    Code{950, Group::feed_mode, per_turn},
    refuse(960, Fault::feed,
           "constant surface speed: the speed of the spindle is not "
           "in the program; post with G97",
           Group::spindle_mode),
    Code{970, Group::spindle_mode, nothing},
};

// Of Fanuc, Haas, LinuxCNC and their like.
constexpr std::array of_iso = {
    Code{50, Group::smoothing, look_ahead, "P", Fault::order, "a spline"},
    Code{51, Group::smoothing, look_ahead, "QR", Fault::order, "a spline"},
    refuse(52, Fault::order, "a spline; post lines and arcs", Group::motion),
    refuse(53, Fault::order, "a spline; post lines and arcs", Group::motion),
    refuse(70, Fault::order, "diameters of a lathe"),
    Code{80, Group::smoothing, look_ahead, "P", Fault::order, "radii of a lathe"},
    refuse(100, Fault::coordinates, "data set by the program", Group::once),
    refuse(120, Fault::cycle, "a pocket that the control makes up", Group::once),
    refuse(130, Fault::cycle, "a pocket that the control makes up", Group::once),
    Code{131, Group::other, nothing},
    Code{150, Group::other, nothing},
    refuse(160, Fault::coordinates, "polar coordinates"),
    Code{230, Group::other, nothing},
    Code{280, Group::once, home},
    Code{300, Group::once, home, "P"},
    refuse(310, Fault::cycle, "a move to a signal", Group::motion),
    refuse(382, Fault::cycle, "probing", Group::motion),
    refuse(383, Fault::cycle, "probing", Group::motion),
    refuse(384, Fault::cycle, "probing", Group::motion),
    refuse(385, Fault::cycle, "probing", Group::motion),
    Code{401, Group::other, nothing},
    refuse(411, Fault::compensation, "compensation of the radius", Group::compensation),
    refuse(421, Fault::compensation, "compensation of the radius", Group::compensation),
    Code{430, Group::length, nothing, "H"},
    refuse(431, Fault::coordinates, "a length that the program sets", Group::length),
    refuse(432, Fault::coordinates, "a length that the program adds", Group::length),
    refuse(434, Fault::rotary, "tool center control", Group::length),
    refuse(435, Fault::rotary, "tool center control", Group::length),
    Code{440, Group::length, nothing, "H"},
    Code{490, Group::length, nothing},
    Code{500, Group::scaling, nothing},
    Code{501, Group::scaling, nothing, "XYZ"},
    refuse(510, Fault::coordinates, "scaling", Group::scaling),
    refuse(511, Fault::coordinates, "a mirror image", Group::scaling),
    refuse(520, Fault::coordinates, "a shift of the frame", Group::once),
    Code{541, Group::offset, numbered_offset},
    Code{591, Group::offset, offset},
    Code{592, Group::offset, offset},
    Code{593, Group::offset, offset},
    Code{610, Group::path, nothing},
    Code{611, Group::path, nothing},
    refuse(650, Fault::subprogram, "a macro", Group::once),
    refuse(660, Fault::subprogram, "a macro", Group::once),
    Code{670, Group::other, nothing},
    Code{700, Group::unit, inch},
    Code{710, Group::unit, metric},
    refuse(680, Fault::coordinates, "a turned frame", Group::rotation),
    refuse(682, Fault::coordinates, "a tilted plane", Group::rotation),
    Code{690, Group::rotation, nothing},
    Code{730, Group::motion, chip_break},
    refuse(740, Fault::cycle, "a cycle for threads", Group::motion),
    refuse(760, Fault::cycle, "fine boring, or a thread", Group::motion),
    Code{800, Group::motion, cancel_motion},
    Code{810, Group::motion, drill},
    Code{820, Group::motion, drill_dwell},
    Code{830, Group::motion, peck},
    refuse(840, Fault::cycle, "tapping", Group::motion),
    refuse(850, Fault::cycle, "boring", Group::motion),
    refuse(860, Fault::cycle, "boring", Group::motion),
    refuse(870, Fault::cycle, "back boring", Group::motion),
    refuse(880, Fault::cycle, "boring", Group::motion),
    refuse(890, Fault::cycle, "boring", Group::motion),
    Code{901, Group::center, center_absolute},
    Code{911, Group::center, center_incremental},
    refuse(920, Fault::coordinates, "a frame set by the program", Group::once),
    Code{921, Group::other, nothing},
    Code{922, Group::other, nothing},
    refuse(923, Fault::coordinates, "a frame set by the program", Group::once),
    Code{980, Group::retract, initial_level},
    Code{990, Group::retract, r_level},
    Code{1030, Group::smoothing, nothing, "P"},
    Code{1540, Group::offset, numbered_offset},
    Code{1870, Group::smoothing, nothing, "PE"},
};

constexpr std::array of_sinumerik = {
    refuse(630, Fault::cycle, "tapping", Group::motion),
    Code{700, Group::unit, inch_lengths},
    Code{710, Group::unit, metric_lengths},
    refuse(740, Fault::cycle, "a reference run", Group::once),
    Code{750, Group::once, fixed_point},
    refuse(1100, Fault::coordinates, "a pole", Group::once),
    refuse(1110, Fault::coordinates, "a pole", Group::once),
    refuse(1120, Fault::coordinates, "a pole", Group::once),
    Code{1530, Group::once, machine_place},
    refuse(3310, Fault::cycle, "tapping", Group::motion),
    refuse(3320, Fault::cycle, "tapping", Group::motion),
    Code{4500, Group::other, nothing},
    Code{4510, Group::other, nothing},
    Code{5000, Group::offset, no_offset},
    Code{6010, Group::exact_stop, nothing},
    Code{6020, Group::exact_stop, nothing},
    Code{6030, Group::exact_stop, nothing},
    Code{6410, Group::path, nothing},
    Code{6420, Group::path, nothing},
    Code{6430, Group::path, nothing},
    Code{6440, Group::path, nothing},
    Code{6450, Group::path, nothing},
    Code{7000, Group::unit, inch},
    Code{7100, Group::unit, metric},
};

constexpr Code further_offset{5050, Group::offset, offset};

constexpr std::array m_words = {
    Code{0, Group::stop, nothing},
    Code{10, Group::stop, nothing},
    Code{20, Group::stop, end},
    Code{30, Group::spindle, spindle_right},
    refuse(40, Fault::spindle_left, "the spindle turns to the left", Group::spindle),
    Code{50, Group::spindle, spindle_stop},
    Code{60, Group::other, tool_change},
    Code{70, Group::other, nothing},
    Code{80, Group::other, nothing},
    Code{90, Group::other, nothing},
    refuse(170, Fault::subprogram, "the end of a subprogram", Group::stop),
    Code{190, Group::other, nothing, "RPQ"},
    Code{300, Group::stop, end},
    Code{480, Group::other, nothing},
    Code{490, Group::other, nothing},
    Code{600, Group::stop, nothing},
    Code{880, Group::other, nothing},
    Code{890, Group::other, nothing},
    refuse(970, Fault::subprogram, "a subprogram", Group::stop),
    refuse(980, Fault::subprogram, "a subprogram", Group::stop),
    refuse(990, Fault::subprogram, "the end of a subprogram", Group::stop),
};

constexpr std::array m_words_of_linuxcnc = {
    Code{500, Group::other, nothing, "P"},
    Code{510, Group::other, nothing, "P"},
    Code{520, Group::other, nothing, "P"},
    Code{530, Group::other, nothing, "P"},
    refuse(700, Fault::subprogram, "the state of a caller"),
    refuse(710, Fault::subprogram, "the state of a caller"),
    refuse(720, Fault::subprogram, "the state of a caller"),
    refuse(730, Fault::subprogram, "the state of a caller"),
};

}  // namespace listed

namespace {

constexpr int last_tenths = 7100;
using Index = std::array<std::uint8_t, last_tenths + 1>;

/// The place of each number in a list, from 1; 0: it is not there.
template <std::size_t n>
constexpr Index index_of(const std::array<Code, n>& codes) {
  static_assert(n < 255);
  Index index{};
  for (std::size_t i = 0; i < n; ++i) {
    index[static_cast<std::size_t>(codes[i].tenths)] = static_cast<std::uint8_t>(i + 1);
  }
  return index;
}

constexpr Index common_index = index_of(listed::common);
constexpr Index iso_index = index_of(listed::of_iso);
constexpr Index sinumerik_index = index_of(listed::of_sinumerik);

const Code* found(const Index& index, std::span<const Code> codes,
                  int tenths) noexcept {
  const std::uint8_t place = index[static_cast<std::size_t>(tenths)];
  return place == 0 ? nullptr : &codes[place - 1U];
}

const Code* searched(std::span<const Code> codes, int tenths) noexcept {
  const auto it = std::ranges::find(codes, tenths, &Code::tenths);
  return it == codes.end() ? nullptr : &*it;
}

}  // namespace

const Code* g_code(int tenths, Dialect dialect) noexcept {
  constexpr int first_further = 5050;
  constexpr int last_further = 5990;
  if (tenths < 0 || tenths > last_tenths) return nullptr;
  if (const Code* code = found(common_index, listed::common, tenths)) return code;
  if (dialect != Dialect::sinumerik) return found(iso_index, listed::of_iso, tenths);
  if (const Code* code = found(sinumerik_index, listed::of_sinumerik, tenths))
    return code;
  const bool further =
      tenths >= first_further && tenths <= last_further && tenths % 10 == 0;
  return further ? &listed::further_offset : nullptr;
}

const Code* m_code(int tenths, Dialect dialect) noexcept {
  if (const Code* code = searched(listed::m_words, tenths)) return code;
  return dialect == Dialect::linuxcnc ? searched(listed::m_words_of_linuxcnc, tenths)
                                      : nullptr;
}

}  // namespace trochoid::program
