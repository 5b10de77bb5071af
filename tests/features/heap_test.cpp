#include "tests/features/heap.h"

#include <gtest/gtest.h>

#include "kinegraph/collision/motion_check.h"
#include "kinegraph/features/eval.h"
#include "kinegraph/features/make_residual.h"
#include "tests/support/crowd.h"

using namespace kinegraph;

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// An arm with all kinds of joints and shapes whose distances have a closed form, close to each other.
Config armOfAllJoints() {
  Config config;
  config.addText(R"g(
    base: { X: "t(0 0 .5)", shape: ssBox, size: [.3 .3 .3 .05], contact: 1 }
    one(base): { joint: hingeZ, limits: [-1 1], mass: 1 }
    two(one): { pre: "t(.2 0 0)", joint: quatBall, shape: capsule, size: [.2 .05], contact: 1, mass: .5 }
    finger(two): { pre: "t(.2 0 .1)", joint: transXYPhi, shape: sphere, size: [.1], contact: 1, mass: .1 }
    thumb(two): { pre: "t(.2 .1 .1)", joint: hingeX, mimic: one, shape: box, size: [.1 .1 .3], contact: 1 }
    world: {}
    block(world): { pre: "t(.5 .1 .5)", joint: free, shape: ssBox, size: [.3 .3 .3 .05], contact: 1, mass: 2 }
  )g");
  return config;
}

std::vector<VectorXd> someJoints(const Config& config, int count) {
  Rng rng(2);
  std::vector<VectorXd> list;
  for (int i = 0; i < count; ++i) {
    VectorXd q = config.getJointState();
    for (double& x : q) x += .3 * rng.normal();
    list.push_back(q);
  }
  return list;
}

}  // namespace

TEST(Heap, SettingJointsAndAskingForPosesRequestsNoMemory) {
  Config config = armOfAllJoints();
  const std::vector<VectorXd> joints = someJoints(config, 5);
  const Frame finger = config.getFrame("finger");
  config.setJointState(joints[0]);
  config.state();
  finger.getPose();
  const long before = heap_requests;
  Vector3d sum = Vector3d::Zero();
  for (const VectorXd& q : joints) {
    config.setJointState(q);
    sum += config.state().pose(finger.id()).p + finger.getPose().p;
  }
  EXPECT_EQ(heap_requests - before, 0);
  EXPECT_TRUE(sum.allFinite());
}

TEST(Heap, ValuesAndJacobiansOfEveryFeatureRequestNoMemory) {
  Config config = armOfAllJoints();
  const std::vector<VectorXd> joints = someJoints(config, 5);
  const std::vector<std::string> names = {"finger", "block", "thumb"};
  int checked = 0;
  for (const FeatureInfo& info : featureRegistry()) {
    if (!info.available()) continue;
    const int frames = info.max_frames < 0 ? info.min_frames : info.max_frames;
    for (const MatrixXd& scale : {MatrixXd(), MatrixXd(MatrixXd::Ones(1, 1))}) {
      Residual residual = makeResidual(config.state(), info.symbol, {names.begin(), names.begin() + frames}, scale);
      if (residual.order() > 0) continue;
      VectorXd y(residual.rows());
      Rows J(residual.rows(), config.getJointDimension());
      eval(config, residual, y, J);
      const long before = heap_requests;
      for (const VectorXd& q : joints) {
        config.setJointState(q);
        J.setZero();
        eval(config, residual, y, J);
      }
      EXPECT_EQ(heap_requests - before, 0) << info.name;
      ++checked;
    }
  }
  EXPECT_GT(checked, 80);
}

TEST(Heap, AMatrixAsScaleAndDifferencesRequestNoMemoryOnceTheyAreWarm) {
  const Config config = armOfAllJoints();
  const std::vector<VectorXd> joints = someJoints(config, 3);
  std::vector<State> states(3, config.state());
  for (int t = 0; t < 3; ++t) states[t].setJoints(joints[t].data());
  const State* view[] = {&states[0], &states[1], &states[2]};
  Residual residual =
      makeResidual(config.state(), FeatureSymbol::pose, {"finger"}, MatrixXd::Ones(2, 7), VectorXd::Ones(7), 2);
  VectorXd y(2);
  Rows J = Rows::Zero(2, 3 * config.getJointDimension());
  JacobianRows rows = J;
  residual.eval(view, .1, y, &rows);
  const long before = heap_requests;
  for (int i = 0; i < 3; ++i) residual.eval(view, .1, y, &rows);
  EXPECT_EQ(heap_requests - before, 0);
}

TEST(Heap, CollisionsRequestOnlyMemoryForWhatTheyReturn) {
  Config config = armOfAllJoints();
  const std::vector<VectorXd> joints = someJoints(config, 5);
  config.getTotalPenetration();
  const long before = heap_requests;
  double total = 0.;
  for (const VectorXd& q : joints) {
    config.setJointState(q);
    total += config.getTotalPenetration();
  }
  EXPECT_EQ(heap_requests - before, 0);
  EXPECT_GT(total, 0.);
}

TEST(Heap, DistancesOfAllShapesRequestNoMemory) {
  Config config = armOfAllJoints();
  const char* names[] = {"cylinder", "mesh", "parts", "cloud", "elip", "cvx", "quad", "sdf"};
  double x = .1;
  for (const char* name : names)
    config.addFrame(name, "two",
                    cat("joint: trans3, pre: [", x += .02, " 0 .1], shape: cylinder, size: [.2 .1], contact: 1"));
  Rng rng(3);
  Mesh mesh;
  for (int i = 0; i < 100; ++i) mesh.vertices.push_back(.1 * Vector3d(rng.normal(), rng.normal(), rng.normal()));
  const auto cloud = std::make_shared<Mesh>(mesh);
  mesh.parts = {0, 30, 60};
  const auto parts = std::make_shared<Mesh>(mesh);
  config.getFrame("mesh").setGeometry({ShapeType::mesh, {}, cloud});
  config.getFrame("parts").setGeometry({ShapeType::mesh, {}, parts});
  config.getFrame("cloud").setGeometry({ShapeType::pointCloud, {}, cloud});
  config.getFrame("elip").setGeometry({ShapeType::ssBoxElip, {.2, .1, .1, .05, .03, .02, .01}, nullptr});
  config.getFrame("cvx").setGeometry({ShapeType::ssCvx, {.02}, cloud});
  config.getFrame("quad").setGeometry({ShapeType::quad, {.2, .2}, nullptr});
  Grid grid;
  grid.cells = {5, 5, 5};
  for (int i = 0; i < 125; ++i)
    grid.values.push_back(float((Vector3d(i / 25, i / 5 % 5, i % 5) - Vector3d::Constant(2.)).norm() * .1 - .1));
  config.getFrame("sdf").setGeometry(
      {ShapeType::sdf, {.4, .4, .4}, nullptr, {}, Vector3d::Ones(), std::make_shared<Grid>(grid)});
  const std::vector<VectorXd> joints = someJoints(config, 5);
  config.getTotalPenetration();
  Residual residual = makeResidual(config.state(), FeatureSymbol::accumulatedCollisions, {});
  VectorXd y(1);
  Rows J(1, config.getJointDimension());
  eval(config, residual, y, J);
  const long before = heap_requests;
  double total = 0.;
  for (const VectorXd& q : joints) {
    config.setJointState(q);
    total += config.getTotalPenetration();
    J.setZero();
    eval(config, residual, y, J);
    EXPECT_NEAR(y[0], config.getTotalPenetration(), 1e-12);
  }
  EXPECT_EQ(heap_requests - before, 0);
  EXPECT_GT(total, .5);
}

TEST(Heap, CollisionsOfManyBodiesRequestNoMemoryOnceTheyAreWarm) {
  Config config = kinegraph::testing::crowd(100, .5, 13);
  Rng rng(14);
  std::vector<VectorXd> joints;
  for (int i = 0; i < 20; ++i) {
    joints.push_back(config.getJointState());
    for (double& x : joints.back()) x += .3 * rng.normal();
  }
  double total = 0.;
  for (int round = 0; round < 2; ++round) {
    const long before = heap_requests;
    for (const VectorXd& q : joints) {
      config.setJointState(q);
      total += config.getTotalPenetration();
    }
    if (round == 1) {
      EXPECT_EQ(heap_requests - before, 0);
    }
  }
  EXPECT_GT(total, 1.);
}

TEST(Heap, AMotionCheckerRequestsNoMemoryPerMotion) {
  const Config config = armOfAllJoints();
  const std::vector<VectorXd> joints = someJoints(config, 6);
  MotionChecker checker(config.state());
  const long before = heap_requests;
  int contacts = 0;
  for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
    contacts += checker.firstContact(joints[i].data(), joints[i + 1].data(), -.2, 1e-4).has_value();
  }
  EXPECT_EQ(heap_requests - before, 0);
  EXPECT_LT(contacts, 5);
}
