#include <trochoid/run/surface_map.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/parallel.h>
#include <trochoid/run/shared/sampling.h>
#include <trochoid/run/wall_setting.h>
#include <trochoid/surface/envelope.h>
#include <trochoid/surface/nominal_model.h>
#include <trochoid/surface/probe.h>
#include <trochoid/surface/turn.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace trochoid::run {

namespace {

constexpr int default_heights = 21;

std::vector<double> heights_of(const inputs::Case& given) {
  const auto& named = given.machine.surface->heights;
  if (!named.empty()) {
    return named;
  }
  if (!given.sampling.edge_heights.empty()) {
    return given.sampling.edge_heights;
  }
  std::vector<double> heights;
  const double a_p = given.setup.cut.a_p;
  for (int i = 0; i < default_heights; ++i) {
    heights.push_back(a_p * i / (default_heights - 1));
  }
  return heights;
}

/// Amplitude of the part of a profile that repeats `cycles` times over it.
double amplitude(const std::vector<double>& e, std::size_t cycles) {
  std::complex<double> sum = 0.0;
  for (std::size_t i = 0; i < e.size(); ++i) {
    const double angle =
        unit::turn * static_cast<double>(cycles * i) / static_cast<double>(e.size());
    sum += e[i] * std::polar(1.0, -angle);
  }
  return 2 * std::abs(sum) / static_cast<double>(e.size());
}

/// What all heights of a pass share.
struct Pass {
  const inputs::Case& given;
  surface::Setting setting;
  surface::Side side;
  double feed;      ///< per turn [m]
  double position;  ///< along the wall where the phase holds [m]
  numerics::PeriodicPieces moments;
};

void fill_errors(const Pass& pass, const surface::HeightCut& cut, MapRow& row) {
  const force::Setup& setup = pass.setting.setup;
  const auto put = [&](double x, const surface::SurfacePoint& point) {
    row.x.push_back(x);
    row.error.push_back(point.error);
    row.tooth.push_back(point.tooth);
  };
  const inputs::Sampling& sampling = pass.given.sampling;
  const auto samples = static_cast<int>(
      std::max(1L, std::lround(sampling.samples_per_rev * sampling.revolutions)));
  const double step = pass.feed / sampling.samples_per_rev;
  if (pass.setting.model == surface::Model::imprint) {
    const int turns = std::max(1, static_cast<int>(std::lround(sampling.revolutions)));
    for (int n = 0; n < turns; ++n) {
      for (const surface::SurfacePoint& point : surface::imprint_errors(cut)) {
        put(cut.x_0 + pass.feed * (point.phi / unit::turn + n), point);
      }
    }
    return;
  }
  const auto tips = surface::edge_places(setup, 0.0);
  for (int k = 0; k < samples; ++k) {
    if (pass.setting.model == surface::Model::quasi_static) {
      const double phi = pass.setting.phase + unit::turn * k / sampling.samples_per_rev;
      const std::size_t tooth =
          surface::last_entered(tips, surface::entry_angle(setup), phi);
      put(step * k, surface::quasi_static_error(cut, tooth, phi));
    } else {
      const double x = pass.position + step * k;
      put(x, surface::envelope_error(cut, x));
    }
  }
  if (pass.setting.model == surface::Model::envelope) {
    if (pass.setting.probe_radius > 0) {
      row.error = surface::probe_reading(row.error, step, pass.setting.probe_radius);
    }
    const double turns = sampling.revolutions;
    if (turns == std::round(turns) && turns >= 1) {
      const auto whole = static_cast<std::size_t>(turns);
      row.once_per_turn = amplitude(row.error, whole);
      row.once_per_tooth =
          amplitude(row.error, whole * static_cast<std::size_t>(setup.cutter.teeth()));
    }
  }
}

/// A probe reads more where the wall leans over the height.
void add_slopes(std::vector<MapRow>& rows, double radius) {
  std::vector<double> heights;
  std::vector<double> mean;
  for (const MapRow& row : rows) {
    double sum = 0.0;
    for (const double e : row.error) {
      sum += e / static_cast<double>(row.error.size());
    }
    heights.push_back(row.height);
    mean.push_back(sum);
  }
  const std::vector<double> more = surface::readings_on_slopes(radius, heights, mean);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (double& e : rows[i].error) {
      e += more[i];
    }
  }
}

void fill_forces(const Pass& pass, SurfaceMap& map) {
  const inputs::Sampling& sampling = pass.given.sampling;
  std::vector<double> values(pass.moments.functions());
  const bool named = !sampling.angles.empty();
  const auto samples =
      named ? sampling.angles.size()
            : static_cast<std::size_t>(std::max(
                  1L, std::lround(sampling.samples_per_rev * sampling.revolutions)));
  for (std::size_t k = 0; k < samples; ++k) {
    const double travelled =
        named ? sampling.angles[k] - pass.setting.phase
              : unit::turn * static_cast<double>(k) / sampling.samples_per_rev;
    const double phi = pass.setting.phase + travelled;
    pass.moments.value(phi, values);
    map.forces.push_back({phi, pass.position + pass.feed * travelled / unit::turn,
                          values[values.size() - 2], values[values.size() - 1]});
  }
}

/// At the largest force of the rows.
Bent bent_at_peak(const Pass& pass, const surface::Bodies& bodies,
                  const SurfaceMap& map) {
  const ForceRow& peak = *std::max_element(map.forces.begin(), map.forces.end(),
                                           [](const ForceRow& a, const ForceRow& b) {
                                             return std::abs(a.F_y) < std::abs(b.F_y);
                                           });
  std::vector<double> moments(pass.moments.functions());
  pass.moments.value(peak.phi, moments);
  Bent shape = bent(pass.given, bodies, moments, map.sigma);
  shape.phi = peak.phi;
  return shape;
}

/// Moments over a turn, with feedback if the case asks for it.
numerics::PeriodicPieces moments_of(const inputs::Case& given,
                                    const surface::Setting& setting,
                                    const surface::Compliance& compliance,
                                    SurfaceMap& map) {
  const surface::EdgeMoments edges(setting.setup, setting.law, compliance.basis());
  const auto K = surface::wall_coefficients(setting.law);
  const double tolerance = std::min(setting.tolerance, given.sampling.tolerance);
  if (map.feedback == surface::Feedback::none) {
    return surface::with_coefficients(surface::unit_moments(edges, tolerance), K);
  }
  surface::SteadyState state =
      surface::steady_state(edges, K, compliance, map.feedback, setting.tolerance);
  map.converged = state.converged;
  map.found = state.found;
  map.turns = state.turns;
  map.change = state.change;
  return std::move(state.moments);
}

}  // namespace

SurfaceMap surface_map(const inputs::Case& given, const Progress& progress) {
  const surface::Setting setting = wall_setting(given);
  const force::Setup& setup = setting.setup;
  const double position = given.machine.wall ? given.machine.wall->position : 0.0;
  const surface::Side side = *surface::side_of(setup.cut.engagement);
  SurfaceMap map{
      .model = setting.model, .feedback = wall_feedback(given), .sigma = side.sigma};
  if (progress) {
    progress("Solving the wall");
  }
  const surface::Bodies bodies = setting.bodies(position);
  const surface::Compliance compliance(bodies, setup.cut.a_p, position, setting.load);
  if (progress) {
    progress("Cutting");
  }
  const Pass pass{given,    setting,
                  side,     setup.cutter.teeth() * setup.cut.f_z,
                  position, moments_of(given, setting, compliance, map)};
  if (!map.converged) {
    return map;
  }
  const std::vector<double> heights = heights_of(given);
  const std::vector<double> rows = compliance.rows(heights);
  fill_forces(pass, map);
  map.rows.resize(heights.size());
  const std::size_t points = compliance.basis().size();
  numerics::for_each_index(heights.size(), [&](std::size_t i) {
    MapRow& row = map.rows[i];
    row.height = heights[i];
    const surface::HeightCut cut{
        side,
        setup.cutter.profile.D / 2,
        pass.feed,
        position - pass.feed * setting.phase / unit::turn,
        surface::edge_places(setup, heights[i]),
        surface::deflection(pass.moments, std::span(rows).subspan(i * points, points),
                            side.sigma)};
    fill_errors(pass, cut, row);
    std::vector<double> value(1);
    for (const ForceRow& force : map.forces) {
      cut.deflection.value(force.phi, value);
      row.deflection.push_back(value[0]);
    }
  });
  if (setting.model == surface::Model::envelope && setting.probe_radius > 0) {
    add_slopes(map.rows, setting.probe_radius);
  }
  if (setting.model == surface::Model::imprint) {
    std::vector<surface::Nominal> nominal;
    for (const double height : heights) {
      nominal.push_back({.x = position, .height = height, .readings = {0}});
    }
    const auto K = surface::wall_coefficients(setting.law);
    const auto rigid = surface::NominalModel(setting, nominal).rigid(K);
    for (std::size_t i = 0; i < heights.size(); ++i) {
      map.rows[i].per_K = {rigid.per_K[i * surface::columns],
                           rigid.per_K[i * surface::columns + 1]};
    }
  }
  if (bodies.cutter || bodies.wall) {
    map.bent = bent_at_peak(pass, bodies, map);
  }
  map.influence_heights = given.machine.surface->influence_heights.empty()
                              ? heights
                              : given.machine.surface->influence_heights;
  map.of_cutter = compliance.of_cutter(map.influence_heights, map.influence_heights);
  map.of_wall = compliance.of_wall(map.influence_heights, map.influence_heights);
  const surface::Compliance whole(bodies, setup.cut.a_p, position,
                                  surface::Load::concentrated);
  const std::vector<double> concentrated = whole.rows(heights);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    map.rows[i].compliance = concentrated[i * points];
  }
  return map;
}

}  // namespace trochoid::run
