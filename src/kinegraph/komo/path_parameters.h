#pragma once

#include <memory>
#include <string>

#include "kinegraph/nlp/parameter.h"

namespace kinegraph {

// Parameters of a trajectory optimization problem, for sensitivities. `nlp` must be made from a Komo; otherwise the
// functions throw ValueError.

/// Returns the number of an objective, in the order of addition, from its name ("positionDiff") or its name with frames
/// ("positionDiff of l_gripper, target"). Throws NameError unless exactly one matches.
int objectiveNumber(const Nlp& nlp, const std::string& name);

/// The target of an objective: one number per component of the feature, the same in all slices; for pairCollisions one
/// number for all pairs. Throws ValueError for an objective that does not exist, selects no slice, or has no target.
std::shared_ptr<NlpParameter> objectiveTarget(const Nlp& nlp, int objective);

/// The scale of an objective: one number, or one per component, as it was specified. Throws ValueError for an objective
/// that does not exist or selects no slice, for a matrix, and for a scale of zero.
std::shared_ptr<NlpParameter> objectiveScale(const Nlp& nlp, int objective);

/// The position or pose of a frame relative to its parent, or in the world if it has none: x y z (m); for a pose also a
/// rotation vector r (rad) about its own origin, along axes of the parent: R <- exp(r) R. Throws FrameNotFound, and
/// ValueError for frames that a joint moves; name their parent instead.
std::shared_ptr<NlpParameter> framePosition(const Nlp& nlp, const std::string& frame);
std::shared_ptr<NlpParameter> framePose(const Nlp& nlp, const std::string& frame);

/// The q from which the motion starts, at rest. Throws ValueError for problems of order 0, which have no slices before
/// the first.
std::shared_ptr<NlpParameter> motionStart(const Nlp& nlp);

}  // namespace kinegraph
