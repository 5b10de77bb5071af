#include "kinegraph/features/eval.h"

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/make_residual.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

Residual features_internal::makeResidual(const State& scene, const FeatureSource& feature,
                                         const std::vector<std::string>& frames, const Scale& scale,
                                         const Target& target, int order) {
  std::vector<int> ids;
  ids.reserve(frames.size());
  for (const std::string& name : frames) ids.push_back(frameId(scene.model(), name, feature.name()));
  return Residual(feature.make(ids, scene), scale.matrix(), target.vector(), order, feature.name());
}

Evaluation eval(const Config& config, const FeatureSource& feature, const std::vector<std::string>& frames,
                const Scale& scale, const Target& target, int order) {
  Residual residual = makeResidual(config.state(), feature, frames, scale, target, order);
  Evaluation out;
  out.y.resize(residual.rows());
  out.J.setZero(residual.rows(), config.getJointDimension());
  eval(config, residual, out.y, out.J);
  return out;
}

void features_internal::eval(const Config& config, Residual& residual, Eigen::Ref<VectorXd> y, JacobianRows J) {
  if (residual.order() > 0) {
    throw ValueError(cat(residual.name(), " of order ", residual.order(), " needs ", residual.order() + 1,
                         " consecutive configurations; evaluate it in a KOMO"));
  }
  const State* state = &config.state();
  residual.eval({&state, 1}, 1., y, &J);
}

}  // namespace kinegraph
