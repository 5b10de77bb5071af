#include "kinegraph/api/recorded_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/simulation/simulation.h"

namespace kinegraph {
namespace {

Config fallingBall() {
  Config C;
  C.addFrame("ball").setShape(ShapeType::sphere, {.1}).setPosition({0., 0., 5.}).setMass(1.);
  return C;
}

TEST(RecordedMotion, HasASliceEvery20MillisecondsWhateverTheSteps) {
  Config C = fallingBall();
  Simulation simulation(C);
  simulation.startRecording();
  for (const double tau : {.005, .013, .042, .2, .1, .04}) simulation.step({}, tau);
  const Recording recording = simulation.stopRecording();
  const ShownMotion motion = recordedMotion(recording);
  ASSERT_EQ(motion.poses.size(), 21u);
  EXPECT_NEAR(motion.seconds, .4, 1e-12);
  EXPECT_EQ(motion.poses.front()[0].p.z(), recording.freePos.front()(0, 2));
  EXPECT_EQ(motion.poses.back()[0].p.z(), C.getFrame("ball").getPosition().z());
  for (std::size_t i = 1; i < motion.poses.size(); ++i)
    EXPECT_LE(motion.poses[i][0].p.z(), motion.poses[i - 1][0].p.z()) << i;
}

TEST(RecordedMotion, ContinuesIfTimeWasSetBack) {
  Config C = fallingBall();
  Simulation simulation(C);
  const SimulationState start = simulation.getState();
  simulation.startRecording();
  for (int i = 0; i < 10; ++i) simulation.step();
  simulation.setState(start);
  for (int i = 0; i < 10; ++i) simulation.step();
  const ShownMotion motion = recordedMotion(simulation.stopRecording());
  EXPECT_NEAR(motion.seconds, .19, 1e-9);  // the step after it was set back takes no time
  EXPECT_LT(motion.poses[5][0].p.z(), 4.96);
  EXPECT_GT(motion.poses[6][0].p.z(), 4.98);
}

TEST(RecordedMotion, OfALongRunHasNoMoreThan1500Slices) {
  Config C = fallingBall();
  Simulation simulation(C, SimulationEngine::kinematic);
  simulation.startRecording();
  for (int i = 0; i < 200; ++i) simulation.step({}, 1.);
  EXPECT_EQ(recordedMotion(simulation.stopRecording()).poses.size(), 1500u);
}

TEST(RecordedMotion, NeedsSteps) {
  Config C = fallingBall();
  Simulation simulation(C);
  simulation.startRecording();
  EXPECT_THROW(recordedMotion(simulation.stopRecording()), ValueError);
}

}  // namespace
}  // namespace kinegraph
