#include <trochoid/correction/speed_map.h>

#include <trochoid/correction/equal_flutes.h>
#include <trochoid/correction/transition.h>
#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace trochoid::correction {

namespace {

/// A motion of a shape that makes the peaks of a rigid cut equal, as far as it can.
PeriodicMotion equalizing(const RigidCut& rigid, Shape shape,
                          const CorrectionOptions& options) {
  const ShapeOptions of_shape{.harmonics = options.harmonics};
  const Amplitude found =
      equal_flutes(Target::peak_force, rigid, shape, of_shape, {.starts = 1});
  return found.ok ? found.motion : table_motion(rigid, shape, of_shape);
}

/// How a curve moves the table at a speed, or the spindle.
struct Way {
  Strategy strategy;
  std::optional<ChosenAt> chosen;
  std::optional<double> by_spindle;  ///< what is left of the difference
};

struct NamedWay {
  std::string name;
  std::function<Way(double Omega)> at;
};

NamedWay always(const char* name, PeriodicMotion motion, Method method) {
  return {name,
          [way = Way{{std::move(motion), method}, {}, {}}](double) { return way; }};
}

NamedWay chosen_by_speed(const RigidCut& rigid, const CorrectionOptions& options,
                         const MapSetting& setting) {
  const Method method = Method::inverse;
  auto candidates = transition_candidates(
      rigid, {Shape::quintic, method, Target::peak_force, options.harmonics});
  return {"quintic_chosen",
          [&rigid, &setting, candidates = std::move(candidates)](double Omega) {
            const TransitionCandidate& best =
                chosen_transition(rigid, candidates, Method::inverse, setting, Omega);
            return Way{{best.motion, Method::inverse},
                       ChosenAt{best.width, best.harmonics},
                       {}};
          }};
}

/// A sine of the spindle speed, as much of it as the drive gives.
NamedWay turned_unevenly(const RigidCut& rigid, const PeriodicMotion& sine,
                         const SpindleDrive& drive) {
  return {"spindle_sine", [&rigid, sine, drive](double Omega) {
            const SpeedModulation m = speed_modulation(rigid, sine, drive, Omega);
            return Way{{sine, Method::plain}, {}, m.peak_difference};
          }};
}

/// R-19 between the speeds that were looked at anyway.
double crossing(const Curve& curve, const std::vector<double>& Omega,
                const std::function<double(double)>& difference, double allowed) {
  constexpr int halvings = 5;
  const auto over = [&](double d) { return !(d <= allowed); };
  for (std::size_t k = 0; k < Omega.size(); ++k) {
    if (!over(curve.points[k].peak_difference)) {
      continue;
    }
    if (k == 0) {
      return 0.0;
    }
    double low = Omega[k - 1];
    double high = Omega[k];
    for (int i = 0; i < halvings; ++i) {
      const double middle = (low + high) / 2;
      (over(difference(middle)) ? high : low) = middle;
    }
    return low;
  }
  return Omega.back();
}

}  // namespace

SpeedMap speed_map(const Setting& s, const Plan& plan,
                   const CorrectionOptions& options) {
  SpeedMap map{.cut = options.map_cut, .Omega = options.spindle_speeds};
  if (map.Omega.empty()) {
    return map;
  }
  const RigidCut rigid = designed_cut(s);
  const MapSetting setting{.model = s.cut.plant,
                           .real = s.cut.plant,
                           .limits = s.limits,
                           .command = command_options(options)};
  const PeriodicMotion sine = equalizing(rigid, Shape::sine, options);
  const PeriodicMotion square = equalizing(rigid, Shape::square, options);
  std::vector<NamedWay> ways = {always("sine_plain", sine, Method::plain),
                                always("sine_lead", sine, Method::lead),
                                always("sine_inverse", sine, Method::inverse),
                                always("square_lead", square, Method::lead),
                                chosen_by_speed(rigid, options, setting),
                                always("this_case", plan.motion, options.strategy)};
  if (options.spindle) {
    ways.insert(ways.end() - 1, turned_unevenly(rigid, sine, *options.spindle));
    map.spindle =
        speed_modulation(rigid, sine, *options.spindle, s.cut.setup.cut.Omega);
  }
  const bool moving = options.map_cut == MapCut::moving;
  const auto point = [&](const Way& way, double Omega) {
    if (way.by_spindle) {
      return MapPoint{.peak_difference = *way.by_spindle};
    }
    return moving ? residual_at(s.cut, way.strategy, setting, Omega)
                  : residual_at(rigid, way.strategy, setting, Omega);
  };
  const std::size_t n = map.Omega.size();
  for (const NamedWay& way : ways) {
    map.curves.push_back({way.name, std::vector<MapPoint>(n), {}});
  }
  std::vector<Way> taken(ways.size() * n);
  numerics::for_each_index(taken.size(), [&](std::size_t i) {
    taken[i] = ways[i / n].at(map.Omega[i % n]);
    map.curves[i / n].points[i % n] = point(taken[i], map.Omega[i % n]);
  });
  const std::array ends = {map.Omega.front(), map.Omega.back()};
  numerics::for_each_index(ways.size(), [&](std::size_t k) {
    Curve& curve = map.curves[k];
    for (std::size_t i = 0; i < n && taken[k * n].chosen; ++i) {
      curve.chosen.push_back(*taken[k * n + i].chosen);
    }
    const auto difference = [&](double Omega) {
      return point(ways[k].at(Omega), Omega).peak_difference;
    };
    curve.highest =
        moving ? crossing(curve, map.Omega, difference, options.allowed_difference)
               : residual_speed(difference, options.allowed_difference, ends);
  });
  return map;
}

}  // namespace trochoid::correction
