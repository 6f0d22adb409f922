#pragma once

// What C++20 has and the C++ library of Emscripten 3.1.6 (libc++ 13) has not: it is
// included before every file there, so that none of them has to know.

#include <algorithm>
#include <charconv>
#include <functional>
#include <iterator>
#include <memory>
#include <ranges>
#include <type_traits>
#include <utility>

namespace std {  // NOLINT(cert-dcl58-cpp)

to_chars_result to_chars(char* first, char* last, double value);
to_chars_result to_chars(char* first, char* last, float value);
to_chars_result to_chars(char* first, char* last, double value, chars_format format,
                         int precision);
from_chars_result from_chars(const char* first, const char* last, double& value);
from_chars_result from_chars(const char* first, const char* last, double& value,
                             chars_format format);

template <class Array>
requires is_unbounded_array_v<Array> unique_ptr<Array> make_unique_for_overwrite(
    size_t n) {
  return unique_ptr<Array>(new remove_extent_t<Array>[n]);
}

namespace ranges {

template <class I, class O>
struct in_out_result {
  I in;
  O out;
};

template <class T>
struct min_max_result {
  T min;
  T max;
};

namespace web {

/// What compares two projections.
template <class Compare, class Projection>
auto less_by(Compare& compare, Projection& of) {
  return [&](auto&& a, auto&& b) {
    return static_cast<bool>(
        std::invoke(compare, std::invoke(of, std::forward<decltype(a)>(a)),
                    std::invoke(of, std::forward<decltype(b)>(b))));
  };
}

template <class Predicate, class Projection>
auto holds_for(Predicate& predicate, Projection& of) {
  return [&](auto&& x) {
    return static_cast<bool>(
        std::invoke(predicate, std::invoke(of, std::forward<decltype(x)>(x))));
  };
}

}  // namespace web

template <class R, class P, class Proj = identity>
bool all_of(R&& r, P predicate, Proj of = {}) {
  return std::all_of(ranges::begin(r), ranges::end(r), web::holds_for(predicate, of));
}

template <class R, class P, class Proj = identity>
bool any_of(R&& r, P predicate, Proj of = {}) {
  return std::any_of(ranges::begin(r), ranges::end(r), web::holds_for(predicate, of));
}

template <class R, class P, class Proj = identity>
bool none_of(R&& r, P predicate, Proj of = {}) {
  return std::none_of(ranges::begin(r), ranges::end(r), web::holds_for(predicate, of));
}

template <class R, class C = ranges::equal_to>
auto adjacent_find(R&& r, C compare = {}) {
  return std::adjacent_find(ranges::begin(r), ranges::end(r), std::move(compare));
}

template <class R, class T, class Proj = identity>
auto find(R&& r, const T& value, Proj of = {}) {
  return std::find_if(ranges::begin(r), ranges::end(r), [&](auto&& x) {
    return std::invoke(of, std::forward<decltype(x)>(x)) == value;
  });
}

template <class I, class P, class Proj = identity>
requires input_iterator<I>
auto find_if(I first, I last, P predicate, Proj of = {}) {
  return std::find_if(first, last, web::holds_for(predicate, of));
}

template <class R, class P, class Proj = identity>
requires ranges::range<R>
auto find_if(R&& r, P predicate, Proj of = {}) {
  return std::find_if(ranges::begin(r), ranges::end(r), web::holds_for(predicate, of));
}

template <class I, class P, class Proj = identity>
requires input_iterator<I>
auto find_if_not(I first, I last, P predicate, Proj of = {}) {
  return std::find_if_not(first, last, web::holds_for(predicate, of));
}

template <class R, class P, class Proj = identity>
requires ranges::range<R>
auto find_if_not(R&& r, P predicate, Proj of = {}) {
  return std::find_if_not(ranges::begin(r), ranges::end(r),
                          web::holds_for(predicate, of));
}

template <class R, class T, class Proj = identity>
auto count(R&& r, const T& value, Proj of = {}) {
  return std::count_if(ranges::begin(r), ranges::end(r), [&](auto&& x) {
    return std::invoke(of, std::forward<decltype(x)>(x)) == value;
  });
}

template <class R, class P, class Proj = identity>
auto count_if(R&& r, P predicate, Proj of = {}) {
  return std::count_if(ranges::begin(r), ranges::end(r), web::holds_for(predicate, of));
}

template <class R, class C = ranges::less, class Proj = identity>
auto sort(R&& r, C compare = {}, Proj of = {}) {
  std::sort(ranges::begin(r), ranges::end(r), web::less_by(compare, of));
  return ranges::end(r);
}

template <class R, class C = ranges::less, class Proj = identity>
auto stable_sort(R&& r, C compare = {}, Proj of = {}) {
  std::stable_sort(ranges::begin(r), ranges::end(r), web::less_by(compare, of));
  return ranges::end(r);
}

template <class R, class C = ranges::less, class Proj = identity>
bool is_sorted(R&& r, C compare = {}, Proj of = {}) {
  return std::is_sorted(ranges::begin(r), ranges::end(r), web::less_by(compare, of));
}

template <class R, class I>
void nth_element(R&& r, I nth) {
  std::nth_element(ranges::begin(r), nth, ranges::end(r));
}

template <class R, class P, class Proj = identity>
auto partition_point(R&& r, P predicate, Proj of = {}) {
  return std::partition_point(ranges::begin(r), ranges::end(r),
                              web::holds_for(predicate, of));
}

template <class R, class T, class C = ranges::less, class Proj = identity>
auto lower_bound(R&& r, const T& value, C compare = {}, Proj of = {}) {
  return std::lower_bound(
      ranges::begin(r), ranges::end(r), value, [&](auto&& a, const T& b) {
        return static_cast<bool>(
            std::invoke(compare, std::invoke(of, std::forward<decltype(a)>(a)), b));
      });
}

template <class R, class T, class C = ranges::less, class Proj = identity>
auto upper_bound(R&& r, const T& value, C compare = {}, Proj of = {}) {
  return std::upper_bound(
      ranges::begin(r), ranges::end(r), value, [&](const T& a, auto&& b) {
        return static_cast<bool>(
            std::invoke(compare, a, std::invoke(of, std::forward<decltype(b)>(b))));
      });
}

template <class R, class T>
auto equal_range(R&& r, const T& value) {
  const auto both = std::equal_range(ranges::begin(r), ranges::end(r), value);
  return ranges::subrange(both.first, both.second);
}

template <class R, class T>
bool binary_search(R&& r, const T& value) {
  return std::binary_search(ranges::begin(r), ranges::end(r), value);
}

template <class R, class C = ranges::less, class Proj = identity>
auto min_element(R&& r, C compare = {}, Proj of = {}) {
  return std::min_element(ranges::begin(r), ranges::end(r), web::less_by(compare, of));
}

template <class R, class C = ranges::less, class Proj = identity>
auto max_element(R&& r, C compare = {}, Proj of = {}) {
  return std::max_element(ranges::begin(r), ranges::end(r), web::less_by(compare, of));
}

template <class R, class C = ranges::less, class Proj = identity>
auto minmax_element(R&& r, C compare = {}, Proj of = {}) {
  const auto both =
      std::minmax_element(ranges::begin(r), ranges::end(r), web::less_by(compare, of));
  return min_max_result<decltype(both.first)>{both.first, both.second};
}

template <class R, class C = ranges::less, class Proj = identity>
auto min(R&& r, C compare = {}, Proj of = {}) {
  return *ranges::min_element(r, compare, of);
}

template <class R, class C = ranges::less, class Proj = identity>
auto max(R&& r, C compare = {}, Proj of = {}) {
  return *ranges::max_element(r, compare, of);
}

template <class R, class C = ranges::less, class Proj = identity>
auto minmax(R&& r, C compare = {}, Proj of = {}) {
  const auto both = ranges::minmax_element(r, compare, of);
  return min_max_result<std::decay_t<decltype(*both.min)>>{*both.min, *both.max};
}

template <class R, class O>
auto copy(R&& r, O out) {
  const auto end = std::copy(ranges::begin(r), ranges::end(r), out);
  return in_out_result<decltype(ranges::end(r)), O>{ranges::end(r), end};
}

template <class I, class O>
void copy_n(I first, std::iter_difference_t<I> n, O out) {
  std::copy_n(first, n, out);
}

template <class R, class O, class P, class Proj = identity>
auto copy_if(R&& r, O out, P predicate, Proj of = {}) {
  const auto end = std::copy_if(ranges::begin(r), ranges::end(r), out,
                                web::holds_for(predicate, of));
  return in_out_result<decltype(ranges::end(r)), O>{ranges::end(r), end};
}

template <class R, class O>
auto move(R&& r, O out) {
  const auto end = std::move(ranges::begin(r), ranges::end(r), out);
  return in_out_result<decltype(ranges::end(r)), O>{ranges::end(r), end};
}

template <class R, class T>
void fill(R&& r, const T& value) {
  std::fill(ranges::begin(r), ranges::end(r), value);
}

template <class R, class F>
void generate(R&& r, F make) {
  std::generate(ranges::begin(r), ranges::end(r), std::ref(make));
}

template <class R, class F, class Proj = identity>
void for_each(R&& r, F visit, Proj of = {}) {
  std::for_each(ranges::begin(r), ranges::end(r), [&](auto&& x) {
    std::invoke(visit, std::invoke(of, std::forward<decltype(x)>(x)));
  });
}

template <class R, class P, class T, class Proj = identity>
void replace_if(R&& r, P predicate, const T& value, Proj of = {}) {
  std::replace_if(ranges::begin(r), ranges::end(r), web::holds_for(predicate, of),
                  value);
}

template <class R, class I>
void rotate(R&& r, I middle) {
  std::rotate(ranges::begin(r), middle, ranges::end(r));
}

template <class R>
void reverse(R&& r) {
  std::reverse(ranges::begin(r), ranges::end(r));
}

template <class R>
auto distance(R&& r) {
  return std::distance(ranges::begin(r), ranges::end(r));
}

template <class R>
auto unique(R&& r) {
  const auto end = std::unique(ranges::begin(r), ranges::end(r));
  return ranges::subrange(end, ranges::end(r));
}

template <class A, class B, class P = ranges::equal_to, class ProjA = identity,
          class ProjB = identity>
bool equal(A&& a, B&& b, P same = {}, ProjA of_a = {}, ProjB of_b = {}) {
  return std::equal(ranges::begin(a), ranges::end(a), ranges::begin(b), ranges::end(b),
                    [&](auto&& x, auto&& y) {
                      return static_cast<bool>(std::invoke(same, std::invoke(of_a, x),
                                                           std::invoke(of_b, y)));
                    });
}

template <class R, class O, class F>
requires ranges::range<R>
auto transform(R&& r, O out, F f) {
  return std::transform(ranges::begin(r), ranges::end(r), out,
                        [&](auto&& x) -> decltype(auto) {
                          return std::invoke(f, std::forward<decltype(x)>(x));
                        });
}

template <class A, class B, class O, class F>
requires ranges::range<A> && ranges::range<B>
auto transform(A&& a, B&& b, O out, F f) {
  auto second = ranges::begin(b);
  const auto end = ranges::end(b);
  for (auto&& x : a) {
    if (second == end) break;
    *out = std::invoke(f, x, *second);
    ++out;
    ++second;
  }
  return out;
}

}  // namespace ranges
}  // namespace std
