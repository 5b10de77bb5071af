#pragma once

// Formulas of features of frame poses, for numbers S that are double or packs of doubles (one configuration per lane).
// Like lane_math.h they are local to each source file that includes them. Features evaluate them for a State
// (features/eval_formula.h), the kernels in lanes for many configurations (lane_kernel_body.h).
//
// A formula has `kRows` rows. `value` computes them. `rate` computes their derivatives for a motion of frame a, or of b
// if `of_b`, which has an `angular` velocity and a `velocityAt(point)`. A State stores the velocity at the world's
// origin, lanes store a point on the axis. The Jacobians of both therefore agree up to rounding only.
//
// Features of a State use other formulas in three cases, with other last bits: quaternions and axes relative to a frame
// (features/orientation.cpp), and the value of relative positions (features/position.cpp). The reasons are given there.

#include "kinegraph/math/lane_math.h"

namespace kinegraph::lanes {

namespace {

/// Returns the transpose of R, given by its columns, times a.
template <class S>
Vec3<S> inFrame(const Vec3<S>* R, const Vec3<S>& a) {
  return {dot(R[0], a), dot(R[1], a), dot(R[2], a)};
}

/// y = p
template <class S>
struct PositionRows {
  static constexpr int kRows = 3;
  Vec3<S> p;

  void value(S* y) const { store(p, y); }
  template <class Motion>
  void rate(const Motion& motion, bool, S* to) const {
    store(motion.velocityAt(p), to);
  }
};

/// y = p_a - p_b
template <class S>
struct OffsetRows {
  static constexpr int kRows = 3;
  Vec3<S> p_a, p_b;

  void value(S* y) const { store(p_a - p_b, y); }
  template <class Motion>
  void rate(const Motion& motion, bool of_b, S* to) const {
    const Vec3<S> velocity = motion.velocityAt(of_b ? p_b : p_a);
    store(of_b ? -velocity : velocity, to);
  }
};

/// y = R_b^T (p_a - p_b): a motion of b alone moves a in the opposite direction relative to b.
template <class S>
struct RelativePositionRows {
  static constexpr int kRows = 3;
  Vec3<S> p_a, R_b[3], p_b;

  void value(S* y) const { store(inFrame(R_b, p_a - p_b), y); }
  template <class Motion>
  void rate(const Motion& motion, bool of_b, S* to) const {
    const Vec3<S> velocity = inFrame(R_b, motion.velocityAt(p_a));
    store(of_b ? -velocity : velocity, to);
  }
};

/// y = u, a unit vector fixed to frame a
template <class S>
struct AxisRows {
  static constexpr int kRows = 3;
  Vec3<S> u;

  void value(S* y) const { store(u, y); }
  template <class Motion>
  void rate(const Motion& motion, bool, S* to) const {
    store(cross(motion.angular, u), to);
  }
};

/// y = u - v, with v fixed to frame b
template <class S>
struct AxisOffsetRows {
  static constexpr int kRows = 3;
  Vec3<S> u, v;

  void value(S* y) const { store(u - v, y); }
  template <class Motion>
  void rate(const Motion& motion, bool of_b, S* to) const {
    store(of_b ? cross(v, motion.angular) : cross(motion.angular, u), to);
  }
};

/// y = R_b^T u
template <class S>
struct RelativeAxisRows {
  static constexpr int kRows = 3;
  Vec3<S> u, R_b[3];

  void value(S* y) const { store(inFrame(R_b, u), y); }
  template <class Motion>
  void rate(const Motion& motion, bool of_b, S* to) const {
    store(inFrame(R_b, of_b ? cross(u, motion.angular) : cross(motion.angular, u)), to);
  }
};

/// y = u . v of axes of a and b
template <class S>
struct AxisProductRows {
  static constexpr int kRows = 1;
  Vec3<S> across;
  S product;

  AxisProductRows(const Vec3<S>& u, const Vec3<S>& v) : across(cross(u, v)), product(dot(u, v)) {}
  void value(S* y) const { *y = product; }
  template <class Motion>
  void rate(const Motion& motion, bool of_b, S* to) const {
    *to = dot(across, of_b ? -motion.angular : motion.angular);
  }
};

/// Velocity of a point p of frame a, and the frame's angular velocity. There are no values.
template <class S>
struct TwistRows {
  static constexpr int kRows = 6;
  Vec3<S> p;

  template <class Motion>
  void rate(const Motion& motion, bool, S* to) const {
    store(motion.velocityAt(p), to);
    store(motion.angular, to + 3);
  }
};

template <class S>
struct QuaternionOf {
  S w;
  Vec3<S> v;
};

/// Converts a rotation matrix, given by its columns. The largest component, or w if the trace is positive, is positive.
template <class S>
QuaternionOf<S> toQuaternion(const Vec3<S>* R) {
  const S trace = R[0].x + R[1].y + R[2].z;
  const auto w_leads = trace > 0.;
  const auto y_over_x = R[1].y > R[0].x;
  const auto z_leads = R[2].z > (y_over_x ? R[1].y : R[0].x);
  const S x_square = ((R[0].x - R[1].y) - R[2].z), y_square = ((R[1].y - R[2].z) - R[0].x),
          z_square = ((R[2].z - R[0].x) - R[1].y);
  const S twice = root((w_leads ? trace : z_leads ? z_square : y_over_x ? y_square : x_square) + 1.);
  const S lead = .5 * twice, over = .5 / twice;
  const Vec3<S> odd = over * Vec3<S>{R[1].z - R[2].y, R[2].x - R[0].z, R[0].y - R[1].x};
  const Vec3<S> even = over * Vec3<S>{R[1].z + R[2].y, R[2].x + R[0].z, R[0].y + R[1].x};  // yz, xz, xy
  QuaternionOf<S> q;
  q.w = w_leads ? lead : z_leads ? odd.z : y_over_x ? odd.y : odd.x;
  q.v.x = w_leads ? odd.x : z_leads ? even.y : y_over_x ? even.z : lead;
  q.v.y = w_leads ? odd.y : z_leads ? even.x : y_over_x ? lead : even.z;
  q.v.z = w_leads ? odd.z : z_leads ? lead : y_over_x ? even.x : even.y;
  return q;
}

template <class Mask, class S>
QuaternionOf<S> negated(Mask mask, const QuaternionOf<S>& q) {
  return {mask ? -q.w : q.w, choose(mask, -q.v, q.v)};
}

/// Returns the sign for which the first nonzero component is positive.
template <class S>
QuaternionOf<S> canonical(const QuaternionOf<S>& q) {
  const auto z = q.v.z < 0.;
  const auto y = (q.v.y < 0.) | ((q.v.y == 0.) & z);
  const auto x = (q.v.x < 0.) | ((q.v.x == 0.) & y);
  return negated((q.w < 0.) | ((q.w == 0.) & x), q);
}

/// a* b
template <class S>
QuaternionOf<S> between(const QuaternionOf<S>& a, const QuaternionOf<S>& b) {
  return {a.w * b.w + dot(a.v, b.v), a.w * b.v - b.w * a.v - cross(a.v, b.v)};
}

template <class S>
S inner(const QuaternionOf<S>& a, const QuaternionOf<S>& b) {
  return a.w * b.w + dot(a.v, b.v);
}

template <class S>
void storeQuaternion(const QuaternionOf<S>& q, S* y) {
  y[0] = q.w, store(q.v, y + 1);
}

/// dq / dt for an angular velocity w
template <class S>
void storeRates(const QuaternionOf<S>& q, const Vec3<S>& w, S* to) {
  to[0] = -.5 * dot(q.v, w);
  store(.5 * (q.w * w - cross(q.v, w)), to + 1);
}

/// y = q_a
template <class S>
struct QuaternionRows {
  static constexpr int kRows = 4;
  QuaternionOf<S> q;

  void value(S* y) const { storeQuaternion(q, y); }
  template <class Motion>
  void rate(const Motion& motion, bool, S* to) const {
    storeRates(q, motion.angular, to);
  }
};

/// y = q_a - q_b, with the sign of q_b that is nearer to q_a
template <class S>
struct QuaternionOffsetRows {
  static constexpr int kRows = 4;
  QuaternionOf<S> q_a, q_b;

  QuaternionOffsetRows(const QuaternionOf<S>& a, const QuaternionOf<S>& b)
      : q_a(a), q_b(negated(inner(a, b) < 0., b)) {}
  void value(S* y) const { storeQuaternion<S>({q_a.w - q_b.w, q_a.v - q_b.v}, y); }
  template <class Motion>
  void rate(const Motion& motion, bool of_b, S* to) const {
    if (of_b) {
      storeRates(q_b, -motion.angular, to);
    } else {
      storeRates(q_a, motion.angular, to);
    }
  }
};

/// y = q_b* q_a
template <class S>
struct RelativeQuaternionRows {
  static constexpr int kRows = 4;
  QuaternionOf<S> q;
  Vec3<S> R_b[3];

  void value(S* y) const { storeQuaternion(q, y); }
  template <class Motion>
  void rate(const Motion& motion, bool of_b, S* to) const {
    const Vec3<S> w = inFrame(R_b, motion.angular);
    storeRates(q, of_b ? -w : w, to);
  }
};

}  // namespace

}  // namespace kinegraph::lanes
