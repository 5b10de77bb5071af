#include "kinegraph/features/custom_feature.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/feature.h"

namespace kinegraph {

namespace {

class CustomFeature final : public Feature {
 public:
  CustomFeature(std::string name, StateFunction function, std::vector<int> frames, const State& scene)
      : name_(std::move(name)), function_(std::move(function)), frames_(std::move(frames)) {
    rows_ = int(function_(scene, frames_).y.size());
  }

  int rows() const override { return rows_; }

  void eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const override {
    const State& state = *states[0];
    const FeatureValue value = call(state);
    y = value.y;
    if (!J) return;
    if (value.J.size() > 0) {
      *J += value.J;
    } else {
      addDifferences(state, *J);
    }
  }

 private:
  FeatureValue call(const State& state) const {
    FeatureValue value = function_(state, frames_);
    if (value.y.size() != rows_) {
      throw ValueError(
          cat("feature ", name_, " returned ", value.y.size(), " numbers; expected ", rows_, " as in the first call"));
    }
    if (value.J.size() > 0 && (value.J.rows() != rows_ || value.J.cols() != state.dofs())) {
      throw ValueError(cat("feature ", name_, " returned a Jacobian of ", value.J.rows(), " x ", value.J.cols(),
                           "; expected ", rows_, " x ", state.dofs(),
                           ", one row per component and one column per dof"));
    }
    return value;
  }

  /// Adds central differences over the dofs that move the frames, or over all dofs without frames.
  void addDifferences(const State& state, JacobianRows& J) const {
    State moved = state;
    VectorXd q = state.q();
    const auto valueAt = [&](int dof, double to) {
      q[dof] = to;
      moved.setJoints(q.data());
      return call(moved).y;
    };
    for (int dof : movingDofs(state)) {
      const double at = q[dof], step = 1e-5 * std::max(1., std::abs(at));
      const VectorXd plus = valueAt(dof, at + step), minus = valueAt(dof, at - step);
      q[dof] = at;
      J.col(dof) += (plus - minus) / (2. * step);
    }
  }

  std::vector<int> movingDofs(const State& state) const {
    const KinematicModel& model = state.model();
    std::vector<bool> moves(std::size_t(model.dofs), frames_.empty());
    for (int frame : frames_) {
      for (int c = model.last_column[state.link(frame)]; c >= 0; c = model.column_before[c])
        moves[std::size_t(model.column_dof[c])] = true;
    }
    std::vector<int> dofs;
    for (int dof = 0; dof < model.dofs; ++dof) {
      if (moves[std::size_t(dof)]) dofs.push_back(dof);
    }
    return dofs;
  }

  std::string name_;
  StateFunction function_;
  std::vector<int> frames_;
  int rows_ = 0;
};

}  // namespace

std::unique_ptr<Feature> makeCustomFeature(std::string name, StateFunction function, std::vector<int> frames,
                                           const State& scene) {
  return std::make_unique<CustomFeature>(std::move(name), std::move(function), std::move(frames), scene);
}

}  // namespace kinegraph
