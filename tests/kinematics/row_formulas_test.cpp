#include "kinegraph/kinematics/row_formulas.h"

#include <gtest/gtest.h>

#include <functional>

#include "kinegraph/common/random.h"
#include "kinegraph/math/pose.h"

namespace kinegraph::lanes {
namespace {

/// Two frames that move as screws, at time t.
struct Frames {
  RigidTransform a, b;
};

using Vec = Vec3<double>;

Vec vec(const Vector3d& a) { return {a[0], a[1], a[2]}; }

/// Rotation with angular velocity w about a point, in the world.
struct Turn {
  Vec angular, point;
  Vec velocityAt(const Vec& at) const { return cross(angular, at - point); }
};

struct Moving {
  Frames start;
  Vector3d w, point;
  bool of_b;

  Frames at(double t) const {
    const Matrix3d R = Eigen::AngleAxisd(t * w.norm(), w.normalized()).toRotationMatrix();
    const RigidTransform X{R, point - R * point};
    return {of_b ? start.a : X * start.a, of_b ? X * start.b : start.b};
  }
};

RigidTransform drawFrame(Rng& rng) {
  const Quaterniond q(rng.normal(), rng.normal(), rng.normal(), rng.normal());
  return {q.normalized().toRotationMatrix(), Vector3d(rng.normal(), rng.normal(), rng.normal())};
}

Moving drawMotion(Rng& rng, bool of_b) {
  const auto vector = [&] { return Vector3d(rng.normal(), rng.normal(), rng.normal()); };
  return {{drawFrame(rng), drawFrame(rng)}, vector(), vector(), of_b};
}

/// Rates of a formula are the derivatives of its values, for motions of either frame.
template <class Make>
void checkRates(const Make& make, bool has_b) {
  using Formula = decltype(make(Frames{}));
  Rng rng(7);
  for (int sample = 0; sample < 50; ++sample) {
    const Moving moving = drawMotion(rng, has_b && sample % 2 == 1);
    const auto value = [&](double t) {
      Eigen::Matrix<double, Formula::kRows, 1> y;
      make(moving.at(t)).value(y.data());
      return y;
    };
    double rate[Formula::kRows];
    make(moving.at(0.)).rate(Turn{vec(moving.w), vec(moving.point)}, moving.of_b, rate);
    constexpr double h = 1e-5;
    auto difference = (value(h) - value(-h)).eval();
    if (difference.norm() > .1) continue;  // the sign of a quaternion has changed
    difference /= 2. * h;
    for (int r = 0; r < Formula::kRows; ++r) EXPECT_NEAR(rate[r], difference[r], 1e-7) << "row " << r;
  }
}

struct Columns {
  Vec R[3];
  explicit Columns(const Matrix3d& from) : R{vec(from.col(0)), vec(from.col(1)), vec(from.col(2))} {}
};

QuaternionOf<double> quaternion(const RigidTransform& X) { return toQuaternion(Columns(X.R).R); }

TEST(RowFormulas, RatesAreTheDerivativesOfValuesUnderMotionsOfEitherFrame) {
  checkRates([](const Frames& f) { return PositionRows<double>{vec(f.a.p)}; }, false);
  checkRates([](const Frames& f) { return OffsetRows<double>{vec(f.a.p), vec(f.b.p)}; }, true);
  checkRates(
      [](const Frames& f) {
        const Columns b(f.b.R);
        return RelativePositionRows<double>{vec(f.a.p), {b.R[0], b.R[1], b.R[2]}, vec(f.b.p)};
      },
      true);
  checkRates([](const Frames& f) { return AxisRows<double>{vec(f.a.R.col(1))}; }, false);
  checkRates([](const Frames& f) { return AxisOffsetRows<double>{vec(f.a.R.col(1)), vec(f.b.R.col(2))}; }, true);
  checkRates(
      [](const Frames& f) {
        const Columns b(f.b.R);
        return RelativeAxisRows<double>{vec(f.a.R.col(0)), {b.R[0], b.R[1], b.R[2]}};
      },
      true);
  checkRates([](const Frames& f) { return AxisProductRows<double>(vec(f.a.R.col(0)), vec(f.b.R.col(2))); }, true);
  checkRates([](const Frames& f) { return QuaternionRows<double>{quaternion(f.a)}; }, false);
  checkRates([](const Frames& f) { return QuaternionOffsetRows<double>(quaternion(f.a), quaternion(f.b)); }, true);
  checkRates(
      [](const Frames& f) {
        const Columns b(f.b.R);
        return RelativeQuaternionRows<double>{between(quaternion(f.b), quaternion(f.a)), {b.R[0], b.R[1], b.R[2]}};
      },
      true);
}

TEST(RowFormulas, QuaternionsAreThoseOfTheRotationAndCanonicalOnesHaveTheirFirstEntryPositive) {
  Rng rng(8);
  for (int sample = 0; sample < 200; ++sample) {
    Quaterniond q(rng.normal(), rng.normal(), rng.normal(), rng.normal());
    if (sample % 4 == 1) q.w() = 0.;
    if (sample % 4 == 2) q.w() = q.x() = 0.;
    q.normalize();
    const QuaternionOf<double> made = canonical(toQuaternion(Columns(q.toRotationMatrix()).R));
    const Vector4d entries(made.w, made.v.x, made.v.y, made.v.z);
    EXPECT_NEAR(std::abs(entries.dot(wxyz(q))), 1., 1e-12);
    for (int k = 0; k < 4; ++k) {
      if (entries[k] == 0.) continue;
      EXPECT_GT(entries[k], 0.);
      break;
    }
  }
}

TEST(RowFormulas, EveryLaneOfAPackHasTheBitsOfASingleNumber) {
  Rng rng(9);
  for (int sample = 0; sample < 50; ++sample) {
    const RigidTransform a[2] = {drawFrame(rng), drawFrame(rng)}, b[2] = {drawFrame(rng), drawFrame(rng)};
    const auto pack = [](const Vector3d& one, const Vector3d& two) {
      return Vec3<Pack<2>>{Pack<2>{one[0], two[0]}, Pack<2>{one[1], two[1]}, Pack<2>{one[2], two[2]}};
    };
    const auto column = [&](int k) { return pack(b[0].R.col(k), b[1].R.col(k)); };
    const Vec3<Pack<2>> R_b[3] = {column(0), column(1), column(2)},
                        R_a[3] = {pack(a[0].R.col(0), a[1].R.col(0)), pack(a[0].R.col(1), a[1].R.col(1)),
                                  pack(a[0].R.col(2), a[1].R.col(2))};
    Pack<2> position[3], turned[4];
    RelativePositionRows<Pack<2>>{pack(a[0].p, a[1].p), {R_b[0], R_b[1], R_b[2]}, pack(b[0].p, b[1].p)}.value(position);
    QuaternionOffsetRows<Pack<2>>(toQuaternion(R_a), toQuaternion(R_b)).value(turned);
    for (int lane = 0; lane < 2; ++lane) {
      double alone[4];
      const Columns columns(b[lane].R);
      RelativePositionRows<double>{vec(a[lane].p), {columns.R[0], columns.R[1], columns.R[2]}, vec(b[lane].p)}.value(
          alone);
      for (int r = 0; r < 3; ++r) EXPECT_EQ(position[r][lane], alone[r]);
      QuaternionOffsetRows<double>(quaternion(a[lane]), quaternion(b[lane])).value(alone);
      for (int r = 0; r < 4; ++r) EXPECT_EQ(turned[r][lane], alone[r]);
    }
  }
}

}  // namespace
}  // namespace kinegraph::lanes
