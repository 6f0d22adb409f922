#include <trochoid/engagement/feed.h>

#include <trochoid/base/units.h>
#include <trochoid/engagement/look.h>
#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <unordered_map>

namespace trochoid::engagement {

namespace {

/// Neighbours whose feeds differ by less than this ratio share one feed.
constexpr double one_feed = 1.1;
/// A part that ends this near to the end of its move ends there [m].
constexpr double near_end = 2e-6;
/// Relative tolerance of the feed.
constexpr double fine = 1e-4;

/// The load of a turn that is the largest share of its limit.
struct Load {
  double share = 0.0;  ///< of the limit
  Held held = Held::range;
  double chip = 0.0;  ///< the largest of the turn [m]
};

Load load_of(const TurnForces& F, const Limits& limits, double spindle) {
  const double tooth =
      F.peak_of_tooth.empty() ? 0.0 : *std::ranges::max_element(F.peak_of_tooth);
  Load out{0.0, Held::range, F.peak_chip};
  const auto look = [&](double value, double limit, Held held) {
    const double share = std::abs(value) / limit;
    if (share > out.share) out = {share, held, out.chip};
  };
  look(F.peak_xy, limits.peak_xy, Held::peak_xy);
  look(tooth, limits.peak_tooth, Held::peak_tooth);
  look(F.torque_peak, limits.torque, Held::torque);
  look(F.torque_mean * spindle, power_at(limits, spindle), Held::power);
  look(F.moment_peak, limits.moment, Held::moment);
  look(F.deflection, limits.deflection, Held::deflection);
  look(F.peak_chip, limits.chip, Held::chip);
  return out;
}

/// Loads may come so near to their limits: the written program has other steps, and keeps
/// them, too.
constexpr double kept = 0.998;

/// A turn and the largest part of its feed that the limits allow.
struct Allowed {
  double factor = 1.0;
  Load load;
};

/// N-14 of a turn.
class LargestFactor {
 public:
  LargestFactor(Turn turn, const Tool& tool, const Limits& limits, double spindle)
      : turn_(std::move(turn)),
        tool_(tool),
        limits_(limits),
        f_z_(turn_.f_z),
        fall_(turn_.fall),
        spindle_(spindle) {}

  Allowed find(const FeedRange& range) {
    high_ = at(range.most);
    if (high_.load.share <= 1) {
      high_.load.held = Held::range;
      return high_;
    }
    return go_below(range.least) ? close_in() : low_;
  }

 private:
  Allowed at(double factor) {
    turn_.f_z = factor * f_z_;
    turn_.fall = factor * fall_;
    Load load = load_of(loads_of(turn_, tool_).forces, limits_, spindle_);
    load.share /= kept;
    return {factor, load};
  }

  /// From above: the load is nearly a straight line with something left at rest, so that
  /// secants soon come below the limit. False: not even the lowest feed is.
  bool go_below(double least) {
    double next = high_.factor / high_.load.share;
    for (;;) {
      low_ = at(std::max(next, least));
      if (low_.load.share <= 1) return true;
      if (!(low_.factor > least)) return false;
      const double slope =
          (high_.load.share - low_.load.share) / (high_.factor - low_.factor);
      const double root = low_.factor - (low_.load.share - 1) / slope * (1 + fine);
      next = slope > 0 ? std::min(root, (1 - fine) * low_.factor) : least;
      high_ = low_;
    }
  }

  /// False position with halved ends (Illinois): teeth that come into cut bend the line.
  Allowed close_in() {
    double below = low_.load.share - 1;
    double above = high_.load.share - 1;
    constexpr int tries = 40;
    for (int i = 0; i < tries && low_.load.share < 1 - close &&
                    high_.factor - low_.factor > fine * high_.factor;
         ++i) {
      const double part = std::clamp(below / (below - above), 0.02, 0.98);
      const Allowed next = at(low_.factor + part * (high_.factor - low_.factor));
      if (next.load.share <= 1) {
        low_ = next;
        below = next.load.share - 1;
        above *= 0.5;
      } else {
        high_ = next;
        above = next.load.share - 1;
        below *= 0.5;
      }
    }
    return low_;
  }

  static constexpr double close = 1e-3;  ///< a load this near to its limit is at it

  Turn turn_;
  const Tool& tool_;
  const Limits& limits_;
  double f_z_;
  double fall_;
  double spindle_;
  Allowed high_;
  Allowed low_;
};

/// The places of a step: after a kink its start is left out, as the marks before the kink
/// lie elsewhere.
std::vector<double> places_of(const Ask& ask) {
  std::vector<double> out;
  const double half = 0.5 * ask.share;
  if (ask.u - half > half) out.push_back(ask.u - half);
  out.push_back(ask.u);
  out.push_back(std::min(ask.u + half, 1.0));
  return out;
}

std::vector<Ask> asks_of(const Look& look, double step_turns) {
  std::vector<Ask> out;
  const auto& pieces = look.path().pieces;
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    const std::int64_t n = count_of(pieces[i], step_turns);
    for (std::int64_t k = 0; k < n; ++k) {
      const double u = (static_cast<double>(k) + 0.5) / static_cast<double>(n);
      out.push_back({i, u, 1.0 / static_cast<double>(n), 0,
                     move_at(look.path(), pieces[i], u * pieces[i].length)});
    }
  }
  return out;
}

/// Turns whose feeds are looked for, each different one once.
class Turns {
 public:
  Turns(const Job& job, const Limits& limits, const FeedRange& range)
      : job_(job), limits_(limits), range_(range) {}

  std::size_t place_of(const Found& found) {
    TurnKey key = key_of(found.turn);
    key.push_back(std::llround(found.step.spindle * 1e6));
    const auto [at, is_new] = known_.try_emplace(std::move(key), turns_.size());
    if (is_new) {
      turns_.push_back(found.turn);
      spindles_.push_back(found.step.spindle);
    }
    return at->second;
  }

  void solve() {
    const std::size_t first = found_.size();
    found_.resize(turns_.size());
    numerics::for_each_index(
        turns_.size() - first,
        [&](std::size_t i) {
          const Turn& turn = turns_[first + i];
          found_[first + i] =
              LargestFactor(turn, job_.tools[static_cast<std::size_t>(turn.tool)],
                            limits_, spindles_[first + i])
                  .find(range_);
        },
        2);
  }

  [[nodiscard]] const Allowed& at(std::size_t i) const { return found_[i]; }

 private:
  const Job& job_;
  const Limits& limits_;
  FeedRange range_;
  std::unordered_map<TurnKey, std::size_t, TurnKeyHash> known_;
  std::vector<Turn> turns_;
  std::vector<double> spindles_;
  std::vector<Allowed> found_;
};

WantedFeed bare_feed(const Look& look, const Ask& ask,
                     const program::Program& program) {
  const stock::Piece& piece = look.path().pieces[ask.piece];
  WantedFeed out{.piece = ask.piece, .line = program.moves[ask.move].line};
  out.from = std::max(0.0, ask.u - 0.5 * ask.share) * piece.length;
  out.to = std::min(1.0, ask.u + 0.5 * ask.share) * piece.length;
  out.along = look.along(ask.piece) + ask.u * piece.length;
  out.programmed = out.feed = piece.feed;
  return out;
}

/// The lowest of what is allowed at the places of a step.
void take_lowest(const Allowed& allowed, const Limits& limits, WantedFeed& feed) {
  const bool first = feed.held == Held::not_cutting;
  if (!first && allowed.factor * feed.programmed > feed.feed) return;
  feed.feed = allowed.factor * feed.programmed;
  feed.held = allowed.load.held;
  feed.reachable = (first || feed.reachable) && kept * allowed.load.share <= 1;
  feed.rubs = allowed.load.chip < limits.least_chip;
}

void obey_axes(const Job& job, const Look& look, const Ask& ask, WantedFeed& feed) {
  if (!job.options.drives) return;
  const stock::Piece& piece = look.path().pieces[ask.piece];
  const double most =
      stock::feed_along(*job.options.drives, stock::tangent(piece, ask.u));
  // A feed that the program has already is the machine's to lower.
  if (feed.feed <= std::max(most, feed.programmed)) return;
  feed.feed = std::max(most, feed.programmed);
  feed.held = Held::drives;
}

/// Feeds on a piece, from step to step.
struct Stretch {
  double from = 0.0;  ///< [m]
  double to = 0.0;    ///< [m]
  double feed = 0.0;  ///< [m/s]
};

/// N-15: a lower feed begins as early as braking to it has to.
void brake_early(std::span<const WantedFeed> wanted, const stock::Path& path,
                 const stock::Drives& drives, std::vector<double>& feed) {
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const WantedFeed& here = wanted[i];
    const stock::Piece& piece = path.pieces[here.piece];
    const double a = stock::acceleration_along(
        drives, stock::tangent(piece, 0.5 * (here.from + here.to) / piece.length));
    const double reach = here.feed * here.feed / (2 * a);
    for (std::size_t k = i + 1; k < wanted.size(); ++k) {
      const WantedFeed& there = wanted[k];
      if (there.piece > wanted[k - 1].piece + 1) break;  // a rapid is between
      const double end = here.along + 0.5 * (here.to - here.from);
      const double distance = there.along - 0.5 * (there.to - there.from) - end;
      if (distance > reach) break;
      if (there.feed < feed[i] &&
          distance < (here.feed * here.feed - there.feed * there.feed) / (2 * a)) {
        feed[i] = there.feed;
      }
    }
  }
}

/// Steps of a piece whose feeds are alike.
std::vector<Stretch> stretches(std::span<const WantedFeed> wanted,
                               std::span<const double> feed) {
  std::vector<Stretch> out;
  double highest = 0.0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!out.empty()) {
      Stretch& last = out.back();
      const double low = std::min(last.feed, feed[i]);
      const double high = std::max(highest, feed[i]);
      if (high <= one_feed * low) {
        last = {last.from, wanted[i].to, low};
        highest = high;
        continue;
      }
    }
    out.push_back({wanted[i].from, wanted[i].to, feed[i]});
    highest = feed[i];
  }
  return out;
}

/// Cut the stretches of a piece where its moves end.
void add_parts(const stock::Path& path, std::uint32_t index,
               std::span<const Stretch> all, std::vector<program::FeedPart>& out) {
  const stock::Piece& piece = path.pieces[index];
  for (std::uint32_t m = piece.first; m <= piece.last; ++m) {
    if (!std::isfinite(path.begins[m])) continue;
    const double begin = path.begins[m];
    double end = piece.length;
    for (std::uint32_t next = m + 1; next <= piece.last; ++next) {
      if (!std::isfinite(path.begins[next])) continue;
      end = path.begins[next];
      break;
    }
    double at = begin;
    for (const Stretch& s : all) {
      const bool last = s.to > end - near_end;
      if (s.to < begin + near_end && !last) continue;
      const double to = last ? end : s.to;
      out.push_back(
          {m, (at - begin) / (end - begin), (to - begin) / (end - begin), s.feed});
      at = to;
      if (last) break;
    }
  }
}

}  // namespace

double power_at(const Limits& limits, double spindle) noexcept {
  const auto& curve = limits.power_curve;
  if (curve.empty()) return limits.power;
  const auto after = std::ranges::find_if(
      curve, [&](const std::array<double, 2>& row) { return row[0] > spindle; });
  double most = curve.back()[1];
  if (after == curve.begin()) {
    most = curve.front()[1];
  } else if (after != curve.end()) {
    const auto& [x1, p1] = *after;
    const auto& [x0, p0] = *std::prev(after);
    most = p0 + (p1 - p0) * (spindle - x0) / (x1 - x0);
  }
  return std::min(limits.power, most);
}

double share_of_limits(const TurnForces& forces, const Limits& limits, double spindle) {
  return load_of(forces, limits, spindle).share;
}

std::vector<WantedFeed> largest_feeds(const Job& given, const Limits& limits,
                                      const FeedRange& range) {
  Job job = given;
  job.options.drives.reset();  // feeds are those of the program
  Look look(job);
  Turns turns(job, limits, range);
  const std::vector<Ask> asks = asks_of(look, job.options.step_turns);
  std::vector<WantedFeed> out;
  const std::size_t together = look.swept().map() == nullptr ? 4096 : 512;
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  for (std::size_t begin = 0; begin < asks.size(); begin += together) {
    if (job.options.stop.wanted()) break;
    const std::size_t n = std::min(together, asks.size() - begin);
    std::vector<std::array<Found, 3>> found(n);
    Ask start = asks[begin];
    start.u = std::max(0.0, start.u - 0.5 * start.share);
    look.sweep_to(look.turns_of(start) - 1);
    numerics::for_each_index(
        n,
        [&](std::size_t i) {
          Ask ask = asks[begin + i];
          std::size_t k = 0;
          for (const double u : places_of(ask)) {
            ask.u = u;
            found[i][k++] = look.at(ask);
          }
        },
        64);
    std::vector<std::array<std::size_t, 3>> place(n, {none, none, none});
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Found& f = found[i][k];
        if (!f.turn.layers.empty() && feeds(f.turn)) place[i][k] = turns.place_of(f);
      }
    }
    turns.solve();
    for (std::size_t i = 0; i < n; ++i) {
      WantedFeed feed = bare_feed(look, asks[begin + i], job.program);
      for (const std::size_t k : place[i]) {
        if (k != none) take_lowest(turns.at(k), limits, feed);
      }
      obey_axes(given, look, asks[begin + i], feed);
      out.push_back(feed);
    }
  }
  return out;
}

std::vector<program::FeedPart> feed_parts(const Job& job,
                                          std::span<const WantedFeed> wanted) {
  const stock::Path path = stock::path(job.program.moves, job.options.rapid_feed);
  std::vector<double> feed;
  feed.reserve(wanted.size());
  for (const WantedFeed& w : wanted) feed.push_back(w.feed);
  if (job.options.drives) brake_early(wanted, path, *job.options.drives, feed);
  std::vector<program::FeedPart> out;
  for (std::size_t i = 0; i < wanted.size();) {
    std::size_t end = i;
    while (end < wanted.size() && wanted[end].piece == wanted[i].piece) ++end;
    const auto of_piece = wanted.subspan(i, end - i);
    add_parts(path, wanted[i].piece,
              stretches(of_piece, std::span(feed).subspan(i, end - i)), out);
    i = end;
  }
  return out;
}

}  // namespace trochoid::engagement
