#include "kinegraph/features/residual_cache.h"

#include <gtest/gtest.h>

#include "kinegraph/features/eval.h"
#include "tests/features/heap.h"
#include "tests/features/worked_scene.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

VectorXd cached(ResidualCache& cache, const Config& config, FeatureSymbol symbol,
                const std::vector<std::string>& frames, const MatrixXd& scale = {}, const VectorXd& target = {}) {
  Residual& residual = *cache.get(config.state(), symbol, frames, scale, target, -1);
  Evaluation out;
  out.y.resize(residual.rows());
  out.J.setZero(residual.rows(), config.getJointDimension());
  eval(config, residual, out.y, out.J);
  return out.y;
}

}  // namespace

TEST(ResidualCache, AnswersAsResidualsThatAreMadeAnew) {
  Config config = workedScene();
  ResidualCache cache;
  const FeatureSymbol symbols[] = {FeatureSymbol::positionDiff, FeatureSymbol::poseRel, FeatureSymbol::distance,
                                   FeatureSymbol::pairCollision_vector, FeatureSymbol::vectorZDiff};
  const MatrixXd scales[] = {MatrixXd(), MatrixXd::Constant(1, 1, 3.)};
  const VectorXd targets[] = {VectorXd(), VectorXd::Constant(1, .2)};
  for (int round = 0; round < 3; ++round) {
    config.getFrame("B").setPosition(Vector3d(1.5, 2. + .1 * round, 3.));
    for (FeatureSymbol symbol : symbols) {
      for (const auto& frames : {std::vector<std::string>{"A", "B"}, {"B", "A"}, {"C", "B"}}) {
        for (const MatrixXd& scale : scales) {
          for (const VectorXd& target : targets) {
            EXPECT_EQ(cached(cache, config, symbol, frames, scale, target),
                      eval(config, symbol, frames, scale, target).y);
          }
        }
      }
    }
  }
}

TEST(ResidualCache, FollowsTheStructureOfTheScene) {
  Config config = workedScene();
  ResidualCache cache;
  const VectorXd before = cached(cache, config, FeatureSymbol::position, {"B"});
  config.delFrame("A");  // shifts ids
  EXPECT_EQ(cached(cache, config, FeatureSymbol::position, {"B"}), before);
  config.delFrame("B");
  expectError<FrameNotFound>([&] { cached(cache, config, FeatureSymbol::position, {"B"}); }, {"position", "'B'"});
}

TEST(ResidualCache, TheSameQuestionAgainRequestsNoMemory) {
  const Config config = workedScene();
  ResidualCache cache;
  const std::vector<std::string> frames = {"A", "B"};
  cache.get(config.state(), FeatureSymbol::poseRel, frames, {}, {}, -1);
  const long before = heap_requests;
  cache.get(config.state(), FeatureSymbol::poseRel, frames, {}, {}, -1);
  EXPECT_EQ(heap_requests - before, 0);
}

TEST(ResidualCache, AWrongScaleIsAnErrorEachTime) {
  const Config config = workedScene();
  ResidualCache cache;
  for (int i = 0; i < 2; ++i) {
    expectError<ValueError>([&] { cached(cache, config, FeatureSymbol::position, {"B"}, MatrixXd::Ones(2, 2)); },
                            {"scale of position"});
    EXPECT_EQ(cached(cache, config, FeatureSymbol::position, {"B"}), eval(config, FeatureSymbol::position, {"B"}).y);
  }
}
