#include <trochoid/identification/find_axes.h>

#include <trochoid/identification/fit_at.h>
#include <trochoid/identification/identify.h>
#include <trochoid/identification/prepare.h>
#include <trochoid/identification/readings.h>
#include <trochoid/identification/residuals.h>
#include <trochoid/identification/runout_starts.h>
#include <trochoid/identification/search.h>
#include <trochoid/identification/uncertainty.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace trochoid::identification {

namespace {

using Vector3 = std::array<double, 3>;

/// Readings whose residuals differ by less than this are the same data.
constexpr double same_rms = 1e-6;
/// The next best reading is worth a warning below this many times the best.
constexpr double close_rms = 1.5;
/// A fit leaves at least this part of what the scan leads to expect.
constexpr double least_part = 0.25;
/// Fitted in any case, so that the distance to the next best is known.
constexpr std::size_t least_fits = 3;
/// Within this many times the best, a reading is searched with all starts.
constexpr double worth_searching = 3.0;
/// A reading that is alone in this and leaves so little of the force is clear as it is.
constexpr double clear_rms = 0.02;
/// Beyond this many times the best, a reading need not be fitted to the last digit.
constexpr double nearly_best = 1.02;
/// Angles of the turn: the few harmonics ask for no more.
constexpr int angles_of_low_band = 128;

/// Readings that leave the same.
struct Family {
  ReadingFamily readings;
  std::vector<Candidate> candidates;
  Minimum minimum = {};
  double rms = INFINITY;  ///< of the scan, then of fits [N]
  bool settled = false;   ///< searched with all starts
  bool fitted = false;
  Fit fit = {};  ///< of the first reading, to the last digit
};

Options low_band(const AxesProblem& problem) {
  Options options = problem.options;
  options.band_harmonics = std::max(2, problem.setup.cutter.teeth());
  if (problem.options.band_harmonics > 0) {
    options.band_harmonics =
        std::min(options.band_harmonics, problem.options.band_harmonics);
  }
  return options;
}

Vector3 turned(const signal::Matrix3& turn, const Vector3& v) {
  Vector3 out{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) out[i] += turn[i][j] * v[j];
  }
  return out;
}

Vector3 sizes(const Vector3& v) {
  return {std::abs(v[0]), std::abs(v[1]), std::abs(v[2])};
}

/// The channels of the runs where their forces stand.
std::vector<Run> as_forces(std::span<const ChannelRun> runs) {
  std::vector<Run> out;
  for (const ChannelRun& run : runs) {
    Run& one = out.emplace_back(Run{run.cut, run.angle, {}, run.group});
    for (std::size_t i = 0; i < run.channel[0].size(); ++i) {
      one.force.push_back({run.channel[0][i], run.channel[1][i], run.channel[2][i]});
    }
  }
  return out;
}

/// A reading with the coefficients that it takes.
struct Judged {
  signal::Matrix3 Q;
  const Family* family = nullptr;
  double rms = 0.0;
  Vector3 K{};  ///< cutting coefficients t, r, a; 0: not told
  Vector3 K_se{};
  Vector3 edge{};  ///< the same of the edge
  Vector3 edge_se{};
};

/// The readings of a family, in its order.
std::vector<Judged> judged(const Family& family) {
  std::array<Vector3, 2> K{};  // of cutting, of the edge
  std::array<Vector3, 2> se{};
  const auto& found = family.fit.coefficients;
  for (std::size_t q = 0; q < std::min<std::size_t>(6, found.size()); ++q) {
    if (!found[q]) continue;
    K[q / 3][q % 3] = found[q]->value;
    se[q / 3][q % 3] = found[q]->se;
  }
  std::vector<Judged> out;
  for (const signal::AxesReading& reading : family.readings) {
    out.push_back({reading.Q, &family, family.rms, turned(reading.turn, K[0]),
                   sizes(turned(reading.turn, se[0])), turned(reading.turn, K[1]),
                   sizes(turned(reading.turn, se[1]))});
  }
  return out;
}

/// Signs of a cut: the tangential force decides first, then the radial one. Of two readings
/// with all of them, as a mirrored face mill has, the radial force is the larger one.
int positive(const Judged& r) {
  return (r.K[0] > 0 ? 8 : 0) + (r.K[1] > 0 ? 4 : 0) + (r.K[2] > 0 ? 2 : 0) +
         (r.K[1] > r.K[2] ? 1 : 0);
}

/// All three are positive.
constexpr int all_positive = 14;

/// The one of several that leave the same whose signs are most those of a cut.
Judged best_by_signs(const std::vector<Judged>& readings) {
  return *std::ranges::max_element(readings, {}, positive);
}

/// Whether the signs of a reading are those of a cut: it is driven, and neither pushed nor
/// pulled where it should not be, nor by its edge. Along the axis a cut may pull either way.
bool sound(const Judged& r) {
  constexpr double clear =
      4.0;  // standard errors; an edge may hide a little of the cutting
  return r.K[0] > 0 && !(r.K[1] + 2 * r.K_se[1] < 0) &&
         !(r.edge[0] + clear * r.edge_se[0] < 0) &&
         !(r.edge[1] + clear * r.edge_se[1] < 0);
}

bool sound(const Family& family) {
  return sound(best_by_signs(judged(family)));
}

/// What the records become within the low harmonics, whatever the channels read.
class Search {
 public:
  Search(const AxesProblem& given, std::span<const ChannelRun> runs)
      : given_(given), runs_(runs), options_(low_band(given)) {}

  /// @return whether there is anything to search; else why not is in the message
  bool prepare() {
    const std::vector<Run> channels = as_forces(runs_);
    Prepared prepared =
        identification::prepare(given_.setup, given_.law, channels, options_);
    message_ = prepared.refusal;
    if (!message_.empty()) return false;
    channels_ = *std::move(prepared.problem);
    channels_.tolerance = final_tolerance;
    channels_.angles = angles_of_low_band;
    for (std::size_t r = 0; r < channels.size(); ++r) {
      samples_ += static_cast<double>(channels[r].angle.size());
      scatter_ += scatter_of(channels[r], channels_.runs[r]);
    }
    force_ = rms_of(rss_of_means(channels_));
    return true;
  }

  [[nodiscard]] const std::string& message() const noexcept { return message_; }

  /// The families with what the scan says of them, the best first.
  [[nodiscard]] std::vector<Family> scanned(std::vector<ReadingFamily> all) const {
    std::vector<signal::Matrix3> first;
    first.reserve(all.size());
    for (const ReadingFamily& family : all) first.push_back(family.front().Q);
    auto found = scan(channels_, runout_starts(channels_), first);
    std::vector<Family> out;
    for (std::size_t k = 0; k < all.size(); ++k) {
      Family& one = out.emplace_back(Family{std::move(all[k]), std::move(found[k])});
      if (!one.candidates.empty()) one.rms = rms_of(one.candidates.front().rss);
    }
    std::ranges::stable_sort(out, {}, &Family::rms);
    return out;
  }

  /// Fit as many as it takes to know the best and how far the next is.
  void compare(std::vector<Family>& families, const std::function<void(double)>& told) {
    const std::size_t least =
        force::keeps_radius(given_.setup) ? families.size() : least_fits;
    double best = INFINITY;
    std::size_t count = 0;
    const double scanned = families.front().rms;
    for (; count < families.size(); ++count) {
      Family& family = families[count];
      // A start that is off adds about the same to the squares of every reading.
      const double own = family.rms * family.rms - scanned * scanned;
      const double expected = std::sqrt(own + best * best);
      if (count >= least && least_part * expected > close_rms * best) break;
      if (told) told(static_cast<double>(count) / static_cast<double>(least + count));
      rank(family);
      best = std::min(best, family.rms);
    }
    families.resize(count);
    while (settle_next(families)) {
    }
    if (told) told(1.0);
  }

 private:
  [[nodiscard]] double rms_of(double rss) const {
    // What is not a number must stand behind all others, not before them.
    return std::isfinite(rss) ? std::sqrt(std::max(0.0, rss + scatter_) / samples_)
                              : INFINITY;
  }

  /// Fits of the averaged data: near enough to compare.
  void rank(Family& family) const {
    if (family.candidates.empty()) return;
    const Problem problem = read_by(channels_, family.readings.front().Q);
    family.minimum = coarse_search(problem, family.candidates);
    family.rms = rms_of(family.minimum.rss);
  }

  /// Search with all starts the first family within so many times the best, or take the
  /// numbers of a fit that may be the best.
  /// @return whether there was anything to do
  bool settle_next(std::vector<Family>& families) {
    std::ranges::stable_sort(families, {}, &Family::rms);
    const double best = families.front().rms;
    if (!std::isfinite(best)) return false;  // none converges: nothing to compare
    const double limit = worth_searching * best;
    const bool alone = families.size() > 1 && !(families[1].rms <= limit);
    for (Family& family : families) {
      if (family.settled || !(family.rms <= limit)) continue;
      const bool clear = alone && family.rms < clear_rms * force_;
      settle(family, clear ? std::vector<Candidate>{} : family.candidates);
      return true;
    }
    // Where what the best ones take no cut has, the next may be the true one.
    const bool doubtful = std::ranges::none_of(families, [&](const Family& family) {
      return family.rms <= nearly_best * best && (!family.fitted || sound(family));
    });
    const double within = (doubtful ? close_rms : nearly_best) * best;
    for (Family& family : families) {
      if (family.fitted || !(family.rms <= within)) continue;
      fit(family);
      return true;
    }
    return false;
  }

  /// The minimum of more starts, to the last digit.
  void settle(Family& family, const std::vector<Candidate>& more) {
    family.settled = true;
    if (family.candidates.empty()) return;
    const Problem problem = read_by(channels_, family.readings.front().Q);
    std::vector<Candidate> starts = {{family.minimum.p, family.minimum.rss}};
    starts.insert(starts.end(), more.begin(), more.end());
    family.minimum = search_from(problem, starts);
    family.rms = family.minimum.converged ? rms_of(family.minimum.rss) : INFINITY;
    if (family.minimum.converged) return;
    message_ =
        "the search for runout and phase did not converge: " + family.minimum.reason;
  }

  void fit(Family& family) {
    family.fitted = true;
    const signal::Matrix3& Q = family.readings.front().Q;
    Problem problem = read_by(channels_, Q);
    restrict_eccentricity(problem, family.minimum.p);
    family.fit.options = options_;
    family.fit.law = given_.law;
    family.fit.coefficients.resize(static_cast<std::size_t>(problem.columns));
    fill_at(problem, on_tool(runs_, Q), family.minimum, family.fit);
    if (!family.fit.ok) message_ = family.fit.message;
    // Refused, but what it leaves unexplained still tells how wrong this reading is.
    family.rms = family.fit.rms > 0 ? family.fit.rms : INFINITY;
  }

  const AxesProblem& given_;
  std::span<const ChannelRun> runs_;
  Options options_;
  Problem channels_;
  double samples_ = 0.0;
  double force_ = 0.0;    ///< that changes over the turn [N], rms
  double scatter_ = 0.0;  ///< of samples at the same angle [N^2]
  std::string message_;
};

bool lacks_a_channel(const ChannelRun& run) {
  return !std::ranges::all_of(run.measured, std::identity());
}

/// Best reading of each group of families that leave the same, the one that leaves least
/// first.
struct Ranked {
  Judged reading;
  std::size_t same = 1;   ///< readings that leave as much
  bool mirrored = false;  ///< several of them take the signs of a cut
};

std::vector<Ranked> ranked(const std::vector<Family>& families) {
  std::vector<Ranked> out;
  for (std::size_t i = 0; i < families.size();) {
    const double most = families[i].rms * (1 + same_rms) + 1e-9;
    std::vector<Judged> alike;
    for (; i < families.size() && !(families[i].rms > most); ++i) {
      const std::vector<Judged> more = judged(families[i]);
      alike.insert(alike.end(), more.begin(), more.end());
    }
    const auto good = std::ranges::count_if(
        alike, [](const Judged& r) { return positive(r) >= all_positive; });
    out.push_back({best_by_signs(alike), alike.size(), good > 1});
  }
  return out;
}

/// The reading that leaves least, or, where its signs are none of a cut, the first that
/// leaves hardly more and has them.
void choose(const std::vector<Family>& families, const std::string& refusal,
            AxesChoice& choice) {
  const std::vector<Ranked> all = ranked(families);
  const double best = all.front().reading.rms;
  const auto better_signs = std::ranges::find_if(all, [&](const Ranked& one) {
    return one.reading.rms <= close_rms * best && sound(one.reading);
  });
  const std::size_t at = better_signs == all.end()
                             ? 0
                             : static_cast<std::size_t>(better_signs - all.begin());
  const Judged& chosen = all[at].reading;
  choice.rms = chosen.rms;
  if (!std::isfinite(chosen.rms) || positive(chosen) == 0) {
    choice.message = refusal;
    return;
  }
  choice.ok = true;
  choice.matrix = chosen.Q;
  if (at > 0) {
    const Judged& first = all.front().reading;
    choice.passed_over = {first.Q, first.rms, first.K};
  }
  const std::size_t next = at + 1;
  choice.next_rms = next < all.size() ? all[next].reading.rms : INFINITY;
  const bool clear = positive(chosen) >= all_positive &&
                     chosen.K[0] > 2 * chosen.K_se[0] &&
                     chosen.K[1] > 2 * chosen.K_se[1];
  choice.signs_clear = clear || all[at].same == 1;
  choice.mirrored = all[at].mirrored;
  choice.start = {chosen.family->fit.runout, chosen.family->fit.phase};
}

}  // namespace

std::optional<std::array<bool, 3>> measured_forces(const std::array<bool, 3>& channels,
                                                   const signal::Matrix3& M) {
  if (std::ranges::all_of(channels, std::identity())) return channels;
  const auto all = signal::axes_candidates();
  if (std::ranges::find(all, M) == all.end()) return std::nullopt;
  std::array<bool, 3> out{};
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t q = 0; q < 3; ++q) {
      if (M[c][q] != 0.0) out[q] = channels[c];
    }
  }
  return out;
}

namespace {

/// Of errors that are independent of each other.
std::array<double, 3> offsets_on_tool(const std::array<double, 3>& of_channels,
                                      const signal::Matrix3& M) {
  std::array<double, 3> out{};
  for (std::size_t c = 0; c < 3; ++c) {
    if (!(of_channels[c] > 0)) continue;
    std::array<std::vector<double>, 3> one{std::vector{0.0}, std::vector{0.0},
                                           std::vector{0.0}};
    one[c][0] = of_channels[c];
    const auto force = signal::force_on_tool(one, M);
    for (std::size_t q = 0; force && q < 3; ++q) {
      out[q] = std::hypot(out[q], (*force)[0][q]);
    }
  }
  return out;
}

}  // namespace

std::vector<Run> on_tool(std::span<const ChannelRun> runs, const signal::Matrix3& M) {
  std::vector<Run> out;
  for (const ChannelRun& run : runs) {
    auto force = signal::force_on_tool(run.channel, M);
    if (!force) {
      throw std::invalid_argument("the matrix of the dynamometer cannot be inverted");
    }
    const auto measured = measured_forces(run.measured, M);
    if (!measured) {
      throw std::invalid_argument(
          "a channel is missing: the matrix gives no force without it");
    }
    out.push_back({run.cut, run.angle, std::move(*force), run.group, *measured,
                   run.Omega_se, offsets_on_tool(run.offset_se, M)});
  }
  return out;
}

AxesChoice find_axes(const AxesProblem& problem, std::span<const ChannelRun> runs,
                     const std::function<void(double)>& told) {
  AxesChoice choice;
  const std::string none = "no reading of the channels could be fitted: ";
  if (std::ranges::any_of(runs, lacks_a_channel)) {
    choice.message = none + "a channel is missing, so give the axes of the others";
    choice.rms = INFINITY;
    return choice;
  }
  Search search(problem, runs);
  if (!search.prepare()) {
    choice.message = none + search.message();
    choice.rms = INFINITY;
    return choice;
  }
  std::vector<Family> families = search.scanned(reading_families(problem.setup));
  search.compare(families, told);
  choose(families, none + search.message(), choice);
  return choice;
}

double reading_rms(const AxesProblem& problem, std::span<const ChannelRun> runs,
                   const signal::Matrix3& M) {
  const Fit fit =
      identify(problem.setup, problem.law, on_tool(runs, M), low_band(problem));
  return fit.rms > 0 ? fit.rms : INFINITY;
}

}  // namespace trochoid::identification
