#include "kinegraph/komo/komo.h"

#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"
#include "tests/support/near.h"

namespace kinegraph {

namespace {

Config arm() {
  Config scene;
  scene.addText(R"g(
    base: { X: "t(0 0 .1)" }
    upper (base): { joint: hingeZ }
    seat (upper): { Q: "t(.3 0 .1)" }
    lower (seat): { joint: hingeY }
    tip (lower): { Q: "t(0 .1 .2)" }
    goal: { X: "t(.3 .2 .1)" }
  )g");
  return scene;
}

struct Demand {
  Vector3d target{.1, .2, .3}, scale{2., 3., 4.};
};

std::shared_ptr<Komo> problemOf(const Config& scene, const Demand& demand = {}) {
  auto komo = std::make_shared<Komo>(scene, 1, 3, 2);
  komo->addControlObjective({}, 2);
  komo->addObjective({}, FeatureSymbol::positionDiff, {"tip", "goal"}, ObjectiveType::sos, demand.scale, demand.target);
  komo->addObjective({1.}, FeatureSymbol::positionDiff, {"tip", "goal"}, ObjectiveType::eq, 10., {}, 1);
  return komo;
}

constexpr double kStep = 1e-5;

VectorXd someX(int size) {
  Rng rng(2);
  VectorXd x(size);
  for (double& value : x) value = rng.uniform(-1., 1.);
  return x;
}

/// Residuals, and the sum of their gradients with weights 1, 2, ...
std::pair<VectorXd, VectorXd> at(Nlp& nlp, const VectorXd& x, const VectorXd& weights) {
  VectorXd phi(Eigen::Index(nlp.types().size())), gradient = VectorXd::Zero(x.size());
  Jacobian J = nlp.makeJacobian();
  nlp.evaluate(x, phi, &J);
  for (int row = 0; row < int(phi.size()); ++row) J.addRowTo(row, weights[row], gradient);
  return {phi, gradient};
}

/// Compares with problems that are rebuilt with one of the numbers changed.
void expectDerivativesOf(NlpParameter& parameter, Nlp& nlp,
                         const std::function<std::shared_ptr<Nlp>(int number, double by)>& makeAnew) {
  const VectorXd x = someX(nlp.dimension());
  const auto rows = Eigen::Index(nlp.types().size());
  const VectorXd weights = VectorXd::LinSpaced(rows, 1., double(rows));
  for (int number = 0; number < parameter.size(); ++number) {
    Jacobian J = nlp.makeJacobian();
    VectorXd phi(rows), moved = VectorXd::Zero(rows), gradient = VectorXd::Zero(x.size());
    nlp.evaluate(x, phi, &J);
    parameter.differentiate({nlp, x, phi, J, weights, {}}, number, moved, gradient);
    const auto [phi_up, gradient_up] = at(*makeAnew(number, kStep), x, weights);
    const auto [phi_down, gradient_down] = at(*makeAnew(number, -kStep), x, weights);
    EXPECT_TRUE(near(moved, VectorXd((phi_up - phi_down) / (2. * kStep)), 1e-5))
        << parameter.names()[std::size_t(number)];
    EXPECT_TRUE(near(gradient, VectorXd((gradient_up - gradient_down) / (2. * kStep)), 1e-4));
    VectorXd again(rows);
    nlp.evaluate(x, again, nullptr);
    EXPECT_TRUE(near(again, phi, 0.)) << "the problem is as before";
  }
}

}  // namespace

TEST(PathParameters, TargetsAndScalesMoveTheResidualsOfTheirObjective) {
  const Config scene = arm();
  const auto nlp = makeNlp(problemOf(scene));
  expectDerivativesOf(*objectiveTarget(*nlp, 1), *nlp, [&](int number, double by) {
    Demand demand;
    demand.target[number] += by;
    return makeNlp(problemOf(scene, demand));
  });
  expectDerivativesOf(*objectiveScale(*nlp, 1), *nlp, [&](int number, double by) {
    Demand demand;
    demand.scale[number] += by;
    return makeNlp(problemOf(scene, demand));
  });
}

TEST(PathParameters, FramesMoveWithAllThatHangsBelowThem) {
  for (const std::string name : {"goal", "seat", "tip", "base"}) {
    const Config scene = arm();
    const auto nlp = makeNlp(problemOf(scene));
    const auto pose = framePose(*nlp, name);
    ASSERT_EQ(pose->size(), 6);
    EXPECT_EQ(framePosition(*nlp, name)->size(), 3);
    expectDerivativesOf(*pose, *nlp, [&](int number, double by) {
      Config moved = arm();
      const bool is_root = name == "base" || name == "goal";
      Pose X = is_root ? moved.getFrame(name).getPose() : moved.getFrame(name).getRelativePose();
      const Vector3d axis = Vector3d::Unit(number % 3);
      if (number < 3)
        X.p += by * axis;
      else
        X.q = Quaterniond(Eigen::AngleAxisd(by, axis)) * X.q;
      is_root ? moved.getFrame(name).setPose(X) : moved.getFrame(name).setRelativePose(X);
      return makeNlp(problemOf(moved));
    });
  }
}

TEST(PathParameters, TheStartMovesTheSlicesBeforeTheFirst) {
  const Config scene = arm();
  const auto nlp = makeNlp(problemOf(scene));
  expectDerivativesOf(*motionStart(*nlp), *nlp, [&](int number, double by) {
    Config moved = arm();
    moved.setJointState(VectorXd(by * VectorXd::Unit(2, number)));
    return makeNlp(problemOf(moved));
  });
}

TEST(PathParameters, ThatAreNotThereAreRefused) {
  const auto nlp = makeNlp(problemOf(arm()));
  EXPECT_EQ(objectiveNumber(*nlp, "qItself"), 0);
  EXPECT_THROW(objectiveNumber(*nlp, "positionDiff"), NameError) << "there are two";
  EXPECT_THROW(objectiveNumber(*nlp, "position"), NameError);
  EXPECT_THROW(objectiveTarget(*nlp, 3), ValueError);
  EXPECT_THROW(framePose(*nlp, "lower"), ValueError) << "its joint says where it is";
  EXPECT_THROW(framePose(*nlp, "nobody"), FrameNotFound);
}

}  // namespace kinegraph
