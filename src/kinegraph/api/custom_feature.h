#pragma once

#include <functional>
#include <span>
#include <string>

#include "kinegraph/features/custom_feature.h"
#include "kinegraph/features/feature_source.h"

namespace kinegraph::inline kinematics_internal {
class State;
}

namespace kinegraph {

/// A frame at one configuration, the argument of a custom feature. Valid during the call only.
class FrameView {
 public:
  FrameView(const State& state, int frame) : state_(&state), frame_(frame) {}

  const std::string& getName() const;
  const VectorXd& getJointState() const;  ///< joint values (n,)
  Vector3d getPosition() const;
  Quaterniond getQuaternion() const { return Quaterniond(getRotationMatrix()); }
  Matrix3d getRotationMatrix() const;
  Pose getPose() const;

  /// Returns the derivative of the world position of a point of the frame, given in its coordinates (m): 3 x n.
  MatrixXd getPositionJacobian(const Vector3d& point = Vector3d::Zero()) const;

  /// Returns the world angular velocity of the frame per velocity of q: 3 x n.
  MatrixXd getAngularJacobian() const;

 private:
  const State* state_;
  int frame_;
};

/// Receives the frames in the order in which the objective names them. Several threads may call it at once.
using FeatureFunction = std::function<FeatureValue(std::span<const FrameView> frames)>;

/// Makes a feature from a function of frames. `name` is for messages. The function must always return the same number
/// of values; otherwise, and for a Jacobian of a wrong size, evaluation throws ValueError.
FeatureSource customFeature(std::string name, FeatureFunction function);

}  // namespace kinegraph
