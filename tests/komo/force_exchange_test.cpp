#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"
#include "kinegraph/features/residual.h"
#include "kinegraph/komo/force_exchange.h"
#include "kinegraph/komo/komo.h"
#include "kinegraph/komo/objective.h"
#include "kinegraph/komo/objective_list.h"
#include "kinegraph/komo/path/contacts.h"
#include "kinegraph/komo/path/path.h"

using namespace kinegraph;

namespace {

Config ballAndBox() {
  Config config;
  config.addText(R"(
    world: {}
    floor (world): { Q: [0, 0, -.05], shape: ssBox, size: [4, 4, .1, .01] }
    box (world): { Q: [.1, .2, .1], joint: free, shape: ssBox, size: [.2, .2, .2, .01], mass: 2 }
    ball (world): { Q: [-.15, .22, .12], joint: free, shape: sphere, size: [.05], mass: .5 }
  )");
  return config;
}

constexpr ForceExchange kKinds[] = {ForceExchange::slide, ForceExchange::stick, ForceExchange::complementary,
                                    ForceExchange::bounce};

}  // namespace

TEST(Exchanges, JacobiansAreThoseOfCentralDifferences) {
  for (const ForceExchange kind : kKinds) {
    for (const int order : {0, 1, 2}) {
      if (kind == ForceExchange::bounce && order < 2) continue;
      const auto komo = std::make_shared<Komo>(ballAndBox(), 4., 1, order);
      komo->addForceExchange({2., 3.}, "box", "ball", kind);
      if (order == 2) komo->addObjective({}, FeatureSymbol::physics, {"box"}, ObjectiveType::eq);
      const auto nlp = makeNlp(komo);
      Rng rng(3);
      VectorXd x = komo->path().variables();
      for (double& value : x) value += .03 * rng.normal();
      const JacobianCheck check = checkJacobian(*nlp, x);
      EXPECT_LT(check.error, 1e-4) << int(kind) << ", order " << order << ": " << nlp->rowName(check.row) << ", column "
                                   << check.column;
    }
  }
}

TEST(Exchanges, AddSixDofsToEachOfTheirSlices) {
  Komo komo(ballAndBox(), 4., 1, 2);
  komo.addForceExchange({2., 3.}, "box", "ball", ForceExchange::slide);
  EXPECT_EQ(komo.path().layout().dimension, 4 * 14 + 2 * 6);
  komo.addForceExchange({2., 3.}, "box", "ball", ForceExchange::bounce);
  EXPECT_EQ(komo.path().layout().dimension, 4 * 14 + 3 * 6) << "a bounce takes one slice";
  ASSERT_EQ(komo.interactions().size(), 3u);
  EXPECT_EQ(komo.interactions()[0].object, "box");
}

TEST(Exchanges, WhatSticksMovesAlong) {
  Komo komo(ballAndBox(), 3., 1, 1);
  komo.addForceExchange({1., 3.}, "box", "ball", ForceExchange::stick);
  const auto& objectives = komo.objectives();
  const auto sliding =
      std::find_if(objectives.begin(), objectives.end(), [](const auto& o) { return o.name() == "slidingVelocity"; });
  ASSERT_NE(sliding, objectives.end());
  EXPECT_EQ(sliding->from, 1) << "the first slice is where they meet";
  const auto slidingIn = [&](const Vector3d& box_moves, const Vector3d& ball_moves) {
    VectorXd q = komo.path().state(1).q();
    const KinematicModel& model = komo.path().state(1).model();
    q.segment<3>(model.frame_dofs[model.frame_index.at("box")].first) += box_moves;
    q.segment<3>(model.frame_dofs[model.frame_index.at("ball")].first) += ball_moves;
    komo.path().setSlice(1, q.data());
    Residual residual = residualIn(*sliding, komo.path(), komo.contacts().forces(), 1);
    const State* states[] = {&komo.path().state(0), &komo.path().state(1)};
    VectorXd y(3);
    residual.eval(states, 1., y, nullptr);
    return y;
  };
  EXPECT_LT(slidingIn({.1, 0., .2}, {.1, 0., .2}).norm(), 1e-12);
  EXPECT_LT((slidingIn({0., .3, 0.}, {0., 0., 0.}) - Vector3d(0., .3, 0.)).norm(), 1e-12)
      << "the velocity of the box as the ball sees it";
}

TEST(Exchanges, MistakesAreExplained) {
  Komo komo(ballAndBox(), 2., 1, 1);
  EXPECT_THROW(komo.addForceExchange({1.}, "box", "ball", ForceExchange::bounce), ValueError);
  EXPECT_THROW(komo.addForceExchange({1.}, "box", "box", ForceExchange::slide), ValueError);
  EXPECT_THROW(komo.addForceExchange({1.}, "bux", "ball", ForceExchange::slide), FrameNotFound);
  EXPECT_THROW(komo.addForceExchange({3.}, "box", "ball", ForceExchange::slide), ValueError);
}
