#include <trochoid/dynamics/normal_motion.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace trochoid::dynamics {

namespace {

using Plane = std::array<double, 2>;

/// Of the largest entry: matrices are not better than that.
constexpr double nothing = 1e-9;

using Seen = std::function<void(const Channel&)>;

/// The channels of an element that hold anything.
void each_channel(const PeriodElement& e, const Seen& seen) {
  if (!e.own.matrices.empty()) seen(e.own);
  for (const Channel& channel : e.delayed) {
    if (!channel.matrices.empty()) seen(channel);
  }
}

Matrix2 matrix_at(const Channel& channel, std::size_t i) {
  const std::size_t n = channel.matrices.size() / 4;
  Matrix2 A;
  for (std::size_t q = 0; q < 4; ++q) A[q] = channel.matrices[q * n + i];
  return A;
}

double size_of(const Matrix2& A) {
  return std::max({std::abs(A[0]), std::abs(A[1]), std::abs(A[2]), std::abs(A[3])});
}

/// The largest matrix at each node.
/// @param each  calls for every channel
std::vector<Matrix2> largest_of(const std::function<void(const Seen&)>& each,
                                std::size_t nodes) {
  std::vector<Matrix2> largest(nodes);
  each([&](const Channel& channel) {
    for (std::size_t i = 0; i < nodes; ++i) {
      const Matrix2 A = matrix_at(channel, i);
      if (size_of(A) > size_of(largest[i])) largest[i] = A;
    }
  });
  return largest;
}

/// The row space of A, in the sense of that of the node before.
Plane normal_of(const Matrix2& A, const Plane& before) {
  const double upper = std::hypot(A[0], A[1]);
  const double lower = std::hypot(A[2], A[3]);
  if (!(upper + lower > 0)) {
    return before;
  }
  const Plane n = upper > lower ? Plane{A[0] / upper, A[1] / upper}
                                : Plane{A[2] / lower, A[3] / lower};
  const bool turned = n[0] * before[0] + n[1] * before[1] < 0;
  return turned ? Plane{-n[0], -n[1]} : n;
}

std::vector<Plane> normals_of(const std::vector<Matrix2>& largest) {
  std::vector<Plane> out;
  out.reserve(largest.size());
  for (const Matrix2& A : largest) {
    out.push_back(normal_of(A, out.empty() ? Plane{1, 0} : out.back()));
  }
  return out;
}

/// The direction of A n; where that is nothing, of the node before.
std::vector<Plane> pushes_of(const std::vector<Matrix2>& largest,
                             const std::vector<Plane>& normal) {
  std::vector<Plane> out;
  for (std::size_t i = 0; i < normal.size(); ++i) {
    const Matrix2& A = largest[i];
    const Plane u = {A[0] * normal[i][0] + A[1] * normal[i][1],
                     A[2] * normal[i][0] + A[3] * normal[i][1]};
    const double length = std::hypot(u[0], u[1]);
    const Plane before = out.empty() ? Plane{1, 0} : out.back();
    out.push_back(length > 0 ? Plane{u[0] / length, u[1] / length} : before);
  }
  return out;
}

/// alpha of A = alpha u n^T.
double share_of(const Matrix2& A, const Plane& u, const Plane& n) {
  return u[0] * (A[0] * n[0] + A[1] * n[1]) + u[1] * (A[2] * n[0] + A[3] * n[1]);
}

/// Are all matrices of an element such products?
bool are_products(const PeriodElement& e, double allowed) {
  bool all = true;
  each_channel(e, [&](const Channel& channel) {
    for (std::size_t i = 0; i < e.nodes(); ++i) {
      const Matrix2 A = matrix_at(channel, i);
      const double alpha = share_of(A, e.push[i], e.normal[i]);
      for (std::size_t q = 0; q < 4; ++q) {
        const double product = alpha * e.push[i][q / 2] * e.normal[i][q % 2];
        all = all && std::abs(A[q] - product) <= allowed;
      }
    }
  });
  return all;
}

void reduce(Channel& channel, const PeriodElement& e) {
  if (channel.matrices.empty()) {
    return;
  }
  std::vector<double> shares;
  for (std::size_t i = 0; i < e.nodes(); ++i) {
    shares.push_back(share_of(matrix_at(channel, i), e.push[i], e.normal[i]));  // D-15
  }
  channel.matrices = std::move(shares);
}

/// No matrix that turns more than one direction into a force: soon seen where there is one.
bool each_has_one_normal(const PeriodElements& elements, double largest) {
  return std::all_of(
      elements.all.begin(), elements.all.end(), [&](const PeriodElement& e) {
        bool one = true;
        each_channel(e, [&](const Channel& channel) {
          for (std::size_t i = 0; i < e.nodes() && one; ++i) {
            const Matrix2 A = matrix_at(channel, i);
            one = std::abs(A[0] * A[3] - A[1] * A[2]) <= nothing * largest * size_of(A);
          }
        });
        return one;
      });
}

/// The directions of all elements, the normals the same in every pitch.
void add_directions(PeriodElements& elements) {
  const std::size_t a_pitch = elements.all.size() / elements.pitches;
  for (std::size_t k = 0; k < a_pitch; ++k) {
    const auto each = [&](const Seen& seen) {
      for (std::size_t i = k; i < elements.all.size(); i += a_pitch) {
        each_channel(elements.all[i], seen);
      }
    };
    const auto normals = normals_of(largest_of(each, elements.all[k].nodes()));
    for (std::size_t i = k; i < elements.all.size(); i += a_pitch) {
      PeriodElement& e = elements.all[i];
      const auto own = [&](const Seen& seen) { each_channel(e, seen); };
      e.normal = normals;
      e.push = pushes_of(largest_of(own, e.nodes()), normals);
    }
  }
}

double largest_entry(const PeriodElements& elements) {
  double largest = 0.0;
  for (const PeriodElement& e : elements.all) {
    each_channel(e, [&](const Channel& channel) {
      for (const double value : channel.matrices) {
        largest = std::max(largest, std::abs(value));
      }
    });
  }
  return largest;
}

}  // namespace

void follow_normals(PeriodElements& elements) {
  if (elements.pitches == 0 || elements.components != 2) {
    return;
  }
  const double largest = largest_entry(elements);
  if (!each_has_one_normal(elements, largest)) {
    return;
  }
  add_directions(elements);
  const double allowed = nothing * largest;
  const bool all =
      std::all_of(elements.all.begin(), elements.all.end(),
                  [&](const PeriodElement& e) { return are_products(e, allowed); });
  for (PeriodElement& e : elements.all) {
    if (all) {
      reduce(e.own, e);
      for (Channel& channel : e.delayed) reduce(channel, e);
    } else {
      e.normal.clear();
      e.push.clear();
    }
  }
  elements.components = all ? 1 : 2;
}

}  // namespace trochoid::dynamics
