#pragma once

#include <memory>
#include <string>

#include "kinegraph/nlp/parameter.h"

namespace kinegraph {

// What a motion problem depends on beside its path. `nlp` is a problem that was made from a Komo; ValueError for others.

/// The number of an objective, in the order in which they were added, by its name ("positionDiff") or its name with its
/// frames ("positionDiff of l_gripper, target"). Throws NameError if there is none, or more than one.
int objectiveNumber(const Nlp& nlp, const std::string& name);

/// The target of an objective: one number per row of the feature, in all slices; of pairCollisions one for all pairs.
/// Throws ValueError for an objective that is not there, selects no slice, or has no target.
std::shared_ptr<NlpParameter> objectiveTarget(const Nlp& nlp, int objective);

/// The scale of an objective: one number, or one per row as it was given. Throws ValueError for an objective that is not
/// there or selects no slice, for a matrix, and for a scale that is zero.
std::shared_ptr<NlpParameter> objectiveScale(const Nlp& nlp, int objective);

/// Where a frame is as seen from its parent, or in the world if it has none: x y z (m); and for a pose a rotation vector
/// (rad), by which it is turned about its own origin, with axes of the parent: R <- exp(r) R. Throws FrameNotFound, and
/// ValueError for frames that a joint moves: their parent can be named.
std::shared_ptr<NlpParameter> framePosition(const Nlp& nlp, const std::string& frame);
std::shared_ptr<NlpParameter> framePose(const Nlp& nlp, const std::string& frame);

/// The q that the motion begins from, at rest. Throws ValueError where no slices lie before the first.
std::shared_ptr<NlpParameter> motionStart(const Nlp& nlp);

}  // namespace kinegraph
