#pragma once

#include <set>
#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph::inline exporters_internal {

/// The motors of a scene as the elements of an MJCF text, with the gains of the simulation:
///
///     joints of q        position actuators with kp = w^2 m and kv = 2 w m; w = 100 rad/s, and m is the inertia of the
///                        joint at the present q, with its armature (.1 kg m^2 unless the scene has another one)
///     motorKp, motorKd   replace these gains
///     hands              one actuator on the mean of their fingers, 2000 N/m and 60 N s/m
///
/// Forces are limited by `ctrl_limits` and `motorLimit`. Joints with `noMotor`, and joints whose dofs are quaternions,
/// have no actuator.
class MjcfMotors {
 public:
  explicit MjcfMotors(const Config& config);

  /// Returns whether a motor moves the joint of a frame or one above it.
  bool isDriven(const FrameData& frame) const;

  /// Returns whether the frame has the joint of a hand, or one that follows it.
  bool isFinger(const FrameData& frame) const { return fingers_.contains(&frame); }

  /// Attributes of the elements of a joint: armature, damping, friction, spring.
  std::string jointAttributes(const FrameData& frame) const;

  /// Adds the actuator of a dof whose joint has a name in the text; `value` is its present position there.
  void add(const FrameData& frame, int dof, const std::string& joint, double value, double unit);

  /// The elements <tendon> and <actuator>, empty without motors.
  std::string text() const;

  const std::vector<double>& controls() const { return controls_; }  ///< that hold the present q

  static std::string options();   ///< the elements <option> and <default>
  static std::string coupling();  ///< attributes of equalities between fingers

 private:
  bool isMotor(const FrameData& frame) const;
  void addHand(const FrameData& frame, const std::string& joint, double value);

  const Config& config_;
  std::set<const FrameData*> fingers_;
  VectorXd inertia_;  ///< of each dof of q
  struct Wrap {
    const FrameData* source;
    std::string joint;
    double ratio;
  };
  std::vector<Wrap> wraps_;
  std::vector<const FrameData*> hands_;
  std::string actuators_;
  std::vector<double> controls_;
};

/// Returns a copy of a scene in which objects have free joints in the world: the frames with a mass and a joint of type
/// rigid that carry no other joint. A simulation lets them fall.
Config withFreeObjects(const Config& config);

/// Returns the joints of hands (inactive, with one dof, and followed by others) and their followers.
std::set<const FrameData*> fingerJoints(const Config& config);

}  // namespace kinegraph::inline exporters_internal
