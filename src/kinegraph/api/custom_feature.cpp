#include "kinegraph/api/custom_feature.h"

#include "kinegraph/features/custom_feature.h"
#include "kinegraph/kinematics/state.h"

namespace kinegraph {

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

const std::string& FrameView::getName() const { return state_->model().frame_name[std::size_t(frame_)]; }

const VectorXd& FrameView::getJointState() const { return state_->q(); }

Vector3d FrameView::getPosition() const { return state_->position(frame_); }

Matrix3d FrameView::getRotationMatrix() const { return state_->pose(frame_).R; }

Pose FrameView::getPose() const { return Pose(state_->pose(frame_)); }

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

FeatureSource customFeature(std::string name, FeatureFunction function) {
  StateFunction of_state = [function = std::move(function)](const State& state, const std::vector<int>& frames) {
    std::vector<FrameView> views;
    views.reserve(frames.size());
    for (int frame : frames) views.emplace_back(state, frame);
    return function(views);
  };
  auto make = [name, of_state = std::move(of_state)](const std::vector<int>& frames, const State& state) {
    return makeCustomFeature(name, of_state, frames, state);
  };
  return {std::move(name), std::move(make)};
}

}  // namespace kinegraph
