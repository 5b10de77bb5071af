#pragma once

#include <map>
#include <string>

#include "kinegraph/parsers/mjcf/mjcf_document.h"
#include "kinegraph/parsers/mjcf/mjcf_values.h"
#include "kinegraph/parsers/xml/frame_attributes.h"

namespace kinegraph::inline parsers_internal {

/// What the actuators of a joint can do. Units of the joint: N m or N.
struct MjcfMotor {
  double effort = 0.;                   ///< limit; 0 for none
  double stiffness = 0., damping = 0.;  ///< of a position servo; stiffness 0 for other actuators
  double damping_ratio = 0.;            ///< replaces the damping if positive; 1 is critical
};

/// Reads <actuator>: the limits and gains of actuators that drive a joint, by joint name. What is not represented
/// causes a warning.
std::map<std::string, MjcfMotor> mjcfMotors(const MjcfDocument& document, MjcfValues& values, Findings& findings);

/// Adds damping, spring, friction, armature and motor of a joint. `motor` may be null.
void addMjcfJointDynamics(const MjcfElement& joint, const MjcfMotor* motor, MjcfValues& values,
                          FrameAttributes& attributes);

/// Adds the frictions of a geom.
void addMjcfFriction(const MjcfElement& geom, MjcfValues& values, FrameAttributes& attributes);

/// Warns of settings that change how things move in MuJoCo, but not here.
void warnOfMjcfDynamics(const MjcfDocument& document, Findings& findings);

}  // namespace kinegraph::inline parsers_internal
