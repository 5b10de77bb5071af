#include "kinegraph/kinematics/state_kernel_body.h"

namespace kinegraph::lanes {

namespace {

/// A vector as Packed3 in one register; the last number is 0.
struct Wide3 {
  using Scalar = double;
  Pack<4> xyz;
};

inline Wide3 operator+(const Wide3& a, const Wide3& b) { return {a.xyz + b.xyz}; }
inline Wide3 operator-(const Wide3& a, const Wide3& b) { return {a.xyz - b.xyz}; }
inline Wide3 operator*(double s, const Wide3& a) { return {s * a.xyz}; }
inline Wide3 cross(const Wide3& a, const Wide3& b) {
  const Pack<4> a_yzx = __builtin_shufflevector(a.xyz, a.xyz, 1, 2, 0, 3),
                b_yzx = __builtin_shufflevector(b.xyz, b.xyz, 1, 2, 0, 3);
  const Pack<4> zxy = a.xyz * b_yzx - a_yzx * b.xyz;
  return {__builtin_shufflevector(zxy, zxy, 1, 2, 0, 3)};
}
inline void load(const double* from, Wide3& to) { to = {Pack<4>{from[0], from[1], from[2], 0.}}; }
inline void store(const Wide3& a, double* to) {
  __builtin_memcpy(to, &a.xyz, sizeof(a.xyz));
}  // stores in order: see StateArrays

}  // namespace

void updateStateAvx2(const StateArrays& state) { updateState<Wide3, 4>(state); }

}  // namespace kinegraph::lanes
