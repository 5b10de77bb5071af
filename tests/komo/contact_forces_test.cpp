#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"
#include "kinegraph/features/residual.h"
#include "kinegraph/komo/komo.h"
#include "kinegraph/komo/objective.h"
#include "kinegraph/komo/objective_list.h"
#include "kinegraph/komo/path/contacts.h"
#include "kinegraph/komo/path/path.h"

using namespace kinegraph;

namespace {

/// A box of 2 kg in contact with a finger.
Config boxAndFinger() {
  Config config;
  config.addText(R"(
    world: {}
    table (world): { Q: [0, 0, .5], shape: ssBox, size: [1, 1, .1, .01] }
    box (world): { Q: [.1, .2, .65], joint: free, shape: ssBox, size: [.2, .2, .2, .01], mass: 2 }
    finger (world): { Q: [-.06, .2, .65], joint: free, shape: sphere, size: [.05] }
  )");
  return config;
}

std::shared_ptr<Komo> pushed(bool is_free) {
  auto komo = std::make_shared<Komo>(boxAndFinger(), 3., 1, 2);
  if (is_free) komo->addFreeContactForce({1., 2.}, "box", "finger", .5, 2., .01);
  if (!is_free) komo->addContactForce({1., 2.}, "box", "finger", .5, 2.);
  komo->addObjective({}, FeatureSymbol::totalForce, {"box"}, ObjectiveType::eq);
  komo->addObjective({}, FeatureSymbol::totalForce, {"box"}, ObjectiveType::eq, {}, {}, 1);
  komo->addObjective({}, FeatureSymbol::physics, {"box"}, ObjectiveType::eq);
  komo->addObjective({}, FeatureSymbol::contactConstraints, {"box", "finger"}, ObjectiveType::eq);
  return komo;
}

VectorXd nearStart(const Komo& komo, double deviation, int seed) {
  Rng rng(seed);
  VectorXd x = komo.path().variables();
  for (double& value : x) value += deviation * rng.normal();
  return x;
}

}  // namespace

TEST(ContactForces, JacobiansOfForcesAreThoseOfCentralDifferences) {
  for (const bool is_free : {false, true}) {
    const auto komo = pushed(is_free);
    const auto nlp = makeNlp(komo);
    for (int seed : {1, 2, 3}) {
      const JacobianCheck check = checkJacobian(*nlp, nearStart(*komo, .02, seed));
      EXPECT_LT(check.error, 1e-4) << nlp->rowName(check.row) << ", column " << check.column;
    }
  }
}

TEST(ContactForces, OnlyTheSlicesOfAContactHaveItsForce) {
  const auto komo = pushed(false);
  EXPECT_EQ(komo->path().layout().dimension, 7 + 3 * 14 + 2);  // the point, box and finger, two forces
  ASSERT_EQ(komo->interactions().size(), 2u);
  EXPECT_EQ(komo->interactions()[0].slice, 0);
  EXPECT_EQ(komo->interactions()[1].slice, 1);
  EXPECT_NEAR((komo->interactions()[0].force - Vector3d(2. * 9.81, 0., 0.)).norm(), 0., 1e-9);  // away from the finger
  EXPECT_NEAR((komo->interactions()[0].point - Vector3d(0., .2, .65)).norm(), 0., 1e-6);
}

TEST(ContactForces, WithoutAForceABodyFallsAndWithItsWeightItRests) {
  Config config = boxAndFinger();
  config.getFrame("finger").setPosition({.1, .2, .5});
  Komo komo(config, 3., 1, 2);
  komo.addContactForce({1., 2.}, "box", "finger", .5, 2.);
  const int first = int(komo.objectives().size());
  komo.addObjective({2.}, FeatureSymbol::physics, {"box"}, ObjectiveType::eq);
  komo.addObjective({3.}, FeatureSymbol::physics, {"box"}, ObjectiveType::eq);
  komo.addObjective({1.}, FeatureSymbol::physics, {"box"}, ObjectiveType::eq);
  const auto residual = [&](int objective, int slice) {
    Residual r =
        residualIn(komo.objectives()[std::size_t(first + objective)], komo.path(), komo.contacts().forces(), slice);
    const State* states[] = {&komo.path().state(slice - 2), &komo.path().state(slice - 1), &komo.path().state(slice)};
    VectorXd y(r.rows());
    r.eval(states, 1., y, nullptr);
    return y;
  };
  EXPECT_LT(residual(0, 1).norm(), 1e-6);
  EXPECT_LT(residual(1, 2).norm(), 1e-6);
  EXPECT_NEAR(residual(2, 0)[2], 9.81, 1e-9);  // the previous slice has no contact
}

namespace {

/// An asymmetric body in a Komo with physics.
std::shared_ptr<Komo> tumbling() {
  Config config;
  config.addText("world: {}\n body (world): { joint: free }");
  config.getFrame("body").setMass(2., {.1, .2, .4});
  auto komo = std::make_shared<Komo>(config, 3., 1, 2);
  komo->addObjective({3.}, FeatureSymbol::physics, {"body"}, ObjectiveType::eq);
  return komo;
}

}  // namespace

TEST(Physics, ABodyThatTumblesFreelyFollowsEulersEquations) {
  const auto komo = tumbling();
  const Vector3d inertia(.1, .2, .4);
  const double tau = 1e-3;
  Vector3d w(1., 2., 3.);  // in body coordinates
  Quaterniond turn(.8, .2, -.4, .4);
  turn.normalize();
  constexpr int kSteps = 100;  // per slice
  for (int t = 0; t < 3; ++t) {
    VectorXd q = VectorXd::Zero(7);
    q.tail(4) = Eigen::Vector4d(turn.w(), turn.x(), turn.y(), turn.z());
    komo->path().setSlice(t, q.data());
    for (int i = 0; i < kSteps; ++i) {
      const double dt = tau / kSteps;
      const auto acceleration = [&](const Vector3d& v) {
        return Vector3d(-v.cross(inertia.cwiseProduct(v)).cwiseQuotient(inertia));
      };
      const Vector3d middle = w + .5 * dt * acceleration(w);
      turn = turn * Quaterniond(Eigen::AngleAxisd(middle.norm() * dt, middle.normalized()));
      w += dt * acceleration(middle);
    }
  }
  Residual residual = residualIn(komo->objectives()[0], komo->path(), komo->contacts().forces(), 2);
  const State* states[] = {&komo->path().state(0), &komo->path().state(1), &komo->path().state(2)};
  VectorXd y(6);
  residual.eval(states, tau, y, nullptr);
  EXPECT_LT(y.tail<3>().norm() / tau, 1e-3) << "rad/s^2; without the gyroscopic torque it would be above 10";
}

TEST(Physics, JacobiansWithGyroscopicTorquesAreThoseOfCentralDifferences) {
  const auto komo = tumbling();
  const auto nlp = makeNlp(komo);
  for (int seed : {1, 2, 3}) {
    const JacobianCheck check = checkJacobian(*nlp, nearStart(*komo, .2, seed));
    EXPECT_LT(check.error, 1e-6) << nlp->rowName(check.row) << ", column " << check.column;
  }
}

TEST(ContactForces, MistakesAreExplained) {
  Komo komo(boxAndFinger(), 1., 1, 0);
  EXPECT_THROW(komo.addContactForce({}, "bix", "finger", .5, 1.), FrameNotFound);
  EXPECT_THROW(komo.addContactForce({}, "box", "box", .5, 1.), ValueError);
  EXPECT_THROW(komo.addContactForce({}, "box", "finger", 0., 1.), ValueError);
  EXPECT_THROW(komo.addContactForce({}, "box", "finger", .5, 0.), ValueError);
  EXPECT_THROW(komo.addContactForce({3.}, "box", "finger", .5, 1.), ValueError);
}
