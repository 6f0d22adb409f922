#include <trochoid/force/law.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace trochoid::force {

namespace {

constexpr bool is_exponent(const Quantity& quantity) noexcept {
  return quantity.role == Role::exponent;
}

/// The same law with `values` in place of its exponents, or of its coefficients.
Law replaced(const Law& law, bool exponents, std::span<const double> values) {
  return std::visit(
      [&](auto changed) -> Law {
        std::size_t i = 0;
        for (const auto& number : numbers(changed)) {
          if (is_exponent(number.quantity) == exponents) {
            changed.*number.value = values[i++];
          }
        }
        return changed;
      },
      law);
}

}  // namespace

Form form(const Law& law) {
  return std::visit([](const auto& l) { return form(l); }, law);
}

Terms terms(const Law& law) {
  Terms all{.form = form(law)};
  const std::vector<double> K = coefficients(law);
  std::copy_n(K.begin(), 3, all.K.begin());
  if (all.form.edge) {
    std::copy_n(K.begin() + 3, 3, all.K_e.begin());
  }
  return all;
}

std::vector<Quantity> quantities(const Law& law) {
  std::vector<Quantity> all;
  std::visit(
      [&](const auto& l) {
        for (const auto& number : numbers(l)) {
          all.push_back(number.quantity);
        }
      },
      law);
  return all;
}

std::vector<Quantity> coefficient_quantities(const Law& law) {
  std::vector<Quantity> all = quantities(law);
  std::erase_if(all, is_exponent);
  return all;
}

std::vector<Quantity> exponent_quantities(const Law& law) {
  std::vector<Quantity> all = quantities(law);
  std::erase_if(all, [](const Quantity& quantity) { return !is_exponent(quantity); });
  return all;
}

std::vector<double> coefficients(const Law& law) {
  std::vector<double> K;
  std::visit(
      [&](const auto& l) {
        for (const auto& number : numbers(l)) {
          if (!is_exponent(number.quantity)) {
            K.push_back(l.*number.value);
          }
        }
      },
      law);
  return K;
}

Law with_coefficients(const Law& law, std::span<const double> K) {
  if (K.size() != form(law).columns()) {
    throw std::invalid_argument("a force law was given " + std::to_string(K.size()) +
                                " coefficients instead of " +
                                std::to_string(form(law).columns()));
  }
  return replaced(law, false, K);
}

Law with_exponents(const Law& law, std::span<const double, 3> m) {
  return replaced(law, true, m);
}

Law with_number(const Law& law, std::string_view key, double value) {
  return std::visit(
      [&](auto changed) -> Law {
        for (const auto& number : numbers(changed)) {
          if (number.quantity.key == key) {
            changed.*number.value = value;
            return changed;
          }
        }
        throw std::invalid_argument("the force law " + std::string(name_of(changed)) +
                                    " has no number " + std::string(key));
      },
      law);
}

}  // namespace trochoid::force
