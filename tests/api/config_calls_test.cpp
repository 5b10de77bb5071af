#include <gtest/gtest.h>

#include <filesystem>

#include "kinegraph/features/eval.h"
#include "kinegraph/ik/solve_ik.h"
#include "kinegraph/simulation/simulation.h"
#include "kinegraph/viewer/config_viewer.h"
#include "tests/support/expect_error.h"

namespace kinegraph {
namespace {

class ConfigCalls : public ::testing::Test {
 protected:
  void SetUp() override {
    setenv("KINEGRAPH_HEADLESS", "1", 1);
    config.addText("base: { } \n hand (base): { joint: hingeX, limits: [-2 2], shape: sphere, size: [.1] }");
  }
  Config config;
};

TEST_F(ConfigCalls, EvalGivesTheFeatureAndItsJacobian) {
  config.setJointState(VectorXd{{.3}});
  const auto [y, J] = config.eval(FeatureSymbol::vectorY, {"hand"});
  EXPECT_TRUE(y.isApprox(Vector3d(0., std::cos(.3), std::sin(.3))));
  EXPECT_TRUE(J.col(0).isApprox(Vector3d(0., -std::sin(.3), std::cos(.3))));
  expectError<FrameNotFound>([&] { config.eval(FeatureSymbol::position, {"hnad"}); }, {"hnad", "hand"});
}

TEST_F(ConfigCalls, ViewShowsOnAPageOfItsOwn) {
  EXPECT_FALSE(config.viewer().isOpen());
  EXPECT_EQ(config.view(true, "nobody is asked"), 0);
  EXPECT_TRUE(config.viewer().isOpen());
  EXPECT_EQ(config.viewer().message(), "nobody is asked");

  Config copy(config);
  EXPECT_NE(&copy.viewer(), &config.viewer());
  ConfigViewer* page = &config.viewer();
  config = copy;
  EXPECT_EQ(&config.viewer(), page);
  EXPECT_TRUE(page->isOpen());
}

TEST_F(ConfigCalls, AShownSceneIsSavedAsAPage) {
  config.view();
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "config_calls_test.html";
  config.viewer().saveHtml(file.string());
  EXPECT_EQ(std::filesystem::file_size(file), config.viewer().recording().size());
  std::filesystem::remove(file);
  EXPECT_THROW(config.viewer().saveHtml("/does/not/exist.html"), FileError);
}

TEST_F(ConfigCalls, ASimulationIsShownOnThePageOfItsConfig) {
  Simulation simulation(config, SimulationEngine::kinematic);
  simulation.view();
  EXPECT_TRUE(config.viewer().isOpen());
  EXPECT_EQ(config.viewer().structure(), 1);
  simulation.step({}, .01, ControlMode::none);
  EXPECT_EQ(config.viewer().structure(), 1);
}

TEST_F(ConfigCalls, AMotionIsPlayedAndTheJointsStay) {
  EXPECT_EQ(config.viewPath(MatrixXd{{0.}, {.5}, {1.}}, .05), 0);
  EXPECT_EQ(config.getJointState()[0], 0.);
  EXPECT_THROW(config.viewPath(MatrixXd::Zero(3, 2)), ValueError);
}

TEST_F(ConfigCalls, FramesReturnTheirPoseInParts) {
  config.setJointState(VectorXd{{.3}});
  const Frame hand = config.getFrame("hand");
  EXPECT_EQ(hand.getPosition(), hand.getPose().p);
  EXPECT_TRUE(hand.getRotationMatrix().isApprox(Eigen::AngleAxisd(.3, Vector3d::UnitX()).toRotationMatrix()));
  EXPECT_TRUE(hand.getRelativeQuaternion().isApprox(hand.getQuaternion()));
}

TEST_F(ConfigCalls, AResultSaysInAWordHowItEnded) {
  config.addFrame("tip", "hand", "Q: [0 0 .5]");
  const IkResult reached = solveIk(config, {IkTarget::toPosition("tip", {0., -.5 * std::sin(.4), .5 * std::cos(.4)})});
  EXPECT_EQ(reached.str().rfind("solved in ", 0), 0u) << reached.str();
  const IkResult beyond = solveIk(config, {IkTarget::toPosition("tip", {0., 0., 2.})});
  EXPECT_EQ(beyond.str(), "goal_unreachable: " + beyond.message);
}

}  // namespace
}  // namespace kinegraph
