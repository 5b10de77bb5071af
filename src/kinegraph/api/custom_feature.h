#pragma once

#include <functional>
#include <span>
#include <string>

#include "kinegraph/features/feature_source.h"

namespace kinegraph {

/// A frame at one configuration, for custom features. Valid during the call that receives it.
class FrameView {
 public:
  FrameView(const State& state, int frame) : state_(&state), frame_(frame) {}

  const std::string& getName() const { return state_->model().frame_name[std::size_t(frame_)]; }
  const VectorXd& getJointState() const { return state_->q(); }  ///< joint values (n,)
  Vector3d getPosition() const { return state_->position(frame_); }
  Quaterniond getQuaternion() const { return Quaterniond(getRotationMatrix()); }
  Matrix3d getRotationMatrix() const { return state_->pose(frame_).R; }
  Pose getPose() const { return Pose(state_->pose(frame_)); }

  /// Returns the derivative (3 x n) of the world position of a point, given in the frame's coordinates (m).
  MatrixXd getPositionJacobian(const Vector3d& point = Vector3d::Zero()) const;

  /// Returns the derivative (3 x n) of the frame's world angular velocity by the joint velocities.
  MatrixXd getAngularJacobian() const;

 private:
  const State* state_;
  int frame_;
};

/// The result of a custom feature: y and, if known, dy/dq (one row per entry of y, n columns).
struct FeatureValue {
  VectorXd y;
  MatrixXd J;  ///< empty: replaced by central differences

  FeatureValue(double y) : y(VectorXd::Constant(1, y)) {}
  FeatureValue(VectorXd y, MatrixXd J = {}) : y(std::move(y)), J(std::move(J)) {}
  FeatureValue(double y, const MatrixXd& J) : y(VectorXd::Constant(1, y)), J(J) {}
};

/// Computes a custom feature of the objective's frames, in their order. Several threads may call it at once.
using FeatureFunction = std::function<FeatureValue(std::span<const FrameView> frames)>;

/// Makes a feature from a function of frames. `name` appears in messages. The function must always return the same
/// number of values; otherwise, and for a Jacobian of wrong size, ValueError is thrown.
FeatureSource ownFeature(std::string name, FeatureFunction function);

}  // namespace kinegraph
