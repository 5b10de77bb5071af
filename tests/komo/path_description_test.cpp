#include "kinegraph/komo/path_description.h"

#include <gtest/gtest.h>

#include "kinegraph/komo/komo.h"

using namespace kinegraph;

namespace {

Komo bodies() {
  Config config;
  config.addText(R"(
    world: {}
    arm (world): { joint: hingeZ }
    rail (arm): { Q: [1, 0, 0], joint: transX }
    box (rail): { Q: [1, 0, 0], shape: ssBox, size: [.1, .1, .1, .01], mass: 2 }
    spot (world): { Q: [0, 1, 0] }
  )");
  return Komo(config, 4., 1, 2);
}

/// Measures of the components of an objective in the last slice.
std::vector<RowDescription> rowsOf(Komo komo, FeatureSymbol feature, const std::vector<std::string>& frames,
                                   const Scale& scale = {}, int order = -1) {
  komo.addObjective({4.}, feature, frames, ObjectiveType::eq, scale, {}, order);
  const PathProblem problem(komo.path(), komo.contacts(), komo.objectives().all());
  std::vector<RowDescription> rows;
  for (int row = 0; row < problem.rows(); ++row) rows.push_back(describePathComponent(komo.path(), problem, row));
  return rows;
}

using Kind = std::pair<Measure, int>;

Kind kindOf(const RowDescription& row) { return {row.measure, row.time_order}; }

}  // namespace

TEST(PathDescription, UnitsAreThoseOfTheFeature) {
  const Komo komo = bodies();
  using S = FeatureSymbol;
  EXPECT_EQ(kindOf(rowsOf(komo.clone(), S::positionDiff, {"box", "spot"})[0]), Kind(Measure::length, 0));
  EXPECT_EQ(kindOf(rowsOf(komo.clone(), S::EqCenterOfMass, {"spot", "box"})[2]), Kind(Measure::length, 0));
  EXPECT_EQ(kindOf(rowsOf(komo.clone(), S::vectorXRel, {"box", "spot"})[1]), Kind(Measure::axis, 0));
  for (const S product : {S::scalarProductXX, S::scalarProductZX, S::scalarProductZY, S::scalarProductZZ})
    EXPECT_EQ(kindOf(rowsOf(komo.clone(), product, {"box", "spot"})[0]), Kind(Measure::cosine, 0));
  const std::vector<RowDescription> pose = rowsOf(komo.clone(), S::poseRel, {"box", "spot"});
  EXPECT_EQ(kindOf(pose[2]), Kind(Measure::length, 0));
  EXPECT_EQ(kindOf(pose[3]), Kind(Measure::quaternion, 0));
  EXPECT_EQ(kindOf(rowsOf(komo.clone(), S::totalForce, {"box"})[0]), Kind(Measure::number, 0));
}

TEST(PathDescription, VelocitiesAndDerivativesArePerTime) {
  const Komo komo = bodies();
  using S = FeatureSymbol;
  EXPECT_EQ(kindOf(rowsOf(komo.clone(), S::position, {"box"}, {}, 2)[0]), Kind(Measure::length, 2));
  const std::vector<RowDescription> velocity = rowsOf(komo.clone(), S::linangVel, {"box"});
  EXPECT_EQ(kindOf(velocity[0]), Kind(Measure::length, 1));
  EXPECT_EQ(kindOf(velocity[5]), Kind(Measure::angle, 1));
  EXPECT_EQ(kindOf(rowsOf(komo.clone(), S::angularVel, {"box"}, {}, 2)[0]), Kind(Measure::angle, 2));
  EXPECT_EQ(kindOf(rowsOf(komo.clone(), S::physics, {"box"})[0]), Kind(Measure::length, 1));  // a change of velocity
}

TEST(PathDescription, RowsOfJointsHaveTheUnitOfTheJointIfThereIsOne) {
  const Komo komo = bodies();
  using S = FeatureSymbol;
  EXPECT_EQ(rowsOf(komo.clone(), S::qItself, {"arm"})[0].measure, Measure::angle);
  EXPECT_EQ(rowsOf(komo.clone(), S::qItself, {"rail"})[0].measure, Measure::length);
  EXPECT_EQ(rowsOf(komo.clone(), S::qItself, {})[0].measure, Measure::number);  // some m, some rad
}

TEST(PathDescription, AMatrixThatMixesRowsHasTheUnitOfTheLargestEntry) {
  MatrixXd scale = MatrixXd::Zero(1, 7);
  scale(0, 1) = 3.;
  scale(0, 5) = 4.;
  const RowDescription row = rowsOf(bodies(), FeatureSymbol::pose, {"box"}, scale)[0];
  EXPECT_EQ(row.measure, Measure::quaternion);
  EXPECT_EQ(row.scale, 5.);
}

TEST(PathDescription, VariablesAreNamedByTheirJointAndSlice) {
  const Komo komo = bodies();
  const VariableDescription rail = describePathVariable(komo.path(), 5);
  EXPECT_EQ(rail.frame, "rail");
  EXPECT_EQ(rail.slice, 2);
  EXPECT_EQ(rail.measure, Measure::length);
  EXPECT_EQ(describePathVariable(komo.path(), 4).measure, Measure::angle);
}
