#pragma once

// Forward kinematics of a single joint, for double or packs of doubles. Like lane_math.h it is local to each source
// file that includes it. State and the kernels in lanes use it.

#include "kinegraph/kinematics/constant_rotation.h"
#include "kinegraph/kinematics/motion_kind.h"
#include "kinegraph/math/lane_math.h"

namespace kinegraph::lanes {

namespace {

constexpr int kPerPlace = 12;  ///< numbers of a pose in memory: the columns of R, then p

/// A pose of vectors V: Vec3<S>, or Packed3.
template <class V>
struct Place {
  V R[3];  ///< columns
  V p;
};

template <class V>
V loadVector(const typename V::Scalar* from) {
  V vector;
  load(from, vector);
  return vector;
}

template <class V>
void storePlace(const Place<V>& X, typename V::Scalar* to) {
  for (int k = 0; k < 3; ++k) store(X.R[k], to + 3 * k);
  store(X.p, to + 9);
}

/// Multiplies X by a constant rotation, given by its columns.
template <class V>
[[gnu::always_inline]] inline void rotateBy(const double* R, Place<V>& X) {
  const V columns[3] = {X.R[0], X.R[1], X.R[2]};
  for (int k = 0; k < 3; ++k) X.R[k] = R[3 * k] * columns[0] + R[3 * k + 1] * columns[1] + R[3 * k + 2] * columns[2];
}

/// Returns the pose at `from` times the constant one (R, p). `rotation` describes the structure of R.
template <class V>
[[gnu::always_inline]] inline Place<V> moved(const typename V::Scalar* from, const ConstantRotation& rotation,
                                             const double* R, const double* p) {
  const auto column = [from](int k) __attribute__((always_inline)) { return loadVector<V>(from + 3 * k); };
  Place<V> X;
  X.p = column(3);
  for (int k = 0; k < 3; ++k) {
    if (p[k] != 0.) X.p = X.p + p[k] * column(k);
  }
  if (rotation.kind == ConstantRotation::quarters) {
    for (int k = 0; k < 3; ++k) X.R[k] = rotation.sign[k] * column(rotation.column[k]);
  } else {
    for (int k = 0; k < 3; ++k) X.R[k] = column(k);
    if (rotation.kind == ConstantRotation::general) rotateBy(R, X);
  }
  return X;
}

template <int Axis, class V, class Sink>
[[gnu::always_inline]] inline void rotateAboutAxis(double factor, typename V::Scalar sine, typename V::Scalar cosine,
                                                   Place<V>& X, const Sink& sink) {
  constexpr int i = (Axis + 1) % 3, j = (Axis + 2) % 3;
  sink.rotates(0, factor * X.R[Axis], X.p);
  const V a = X.R[i], b = X.R[j];
  X.R[i] = cosine * a + sine * b;
  X.R[j] = cosine * b - sine * a;
}

template <class V, class Sink>
[[gnu::always_inline]] inline void rotateAboutAxis(int axis, double factor, typename V::Scalar sine,
                                                   typename V::Scalar cosine, Place<V>& X, const Sink& sink) {
  if (axis == 0) {
    rotateAboutAxis<0>(factor, sine, cosine, X, sink);
  } else if (axis == 1) {
    rotateAboutAxis<1>(factor, sine, cosine, X, sink);
  } else {
    rotateAboutAxis<2>(factor, sine, cosine, X, sink);
  }
}

/// Moves X by one step of a joint with the dofs q. `angle(x)` returns sine and cosine of x as a pair. `sink` receives
/// the motion of dof k of the step per unit of its velocity: `rotates(k, angular velocity, point on the axis)`,
/// `translates(k, velocity)` or `rests(k)`.
template <class V, class Angle, class Sink>
[[gnu::always_inline]] inline void moveBy(MotionKind kind, int axis, double factor, const double* about,
                                          const typename V::Scalar* q, const Angle& angle, Place<V>& X, Sink sink) {
  using S = typename V::Scalar;
  switch (kind) {
    case MotionKind::translate: {
      const V along = factor * (axis == 0 ? X.R[0] : axis == 1 ? X.R[1] : X.R[2]);
      sink.translates(0, along);
      X.p = X.p + q[0] * along;
      break;
    }
    case MotionKind::rotate: {
      const auto [sine, cosine] = angle(factor * q[0]);
      rotateAboutAxis(axis, factor, sine, cosine, X, sink);
      break;
    }
    case MotionKind::rotateAbout: {  // each column c becomes cos c + sin (axis x c) + (1 - cos) (axis . c) axis
      const auto [sine, cosine] = angle(factor * q[0]);
      const V world = combine(X.R, about);
      sink.rotates(0, factor * world, X.p);
      const S rest = 1. - cosine;
      for (int k = 0; k < 3; ++k) X.R[k] = cosine * X.R[k] + sine * cross(world, X.R[k]) + (about[k] * rest) * world;
      break;
    }
    case MotionKind::quaternion: {
      // w = 2 vec(dq * conj(q)) / |q|: the component of dq along q only changes the norm.
      const S norm = larger(root(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]), all<S>(1e-100)),
              over = 1. / norm;
      const S w = over * q[0], x = over * q[1], y = over * q[2], z = over * q[3], rate = 2. * over;
      const auto world = [&X](S a, S b, S c) { return a * X.R[0] + b * X.R[1] + c * X.R[2]; };
      sink.rotates(0, -rate * world(x, y, z), X.p);
      sink.rotates(1, rate * world(w, z, -y), X.p);
      sink.rotates(2, rate * world(-z, w, x), X.p);
      sink.rotates(3, rate * world(y, -x, w), X.p);
      const V a = world(1. - 2. * (y * y + z * z), 2. * (x * y + w * z), 2. * (x * z - w * y));
      const V b = world(2. * (x * y - w * z), 1. - 2. * (x * x + z * z), 2. * (y * z + w * x));
      const V c = world(2. * (x * z + w * y), 2. * (y * z - w * x), 1. - 2. * (x * x + y * y));
      X.R[0] = a, X.R[1] = b, X.R[2] = c;
      break;
    }
    case MotionKind::circle: {  // rotates by twice the angle of (c, s)
      const S over = 1. / larger(q[0] * q[0] + q[1] * q[1], all<S>(1e-100)), rate = 2. * over;
      sink.rotates(0, (-rate * q[1]) * X.R[2], X.p);
      sink.rotates(1, (rate * q[0]) * X.R[2], X.p);
      const S cosine = over * (q[0] * q[0] - q[1] * q[1]), sine = rate * (q[0] * q[1]);
      const V a = X.R[0], b = X.R[1];
      X.R[0] = cosine * a + sine * b;
      X.R[1] = cosine * b - sine * a;
      break;
    }
    case MotionKind::time:
      sink.rests(0);
      break;
  }
}

}  // namespace

}  // namespace kinegraph::lanes
