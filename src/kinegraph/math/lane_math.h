#pragma once

// Arithmetic for one scalar type S that is double or a pack of doubles (a GCC vector type), one problem per lane.
//
// All definitions are local to the including source file: files that are compiled for wider registers must not share
// inline functions with the rest of the library. CMakeLists.txt disables fused multiply-add for these files, to get the
// same bits for all widths.

#include <type_traits>
#include <utility>

namespace kinegraph::lanes {

namespace {

constexpr double kPi = 3.14159265358979323846;

template <int Width>
struct PackOf {
  typedef double Type __attribute__((vector_size(Width * sizeof(double))));
};
template <int Width>
using Pack = typename PackOf<Width>::Type;

template <class S>
constexpr int kWidth = int(sizeof(S) / sizeof(double));

template <class S>
S all(double value) {
  return S{} + value;
}
template <class S>
S smaller(S a, S b) {
  return a < b ? a : b;
}
template <class S>
S larger(S a, S b) {
  return a > b ? a : b;
}
template <class S>
S magnitude(S a) {
  return a < S{} ? -a : a;
}

/// Returns half of a pack; `begin` is its first lane.
template <class Mask, int... Lane>
[[gnu::always_inline]] inline auto half(Mask mask, int begin, std::integer_sequence<int, Lane...>) {
  constexpr int kCount = sizeof...(Lane);
  return begin == 0 ? __builtin_shufflevector(mask, mask, Lane...)
                    : __builtin_shufflevector(mask, mask, kCount + Lane...);
}

/// Whether a lane of a comparison is set.
inline bool any(bool one) { return one; }
template <class Mask>
[[gnu::always_inline]] inline bool any(Mask mask) {
  constexpr int kHalf = kWidth<Mask> / 2;
  if constexpr (kHalf == 1) {
    return (mask[0] | mask[1]) != 0;
  } else {
    constexpr std::make_integer_sequence<int, kHalf> lanes;
    return any(half(mask, 0, lanes) | half(mask, kHalf, lanes));
  }
}

/// Returns the least number of a pack.
inline double leastOf(double one) { return one; }
template <class S>
[[gnu::always_inline]] inline double leastOf(S pack) {
  constexpr int kHalf = kWidth<S> / 2;
  if constexpr (kHalf == 1) {
    return smaller(double(pack[0]), double(pack[1]));
  } else {
    constexpr std::make_integer_sequence<int, kHalf> lanes;
    return leastOf(smaller(half(pack, 0, lanes), half(pack, kHalf, lanes)));
  }
}

inline double root(double a) { return __builtin_sqrt(a); }
template <class S>
S root(S a) {
  for (int i = 0; i < kWidth<S>; ++i) a[i] = __builtin_sqrt(a[i]);
  return a;
}

template <class S>
struct Vec3 {
  using Scalar = S;
  S x, y, z;
};

template <class S>
Vec3<S> operator+(const Vec3<S>& a, const Vec3<S>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class S>
Vec3<S> operator-(const Vec3<S>& a, const Vec3<S>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class S>
Vec3<S> operator-(const Vec3<S>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class S>
Vec3<S> operator*(const S& s, const Vec3<S>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class S>
requires(!std::is_same_v<S, double>) Vec3<S>
operator*(double s, const Vec3<S>& a) { return {s * a.x, s * a.y, s * a.z}; }
template <class S>
S dot(const Vec3<S>& a, const Vec3<S>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class S>
Vec3<S> cross(const Vec3<S>& a, const Vec3<S>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Mask, class S>
Vec3<S> choose(Mask mask, const Vec3<S>& a, const Vec3<S>& b) {
  return {mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z};
}

template <class S>
Vec3<S> load(const S* from) {
  return {from[0], from[1], from[2]};
}
template <class S>
void load(const S* from, Vec3<S>& to) {
  to = load(from);
}
template <class S>
void store(const Vec3<S>& a, S* to) {
  to[0] = a.x, to[1] = a.y, to[2] = a.z;
}

/// A vector of one problem, in registers of every machine, with the operations of Vec3<double>, entry by entry. Both
/// parts have equal sizes, for fast loads after stores.
struct Packed3 {
  using Scalar = double;
  Pack<2> xy;
  Pack<2> z;  ///< z and 0
};

inline Packed3 operator+(const Packed3& a, const Packed3& b) { return {a.xy + b.xy, a.z + b.z}; }
inline Packed3 operator-(const Packed3& a, const Packed3& b) { return {a.xy - b.xy, a.z - b.z}; }
inline Packed3 operator*(double s, const Packed3& a) { return {s * a.xy, s * a.z}; }
inline Packed3 cross(const Packed3& a, const Packed3& b) {
  const Pack<2> a_yx = __builtin_shufflevector(a.xy, a.xy, 1, 0), b_yx = __builtin_shufflevector(b.xy, b.xy, 1, 0);
  const Pack<2> minus_y = a_yx * b.z[0] - a.z[0] * b_yx, products = a.xy * b_yx;
  return {Pack<2>{minus_y[0], -minus_y[1]}, Pack<2>{products[0] - products[1], 0.}};
}
inline void load(const double* from, Packed3& to) { to = {Pack<2>{from[0], from[1]}, Pack<2>{from[2], 0.}}; }
inline void store(const Packed3& a, double* to) { to[0] = a.xy[0], to[1] = a.xy[1], to[2] = a.z[0]; }

/// Returns sum_k column k * weights[k]; weights of 0 are frequent, and equal in all lanes.
template <class V>
V combine(const V* columns, const double* weights) {
  V sum{};
  for (int k = 0; k < 3; ++k) {
    if (weights[k] != 0.) sum = sum + weights[k] * columns[k];
  }
  return sum;
}

constexpr double kMostAngle = 1e5;  ///< rad

/// Computes sine and cosine of the angles (rad) in a pack, by quadrants and Taylor series on [-pi/4, pi/4]. The error
/// is 2e-16 within kMostAngle; larger angles would lose digits.
template <class S>
[[gnu::always_inline]] inline void sineAndCosine(S angle, S& sine, S& cosine) {
  using Mask = decltype(angle < angle);
  constexpr double kRound = 6755399441055744.;  // 1.5 * 2^52: adding it rounds to integers
  const S shifted = angle * (2. / kPi) + kRound;
  const S quarters = shifted - kRound;
  const S r = (angle - quarters * 1.5707963267341256) - quarters * 6.077100506506192e-11;  // pi/2 in two parts
  const S s = r * r;
  const S sin_r =
      r + r * s *
              (-1. / 6 +
               s * (1. / 120 +
                    s * (-1. / 5040 + s * (1. / 362880 + s * (-1. / 39916800 +
                                                              s * (1. / 6227020800. - s * (1. / 1307674368000.)))))));
  const S cos_r =
      1. +
      s * (-.5 + s * (1. / 24 + s * (-1. / 720 +
                                     s * (1. / 40320 + s * (-1. / 3628800 + s * (1. / 479001600. +
                                                                                 s * (-1. / 87178291200. +
                                                                                      s * (1. / 20922789888000.))))))));
  const Mask quadrant = (Mask)shifted;
  const Mask swaps = (quadrant & 1) != 0;
  const S a = swaps ? cos_r : sin_r, b = swaps ? sin_r : cos_r;
  sine = (quadrant & 2) != 0 ? -a : a;
  cosine = ((quadrant + 1) & 2) != 0 ? -b : b;
}

/// Computes sine and cosine of all angles; slow beyond kMostAngle.
template <class S>
[[gnu::noinline]] void sineAndCosineOfAny(S angle, S& sine, S& cosine) {
  sineAndCosine(angle, sine, cosine);
  for (int i = 0; i < kWidth<S>; ++i) {
    if (magnitude(angle[i]) > kMostAngle) sine[i] = __builtin_sin(angle[i]), cosine[i] = __builtin_cos(angle[i]);
  }
}

}  // namespace

}  // namespace kinegraph::lanes
