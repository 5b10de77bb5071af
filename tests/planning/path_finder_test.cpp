#include "kinegraph/planning/path_finder.h"

#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"
#include "tests/planning/plane_room.h"

namespace kinegraph {
namespace {

TEST(PathFinder, AProblemWithItsEndsIsThatOfTwoCalls) {
  const Config C = room(.8);
  const VectorXd start{{-1.2, 1.}}, goal{{1.2, -1.}};
  PathFinder one, two;
  const SolverResult a = one.setProblem(C, start, goal).solve(),
                     b = two.setProblem(C).setStartGoal(start, goal).solve();
  ASSERT_TRUE(a.feasible);
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(one.get_resampledPath(7).rows(), 7);
  EXPECT_TRUE(one.path().row(0).transpose().isApprox(start));
}

TEST(PathFinder, WithoutAPathThereIsNothingToShow) {
  const Config C = room(.8);
  PathFinder finder;
  finder.setProblem(C, VectorXd{{-1.2, 1.}}, VectorXd{{1.2, -1.}});
  EXPECT_THROW(finder.view(), ValueError);
  EXPECT_THROW(finder.get_resampledPath(3), ValueError);
}

}  // namespace
}  // namespace kinegraph
