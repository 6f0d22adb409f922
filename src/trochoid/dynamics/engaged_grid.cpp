#include <trochoid/dynamics/engaged_grid.h>

#include <trochoid/chip/chip.h>
#include <trochoid/geometry/edge.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace trochoid::dynamics {

namespace {

constexpr double turn = 2 * std::numbers::pi;
/// Just before and just after a node [rad].
constexpr double beside = 1e-9;

/// The arc on the front of the tool whose points lie in the stock.
struct Window {
  double from = 0.0;
  double to = 0.0;

  [[nodiscard]] bool holds(double theta) const noexcept {
    const double u = theta - turn * std::floor(theta / turn);
    return u > from && u < to;
  }
};

Window window_of(const force::Setup& setup) {
  const double r = setup.cutter.profile.D / 2;
  const geometry::Band stock =
      geometry::stock_band(setup.cut.engagement, setup.cutter.profile.D);
  return {std::acos(std::clamp(stock.y_hi / r, -1.0, 1.0)),
          std::acos(std::clamp(stock.y_lo / r, -1.0, 1.0))};
}

/// One slice: the teeth there, and how far they lag behind their tips.
struct Disk {
  double lag = 0.0;
  double width = 0.0;
  double edge = 0.0;
  std::vector<geometry::EdgePosition> teeth;
};

std::vector<Disk> disks_of(const force::Setup& setup, int count) {
  const geometry::Meridian meridian = geometry::meridian(setup.cutter.profile);
  const std::vector<double> psi = geometry::tooth_angles(setup.cutter);
  const double width = setup.cut.a_p / count;
  std::vector<Disk> disks;
  for (int i = 0; i < count; ++i) {
    const double s = geometry::arc_length_at(meridian, (i + 0.5) * width);
    const geometry::Lag lag = geometry::lag_at(setup.cutter, meridian, s);
    const geometry::MeridianPoint point = geometry::point_at(meridian, s);
    Disk disk{lag.angle, width, 0.0, {}};
    disk.edge = setup.edge_length == force::EdgeLength::axial
                    ? width
                    : width * geometry::edge_length_factor(point, lag);
    disk.teeth.resize(psi.size());
    const geometry::Runout runout =
        setup.chip.model == chip::Model::none ? geometry::Runout{} : setup.runout;
    geometry::edge_positions(runout, psi, point.r, lag.angle, disk.teeth);
    disks.push_back(std::move(disk));
  }
  return disks;
}

/// Steps that fill a length, halved again and again towards both ends: where the chip
/// begins, the force of a power law has an infinite slope.
std::vector<double> steps_of(double length, double longest) {
  constexpr int levels = 5;
  constexpr int each = 8;
  std::vector<double> sizes;  // relative to the longest
  double ends = 0.0;
  for (int level = levels; level > 0; --level) {
    for (int k = 0; k < each; ++k) {
      sizes.push_back(std::ldexp(1.0, -level));
      ends += 2 * sizes.back();
    }
  }
  const double inner = std::ceil(length / longest * (1 - 1e-9) - ends);
  if (inner < 1) {
    const auto count = std::ceil(length / longest * (1 - 1e-9));
    return std::vector<double>(static_cast<std::size_t>(std::max(1.0, count)),
                               length / std::max(1.0, count));
  }
  const double step = length / (inner + ends);
  std::vector<double> steps;
  for (const double size : sizes) {
    steps.push_back(size * step);
  }
  steps.insert(steps.end(), static_cast<std::size_t>(inner), step);
  for (auto size = sizes.rbegin(); size != sizes.rend(); ++size) {
    steps.push_back(*size * step);
  }
  return steps;
}

class Builder {
 public:
  Builder(const force::Setup& setup, const GridOptions& options)
      : setup_(setup),
        window_(window_of(setup)),
        passage_(chip::passage(setup.cutter, setup.cut, setup.chip)),
        psi_(geometry::tooth_angles(setup.cutter)),
        disks_(disks_of(setup, options.slices)) {
    const auto teeth = static_cast<std::size_t>(setup.cutter.teeth());
    grid_.lookback =
        options.lookback > 0 ? static_cast<std::size_t>(options.lookback) : 2 * teeth;
    add_nodes(options.steps_per_tooth);
    for (const double phi : grid_.angle) {
      const Contacts before = add_contacts(phi, -beside);
      const Contacts after = add_contacts(phi, +beside);
      grid_.before.push_back(before);
      grid_.after.push_back(after);
      grid_.jump.push_back(!same_contacts(before, after));
    }
  }

  EngagedGrid take() { return std::move(grid_); }

 private:
  void add_nodes(int steps_per_tooth) {
    const double pitch = setup_.cutter.pitch.front();
    std::vector<double> marks = {0.0, pitch};
    for (const double edge : {window_.from, window_.to}) {
      const double at = edge - pitch * std::floor(edge / pitch);
      marks.push_back(at);
    }
    std::sort(marks.begin(), marks.end());
    std::vector<double> nodes;
    for (std::size_t i = 0; i + 1 < marks.size(); ++i) {
      const double length = marks[i + 1] - marks[i];
      if (length < 1e-7 * pitch) {
        continue;
      }
      double at = marks[i];
      for (const double step : steps_of(length, pitch / steps_per_tooth)) {
        nodes.push_back(at);
        at += step;
        grid_.step.push_back(step);
      }
    }
    grid_.nodes = nodes.size();
    for (std::size_t j = 0; j < psi_.size(); ++j) {
      for (const double at : nodes) {
        grid_.angle.push_back(static_cast<double>(j) * pitch + at);
      }
    }
  }

  Contacts add_contacts(double phi, double side) {
    Contacts range{grid_.contacts.size(), 0};
    for (const Disk& disk : disks_) {
      for (std::size_t j = 0; j < psi_.size(); ++j) {
        const double theta = phi - psi_[j] - disk.lag;
        if (window_.holds(theta + side)) {
          add_contact(disk, j, theta);
        }
      }
    }
    range.last = grid_.contacts.size();
    return range;
  }

  [[nodiscard]] bool same_contacts(const Contacts& a, const Contacts& b) const {
    return std::equal(grid_.contacts.begin() + static_cast<std::ptrdiff_t>(a.first),
                      grid_.contacts.begin() + static_cast<std::ptrdiff_t>(a.last),
                      grid_.contacts.begin() + static_cast<std::ptrdiff_t>(b.first),
                      grid_.contacts.begin() + static_cast<std::ptrdiff_t>(b.last),
                      [](const Contact& p, const Contact& q) {
                        return p.tooth == q.tooth && p.sine == q.sine;
                      });
  }

  void add_contact(const Disk& disk, std::size_t j, double theta) {
    const geometry::EdgePosition& own = disk.teeth[j];
    const chip::Slice slice{setup_.cutter.profile.D / 2, disk.teeth};
    grid_.contacts.push_back({std::sin(theta + own.epsilon),
                              std::cos(theta + own.epsilon), disk.width, disk.edge, j,
                              grid_.above.size()});
    const auto tooth = static_cast<int>(j);
    const std::size_t teeth = psi_.size();
    for (std::size_t m = 1; m <= grid_.lookback; ++m) {
      // A mark older than a turn stands one or more feeds per turn farther back.
      const std::size_t older = (m - 1) / teeth;
      const int mark = static_cast<int>((m - 1) % teeth) + 1;
      const bool counts = static_cast<int>(m) <= passage_.marks || older > 0;
      const double a = chip::chip_over_mark(passage_, slice, tooth, theta, mark) +
                       static_cast<double>(older * teeth) * setup_.cut.f_z *
                           std::sin(theta + own.epsilon);
      grid_.above.push_back(counts ? a : std::numeric_limits<double>::infinity());
    }
  }

  const force::Setup& setup_;
  Window window_;
  chip::Passage passage_;
  std::vector<double> psi_;
  std::vector<Disk> disks_;
  EngagedGrid grid_;
};

}  // namespace

EngagedGrid engaged_grid(const force::Setup& setup, const GridOptions& options) {
  const auto& pitch = setup.cutter.pitch;
  const geometry::Profile& p = setup.cutter.profile;
  if (p.R != 0 || p.alpha != 0 || p.beta != 0) {
    throw std::invalid_argument("the cutter is no cylinder");
  }
  if (std::any_of(pitch.begin(), pitch.end(),
                  [&](double x) { return std::abs(x - pitch.front()) > 1e-12; })) {
    throw std::invalid_argument("the teeth are not equally spaced");
  }
  return Builder(setup, options).take();
}

}  // namespace trochoid::dynamics
