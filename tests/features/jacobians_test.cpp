#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/feature_source.h"
#include "kinegraph/features/residual.h"
#include "kinegraph/scene/config.h"
#include "tests/support/differences.h"

using namespace kinegraph;

namespace {

constexpr double kTolerance = 1e-6;  ///< of a Jacobian, relative
constexpr double kTau = .3;          ///< s
constexpr int kSamples = 4;          ///< random joint vectors per feature, frames and order
constexpr double kLeastUsed = .9;    ///< fraction of the samples of a symbol that must be differentiable

/// Two chains whose joints are given, with a shape at the end of each, and a third body on the first chain. All of them
/// are turned against each other, so that no faces are parallel, and near enough to touch for some q.
std::string scene(const std::string& first, const std::string& second) {
  return "base: { X: \"t(.1 -.2 .3) d(25 .3 1 .2)\" }\n"
         "upper(base): { pre: \"t(.1 .1 0) d(70 1 .2 .5)\", " +
         first +
         " }\n"
         "lower(upper): { pre: \"t(.15 0 .1) d(-50 .4 1 .3)\", " +
         second +
         " }\n"
         "finger(lower): { Q: \"t(.03 .02 .04) d(35 1 .6 .2)\", shape: capsule, size: [.2 .03], contact: 1, mass: .7 "
         "}\n"
         "other(base): { pre: \"t(.2 .25 .05) d(-40 .2 .3 1)\", " +
         second +
         " }\n"
         "box(other): { Q: \"t(-.05 .06 .02) d(20 .5 1 .1)\", shape: ssBox, size: [.3 .24 .2 .02], contact: 1, mass: "
         "1.3 }\n"
         "block(base): { pre: \"t(.25 -.05 .3) d(65 .1 .3 .4)\", " +
         first + ", shape: ssBox, size: [.2 .16 .1 .03], contact: 1, mass: .4 }\n";
}

struct Scene {
  const char* name;
  const char* first;
  const char* second;
  const char* more = "";
};

constexpr Scene kScenes[] = {
    {"hinges", "joint: hingeX, limits: [-2 2]", "joint: hingeY"},
    {"hingesZ", "joint: hingeZ, joint_scale: 1.7", "joint: hinge, axis: [1 2 -1], limits: [-1 1.5]"},
    {"prismatic", "joint: transX, limits: [-.3 .3]", "joint: transZ"},
    {"trans3AndTransY", "joint: trans3", "joint: transY"},
    {"planarBase", "joint: transXYPhi, limits: [-1 -1 -2 1 1 2]", "joint: hingeX"},
    {"planarOthers", "joint: phiTransXY", "joint: transYPhi"},
    {"universal", "joint: universal", "joint: transXY"},
    {"quatBall", "joint: quatBall", "joint: hingeY"},
    {"free", "joint: hingeZ", "joint: free"},
    {"circleAndXBall", "joint: circleZ", "joint: XBall"},
    {"generic", "joint: _xAzb", "joint: hingeX"},
    {"mimic", "joint: hingeX, limits: [-2 2]", "joint: hingeY",
     "follower(finger): { pre: \"t(.1 0 0) d(30 1 1 0)\", joint: hingeX, mimic: upper, joint_scale: -.6, shape: "
     "sphere, size: [.05], contact: 1 }"},
};

Config makeScene(const Scene& joints) {
  Config config;
  config.addText(scene(joints.first, joints.second) + joints.more);
  return config;
}

/// The frames that a symbol is tested with: every choice of the number it takes.
std::vector<std::vector<int>> frameChoices(const FeatureInfo& info, const Config& config) {
  const auto id = [&](const char* name) { return config.getFrame(name).id(); };
  const std::vector<std::vector<int>> all = {{},
                                             {id("finger")},
                                             {id("lower")},
                                             {id("finger"), id("box")},
                                             {id("block"), id("box")},
                                             {id("finger"), id("box"), id("block")}};
  std::vector<std::vector<int>> fitting;
  for (const auto& frames : all) {
    const int count = int(frames.size());
    if (count >= info.min_frames && (info.max_frames < 0 || count <= info.max_frames)) fitting.push_back(frames);
  }
  return fitting;
}

VectorXd randomJoints(const Config& config, Rng& rng) {
  VectorXd q = config.model()->home;
  for (double& x : q) x += .3 * rng.normal();
  return q;
}

struct Count {
  int tried = 0, used = 0;
  double largest = 0.;  ///< largest entry of all Jacobians
};

/// The residual of consecutive configurations as a function of all their joint vectors.
void checkSamples(Residual& residual, const Config& config, Rng& rng, const std::string& what, Count& count) {
  const int n = config.getJointDimension(), slices = residual.order() + 1;
  std::vector<State> states(slices, config.state());
  std::vector<const State*> view;
  for (State& state : states) view.push_back(&state);
  const auto value = [&](const VectorXd& x) {
    for (int t = 0; t < slices; ++t) states[t].setJoints(x.data() + t * n);
    VectorXd y(residual.rows());
    residual.eval(view, kTau, y, nullptr);
    return y;
  };
  MatrixXd first;
  for (int sample = 0; sample < kSamples; ++sample) {
    VectorXd x(slices * n);
    for (int t = 0; t < slices; ++t) x.segment(t * n, n) = randomJoints(config, rng);
    const Differences numeric = differences(value, x);
    ++count.tried;
    if (!numeric.differentiable) continue;
    ++count.used;
    const VectorXd without_jacobian = value(x);
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J;
    J.setZero(residual.rows(), slices * n);
    VectorXd y(residual.rows());
    JacobianRows rows = J;
    residual.eval(view, kTau, y, &rows);
    EXPECT_EQ(y, without_jacobian) << what;
    EXPECT_LE(relativeError(J, numeric.D), kTolerance) << what << ", sample " << sample;
    if (first.size() == 0) first = J;
    if (residual.isLinear()) EXPECT_EQ(J, first) << what;
    if (J.size() > 0) count.largest = std::max(count.largest, J.cwiseAbs().maxCoeff());
  }
}

/// For test names.
struct Symbol {
  FeatureInfo info;
  friend void PrintTo(const Symbol& symbol, std::ostream* out) { *out << symbol.info.name; }
};

std::vector<Symbol> availableFeatures() {
  std::vector<Symbol> list;
  for (const FeatureInfo& info : featureRegistry()) {
    const bool needs_forces =
        info.symbol == FeatureSymbol::totalForce || info.symbol == FeatureSymbol::contactConstraints;
    if (info.available() && !needs_forces) list.push_back({info});  // constant without them; tests/komo has some
  }
  return list;
}

class EveryFeature : public ::testing::TestWithParam<Symbol> {};

}  // namespace

TEST_P(EveryFeature, HasTheJacobianOfCentralDifferences) {
  const FeatureInfo& info = GetParam().info;
  Rng rng(11);
  Count count;
  for (const Scene& joints : kScenes) {
    const Config config = makeScene(joints);
    int made = 0;
    std::string refusal;
    for (const std::vector<int>& frames : frameChoices(info, config)) {
      for (int order = 0; order <= 2; ++order) {
        std::unique_ptr<Residual> residual;
        try {
          residual = std::make_unique<Residual>(makeFeature(info.symbol, frames, *config.model()), MatrixXd(),
                                                VectorXd(), order, info.name);
        } catch (const ValueError& error) {  // frames without a joint, an order below the feature's own
          refusal = error.what();
          continue;
        }
        ++made;
        checkSamples(*residual, config, rng, cat(info.name, " of order ", order, " with ", joints.name), count);
      }
    }
    EXPECT_GE(made, 2) << "the scene of " << joints.name << " lacks frames that it takes: " << refusal;
  }
  EXPECT_GE(count.used, kLeastUsed * count.tried)
      << count.used << " of " << count.tried << " samples are differentiable";
  EXPECT_GT(count.largest, 1e-3) << "no joint of any scene changes it";
  RecordProperty("used", count.used);
  RecordProperty("tried", count.tried);
}

TEST_P(EveryFeature, HasAJacobianThatScaleAndTargetTransformLikeTheValue) {
  const FeatureInfo& info = GetParam().info;
  Rng rng(12);
  Count count;
  const auto random = [&](int rows, int columns) {
    MatrixXd numbers(rows, columns);
    for (double& x : numbers.reshaped()) x = rng.normal();
    return numbers;
  };
  for (const Scene& joints : kScenes) {
    const Config config = makeScene(joints);
    const std::vector<int> frames = frameChoices(info, config).front();
    const int rows = makeFeature(info.symbol, frames, *config.model())->rows();
    const int least_order = makeFeature(info.symbol, frames, *config.model())->order();
    if (rows == 0) continue;
    for (int order = least_order; order <= 2; ++order) {
      for (const MatrixXd& scale : {random(1, 1), random(rows, 1), random(2, rows)}) {
        Residual residual(makeFeature(info.symbol, frames, *config.model()), scale, random(rows, 1), order, info.name);
        ASSERT_EQ(residual.rows(), residual.mixesRows() ? 2 : rows);
        checkSamples(residual, config, rng,
                     cat(info.name, " of order ", order, ", scaled by ", scale.rows(), " x ", scale.cols(), ", with ",
                         joints.name),
                     count);
      }
    }
  }
  EXPECT_GE(count.used, kLeastUsed * count.tried);
  EXPECT_GT(count.used, 0);
}

TEST_P(EveryFeature, TellsTheSecondDerivativesThatItsJacobianHas) {
  const FeatureInfo& info = GetParam().info;
  Rng rng(13);
  int told = 0;
  for (const Scene& joints : kScenes) {
    const Config config = makeScene(joints);
    const int n = config.getJointDimension();
    std::vector<std::vector<int>> choices = frameChoices(info, config);
    for (const char* moving : {"finger", "block"}) {  // some have them only relative to fixed frames
      if (info.max_frames == 2) choices.push_back({config.getFrame(moving).id(), config.getFrame("base").id()});
    }
    for (const std::vector<int>& frames : choices) {
      std::shared_ptr<const Feature> feature;
      try {
        feature = makeFeature(info.symbol, frames, *config.model());
      } catch (const ValueError&) {  // frames without a joint
        continue;
      }
      const int rows = feature->rows();
      for (const bool mixes : {false, true}) {
        if (rows == 0 || feature->order() > 0) continue;
        const MatrixXd scale =
            mixes ? MatrixXd(MatrixXd::Random(2, rows)) : MatrixXd(VectorXd::LinSpaced(rows, .5, 2.));
        Residual residual(feature, scale, {}, 0, info.name);
        State state = config.state();
        if (!residual.hasCurvature(state)) continue;
        ++told;
        VectorXd weights(residual.rows());
        for (double& weight : weights) weight = rng.normal();
        const State* view[] = {&state};
        const auto gradient = [&](const VectorXd& q) -> VectorXd {
          state.setJoints(q.data());
          VectorXd y(residual.rows());
          Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J;
          J.setZero(residual.rows(), n);
          JacobianRows view_of_J = J;
          residual.eval(view, kTau, y, &view_of_J);
          return J.transpose() * weights;
        };
        const VectorXd q = randomJoints(config, rng);
        const Differences numeric = differences(gradient, q);
        ASSERT_TRUE(numeric.differentiable) << info.name << " with " << joints.name;
        state.setJoints(q.data());
        MatrixXd H = MatrixXd::Zero(n, n);
        residual.addCurvature(state, {weights.data(), std::size_t(weights.size())}, H);
        EXPECT_TRUE(MatrixXd(H.triangularView<Eigen::StrictlyUpper>()).isZero(0.));
        H.triangularView<Eigen::StrictlyUpper>() = H.transpose();
        EXPECT_LE(relativeError(H, numeric.D), kTolerance) << info.name << " with " << joints.name;
      }
    }
  }
  if (info.second_derivatives) EXPECT_GE(told, 20);
  if (!info.second_derivatives) EXPECT_EQ(told, 0) << "the registry does not say so";
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryFeature, ::testing::ValuesIn(availableFeatures()),
                         [](const auto& info) { return info.param.info.name; });
