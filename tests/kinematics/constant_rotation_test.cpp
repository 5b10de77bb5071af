#include "kinegraph/kinematics/constant_rotation.h"

#include <gtest/gtest.h>

#include "kinegraph/common/random.h"
#include "kinegraph/math/pose.h"

namespace kinegraph {
namespace {

/// All products of quarter rotations about x and z, each up to three times: all 24, some repeatedly.
std::vector<Matrix3d> quarterTurns() {
  std::vector<Matrix3d> turns;
  for (int x = 0; x < 4; ++x) {
    for (int z = 0; z < 4; ++z) {
      for (int y = 0; y < 4; ++y) {
        const Matrix3d R =
            axisRotation(0, x * M_PI / 2.) * axisRotation(2, z * M_PI / 2.) * axisRotation(1, y * M_PI / 2.);
        turns.push_back(R.unaryExpr([](double entry) { return std::round(entry); }));
      }
    }
  }
  return turns;
}

TEST(ConstantRotation, ColumnsAndSignsOfQuarterRotationsMultiplyAsTheMatrixDoes) {
  Rng rng(1);
  for (const Matrix3d& R : quarterTurns()) {
    const ConstantRotation turn = classifyRotation(R.data());
    EXPECT_EQ(turn.kind, R.isIdentity(0.) ? ConstantRotation::none : ConstantRotation::quarters);
    const Matrix3d left = Matrix3d::NullaryExpr([&] { return rng.normal(); });
    for (int k = 0; k < 3; ++k) EXPECT_EQ(left * R.col(k), turn.sign[k] * left.col(turn.column[k]));
  }
}

TEST(ConstantRotation, RoundingIsIgnoredAndLargerDeviationsAreGeneralRotations) {
  for (Matrix3d R : quarterTurns()) {
    const ConstantRotation::Kind kind = classifyRotation(R.data()).kind;
    const Matrix3d rounded = R + Matrix3d::Constant(3e-16);
    EXPECT_EQ(classifyRotation(rounded.data()).kind, kind);
    const Matrix3d turned = R * axisRotation(1, 1e-9);
    EXPECT_EQ(classifyRotation(turned.data()).kind, ConstantRotation::general);
  }
}

}  // namespace
}  // namespace kinegraph
