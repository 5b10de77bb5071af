#include "kinegraph/features/distance.h"
#include "kinegraph/features/collisions.h"

#include <gtest/gtest.h>

#include "tests/features/worked_scene.h"
#include "tests/support/crowd.h"
#include "tests/support/differences.h"

using namespace kinegraph;

TEST(NegDistance, OfShapesApartIsMinusTheirGap) {
  const Config config = workedScene();
  for (const char* name : {"distance", "negDistance", "pairCollision_negScalar"}) {
    EXPECT_NEAR(value(config, name, {"A", "B"})[0], -.2, 1e-9) << name;
    EXPECT_NEAR(value(config, name, {"B", "A"})[0], -.2, 1e-9) << name;
    EXPECT_NEAR(value(config, name, {"A", "C"})[0], -.1, 1e-9) << name;
    EXPECT_NEAR(value(config, name, {"A", "P"})[0], -.1, 1e-9) << name;
    EXPECT_NEAR(value(config, name, {"A", "D"})[0], 0., 1e-9) << name;
    EXPECT_NEAR(value(config, name, {"C", "D"})[0], 0., 1e-9) << name;
  }
}

TEST(NegDistance, IsPositiveWhereShapesPenetrateByThatDepth) {
  Config config;
  config.addText("a: { shape: sphere, size: [.1] }  b: { X: [.15 0 0], shape: sphere, size: [.1] }");
  config.addText("c: { shape: ssBox, size: [1 1 1 .1] }  d: { X: [0 0 .55], shape: ssBox, size: [.4 .4 .4 .05] }");
  EXPECT_NEAR(value(config, "distance", {"a", "b"})[0], .05, 1e-12);
  EXPECT_NEAR(value(config, "distance", {"c", "d"})[0], .15, 1e-6);
}

TEST(NegDistance, HasTheJacobianOfCentralDifferencesInPenetrationToo) {
  Rng rng(21);
  struct Body {
    const char* shape;
    double tolerance = 1e-6;
  };
  const Body bodies[] = {{"shape: sphere, size: [.1]"},
                         {"shape: capsule, size: [.2 .05]"},
                         {"shape: ssBox, size: [.2 .2 .3 .03]"},
                         {"shape: box, size: [.1 .3 .2]"},
                         {"shape: cylinder, size: [.2 .1]"},
                         {"shape: ssCylinder, size: [.3 .1 .02]"},
                         {"shape: ssBoxElip, size: [.2 .1 .2 .03 .05 .02 .01]"},
                         {"shape: quad, size: [.2 .3]"}};
  for (const auto& [shape, tolerance] : bodies) {
    Config config;
    config.addText(std::string("box: { shape: ssBox, size: [.5 .4 .3 .02] }  base: {}  body(base): { joint: free, ") +
                   shape + " }");
    const auto distance = [&](const VectorXd& q) {
      config.setJointState(q);
      return value(config, "distance", {"body", "box"});
    };
    int deep = 0, used = 0;
    for (int sample = 0; sample < 40; ++sample) {
      VectorXd q(7);
      for (double& x : q) x = rng.normal();
      q.head(3) = q.head(3).normalized() * rng.uniform(.1, .25);
      const Differences numeric = differences(distance, q);
      if (distance(q)[0] < .01) continue;
      ++deep;
      if (!numeric.differentiable) continue;
      ++used;
      EXPECT_LE(relativeError(eval(config, FeatureSymbol::distance, {"body", "box"}).J, numeric.D), tolerance)
          << shape << ", sample " << sample;
    }
    EXPECT_GE(deep, 20) << shape;
    EXPECT_GE(used, .8 * deep) << shape;
  }
}

TEST(Witness, PointsNormalAndVectorAreThoseOfTheNearestSurfaces) {
  const Config config = workedScene();
  EXPECT_TRUE(near(value(config, "pairCollision_vector", {"A", "B"}), numbers({-.2, 0, 0}), 1e-6));
  EXPECT_TRUE(near(value(config, "pairCollision_normal", {"A", "B"}), numbers({-1, 0, 0}), 1e-6));
  EXPECT_TRUE(near(value(config, "pairCollision_p1", {"A", "B"}), numbers({1.2, 2, 3}), 1e-6));
  EXPECT_TRUE(near(value(config, "pairCollision_p2", {"A", "B"}), numbers({1.4, 2, 3}), 1e-6));
  EXPECT_TRUE(near(value(config, "pairCollision_vector", {"A", "C"}), numbers({0, 0, -.1}), 1e-6));
  EXPECT_TRUE(near(value(config, "pairCollision_normal", {"A", "C"}), numbers({0, 0, -1}), 1e-6));
}

TEST(Witness, VectorReversesWhereShapesPenetrate) {
  Config config;
  config.addText("a: { shape: sphere, size: [.1] }  b: { X: [.15 0 0], shape: sphere, size: [.1] }");
  EXPECT_TRUE(near(value(config, "pairCollision_vector", {"a", "b"}), numbers({.05, 0, 0}), 1e-12));
  EXPECT_TRUE(near(value(config, "pairCollision_normal", {"a", "b"}), numbers({-1, 0, 0}), 1e-12));
}

TEST(Witness, HasTheDerivativeOfOneSideWhereTheNearestFeatureChanges) {
  Config config;
  config.addText(R"g(
    table: { shape: box, size: [.4 .4 .1] }
    base: { X: [0 0 .2] }
    ball (base): { joint: transX, shape: sphere, size: [.05] }
  )g");
  const auto rate = [&](double x) {
    config.setJointState(numbers({x}));
    return eval(config, FeatureSymbol::pairCollision_p2, {"ball", "table"}).J(0, 0);
  };
  EXPECT_NEAR(rate(.19), 1., 1e-6) << "above the face the point follows";
  EXPECT_NEAR(rate(.21), 0., 1e-6) << "beyond the edge it stays there";
  EXPECT_NEAR(rate(.2), 0., 1e-6) << "and not the mean of both";
  EXPECT_NEAR(rate(-.2), 0., 1e-6);
}

TEST(Oppose, SumsTheVectorsFromTheObjectToTheFingers) {
  const Config config = workedScene();
  EXPECT_TRUE(near(value(config, "oppose", {"B", "D", "A"}), numbers({.35, 0, .1}), 1e-5));
  EXPECT_TRUE(
      near(value(config, "opposeCentral", {"B", "D", "A"}), numbers({.35, 0, .1, -.00661, .00497, .00005}), 1e-5));
}

TEST(Oppose, IsZeroForFingersOnOppositeSides) {
  Config config;
  config.addText("l: { X: [-.3 0 0], shape: sphere, size: [.02] }  r: { X: [.3 0 0], shape: sphere, size: [.02] }");
  config.addText("o: { shape: sphere, size: [.1] }");
  EXPECT_TRUE(near(value(config, "opposeCentral", {"l", "r", "o"}), VectorXd::Zero(6), 1e-4));
}

TEST(AccumulatedCollisions, SumTheDepthsOfAllCollidablePairs) {
  Config config;
  config.addText(
      "a: { shape: sphere, size: [.1], contact: 1 }  b: { X: [.15 0 0], shape: sphere, size: [.1], contact: 1 }");
  EXPECT_NEAR(value(config, "accumulatedCollisions", {})[0], .05, 1e-12);
  config.addText("c: { X: [0 .18 0], shape: sphere, size: [.1], contact: 1 }  d: { shape: sphere, size: [.1] }");
  EXPECT_NEAR(value(config, "accumulatedCollisions", {})[0], .07, 1e-12);
  config.getFrame("b").setPosition({3, 0, 0});
  EXPECT_NEAR(value(config, "accumulatedCollisions", {})[0], .02, 1e-12) << "never stale";
}

TEST(AccumulatedCollisions, OfNamedFramesLookAtThoseAndNoOthers) {
  Config config;
  config.addText(
      "a: { shape: sphere, size: [.1], contact: 1 }  b: { X: [.15 0 0], shape: sphere, size: [.1], contact: 1 }");
  config.addText("c: { X: [0 .18 0], shape: sphere, size: [.1], contact: 1 }");
  EXPECT_NEAR(value(config, "accumulatedCollisions", {"b"})[0], .05, 1e-12);
  EXPECT_NEAR(value(config, "accumulatedCollisions", {"c"})[0], .02, 1e-12);
  EXPECT_NEAR(value(config, "accumulatedCollisions", {"b", "c"})[0], .07, 1e-12);
}

TEST(AccumulatedCollisions, OfManyBodiesAreThoseOfTheConfigWithTheirJacobian) {
  Config config = kinegraph::testing::crowd(100, .6, 11);
  const auto sum = [&](const VectorXd& q) {
    config.setJointState(q);
    return value(config, "accumulatedCollisions", {});
  };
  Rng rng(12);
  for (int sample = 0; sample < 3; ++sample) {
    VectorXd q = config.getJointState();
    for (double& x : q) x += .02 * rng.normal();
    const double depths = sum(q)[0];
    EXPECT_NEAR(depths, config.getTotalPenetration(), 1e-12);
    EXPECT_GT(depths, .5);
    const Differences numeric = differences(sum, q, 1e-6);
    config.setJointState(q);
    const MatrixXd J = eval(config, FeatureSymbol::accumulatedCollisions, {}).J;
    int same = 0;  // pairs at the onset of contact and non-smooth points of single pairs affect single columns
    for (int i = 0; i < J.cols(); ++i) same += std::abs(J(0, i) - numeric.D(0, i)) < 1e-5;
    EXPECT_GE(same, J.cols() - 3);
  }
  const double one = value(config, "accumulatedCollisions", {"body5", "link1"})[0];
  double expected = 0.;
  for (const auto& pair : config.getCollisions()) {
    for (const char* name : {"body5", "link1"}) {
      const int id = config.getFrame(name).id();
      if (pair.a == id || pair.b == id) expected -= pair.distance;
    }
  }
  for (const auto& pair : config.getCollisions()) {
    const int a = config.getFrame("body5").id(), b = config.getFrame("link1").id();
    if (std::minmax(pair.a, pair.b) == std::minmax(a, b)) expected += pair.distance;
  }
  EXPECT_NEAR(one, expected, 1e-12);
}

TEST(PairCollisions, HasARowForEachPairThatIsItsNegativeDistance) {
  Config config;
  config.addText(
      "a: { shape: sphere, size: [.1], contact: 1 }  b: { X: [.15 0 0], shape: sphere, size: [.1], contact: 1 }");
  config.addText("c: { X: [0 .26 0], shape: sphere, size: [.1], contact: 1 }");
  EXPECT_TRUE(near(value(config, "pairCollisions", {}), numbers({.05, -.06, -.1}), 1e-12));
  EXPECT_TRUE(near(value(config, "pairCollisions", {"c"}), numbers({-.06, -.1}), 1e-12));
  config.getFrame("b").setPosition({3, 0, 0});
  EXPECT_TRUE(near(value(config, "pairCollisions", {"b"}), numbers({-.1, -.1}), 1e-12)) << "no farther than it looks";
}

TEST(PairCollisions, ThatArePositiveSumToTheAccumulatedOnes) {
  Config config;
  config.addText(
      "a: { shape: sphere, size: [.1], contact: 1 }  b: { X: [.15 0 0], shape: sphere, size: [.1], contact: 1 }");
  config.addText("c: { X: [0 .18 0], shape: ssBox, size: [.2 .2 .2 .02], contact: 1 }");
  const VectorXd each = value(config, "pairCollisions", {});
  EXPECT_NEAR(each.cwiseMax(0.).sum(), value(config, "accumulatedCollisions", {})[0], 1e-12);
  EXPECT_GT(each.maxCoeff(), .04);
}

TEST(PairCollisions, OfBodiesThatNoJointMovesApartFollowTheSceneWhenTheseArePlacedAnew) {
  Config config;
  config.addText(R"g(
    base: {}
    arm (base): { joint: hingeZ, shape: sphere, size: [.1], contact: 1 }
    left (arm): { Q: [.15 0 0], shape: sphere, size: [.1], contact: 1 }
    wall: { X: [0 .25 0], shape: sphere, size: [.1], contact: 1 }
    post: { X: [.15 .25 0], shape: sphere, size: [.1], contact: 1 }
  )g");
  const PairCollisions feature({}, *config.model(), PairChoice::scene);
  const auto values = [&] {
    const State* state = &config.state();
    VectorXd y(feature.rows());
    MatrixXd J = MatrixXd::Zero(feature.rows(), 1);
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = J;
    JacobianRows view = rows;
    feature.eval({&state, 1}, 1., y, &view);
    return std::pair(y, VectorXd(rows.col(0)));
  };
  for (const double q : {0., .7}) {
    for (const double x : {.15, .12, .4, .17}) {
      config.getFrame("left").setRelativePosition({x, 0, 0});
      config.getFrame("post").setPosition({x, .25, 0});
      config.setJointState(numbers({q}));
      const auto [y, rate] = values();
      int row = 0;
      for (const auto& [a, b] : config.model()->collidable()) {
        const double distance = (config.state().position(a) - config.state().position(b)).norm() - .2;
        EXPECT_NEAR(y[row], std::max(-distance, -.1), 1e-12) << x << ", " << q;
        if (config.model()->frame_link[a] == config.model()->frame_link[b]) EXPECT_EQ(rate[row], 0.);
        ++row;
      }
    }
  }
}
