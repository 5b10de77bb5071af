#include <gtest/gtest.h>

#include "kinegraph/control/diff_ik.h"
#include "kinegraph/control/mpc.h"
#include "kinegraph/komo/path/path.h"
#include "tests/control/arm.h"
#include "tests/support/malloc_count.h"

using namespace kinegraph;

TEST(Heap, StepsOfDiffIkRequestNoMemoryAfterTheFirst) {
  Config C = planarArm();
  DiffIk ik(C, {.velocity = VectorXd::Constant(3, 1.), .acceleration = VectorXd::Constant(3, 5.)});
  ik.addTask(FeatureSymbol::positionDiff, {"tip", "target"});
  ik.addTask(FeatureSymbol::qItself, {}, 1., .02, Eigen::Vector3d(3., -2., 2.), 1);
  ik.addEquality(FeatureSymbol::qItself, {"j1"}, .01, VectorXd::Zero(1));
  C.getFrame("obstacle").setPosition(C.getFrame("target").getPosition());  // limits and a pair become active
  ik.step(.005);
  C.state();
  const long before = heap_requests;
  for (int i = 0; i < 400; ++i) ik.step(.005);
  EXPECT_EQ(heap_requests, before);
  EXPECT_FALSE(ik.active().empty());
}

TEST(Heap, CallsOfMpcRequestNoMemoryAfterTheFirst) {
  const Config C = planarArm();
  for (const int evaluations : {2, 50}) {
    Mpc mpc(reachingHorizon(C), {.evaluations = evaluations});
    VectorXd q = C.getJointState(), velocity = VectorXd::Zero(3);
    MatrixXd poses = MatrixXd::Zero(mpc.komo().slices(), 3);
    const std::string target = "target";
    long requests = 0;
    for (int i = 0; i < 40; ++i) {
      for (int t = 0; t < poses.rows(); ++t) poses.row(t) << .9 - .01 * (i + t), .8, 0.;
      const long before = heap_requests;
      mpc.setPoses(target, poses);
      mpc.step(q, velocity);
      if (i > 2) requests += heap_requests - before;
      velocity = (mpc.komo().path().state(0).q() - q) / mpc.komo().tau();
      q = mpc.komo().path().state(0).q();
    }
    EXPECT_EQ(requests, 0) << "at most " << evaluations << " evaluations";
  }
}
