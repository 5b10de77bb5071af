#include "kinegraph/api/custom_feature.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A feature that a function of frames computes.
class CustomFeature final : public Feature {
 public:
  CustomFeature(std::string name, FeatureFunction function, std::vector<int> frames, const State& scene)
      : name_(std::move(name)), function_(std::move(function)), frames_(std::move(frames)) {
    rows_ = int(function_(views(scene)).y.size());
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
  std::vector<FrameView> views(const State& state) const {
    std::vector<FrameView> views;
    views.reserve(frames_.size());
    for (int frame : frames_) views.emplace_back(state, frame);
    return views;
  }

  FeatureValue call(const State& state) const {
    FeatureValue value = function_(views(state));
    if (value.y.size() != rows_) {
      throw ValueError(cat("feature ", name_, " returned ", value.y.size(), " values; expected ", rows_));
    }
    if (value.J.size() > 0 && (value.J.rows() != rows_ || value.J.cols() != state.dofs())) {
      throw ValueError(cat("feature ", name_, " returned a Jacobian of ", value.J.rows(), " x ", value.J.cols(),
                           "; expected ", rows_, " x ", state.dofs(), ", a row per entry of y and a column per dof"));
    }
    return value;
  }

  /// Adds central differences over the dofs that move the frames; over all dofs without frames.
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
  FeatureFunction function_;
  std::vector<int> frames_;
  int rows_ = 0;
};

}  // namespace

MatrixXd FrameView::getPositionJacobian(const Vector3d& point) const {
  RowMajor J = RowMajor::Zero(3, state_->dofs());
  state_->addPointJacobian(frame_, state_->pose(frame_) * point, 1., J);
  return J;
}

MatrixXd FrameView::getAngularJacobian() const {
  RowMajor J = RowMajor::Zero(3, state_->dofs());
  state_->addAngularJacobian(frame_, 1., J);
  return J;
}

FeatureSource ownFeature(std::string name, FeatureFunction function) {
  auto make = [name, function = std::move(function)](const std::vector<int>& frames, const State& state) {
    return std::make_unique<CustomFeature>(name, function, frames, state);
  };
  return {std::move(name), std::move(make)};
}

}  // namespace kinegraph
