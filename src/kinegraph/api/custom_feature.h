#pragma once

#include <functional>
#include <span>
#include <string>

#include "kinegraph/features/feature_source.h"

namespace kinegraph {

/// A frame at one configuration, as a feature of your own sees it. It lives as long as the call that it is given to.
class FrameView {
 public:
  FrameView(const State& state, int frame) : state_(&state), frame_(frame) {}

  const std::string& getName() const { return state_->model().frame_name[std::size_t(frame_)]; }
  const VectorXd& getJointState() const { return state_->q(); }  ///< q of the configuration (n,)
  Vector3d getPosition() const { return state_->position(frame_); }
  Quaterniond getQuaternion() const { return Quaterniond(getRotationMatrix()); }
  Matrix3d getRotationMatrix() const { return state_->pose(frame_).R; }
  Pose getPose() const { return Pose(state_->pose(frame_)); }

  /// 3 x n: derivative of the world position of a point of the frame, given in its coordinates (m).
  MatrixXd getPositionJacobian(const Vector3d& point = Vector3d::Zero()) const;

  /// 3 x n: world angular velocity of the frame per velocity of q.
  MatrixXd getAngularJacobian() const;

 private:
  const State* state_;
  int frame_;
};

/// What a feature of your own returns: y, and dy/dq (rows of y x n) where it is known.
struct FeatureValue {
  VectorXd y;
  MatrixXd J;  ///< empty: central differences replace it

  FeatureValue(double y) : y(VectorXd::Constant(1, y)) {}
  FeatureValue(VectorXd y, MatrixXd J = {}) : y(std::move(y)), J(std::move(J)) {}
  FeatureValue(double y, const MatrixXd& J) : y(VectorXd::Constant(1, y)), J(J) {}
};

/// The frames in the order in which the objective names them. It may be called by several threads at once.
using FeatureFunction = std::function<FeatureValue(std::span<const FrameView> frames)>;

/// A function of frames as a feature like any other. `name` is for messages. It always returns the same number of
/// values; ValueError if it does not, and for a Jacobian of another size.
FeatureSource ownFeature(std::string name, FeatureFunction function);

}  // namespace kinegraph
