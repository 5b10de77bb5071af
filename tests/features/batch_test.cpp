#include "kinegraph/features/eval.h"

#include <gtest/gtest.h>

#include <memory>
#include <set>

#include "kinegraph/collision/edge_checkers.h"
#include "kinegraph/features/make_residual.h"
#include "tests/features/heap.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

/// An arm with three joints between two blocks.
Config arm() {
  Config config;
  config.addText(R"g(
    base: { X: "t(0 0 .5)" }
    one(base): { joint: hingeZ, limits: [-1 1] }
    two(one): { pre: "t(.4 0 0)", joint: hingeY, limits: [-1 1], shape: capsule, size: [.2 .05], contact: 1 }
    tip(two): { pre: "t(.4 0 .1)", joint: transX, shape: ssBox, size: [.1 .1 .1 .02], contact: 1 }
    left: { X: "t(.5 .5 .5)", shape: ssBox, size: [.3 .3 .3 .05], contact: 1 }
    right: { X: "t(.6 -.5 .5)", shape: sphere, size: [.2], contact: 1 }
  )g");
  return config;
}

RowMatrix randomJoints(int count, int dofs, int seed = 3) {
  Rng rng{std::uint64_t(seed)};
  RowMatrix Q(count, dofs);
  for (double& q : Q.reshaped()) q = .7 * rng.normal();
  return Q;
}

struct Results {
  RowMatrix y, J, poses, distances;
  std::vector<char> valid;

  bool operator==(const Results& other) const {
    return y == other.y && J == other.J && poses == other.poses && distances == other.distances && valid == other.valid;
  }
};

Results evaluateAll(const Config& config, const RowMatrix& Q, int threads) {
  const Residual residual = makeResidual(config.state(), FeatureSymbol::pose, {"tip"});
  const int frame = config.getFrame("tip").id(), count = int(Q.rows());
  Results out{RowMatrix(count, 7),
              RowMatrix(7 * count, Q.cols()),
              RowMatrix(count, 14),
              RowMatrix(count, Eigen::Index(config.getCollidablePairs().size())),
              {}};
  const BatchOptions options{threads};
  JacobianRows J = out.J;
  evalBatch(config.state(), residual, Q, out.y, &J, options);
  framePoses(config.state(), {0, frame}, Q, out.poses, options);
  pairDistances(config.state(), Q, out.distances, options);
  const auto valid = std::make_unique<bool[]>(std::size_t(count));
  areValid(config.state(), Q, .01, {valid.get(), std::size_t(count)}, options);
  out.valid.assign(valid.get(), valid.get() + count);
  return out;
}

}  // namespace

TEST(Batch, GivesWhatSingleConfigurationsGive) {
  Config config = arm();
  const RowMatrix Q = randomJoints(100, 3);
  const VectorXd before = config.getJointState();
  const Results all = evaluateAll(config, Q, 1);
  EXPECT_EQ(config.getJointState(), before);
  int invalid = 0;
  for (int i = 0; i < 100; ++i) {
    config.setJointState(Q.row(i).transpose());
    const Evaluation one = eval(config, FeatureSymbol::pose, {"tip"});
    EXPECT_LT((all.y.row(i).transpose() - one.y).lpNorm<Eigen::Infinity>(), 1e-12);
    EXPECT_LT((all.J.middleRows(7 * i, 7) - one.J).lpNorm<Eigen::Infinity>(), 1e-12);
    const MatrixXd poses = config.getFrameState();
    EXPECT_EQ(all.poses.row(i).head<7>(), poses.row(0));
    EXPECT_LT((all.poses.row(i).tail<7>() - poses.row(config.getFrame("tip").id())).lpNorm<Eigen::Infinity>(), 1e-12);
    bool inside = std::abs(Q(i, 0)) <= 1. && std::abs(Q(i, 1)) <= 1.;
    const auto pairs = config.getCollidablePairs();
    for (std::size_t pair = 0; pair < pairs.size(); ++pair) {
      const std::vector<std::string> names = {config.getFrame(pairs[pair].first).getName(),
                                              config.getFrame(pairs[pair].second).getName()};
      const double distance = -eval(config, FeatureSymbol::distance, names).y[0];
      EXPECT_EQ(all.distances(i, Eigen::Index(pair)), distance);
      if (distance < .01) inside = false;
    }
    EXPECT_EQ(bool(all.valid[i]), inside) << i;
    invalid += !inside;
  }
  EXPECT_GT(invalid, 20);
  EXPECT_LT(invalid, 80);
}

TEST(Batch, GivesTheSameNumbersOnAnyNumberOfThreads) {
  const Config config = arm();
  const RowMatrix Q = randomJoints(1001, 3);
  const Results one = evaluateAll(config, Q, 1);
  for (int threads : {2, 3, 8}) EXPECT_TRUE(evaluateAll(config, Q, threads) == one) << threads;
}

TEST(Batch, ReusedCheckersBelongToThePresentScene) {
  Config config = arm();
  const RowMatrix Q = randomJoints(200, 3);
  EdgeCheckers kept;
  const auto answers = [&](double margin, int threads, EdgeCheckers* checkers) {
    const auto valid = std::make_unique<bool[]>(std::size_t(Q.rows()));
    areValid(config.state(), Q, margin, {valid.get(), std::size_t(Q.rows())},
             {.threads = threads, .checkers = checkers});
    const auto free = std::make_unique<bool[]>(std::size_t(Q.rows() - 1));
    areMotionsFree(config.state(), Q.topRows(Q.rows() - 1), Q.bottomRows(Q.rows() - 1), margin, 1e-4,
                   {free.get(), std::size_t(Q.rows() - 1)}, {.threads = threads, .checkers = checkers});
    std::vector<bool> all(valid.get(), valid.get() + Q.rows());
    all.insert(all.end(), free.get(), free.get() + Q.rows() - 1);
    return all;
  };
  std::set<std::vector<bool>> different;
  for (const double x : {2., .3, .1}) {
    Frame post = config.findFrame("post") ? config.getFrame("post") : config.addFrame("post");
    post.setShape(ShapeType::sphere, {.1}).setPosition({x, 0., .2}).setContact(1);
    for (const double margin : {0., .02}) {
      const std::vector<bool> wanted = answers(margin, 1, nullptr);
      for (const int threads : {1, 3}) EXPECT_EQ(answers(margin, threads, &kept), wanted);
      different.insert(wanted);
    }
  }
  EXPECT_GT(different.size(), 2u);
  const auto first = kept.take(config.state(), .01, 1e-4);
  EXPECT_EQ(first->margin(), .01);
  Config other(config);
  other.addFrame("other");
  EXPECT_EQ(kept.take(other.state(), 0.)->scene().sharedModel(), other.model());
}

TEST(Batch, NoConfigurationsAreFine) {
  const Config config = arm();
  EXPECT_EQ(evaluateAll(config, RowMatrix(0, 3), 2).y.rows(), 0);
}

TEST(Batch, RequestsNoMemoryPerConfiguration) {
  const Config config = arm();
  const State& scene = config.state();
  const Residual residual = makeResidual(scene, FeatureSymbol::position, {"tip"});
  const int pairs = int(config.getCollidablePairs().size()), most = 2000;
  const RowMatrix all = randomJoints(most, 3);
  RowMatrix y(most, 3), J(3 * most, 3), poses(most, 7), twists(6 * most, 3), distances(most, pairs);
  const auto valid = std::make_unique<bool[]>(std::size_t(most));
  const auto requestsFor = [&](int count) {
    const auto Q = all.topRows(count);
    JacobianRows rows = J.topRows(3 * count);
    const long before = heap_requests;
    evalBatch(scene, residual, Q, y.topRows(count), &rows);
    framePoses(scene, {3}, Q, poses.topRows(count));
    frameJacobians(scene, {3}, Q, twists.topRows(6 * count));
    pairDistances(scene, Q, distances.topRows(count));
    areValid(scene, Q, 0., {valid.get(), std::size_t(count)});
    return heap_requests - before;
  };
  EXPECT_GT(requestsFor(1), 0);
  EXPECT_EQ(requestsFor(most), requestsFor(1));
}

TEST(Batch, StopsWhereBetweenThrows) {
  const Config config = arm();
  const RowMatrix Q = randomJoints(1000, 3);
  RowMatrix poses(1000, 7);
  const BatchOptions options{1, [] { throw Error("stopped"); }};
  expectError<Error>([&] { framePoses(config.state(), {0}, Q, poses, options); }, {"stopped"});
}

TEST(Batch, JointVectorsOfAnotherLengthOrNotFiniteAreErrors) {
  const Config config = arm();
  RowMatrix poses(4, 7);
  expectError<ValueError>([&] { framePoses(config.state(), {0}, RowMatrix::Zero(4, 2), poses); }, {"4 x 2", "3 dofs"});
  RowMatrix Q = RowMatrix::Zero(4, 3);
  Q(2, 1) = std::nan("");
  expectError<ValueError>([&] { framePoses(config.state(), {0}, Q, poses); }, {"row 2", "not finite"});
}

TEST(Batch, FeaturesOfSeveralConfigurationsAreAnError) {
  const Config config = arm();
  const Residual velocity = makeResidual(config.state(), FeatureSymbol::position, {"tip"}, {}, {}, 1);
  RowMatrix y(2, 3);
  expectError<ValueError>([&] { evalBatch(config.state(), velocity, RowMatrix::Zero(2, 3), y, nullptr); },
                          {"position", "order 1"});
}
