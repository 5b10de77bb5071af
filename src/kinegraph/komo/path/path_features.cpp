#include "kinegraph/komo/path/path_features.h"

namespace kinegraph::inline komo_internal {

JointsOfFrames::JointsOfFrames(std::vector<Part> parts) : parts_(std::move(parts)) {
  for (const Part& part : parts_) rows_ += part.count;
}

void JointsOfFrames::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  const State& state = *states[0];
  int row = 0;
  for (const Part& part : parts_) {
    const int first = state.model().frame_dofs[part.frame].first + part.first;
    for (int i = 0; i < part.count; ++i, ++row) {
      y[row] = state.q()[first + i];
      if (J) (*J)(row, first + i) += 1.;
    }
  }
}

}  // namespace kinegraph::inline komo_internal
