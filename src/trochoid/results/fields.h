#pragma once

#include <trochoid/base/estimate.h>
#include <trochoid/results/value.h>

#include <concepts>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <optional>
#include <ranges>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

/// Keys of summary.json and columns of CSV files, each described once: its name, what it
/// means, and how its value is had from a result in SI. The files and
/// docs/formats/results.md are made of these lists. The unit is the end of the name.
namespace trochoid::results {

/// A number that stood in the case or in a record: it is written as it stood there.
struct Given {
  double value = 0.0;
};

/// A number in the unit of its name already, or one without a unit that ends its name.
struct AsNamed {
  double value = 0.0;
};

/// What stands under a key. Its numbers are in SI.
struct Content {
  enum class Numbers {
    computed,
    given,    ///< written as they stood in the case
    as_named  ///< in the unit of the key already, or without one
  };
  Value value;
  Numbers numbers = Numbers::computed;

  template <class T>
  requires(!std::same_as<std::remove_cvref_t<T>, Content> &&
           std::constructible_from<Value, T&&>) Content(T&& what)
      : value(std::forward<T>(what)) {}
  Content(Given one) : value(one.value), numbers(Numbers::given) {}
  Content(AsNamed one) : value(one.value), numbers(Numbers::as_named) {}
  Content(Value what, Numbers kind) : value(std::move(what)), numbers(kind) {}
};

inline Given given(double value) {
  return {value};
}
/// The same of lists, and of what may be absent.
inline Content all_given(Value value) {
  return {std::move(value), Content::Numbers::given};
}
inline AsNamed as_named(double value) {
  return {value};
}
inline Content as_named(Value value) {
  return {std::move(value), Content::Numbers::as_named};
}

/// @brief A content in the unit that ends its key.
Value in_unit_of(std::string_view key, Content content);

/// A key as the page of formats has it: `fits[].runout.angle_deg`.
struct KeyText {
  std::string path;
  std::string_view meaning;
};

/// @brief An estimate with its error and interval in a unit of files; null: not known.
Value estimate_value(const std::optional<base::Estimate>& estimate, double unit);
/// What stands under a key that holds an estimate, and under one that holds several.
std::vector<KeyText> below_estimate(std::string_view before = ".");

/// Append what is said of a key, once.
void add_text(std::vector<KeyText>& out, std::string path, std::string_view meaning);

template <class T>
class Fields;

template <class T>
using If = std::function<bool(const T&)>;

/// @brief A key of an object, which is made of a T.
template <class T>
struct Field {
  std::string_view key;      ///< empty: the keys of a part, among the others
  std::string_view meaning;  ///< empty: it is said where the key stands before
  std::function<Value(const T&)> value;
  If<T> there;                 ///< empty: always
  std::vector<KeyText> below;  ///< paths that go on behind the key

  template <std::invocable<const T&> Get>
  Field(std::string_view name, std::string_view what, Get get, If<T> when = {})
      : key(name),
        meaning(what),
        value([name, get](const T& of) {
          return in_unit_of(name, Content(std::invoke(get, of)));
        }),
        there(std::move(when)) {}

  /// An object, a list of objects, or null where there is none.
  template <class Part, std::invocable<const T&> Get>
  Field(std::string_view name, std::string_view what, const Fields<Part>& part, Get get,
        If<T> when = {})
      : key(name),
        meaning(what),
        value([&part, get](const T& of) { return part.value(std::invoke(get, of)); }),
        there(std::move(when)),
        below(part.texts(
            std::ranges::range<std::invoke_result_t<Get, const T&>> ? "[]." : ".")) {}

  /// The same with what stands under the key, where its own names depend on the case.
  [[nodiscard]] Field with(std::vector<KeyText> texts) && {
    below = std::move(texts);
    return std::move(*this);
  }
};

/// @brief The keys of an object, in the order in which they are written.
template <class T>
class Fields {
 public:
  Fields(std::initializer_list<Field<T>> all) : all_(all) {}

  [[nodiscard]] Object object(const T& of) const {
    Object out;
    for (const Field<T>& field : all_) {
      if (field.there && !field.there(of)) continue;
      Value value = field.value(of);
      if (!field.key.empty()) {
        out.push_back({std::string(field.key), std::move(value)});
      } else if (auto* part = std::get_if<Object>(&value.data)) {
        for (Member& member : *part) out.push_back(std::move(member));
      }
    }
    return out;
  }

  /// Of one, of what may be none, or of a list of them.
  template <class What>
  [[nodiscard]] Value value(const What& what) const {
    if constexpr (std::convertible_to<const What&, const T&>) {
      return object(what);
    } else if constexpr (std::ranges::range<What>) {
      Array list;
      for (const auto& one : what) list.push_back(value(one));
      return list;
    } else {
      return what ? Value(object(*what)) : Value();
    }
  }

  [[nodiscard]] std::vector<KeyText> texts(std::string_view before = {}) const {
    std::vector<KeyText> out;
    for (const Field<T>& field : all_) {
      const std::string path = std::string(before) + std::string(field.key);
      if (!field.meaning.empty()) add_text(out, path, field.meaning);
      for (const KeyText& below : field.below) {
        const auto rest = field.key.empty() ? below.path.substr(1) : below.path;
        add_text(out, path + rest, below.meaning);
      }
    }
    return out;
  }

 private:
  std::vector<Field<T>> all_;
};

}  // namespace trochoid::results
