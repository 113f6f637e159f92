// Numbers that carry their derivatives (forward mode), so that an equation is written once and its
// Jacobian follows. `Directions` is the set of variables, one bit each, that a number depends on:
// it is part of the type, so that slopes known to be zero cost nothing.
//
//   auto u = variable<0>(1.5), v = variable<1>(0.2);
//   auto f = u * v + 2.0 * u;         // Dual<double, 0b11>
//   slope<0>(f)                       // 2.2
//
// Value is double, or a vector of doubles that knows +, -, *, < and ?: (tracker's Pack). Constants
// mix freely. Where a number bends (abs, max) the slope is that of the branch taken.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#define OTTER_NAV_INLINE [[gnu::always_inline]] inline

namespace otter_nav {

using Directions = std::uint32_t;

constexpr int countOf(Directions set) {
  int count = 0;
  for (; set != 0; set &= set - 1) {
    ++count;
  }
  return count;
}
// The place of direction `d` among those of the set.
constexpr int slotOf(Directions set, int d) {
  return countOf(set & ((Directions{1} << d) - 1U));
}
constexpr int directionAt(Directions set, int place) {
  int d = 0;
  while ((set >> d & 1U) == 0U || slotOf(set, d) != place) {
    ++d;
  }
  return d;
}

template <typename Value, Directions Set>
struct Dual {
  static_assert(Set != 0, "a number without directions is a Value");
  Value value;
  Value slopes[countOf(Set)];

  Dual() = default;
  // A constant.
  // NOLINTNEXTLINE(google-explicit-constructor): constants mix freely.
  constexpr Dual(Value constant) : value(constant), slopes{} {}
};

template <int Direction, typename Value>
[[nodiscard]] OTTER_NAV_INLINE Dual<Value, Directions{1} << Direction> variable(Value value) {
  Dual<Value, Directions{1} << Direction> x;
  x.value = value;
  x.slopes[0] = Value{} + 1.0;
  return x;
}

// The value without its slopes.
template <typename Value>
[[nodiscard]] OTTER_NAV_INLINE Value valueOf(const Value& x) {
  return x;
}
template <typename Value, Directions Set>
[[nodiscard]] OTTER_NAV_INLINE Value valueOf(const Dual<Value, Set>& x) {
  return x.value;
}
// d x / d direction.
template <int Direction, typename Value, Directions Set>
[[nodiscard]] OTTER_NAV_INLINE Value slope(const Dual<Value, Set>& x) {
  if constexpr ((Set >> Direction & 1U) != 0U) {
    return x.slopes[slotOf(Set, Direction)];
  } else {
    return Value{};
  }
}

namespace dual {

template <typename T>
struct IsDual : std::false_type {};
template <typename Value, Directions Set>
struct IsDual<Dual<Value, Set>> : std::true_type {};
template <typename T>
using IfNumber = std::enable_if_t<!IsDual<T>::value>;

template <Directions Set, std::size_t... Places, typename F>
OTTER_NAV_INLINE void each(std::index_sequence<Places...> /*places*/, const F& f) {
  (f(std::integral_constant<int, directionAt(Set, static_cast<int>(Places))>{}), ...);
}

// A function's value with its derivatives by one argument, or by two.
template <typename Value, Directions Set>
[[nodiscard]] OTTER_NAV_INLINE Dual<Value, Set> chain(Value value, Value by_x,
                                                      const Dual<Value, Set>& x) {
  Dual<Value, Set> f;
  f.value = value;
  for (int i = 0; i < countOf(Set); ++i) {
    f.slopes[i] = by_x * x.slopes[i];
  }
  return f;
}
template <typename Value, Directions A, Directions B, typename OnlyA, typename OnlyB, typename Both>
[[nodiscard]] OTTER_NAV_INLINE Dual<Value, (A | B)> merge(Value value, const Dual<Value, A>& a,
                                                          const Dual<Value, B>& b,
                                                          const OnlyA& only_a, const OnlyB& only_b,
                                                          const Both& both) {
  constexpr Directions kSet = A | B;
  Dual<Value, kSet> f;
  f.value = value;
  each<kSet>(
      std::make_index_sequence<countOf(kSet)>{}, [&](auto direction)
                                                     __attribute__((always_inline)) {
                                                       constexpr int d = decltype(direction)::value;
                                                       constexpr bool in_a = (A >> d & 1U) != 0U;
                                                       constexpr bool in_b = (B >> d & 1U) != 0U;
                                                       Value& out = f.slopes[slotOf(kSet, d)];
                                                       if constexpr (in_a && in_b) {
                                                         out = both(a.slopes[slotOf(A, d)],
                                                                    b.slopes[slotOf(B, d)]);
                                                       } else if constexpr (in_a) {
                                                         out = only_a(a.slopes[slotOf(A, d)]);
                                                       } else {
                                                         out = only_b(b.slopes[slotOf(B, d)]);
                                                       }
                                                     });
  return f;
}

}  // namespace dual

template <typename V, Directions A, Directions B>
[[nodiscard]] OTTER_NAV_INLINE Dual<V, (A | B)> operator+(const Dual<V, A>& a,
                                                          const Dual<V, B>& b) {
  return dual::merge<V, A, B>(
      a.value + b.value, a, b, [](V x) { return x; }, [](V y) { return y; },
      [](V x, V y) { return x + y; });
}
template <typename V, Directions A, Directions B>
[[nodiscard]] OTTER_NAV_INLINE Dual<V, (A | B)> operator-(const Dual<V, A>& a,
                                                          const Dual<V, B>& b) {
  return dual::merge<V, A, B>(
      a.value - b.value, a, b, [](V x) { return x; }, [](V y) { return -y; },
      [](V x, V y) { return x - y; });
}
template <typename V, Directions A, Directions B>
[[nodiscard]] OTTER_NAV_INLINE Dual<V, (A | B)> operator*(const Dual<V, A>& a,
                                                          const Dual<V, B>& b) {
  return dual::merge<V, A, B>(
      a.value * b.value, a, b, [&](V x) { return x * b.value; }, [&](V y) { return a.value * y; },
      [&](V x, V y) { return x * b.value + a.value * y; });
}
template <typename V, Directions A>
[[nodiscard]] OTTER_NAV_INLINE Dual<V, A> inverse(const Dual<V, A>& x) {
  const V inverse_value = 1.0 / x.value;
  return dual::chain(inverse_value, -inverse_value * inverse_value, x);
}
[[nodiscard]] OTTER_NAV_INLINE double inverse(double x) {
  return 1.0 / x;
}
template <typename V, Directions A, Directions B>
[[nodiscard]] OTTER_NAV_INLINE Dual<V, (A | B)> operator/(const Dual<V, A>& a,
                                                          const Dual<V, B>& b) {
  return a * inverse(b);
}
template <typename V, Directions A>
[[nodiscard]] OTTER_NAV_INLINE Dual<V, A> operator-(Dual<V, A> x) {
  x.value = -x.value;
  for (V& s : x.slopes) {
    s = -s;
  }
  return x;
}

template <typename V, Directions A, typename T, typename = dual::IfNumber<T>>
[[nodiscard]] OTTER_NAV_INLINE Dual<V, A> operator+(Dual<V, A> x, const T& c) {
  x.value = x.value + c;
  return x;
}
template <typename V, Directions A, typename T, typename = dual::IfNumber<T>>
[[nodiscard]] OTTER_NAV_INLINE Dual<V, A> operator+(const T& c, Dual<V, A> x) {
  x.value = c + x.value;
  return x;
}
template <typename V, Directions A, typename T, typename = dual::IfNumber<T>>
[[nodiscard]] OTTER_NAV_INLINE Dual<V, A> operator-(Dual<V, A> x, const T& c) {
  x.value = x.value - c;
  return x;
}
template <typename V, Directions A, typename T, typename = dual::IfNumber<T>>
[[nodiscard]] OTTER_NAV_INLINE Dual<V, A> operator-(const T& c, const Dual<V, A>& x) {
  return c + -x;
}
template <typename V, Directions A, typename T, typename = dual::IfNumber<T>>
[[nodiscard]] OTTER_NAV_INLINE Dual<V, A> operator*(Dual<V, A> x, const T& c) {
  x.value = x.value * c;
  for (V& s : x.slopes) {
    s = s * c;
  }
  return x;
}
template <typename V, Directions A, typename T, typename = dual::IfNumber<T>>
[[nodiscard]] OTTER_NAV_INLINE Dual<V, A> operator*(const T& c, const Dual<V, A>& x) {
  return x * c;
}
template <typename V, Directions A, typename T, typename = dual::IfNumber<T>>
[[nodiscard]] OTTER_NAV_INLINE Dual<V, A> operator/(const Dual<V, A>& x, const T& c) {
  return x * (1.0 / c);
}

template <typename V, Directions A, typename T, typename = dual::IfNumber<T>>
[[nodiscard]] OTTER_NAV_INLINE bool operator<(const Dual<V, A>& x, const T& c) {
  return x.value < c;
}

// |x| x, the law of quadratic drag, with its slope 2 |x|.
template <typename V>
[[nodiscard]] OTTER_NAV_INLINE V absoluteOf(const V& x) {
  if constexpr (std::is_floating_point_v<V>) {
    return std::abs(x);
  } else {
    return x < 0.0 ? -x : x;
  }
}
template <typename V>
[[nodiscard]] OTTER_NAV_INLINE V signedSquare(const V& x) {
  return absoluteOf(x) * x;
}
template <typename V, Directions A>
[[nodiscard]] OTTER_NAV_INLINE Dual<V, A> signedSquare(const Dual<V, A>& x) {
  const V size = absoluteOf(x.value);
  return dual::chain<V, A>(size * x.value, 2.0 * size, x);
}

}  // namespace otter_nav
