#include <gtest/gtest.h>

#include "kinegraph/komo/komo.h"
#include "kinegraph/komo/komo_parts.h"
#include "kinegraph/komo/path/path.h"
#include "tests/support/expect_error.h"

namespace kinegraph {
namespace {

/// An arm that grasps a box: two modes, a shared dof per grasp, and a path.
std::shared_ptr<Komo> graspPath() {
  Config config;
  config.addText(
      "world {}\n"
      "shoulder (world) { joint: hingeZ, limits: [-3 3] }\n"
      "upper (shoulder) { pose: [1 0 0], note: kept }\n"
      "elbow (upper) { joint: hingeZ, limits: [-3 3] }\n"
      "tip (elbow) { pose: [1 0 0] }\n"
      "box (world) { pose: [1 1 0], shape: ssBox, size: [.1 .1 .1 .01] }\n");
  config.setJointState(Eigen::Vector2d(.1, 1.5));
  auto komo = std::make_shared<Komo>(config, 2.5, 4, 2);
  komo->addControlObjective({}, 2, .1);
  komo->addModeSwitch({1., -1.}, SwitchMode::stable, {"tip", "box"});
  komo->addObjective({1.}, FeatureSymbol::positionDiff, {"tip", "box"}, ObjectiveType::eq, 10.);
  komo->addObjective({2., 2.5}, FeatureSymbol::position, {"box"}, ObjectiveType::eq, 10., Vector3d(0., 1.5, 0.));
  Rng rng(3);
  komo->setRandomPath(rng);
  return komo;
}

void expectSame(const std::shared_ptr<Komo>& a, const std::shared_ptr<Komo>& b) {
  const auto nlp_a = makeNlp(a), nlp_b = makeNlp(b);
  EXPECT_EQ(nlp_a->types(), nlp_b->types());
  EXPECT_EQ(nlp_a->lower(), nlp_b->lower());
  const VectorXd x = a->path().variables();
  EXPECT_EQ(x, b->path().variables());
  VectorXd phi_a(Eigen::Index(nlp_a->types().size())), phi_b = phi_a;
  Jacobian J_a = nlp_a->makeJacobian(), J_b = nlp_b->makeJacobian();
  nlp_a->evaluate(x, phi_a, &J_a);
  nlp_b->evaluate(x, phi_b, &J_b);
  EXPECT_EQ(phi_a, phi_b);
  EXPECT_EQ(J_a.values, J_b.values);
  EXPECT_EQ(a->getFrameState(-2), b->getFrameState(-2));
  EXPECT_EQ(a->getFrameState(a->slices() - 1), b->getFrameState(b->slices() - 1));
  EXPECT_EQ(a->configuration(5).getFrame("box").getParent()->getName(),
            b->configuration(5).getFrame("box").getParent()->getName());
  EXPECT_EQ(nlp_a->describeRow(10).objective, nlp_b->describeRow(10).objective);
}

TEST(Komo, ACloneIsTheSameProblemAndGoesItsOwnWay) {
  const auto komo = graspPath();
  const auto clone = std::make_shared<Komo>(komo->clone());
  expectSame(komo, clone);
  const VectorXd before = komo->path().variables();
  clone->path().setVariables(VectorXd::Zero(before.size()));
  clone->addRigidSwitch(2., "world", "box");
  EXPECT_EQ(komo->path().variables(), before);
  EXPECT_EQ(komo->configuration(9).getFrame("box").getParent()->getName(),
            graspPath()->configuration(9).getFrame("box").getParent()->getName());
  expectSame(komo, graspPath());
}

TEST(Komo, PartsMakeItAnew) {
  const auto komo = graspPath();
  expectSame(komo, std::make_shared<Komo>(komo->parts()));
  EXPECT_NE(Komo(komo->parts()).configuration(0).getFrame("upper").attributes().find("note"), nullptr);
  auto more = std::make_shared<Komo>(komo->parts());
  for (const auto& one : {komo, more}) one->addModeSwitch({2., -1.}, SwitchMode::stable, {"world", "box"}, false);
  expectSame(komo, more);
}

TEST(Komo, PartsThatDoNotFitAreRefused) {
  Komo::Parts parts = graspPath()->parts();
  parts.path.states.pop_back();
  expectError<ValueError>([&] { Komo komo(parts); }, {"do not fit"});
  parts = graspPath()->parts();
  parts.path.mode_of[3] = 9;
  expectError<ValueError>([&] { Komo komo(parts); }, {"mode 9"});
}

TEST(Komo, IsFoundFromItsProblem) {
  const auto komo = graspPath();
  EXPECT_EQ(komoOf(*makeNlp(komo)), komo);
}

}  // namespace
}  // namespace kinegraph
