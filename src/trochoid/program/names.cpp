#include <trochoid/program/names.h>
#include <trochoid/program/words.h>

#include <algorithm>
#include <array>

namespace trochoid::program {

namespace {

using namespace std::string_view_literals;

bool is_one_of(std::string_view name, const auto& all) noexcept {
  return std::ranges::any_of(
      all, [name](std::string_view one) { return same_word(name, one); });
}

bool begins_with(std::string_view name, std::string_view start) noexcept {
  return name.size() >= start.size() && same_word(name.substr(0, start.size()), start);
}

/// Names, sorted by what they are.
namespace named {

// Of every dialect: macros of Fanuc, LinuxCNC and Sinumerik.
constexpr std::array loops = {
    "IF"sv,      "ELSE"sv,    "ELSEIF"sv, "ENDIF"sv,  "WHILE"sv, "ENDWHILE"sv,
    "GOTO"sv,    "GOTOF"sv,   "GOTOB"sv,  "GOTOC"sv,  "GOTOS"sv, "FOR"sv,
    "ENDFOR"sv,  "LOOP"sv,    "UNTIL"sv,  "REPEAT"sv, "CASE"sv,  "DO"sv,
    "ENDLOOP"sv, "REPEATB"sv, "THEN"sv,   "END"sv};

constexpr std::array subprograms = {"EXTCALL"sv, "CALL"sv,    "MCALL"sv,  "PCALL"sv,
                                    "PROC"sv,    "ISOCALL"sv, "EXTERN"sv, "RET"sv,
                                    "SBLOF"sv,   "ENDPROC"sv};

constexpr std::array variables = {"DEF"sv, "SET"sv, "REDEF"sv};

constexpr std::array rotary = {"TRAORI"sv, "TRACYL"sv,  "TRANSMIT"sv, "TRAANG"sv,
                               "TOROT"sv,  "TOFRAME"sv, "TCARR"sv,    "ORIWKS"sv,
                               "ORIMKS"sv, "ORIAXES"sv, "ORIVECT"sv,  "PAROT"sv,
                               "TCOABS"sv, "TCOFR"sv};

constexpr std::array arcs = {"CIP"sv, "CT"sv, "AR"sv};

constexpr std::array orders = {
    "RND"sv,  "RNDM"sv,   "CHF"sv,     "CHR"sv, "ASPLINE"sv, "BSPLINE"sv, "CSPLINE"sv,
    "POLY"sv, "DIAMON"sv, "OEMIPO1"sv, "ANG"sv, "FRC"sv,     "FRCM"sv};

constexpr std::array frames = {"TRANS"sv,  "ROT"sv,   "SCALE"sv,  "MIRROR"sv,
                               "ATRANS"sv, "AROT"sv,  "ASCALE"sv, "AMIRROR"sv,
                               "ROTS"sv,   "AROTS"sv, "CROTS"sv};

constexpr std::array always_frames = {"PRESETON"sv, "G58"sv, "OFFN"sv, "SETFRAME"sv};

constexpr std::array quiet = {
    "MSG"sv,         "CYCLE832"sv,  "COMPON"sv,  "COMPOF"sv,   "COMPCURV"sv,
    "COMPCAD"sv,     "COMPSURF"sv,  "FFWON"sv,   "FFWOF"sv,    "SOFT"sv,
    "SOFTA"sv,       "BRISK"sv,     "BRISKA"sv,  "DRIVE"sv,    "FNORM"sv,
    "FLIN"sv,        "FCUB"sv,      "ADIS"sv,    "ADISPOS"sv,  "STOPRE"sv,
    "TRAFOOF"sv,     "CFTCP"sv,     "CFC"sv,     "CFIN"sv,     "WORKPIECE"sv,
    "GROUP_BEGIN"sv, "GROUP_END"sv, "DISPLOF"sv, "DISPLON"sv,  "WALIMON"sv,
    "WALIMOF"sv,     "NORM"sv,      "KONT"sv,    "DIAMOF"sv,   "CDOF"sv,
    "CDON"sv,        "FGROUP"sv,    "SPATH"sv,   "UPATH"sv,    "CTOL"sv,
    "OTOL"sv,        "DYNNORM"sv,   "DYNPOS"sv,  "DYNROUGH"sv, "DYNSEMIFIN"sv,
    "DYNFINISH"sv,   "DYNPREC"sv,   "SUPD"sv};

}  // namespace named

}  // namespace

std::optional<Fault> refused_name(std::string_view name, bool assigned,
                                  Dialect dialect) noexcept {
  // DO1 and END1 of Fanuc.
  std::string_view plain = name;
  while (!plain.empty() && plain.back() >= '0' && plain.back() <= '9') {
    plain.remove_suffix(1);
  }
  if (is_one_of(plain, named::loops)) return Fault::loop;
  if (dialect != Dialect::sinumerik) return std::nullopt;
  if (is_one_of(name, named::subprograms)) return Fault::subprogram;
  if (is_one_of(name, named::variables)) return Fault::variable;
  if (is_one_of(name, named::rotary)) return Fault::rotary;
  if (is_one_of(name, named::arcs)) return Fault::arc;
  if (is_one_of(name, named::orders)) return Fault::order;
  if (is_one_of(name, named::always_frames)) return Fault::coordinates;
  const bool kept = same_word(name, "CYCLE832") || same_word(name, "CYCLE800");
  if (!kept && (begins_with(name, "CYCLE") || begins_with(name, "POCKET") ||
                begins_with(name, "HOLES") || begins_with(name, "SLOT") ||
                begins_with(name, "LONGHOLE"))) {
    return Fault::cycle;
  }
  if (assigned && plain.size() == 1 && name.size() > 1 &&
      (plain == "R" || plain == "r")) {
    return Fault::variable;
  }
  if (assigned && plain.size() == 1 && name.size() > 1 &&
      is_one_of(plain, std::array{"I"sv, "J"sv, "K"sv})) {
    return Fault::arc;
  }
  return std::nullopt;
}

bool without_effect(std::string_view name) noexcept {
  return is_one_of(name, named::quiet);
}

bool changes_frame(std::string_view name) noexcept {
  return is_one_of(name, named::frames);
}

}  // namespace trochoid::program
