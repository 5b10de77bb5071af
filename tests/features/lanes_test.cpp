#include <gtest/gtest.h>

#include "kinegraph/common/text.h"
#include "kinegraph/features/eval.h"
#include "kinegraph/features/make_residual.h"
#include "kinegraph/math/lane_widths.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

/// All types of joints in one tree, quarter rotations and other constant ones, and a mimicking joint.
Config everyJoint() {
  Config config;
  config.addText(R"g(
    world: {}
    base(world): { joint: transXYPhi }
    post(base): { pre: "t(.2 .1 .5) d(90 1 0 0)", joint: hinge, axis: [1 2 3], joint_scale: 1.7 }
    roll(post): { pre: "t(.1 0 .3) d(40 .3 1 .2)", joint: hingeX, limits: [-2 2] }
    ball(roll): { pre: "t(0 .2 .1) d(90 0 0 1)", joint: quatBall }
    wrist(ball): { joint: universal }
    slide(wrist): { pre: "d(180 1 0 0)", joint: transZ, limits: [-.5 .5] }
    left(slide): { pre: "t(.1 .2 .3) d(50 1 1 1)", joint: circleZ }
    tip(left): { Q: "t(.1 .2 .3) d(120 1 1 1)", shape: capsule, size: [.2 .03], contact: 1, mass: .7 }
    other(post): { pre: "t(0 -.3 .2)", joint: hingeY, limits: [-1 1] }
    follower(other): { pre: "t(0 0 .3)", joint: hingeZ, mimic: roll, joint_scale: -.6 }
    planar(follower): { joint: phiTransXY }
    side(planar): { pre: "d(90 0 1 0)", joint: transYPhi }
    mixed(side): { pre: "t(.1 0 0)", joint: _xAzb }
    clock(mixed): { joint: tau }
    ballslide(clock): { joint: XBall }
    box(ballslide): { Q: "t(-.05 .06 .02) d(-90 0 0 1)", shape: ssBox, size: [.3 .24 .2 .02], contact: 1, mass: 1.3 }
    body(world): { pre: "t(.3 .2 .1)", joint: free, shape: ssBox, size: [.2 .16 .1 .03], contact: 1, mass: .4 }
    still(world): { Q: "t(1 2 3) d(30 0 1 0)", mass: .2 }
  )g");
  return config;
}

RowMatrix randomJoints(const Config& config, int count, double spread = 1.) {
  Rng rng(7);
  RowMatrix Q(count, config.getJointDimension());
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < Q.cols(); ++k) Q(i, k) = config.model()->home[k] + spread * rng.normal();
  }
  return Q;
}

struct Values {
  RowMatrix y, J;
};

Values inLanes(const Config& config, const Residual& residual, const RowMatrix& Q, int width) {
  const Eigen::Index rows = residual.rows();
  Values out{RowMatrix::Constant(Q.rows(), rows, 7.), RowMatrix::Constant(Q.rows() * rows, Q.cols(), 7.)};
  JacobianRows J = out.J;
  evalBatch(config.state(), residual, Q, out.y, &J, {.lanes = width});
  return out;
}

Values oneByOne(Config config, Residual residual, const RowMatrix& Q) {
  const Eigen::Index rows = residual.rows();
  Values out{RowMatrix(Q.rows(), rows), RowMatrix::Zero(Q.rows() * rows, Q.cols())};
  for (Eigen::Index i = 0; i < Q.rows(); ++i) {
    config.setJointState(Q.row(i).transpose());
    Eigen::Map<VectorXd> value(out.y.row(i).data(), rows);
    eval(config, residual, value, out.J.middleRows(i * rows, rows));
  }
  return out;
}

double difference(const RowMatrix& a, const RowMatrix& b) {
  return a.size() == 0 ? 0. : ((a - b).array().abs() / (1. + b.array().abs())).maxCoeff();
}

std::vector<std::vector<std::string>> frameChoices(const FeatureInfo& info) {
  std::vector<std::vector<std::string>> fitting;
  for (const std::vector<std::string>& names : std::vector<std::vector<std::string>>{{},
                                                                                     {"tip"},
                                                                                     {"still"},
                                                                                     {"slide"},
                                                                                     {"tip", "box"},
                                                                                     {"box", "still"},
                                                                                     {"body", "tip"},
                                                                                     {"still", "box"},
                                                                                     {"tip", "tip"},
                                                                                     {"tip", "box", "body"}}) {
    const int count = int(names.size());
    if (count >= info.min_frames && (info.max_frames < 0 || count <= info.max_frames)) fitting.push_back(names);
  }
  return fitting;
}

}  // namespace

TEST(Lanes, AllFeaturesGiveWhatOneConfigurationAloneGivesAtEveryWidth) {
  const Config config = everyJoint();
  const RowMatrix Q = randomJoints(config, 13);  // not a multiple of a width
  int in_lanes = 0, checked = 0;
  Rng rng(3);
  for (const FeatureInfo& info : featureRegistry()) {
    if (!info.available() || info.symbol == FeatureSymbol::totalForce)
      continue;  // its frames need a mass, and it has no rows in lanes
    for (const std::vector<std::string>& frames : frameChoices(info)) {
      for (int form = 0; form < 4; ++form) {  // without scale; a number, one per row, and a matrix
        std::unique_ptr<Residual> residual;
        try {
          residual = std::make_unique<Residual>(makeResidual(config.state(), info.symbol, frames));
        } catch (const ValueError&) {  // frames that the feature rejects
          continue;
        }
        if (residual->order() > 0) continue;
        const int rows = residual->rows();
        if (form > 0 && rows > 0) {
          MatrixXd scale(form == 1 ? 1 : form == 2 ? rows : 2, form == 3 ? rows : 1);
          for (double& x : scale.reshaped()) x = rng.normal();
          VectorXd target(form == 1 ? 1 : rows);
          for (double& x : target) x = rng.normal();
          residual->setScale(scale);
          residual->setTarget(target);
        }
        LaneRowList list;
        in_lanes += residual->feature().addLaneRows(list);
        const Values alone = oneByOne(config, *residual, Q);
        for (int width : laneWidths()) {
          const Values wide = inLanes(config, *residual, Q, width);
          EXPECT_LT(difference(wide.y, alone.y), 1e-12)
              << info.name << " of " << join(frames) << ", form " << form << ", width " << width;
          EXPECT_LT(difference(wide.J, alone.J), 1e-12)
              << info.name << " of " << join(frames) << ", form " << form << ", width " << width;
          ++checked;
        }
      }
    }
  }
  EXPECT_GT(in_lanes, 400);
  EXPECT_GT(checked, 500);
}

TEST(Lanes, AllWidthsGiveTheSameBits) {
  const Config config = everyJoint();
  const RowMatrix Q = randomJoints(config, 37);
  for (FeatureSymbol symbol : {FeatureSymbol::poseRel, FeatureSymbol::poseDiff, FeatureSymbol::pose}) {
    const Residual residual =
        makeResidual(config.state(), symbol, std::vector<std::string>(symbol == FeatureSymbol::pose ? 1 : 2, "tip"));
    const Values narrow = inLanes(config, residual, Q, 2);
    for (int width : laneWidths()) {
      const Values wide = inLanes(config, residual, Q, width);
      EXPECT_EQ(wide.y, narrow.y) << width;
      EXPECT_EQ(wide.J, narrow.J) << width;
    }
  }
}

TEST(Lanes, PosesAndGeometricJacobiansAreThoseOfTheState) {
  const Config config = everyJoint();
  const RowMatrix Q = randomJoints(config, 21);
  const int n = config.getJointDimension(), tip = config.getFrame("tip").id(), box = config.getFrame("box").id();
  State state = config.state();
  for (int width : laneWidths()) {
    RowMatrix poses(21, 14), J = RowMatrix::Constant(21 * 12, n, 7.);
    framePoses(config.state(), {tip, box}, Q, poses, {.lanes = width});
    frameJacobians(config.state(), {tip, box}, Q, J, {.lanes = width});
    for (int i = 0; i < 21; ++i) {
      state.setJoints(Q.row(i).data());
      RowMatrix expected = RowMatrix::Zero(12, n);
      for (int f = 0; f < 2; ++f) {
        const int frame = f == 0 ? tip : box;
        const Vector7d pose = Pose(state.pose(frame)).canonical().numbers();
        EXPECT_LT((poses.row(i).segment<7>(7 * f).transpose() - pose).norm(), 1e-12);
        state.addPointJacobian(frame, state.position(frame), 1., expected.middleRows(6 * f, 3));
        state.addAngularJacobian(frame, 1., expected.middleRows(6 * f + 3, 3));
      }
      EXPECT_LT(difference(J.middleRows(12 * i, 12), expected), 1e-12) << i;
    }
  }
}

TEST(Lanes, LargeAnglesAreRight) {
  Config config;
  config.addText("base: {}\nlink(base): { joint: hingeZ }\ntip(link): { Q: [1 0 0] }\n");
  RowMatrix Q(9, 1);
  Q << 0., 3.141592653589793, -1.5707963267948966, 99999., -1e5, 123456.789, -1e9, 1e18, 1e300;
  for (int width : laneWidths()) {
    const Values wide = inLanes(config, makeResidual(config.state(), FeatureSymbol::position, {"tip"}), Q, width);
    for (int i = 0; i < Q.rows(); ++i) {
      EXPECT_NEAR(wide.y(i, 0), std::cos(Q(i, 0)), 1e-15) << Q(i, 0);
      EXPECT_NEAR(wide.y(i, 1), std::sin(Q(i, 0)), 1e-15) << Q(i, 0);
      config.setJointState(Q.row(i).transpose());
      EXPECT_NEAR(config.getFrame("tip").getPose().p.x(), std::cos(Q(i, 0)), 1e-15) << Q(i, 0);
    }
  }
}

TEST(Lanes, QuaternionsHaveTheSignOfOneConfigurationAlone) {
  const Config config = everyJoint();
  const RowMatrix Q = randomJoints(config, 500, 3.);
  const Residual residual = makeResidual(config.state(), FeatureSymbol::quaternion, {"box"});
  const Values alone = oneByOne(config, residual, Q);
  for (int k = 0; k < 4; ++k)
    EXPECT_LT(alone.y.col(k).minCoeff(), -.4);  // covers all four branches of the conversion from rotation matrices
  for (int width : laneWidths()) EXPECT_LT(difference(inLanes(config, residual, Q, width).y, alone.y), 1e-12) << width;
}

TEST(Lanes, OtherWidthsAreAnError) {
  const Config config = everyJoint();
  RowMatrix poses(4, 7);
  expectError<ValueError>([&] { framePoses(config.state(), {0}, randomJoints(config, 4), poses, {.lanes = 3}); },
                          {"lanes", "3"});
}
