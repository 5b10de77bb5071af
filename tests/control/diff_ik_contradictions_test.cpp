#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kinegraph/common/random.h"
#include "kinegraph/common/text.h"
#include "kinegraph/control/diff_ik.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

/// An arm of `joints` hinges with two fingers that one joint opens; `half_gap` (m) is half the distance of their
/// centers, which are 20 mm wide.
Config armWithFingers(int joints, double half_gap) {
  std::string text = "base: {}\n", parent = "base";
  for (int i = 0; i < joints; ++i) {
    text += cat("l", i, " (", parent, "): { pre: \"t(0 0 .15)\", joint: hinge", i % 2 ? "Y" : "Z",
                ", limits: [-2.9 2.9] }\n");
    parent = cat("l", i);
  }
  text += cat("hand (", parent, "): { Q: [0 0 .1] }\nf (hand): { joint: transY, limits: [0 .04] }\n",
              "left (f): { Q: [0 ", half_gap, " .05], shape: box, size: [.02 .02 .06], contact: -1 }\n",
              "g (hand): { joint: transY, mimic: f, joint_scale: -1 }\n", "right (g): { Q: [0 ", -half_gap,
              " .05], shape: box, size: [.02 .02 .06], contact: -1 }\n");
  Config C;
  C.addText(text);
  return C;
}

}  // namespace

TEST(DiffIk, FingersThatCannotPartInOneStepPartAndTheArmFollowsItsTask) {
  for (const double depth : {-.002, .0002, .001}) {
    Config C = armWithFingers(5, .01 - depth / 2.);
    VectorXd q(6), there(6);
    q << .3, .4, .5, .6, .7, 0.;
    there = q.array() + .2;
    there[5] = 0.;
    C.setJointState(there);
    const Vector3d target = C.getFrame("hand").getPosition();
    C.setJointState(q);
    DiffIkOptions options;
    options.velocity = VectorXd::Constant(6, 2.4);
    options.velocity[5] = .2;
    DiffIk ik(C, options);
    ik.addTask(FeatureSymbol::position, {"hand"}, 1., 1., target);
    EXPECT_NEAR(ik.step(.01)[5], .2, depth > 0. ? 1e-6 : 1.);  // as fast as the joint may
    for (int i = 0; i < 200; ++i) ik.step(.01);
    EXPECT_LT((C.getFrame("hand").getPosition() - target).norm(), 1e-5) << depth;
    EXPECT_GT(C.getJointState()[5], (.01 + depth) / 2. - 1e-4) << depth;  // the margin is 1 cm
    EXPECT_EQ(ik.status(), DiffIkStatus::solved) << ik.message();
  }
}

TEST(DiffIk, AnArmInABallLeavesItForAnyWeight) {
  for (int seed = 0; seed < 60; ++seed) {
    Rng rng{std::uint64_t(seed)};
    const int n = 2 + seed % 6;
    std::string text = "base: {}\n", parent = "base";
    const char* const types[] = {"hingeX", "hingeY", "hingeZ", "transZ", "transX"};
    for (int i = 0; i < n; ++i) {
      text += cat("l", i, " (", parent, "): { pre: \"t(0 0 .2)\", joint: ", types[int(rng.uniform(0., 4.999))],
                  ", limits: [-1.5 1.5] }\ns", i, " (l", i,
                  "): { shape: capsule, size: [.15 .03], Q: \"t(0 0 .1)\", contact: -2 }\n");
      parent = cat("l", i);
    }
    Config C;
    C.addText(cat(text, "hand (", parent, "): { Q: [0 0 .2] }\n"));
    VectorXd q(n), speeds(n);
    for (int i = 0; i < n; ++i) q[i] = rng.uniform(-1., 1.), speeds[i] = std::pow(10., rng.uniform(-2., 1.));
    C.setJointState(q);
    const Vector3d near = C.getFrame(cat("s", n / 2)).getPosition();
    C.addFrame("ball")
        .setShape(ShapeType::sphere, {rng.uniform(.02, .15)})
        .setContact(1)
        .setPosition(near + Vector3d(rng.uniform(-.1, .1), rng.uniform(-.1, .1), rng.uniform(-.1, .1)));
    for (const double weight : {1., 1e3}) {
      C.setJointState(q);
      DiffIk ik(C, {.velocity = speeds});
      ik.addTask(FeatureSymbol::position, {"hand"}, weight, 1.,
                 C.getFrame("hand").getPosition() + Vector3d(.05, -.05, .02));
      double fastest = 0.;
      for (int i = 0; i < 100; ++i) {
        const VectorXd velocity = ik.step(.01);
        EXPECT_LE((velocity.cwiseAbs() - speeds).maxCoeff(), 1e-9) << seed;
        fastest = std::max(fastest, velocity.cwiseAbs().maxCoeff());
      }
      EXPECT_GT(fastest, 1e-9) << seed << " stands still";
    }
  }
}

TEST(DiffIk, AJointWithEqualLimitsStays) {
  Config C;
  C.addText(R"scene(
base: {}
slide (base): { joint: hingeZ, limits: [.3 .3], q: .3 }
elbow (slide): { joint: hingeZ, pre: "t(.5 0 0)", limits: [-2 2] }
wrist (elbow): { joint: hingeZ, pre: "t(.4 0 0)", limits: [-2 2] }
tip (wrist): { Q: [.3 0 0] }
goal (base): { Q: [0 1.1 0] }
)scene");
  DiffIk ik(C, {.velocity = VectorXd::Ones(3)});
  ik.addTask(FeatureSymbol::positionDiff, {"tip", "goal"});
  for (int i = 0; i < 300; ++i) {
    ik.step(.01);
    EXPECT_NEAR(C.getJointState()[0], .3, 1e-12);
  }
  EXPECT_GT((C.getJointState() - Eigen::Vector3d(.3, 0., 0.)).norm(), .1);
}

TEST(DiffIk, NonsenseIsRefusedAndNothingMoves) {
  Config C = armWithFingers(3, .03);
  DiffIk ik(C);
  ik.addTask(FeatureSymbol::position, {"hand"}, 1., 1., Vector3d(.2, .1, .4));
  const VectorXd before = C.getJointState();
  const double inf = std::numeric_limits<double>::infinity();
  for (const double dt : {inf, std::nan(""), -1., 0.})
    expectError<ValueError>([&] { ik.step(dt); }, {"dt is", "finite number > 0"});
  expectError<ValueError>([&] { ik.setPosture(VectorXd::Constant(4, std::nan(""))); }, {"posture", "not finite"});
  expectError<ValueError>([&] { ik.addTask(FeatureSymbol::position, {"hand"}, -1.); }, {"weight is -1"});
  EXPECT_EQ(C.getJointState(), before);
}
