#include "kinegraph/ik/solve_ik.h"

#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"
#include "tests/support/near.h"

namespace kinegraph {

namespace {

Config twoArmsAndCup() {
  Config scene;
  scene.addText(R"g(
    base: {}
    a1 (base): { joint: hingeZ, limits: [-2 2] }
    a2 (a1): { Q: "t(.3 0 .1)", joint: hingeY, limits: [-2 2] }
    a3 (a2): { Q: "t(.3 0 0)", joint: hingeX, limits: [-2 2] }
    a4 (a3): { Q: "t(.1 .1 0)", joint: hingeY, limits: [-2 2] }
    tip (a4): { Q: "t(.1 0 .1)", shape: sphere, size: [.05], contact: 1 }
    b1 (base): { Q: "t(.5 .5 0)", joint: hingeZ, limits: [-2 2] }
    cup (b1): { Q: "t(.1 0 .3)", shape: sphere, size: [.05], contact: 1 }
    idle (base): { joint: hingeX }
  )g");
  scene.setJointState(VectorXd(Eigen::Matrix<double, 6, 1>(.3, -.4, .5, .6, .1, .7)));
  return scene;
}

/// Targets that hold in a configuration nearby.
std::vector<std::vector<IkTarget>> kinds() {
  Config scene = twoArmsAndCup();
  scene.setJointState(VectorXd(scene.getJointState() + .1 * VectorXd::Ones(6)));
  const Pose near_by = scene.getFrame("tip").getPose(), cup = scene.getFrame("cup").getPose();
  const IkFeature apart{FeatureSymbol::positionDiff, {"tip", "cup"}};
  return {
      {IkTarget::toPosition("tip", near_by.p)},
      {IkTarget::toRotation("tip", near_by.q)},
      {IkTarget::toDirection("tip", Vector3d(0., 1., 1.), near_by.q * Vector3d(0., 1., 1.))},
      {IkTarget::toGaze("tip", (near_by * Pose(Vector3d(.8, 0., 0.), Quaterniond::Identity())).p, Vector3d::UnitX())},
      {IkTarget::toPosition("tip", (cup.inverse() * near_by).p).relativeTo("cup")},
      {IkTarget::toFeature(apart, near_by.p - cup.p)}};
}

}  // namespace

TEST(IkNlp, HoldsAtAnswersAndHasTheJacobianOfDifferences) {
  const Config scene = twoArmsAndCup();
  for (const double home : {0., 1.}) {
    for (const std::vector<IkTarget>& targets : kinds()) {
      IkOptions options;
      options.home_weight = home;
      const IkResult result = solveIk(scene, targets, options);
      ASSERT_TRUE(result.feasible()) << result.message;
      const std::shared_ptr<Nlp> nlp = makeNlp(result);
      VectorXd phi(Eigen::Index(nlp->types().size()));
      nlp->evaluate(result.q, phi, nullptr);
      EXPECT_LT(largestViolation(nlp->types(), phi), 1e-5);
      Rng rng(1);
      VectorXd near_by = result.q;
      for (double& value : near_by) value += rng.uniform(-.2, .2);
      EXPECT_LT(checkJacobian(*nlp, near_by).error, 1e-6) << nlp->rowName(0);
      EXPECT_EQ(nlp->lower()[5], nlp->upper()[5]) << "a joint that moves no target is given";
    }
  }
}

TEST(IkNlp, HasThePairsThatAreNear) {
  Config scene = twoArmsAndCup();
  const Vector3d tip = scene.getFrame("tip").getPose().p;
  scene.getFrame("cup").setPosition(tip + Vector3d(.101, 0., 0.));
  const IkResult result = solveIk(scene, {IkTarget::toPosition("tip", tip)});
  ASSERT_TRUE(result.feasible()) << result.message;
  const std::shared_ptr<Nlp> nlp = makeNlp(result);
  ASSERT_EQ(nlp->types().back(), ObjectiveType::ineq);
  EXPECT_EQ(nlp->rowName(int(nlp->types().size()) - 1), "distance of 'tip' and 'cup'");
  VectorXd phi(Eigen::Index(nlp->types().size()));
  nlp->evaluate(result.q, phi, nullptr);
  EXPECT_NEAR(phi[phi.size() - 1], -.001, 1e-5);
}

TEST(IkNlp, TargetsMoveTheirRows) {
  const Config scene = twoArmsAndCup();
  for (const std::vector<IkTarget>& targets : kinds()) {
    const IkResult result = solveIk(scene, targets);
    ASSERT_TRUE(result.feasible()) << result.message;
    const std::shared_ptr<Nlp> nlp = makeNlp(result);
    const auto parameter = ikTarget(*nlp, 0);
    const auto rows = Eigen::Index(nlp->types().size());
    EXPECT_EQ(parameter->size(), 3);
    Jacobian J = nlp->makeJacobian();
    VectorXd phi(rows), weights = VectorXd::Ones(rows), again(rows);
    nlp->evaluate(result.q, phi, &J);
    double moved = 0.;
    for (int number = 0; number < parameter->size(); ++number) {
      VectorXd dphi = VectorXd::Zero(rows), gradient = VectorXd::Zero(result.q.size());
      parameter->differentiate({*nlp, result.q, phi, J, weights, {}}, number, dphi, gradient);
      moved += dphi.norm();
    }
    EXPECT_GT(moved, .5);
    nlp->evaluate(result.q, again, nullptr);
    EXPECT_TRUE(near(again, phi, 0.)) << "the problem is as before";
  }
}

TEST(IkNlp, IsRefusedForWhatIsNoAnswer) {
  const Config scene = twoArmsAndCup();
  EXPECT_THROW(makeNlp(IkResult()), ValueError);
  IkOptions once;
  once.attempts = 1;
  EXPECT_THROW(makeNlp(solveIk(scene, {IkTarget::toPosition("tip", Vector3d(9., 9., 9.))}, once)), ValueError);
  const std::shared_ptr<Nlp> nlp = makeNlp(solveIk(scene, kinds()[0]));
  EXPECT_EQ(ikTargetNumber(*nlp, "tip"), 0);
  EXPECT_THROW(ikTargetNumber(*nlp, "tipp"), NameError);
  EXPECT_THROW(ikTarget(*nlp, 1), ValueError);
}

}  // namespace kinegraph
