#include "kinegraph/komo/path/sub_problem.h"

#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

Path waypoints(int per_phase) {
  Config config;
  config.addText(R"(
    world: {}
    arm (world): { joint: hingeZ, q: .5 }
    box (world): { Q: [1, 1, 0] }
  )");
  Path path;
  path.setScene(config);
  path.setGrid(TimeGrid(3., per_phase, 1., 1));
  return path;
}

}  // namespace

TEST(SubProblem, IsAPhaseFromItsBeginningToItsEnd) {
  Path path = waypoints(1);
  path.beginModes();
  Attachment grasp;
  grasp.type = JointType::trans3;
  grasp.starts_at_object = true;
  path.attach(1, "arm", "box", grasp);
  path.setVariables(VectorXd::LinSpaced(path.layout().dimension, 1., double(path.layout().dimension)));
  const SubProblem sub = subProblem(path, 2);
  EXPECT_EQ(sub.start, path.joints().row(1).transpose());
  EXPECT_EQ(sub.end, path.joints().row(2).transpose());
  EXPECT_EQ(sub.config.getFrame("box").getParent()->getName(), "arm");
  EXPECT_EQ(sub.config.getJointState(), sub.start);  // the grasp is inactive
}

TEST(SubProblem, NeedsOneSlicePerPhaseAndAPhaseThatIsThere) {
  expectError<ValueError>([] { subProblem(waypoints(2), 0); }, {"one slice per phase", "has 2"});
  expectError<ValueError>([] { subProblem(waypoints(1), 3); }, {"phase 3 is not in 0 .. 2"});
}
