#include "kinegraph/features/eval.h"

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"

namespace kinegraph {

Residual makeResidual(const Program& program, FeatureSymbol symbol, const std::vector<std::string>& frames,
                      const MatrixXd& scale, const VectorXd& target, int order) {
  const FeatureInfo& info = featureInfo(symbol);
  std::vector<int> ids;
  for (const std::string& name : frames) ids.push_back(frameId(program, name, info.name));
  std::unique_ptr<Feature> feature;
  try {
    feature = makeFeature(symbol, ids, program);
  } catch (const ValueError& error) {
    throw ValueError(frames.empty() ? error.what() : cat(error.what(), " (frames: ", join(frames), ")"));
  }
  return Residual(std::move(feature), scale, target, order, info.name);
}

Evaluation eval(const Config& config, FeatureSymbol symbol, const std::vector<std::string>& frames, const MatrixXd& scale,
                const VectorXd& target, int order) {
  Residual residual = makeResidual(*config.program(), symbol, frames, scale, target, order);
  Evaluation out;
  out.y.resize(residual.rows());
  out.J.setZero(residual.rows(), config.getJointDimension());
  eval(config, residual, out.y, out.J);
  return out;
}

void eval(const Config& config, Residual& residual, Eigen::Ref<VectorXd> y, JacobianRows J) {
  if (residual.order() > 0) {
    throw ValueError(cat(residual.name(), " of order ", residual.order(), " needs ", residual.order() + 1,
                         " consecutive configurations; evaluate it in a KOMO"));
  }
  const State* state = &config.state();
  residual.eval({&state, 1}, 1., y, &J);
}

}  // namespace kinegraph
