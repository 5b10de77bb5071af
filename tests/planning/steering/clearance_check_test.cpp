#include "kinegraph/planning/steering/clearance_check.h"

#include <gtest/gtest.h>

#include "tests/planning/plane_room.h"

namespace kinegraph {
namespace {

struct Checked {
  Config C = room(.5);
  JointSpace space{*C.model()};
  State scene = C.state();

  /// The evaluations of the check of an edge.
  long looksAt(const VectorXd& from, const VectorXd& to, bool expected, Clearance clearance = {}) {
    ClearanceCheck check(scene, space, std::move(clearance));
    EXPECT_EQ(check.seemsFree(from, to), expected);
    return check.evaluations;
  }
};

TEST(ClearanceCheck, EightPosturesSideBySideAreOneEvaluation) {
  Checked checked;
  const VectorXd start{{-1., 0.}};
  const auto to = [&](double x) { return VectorXd{{x, 0.}}; };
  constexpr double step = 1. / 32.;
  EXPECT_EQ(checked.looksAt(start, to(-1. + .5 * step), true), 1);
  EXPECT_EQ(checked.looksAt(start, to(-1. + 8. * step), true), 1);
  EXPECT_EQ(checked.looksAt(start, to(-1. + 9. * step), true), 2);
  EXPECT_EQ(checked.looksAt(start, to(-1. + 64. * step), true), 8);
}

TEST(ClearanceCheck, AMotionThatEndsSomewhereTakesNoMoreThanOneThatIsFree) {
  Checked checked;
  const VectorXd low{{-1., 1.}}, high{{-1. + 8. / 32., 1.}}, inside{{0., 1.}};
  EXPECT_EQ(checked.looksAt(low, high, true), 1);
  EXPECT_EQ(checked.looksAt(high, inside, false), 1) << "wherever it ends";
  ClearanceCheck check(checked.scene, checked.space, {});
  EXPECT_FALSE(check.isMotionFree(high, inside));
  EXPECT_TRUE(check.isMotionFree(low, high));
  EXPECT_EQ(check.evaluations, 2) << "a motion at all times is one, too";
}

TEST(ClearanceCheck, WhereMarginsDifferPosturesAreJudgedByTheirOwn) {
  Checked checked;
  Clearance clearance{.margin = .3};
  clearance.tight = {{VectorXd{{-.26, .9}}, .005}};  // 1 cm from the wall
  Rng rng(1);
  int free = 0;
  for (int i = 0; i < 300; ++i) {
    const VectorXd from{{rng.uniform(-1.2, -.2), rng.uniform(.4, 1.4)}},
        to{{rng.uniform(-1.2, -.2), rng.uniform(.4, 1.4)}};
    ClearanceCheck check(checked.scene, checked.space, clearance), each(checked.scene, checked.space, clearance);
    const int parts = std::max(1, int(std::ceil((to - from).norm() / clearance.resolution)));
    bool expected = true;
    for (int k = 1; k <= parts && expected; ++k) expected = each.isFree(from + double(k) / parts * (to - from));
    EXPECT_EQ(check.seemsFree(from, to), expected) << i;
    EXPECT_LE(check.evaluations, 2 + parts / 2) << "side by side as far as one margin holds";
    free += expected;
  }
  EXPECT_GT(free, 20);
  EXPECT_LT(free, 280);
}

}  // namespace
}  // namespace kinegraph
