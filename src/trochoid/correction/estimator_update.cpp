#include <trochoid/correction/controller_memory.h>
#include <trochoid/correction/estimator.h>
#include <trochoid/correction/estimator_update.h>

#include <math.h>

// The mathematics of the estimator. No allocation; loops are bounded by the largest
// numbers of teeth and waves.

namespace trochoid::correction {

namespace {

constexpr double pi = 3.141592653589793;
constexpr double scale = 1e-5;        // of a wave [m]: numbers about one
constexpr double offset_sd = 1.0;     // of the constant terms, before anything is known
constexpr double model_ridge = 1e-4;  // over the mean of the diagonal of S S^T
constexpr double model_memory = 0.05;  // the model is forgotten so much slower
constexpr double explained = 0.8;      // of a change, by one tooth
constexpr int32_t odd_turns = 2;       // in a row, before they are believed
constexpr int32_t relearnt = 3;        // turns after which a change is told
constexpr int32_t wave_points = 96;    // of a turn, at which the waves are summed

using Vector = double[TROCHOID_ESTIMATOR_TEETH];

int32_t waves_of(const TrochoidEstimator& e) {
  return 2 * e.config.harmonics;
}

double predicted(const TrochoidEstimator& e, int32_t j) {
  double v = e.theta[j][0];
  for (int32_t k = 0; k < waves_of(e); ++k) {
    v += e.theta[j][k + 1] * e.wave[k];
  }
  return v;
}

/// Nothing is known of the runout any more, and little of the model.
void open_covariance(TrochoidEstimator& e) {
  for (int32_t a = 0; a <= waves_of(e); ++a) {
    for (int32_t b = 0; b <= waves_of(e); ++b) {
      e.P[a][b] = a == b ? e.most_P[a] : 0.0;
    }
  }
}

/// L-10.
void update(TrochoidEstimator& e, const Vector& v) {
  const int32_t n = waves_of(e) + 1;
  double x[TROCHOID_ESTIMATOR_TERMS] = {1.0};
  double Px[TROCHOID_ESTIMATOR_TERMS] = {};
  for (int32_t k = 1; k < n; ++k) {
    x[k] = e.wave[k - 1];
  }
  const double lambda = e.config.forgetting;
  double denominator = e.config.noise * e.config.noise;
  for (int32_t a = 0; a < n; ++a) {
    for (int32_t b = 0; b < n; ++b) {
      Px[a] += e.P[a][b] * x[b];
    }
    denominator += x[a] * Px[a];
  }
  for (int32_t j = 0; j < e.config.teeth; ++j) {
    const double innovation = v[j] - predicted(e, j);
    for (int32_t a = 0; a < n; ++a) {
      e.theta[j][a] += Px[a] / denominator * innovation;
    }
  }
  double shrink[TROCHOID_ESTIMATOR_TERMS];
  const double kept = 1.0 - model_memory * (1.0 - lambda);
  for (int32_t a = 0; a < n; ++a) {
    for (int32_t b = 0; b < n; ++b) {
      const double forgotten =
          sqrt((a == 0 ? lambda : kept) * (b == 0 ? lambda : kept));
      e.P[a][b] = (e.P[a][b] - Px[a] * Px[b] / denominator) / forgotten;
    }
    e.P[a][a] = fmax(e.P[a][a], 1e-12);
    shrink[a] = sqrt(fmin(1.0, e.most_P[a] / e.P[a][a]));
  }
  for (int32_t a = 0; a < n; ++a) {
    for (int32_t b = 0; b < n; ++b) {
      e.P[a][b] *= shrink[a] * shrink[b];
    }
  }
}

/// z = (S S^T + epsilon I)^-1 v by Gauss, positive definite.
void solve(const TrochoidEstimator& e, const Vector& v, Vector& z) {
  const int32_t n = e.config.teeth;
  double A[TROCHOID_ESTIMATOR_TEETH][TROCHOID_ESTIMATOR_TEETH] = {};
  double trace = 0.0;
  for (int32_t i = 0; i < n; ++i) {
    for (int32_t j = 0; j < n; ++j) {
      for (int32_t k = 1; k <= waves_of(e); ++k) {
        A[i][j] += e.theta[i][k] * e.theta[j][k];
      }
    }
    trace += A[i][i];
    z[i] = v[i];
  }
  for (int32_t i = 0; i < n; ++i) {
    A[i][i] += model_ridge * trace / n + 1e-12;
  }
  for (int32_t i = 0; i < n; ++i) {
    for (int32_t j = i + 1; j < n; ++j) {
      const double f = A[j][i] / A[i][i];
      for (int32_t k = i; k < n; ++k) {
        A[j][k] -= f * A[i][k];
      }
      z[j] -= f * z[i];
    }
  }
  for (int32_t i = n - 1; i >= 0; --i) {
    for (int32_t j = i + 1; j < n; ++j) {
      z[i] -= A[i][j] * z[j];
    }
    z[i] /= A[i][i];
  }
}

/// Largest magnitude of the waves' sum over a turn [m].
double largest_sum(const TrochoidEstimator& e, const double* wave) {
  double most = 0.0;
  for (int32_t i = 0; i < wave_points; ++i) {
    const double c1 = cos(2.0 * pi * i / wave_points);
    const double s1 = sin(2.0 * pi * i / wave_points);
    double c = c1;
    double s = s1;
    double sum = 0.0;
    for (int32_t n = 0; n < e.config.harmonics; ++n) {
      sum += wave[2 * n] * c + wave[2 * n + 1] * s;
      const double next = c * c1 - s * s1;
      s = s * c1 + c * s1;
      c = next;
    }
    most = fmax(most, fabs(sum));
  }
  return most * scale;
}

/// L-11.
void step(TrochoidEstimator& e) {
  Vector v{};
  Vector z{};
  for (int32_t j = 0; j < e.config.teeth; ++j) {
    v[j] = predicted(e, j);
  }
  solve(e, v, z);
  double change[TROCHOID_ESTIMATOR_WAVES] = {};
  double largest = 0.0;
  for (int32_t k = 0; k < waves_of(e); ++k) {
    for (int32_t j = 0; j < e.config.teeth; ++j) {
      change[k] -= e.config.rate * e.theta[j][k + 1] * z[j];
    }
    largest = fmax(largest, fabs(change[k]) * scale);
  }
  const double less = largest > e.config.step_m ? e.config.step_m / largest : 1.0;
  double next[TROCHOID_ESTIMATOR_WAVES];
  for (int32_t k = 0; k < waves_of(e); ++k) {
    next[k] = e.wave[k] + less * change[k];
    if (!(fabs(next[k]) < 1e6)) {
      return;  // no step that is not a number
    }
  }
  const double sum = largest_sum(e, next);
  const double fits = sum > e.config.most_m ? e.config.most_m / sum : 1.0;
  for (int32_t n = 0; n < e.config.harmonics; ++n) {
    e.wave[2 * n] = fits * next[2 * n];
    e.wave[2 * n + 1] = fits * next[2 * n + 1];
    e.result.cosine_m[n] = e.wave[2 * n] * scale;
    e.result.sine_m[n] = e.wave[2 * n + 1] * scale;
  }
  e.waiting = e.config.wait_turns;
  e.result.learnt += e.result.learnt < most_counted ? 1 : 0;
}

/// What a change looks most like (L-12).
void tell(TrochoidEstimator& e, const Vector& change) {
  e.result.event = TROCHOID_TOOL_CHANGED;
  e.result.tooth = 0;
  e.result.change_m = 0.0;
  e.result.events += e.result.events < most_counted ? 1 : 0;
  double best = explained;
  for (int32_t i = 0; i < e.config.teeth; ++i) {
    double product = 0.0;
    double model = 0.0;
    double square = 0.0;
    for (int32_t j = 0; j < e.config.teeth; ++j) {
      product += e.config.runout_model[j][i] * change[j];
      model += e.config.runout_model[j][i] * e.config.runout_model[j][i];
      square += change[j] * change[j];
    }
    if (model > 0.0 && square > 0.0 && product * product > best * model * square) {
      best = product * product / (model * square);
      e.result.event = TROCHOID_TOOTH_WORN;
      e.result.tooth = i + 1;
      e.result.change_m = product / model;
    }
  }
}

double largest_of(const TrochoidEstimator& e, const Vector& values) {
  double most = 0.0;
  for (int32_t j = 0; j < e.config.teeth; ++j) {
    most = fmax(most, fabs(values[j]));
  }
  return most;
}

void take_reference(TrochoidEstimator& e) {
  for (int32_t j = 0; j < e.config.teeth; ++j) {
    e.reference[j] = e.theta[j][0];
  }
}

/// Whether the tool has changed; a sudden change opens the estimate at once.
void look_for_events(TrochoidEstimator& e, const Vector& v) {
  const TrochoidEstimatorConfig& c = e.config;
  Vector missed{};
  for (int32_t j = 0; j < c.teeth; ++j) {
    missed[j] = v[j] - predicted(e, j);
  }
  e.measured += e.measured < most_counted ? 1 : 0;
  if (c.event_change <= 0.0 || e.measured <= c.settled_turns) {
    return;
  }
  e.odd = largest_of(e, missed) > c.event_change ? e.odd + 1 : 0;
  if (e.odd >= odd_turns) {
    open_covariance(e);
    tell(e, missed);
    e.odd = 0;
    e.measured = c.settled_turns > relearnt ? c.settled_turns - relearnt : 0;
    e.sudden = 1;
  }
}

/// Slow changes, and where a reference is taken.
void look_for_wear(TrochoidEstimator& e) {
  const TrochoidEstimatorConfig& c = e.config;
  if (e.measured == c.settled_turns) {
    take_reference(e);
    e.sudden = 0;
    return;
  }
  if (c.event_change <= 0.0 || e.measured < c.settled_turns || e.sudden != 0) {
    return;
  }
  Vector change{};
  for (int32_t j = 0; j < c.teeth; ++j) {
    change[j] = e.theta[j][0] - e.reference[j];
  }
  if (e.odd == 0 && largest_of(e, change) > c.event_change) {
    tell(e, change);
    take_reference(e);
  }
}

}  // namespace

void begin_learning(TrochoidEstimator& e) {
  const TrochoidEstimatorConfig& c = e.config;
  double square = 0.0;
  for (int32_t j = 0; j < c.teeth; ++j) {
    for (int32_t k = 0; k < 2 * c.harmonics; ++k) {
      e.theta[j][k + 1] = c.wave_model[j][k] * scale;
      square += e.theta[j][k + 1] * e.theta[j][k + 1];
    }
  }
  e.most_P[0] = offset_sd * offset_sd;
  const double each = square / (2.0 * c.harmonics * c.teeth);
  for (int32_t k = 1; k <= 2 * c.harmonics; ++k) {
    e.most_P[k] = c.trust * c.trust * each;
  }
  open_covariance(e);
}

void learn_turn(TrochoidEstimator& e) {
  Vector v{};
  double mean = 0.0;
  for (int32_t j = 0; j < e.config.teeth; ++j) {
    mean += e.result.force_N[j] / e.config.teeth;
  }
  for (int32_t j = 0; j < e.config.teeth; ++j) {
    v[j] = e.result.force_N[j] / mean - 1.0;  // L-9
  }
  look_for_events(e, v);
  if (e.odd > 0) {  // what was not foreseen once is not learnt from
    e.result.turn = TROCHOID_TURN_WAITED;
    return;
  }
  update(e, v);
  look_for_wear(e);
  if (e.result.difference <= e.config.deadband) {
    e.result.turn = TROCHOID_TURN_EQUAL;
    return;
  }
  step(e);
  e.result.turn = TROCHOID_TURN_LEARNT;
}

}  // namespace trochoid::correction
