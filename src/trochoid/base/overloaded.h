#pragma once

namespace trochoid::base {

/// One callable of several, for std::visit: without a default among them, an alternative
/// that none of them takes does not compile.
template <class... Callables>
struct Overloaded : Callables... {
  using Callables::operator()...;
};
template <class... Callables>
Overloaded(Callables...) -> Overloaded<Callables...>;

}  // namespace trochoid::base
