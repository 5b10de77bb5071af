#pragma once

#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline scene_internal {

/// Makes a frame the root of its tree by reversing the path above it; all frames keep their world poses. The joints on
/// the path are inverted and move to the frame below them, so a hinge at q becomes -q and its limits swap and change
/// sign. With `until_part_break` the path ends at the first rigid or free joint, which is cut. Throws ValueError for
/// joints on the path without an inverse joint type; the scene is then unchanged.
void makeRoot(SceneTree& scene, FrameData& frame, bool until_part_break = false);

/// Activates exactly the joints at or below `root`. A mimicking joint is active if its source is.
void selectJointsBySubtree(SceneTree& scene, const FrameData& root);

/// Index in q of the first dof of a frame's joint, or of its source if it mimics. For an inactive joint, the index
/// among the dofs of all inactive joints in frame order. Throws ValueError without a joint.
int dofIndex(SceneTree& scene, const FrameData& frame);

/// Makes the current q the zero of all joints: their motion moves into the frame above; limits and homes shift. Throws
/// ValueError, without changes, if a joint has several dofs, or if the frame above is a root, has a shape, an inertia
/// or a joint, or has other joints below it.
void recalibrateJointsToZero(SceneTree& scene);

struct Simplification {
  bool prune_rigid_joints = false;        ///< remove rigid joints, which merges the links they connect
  bool reconnect_to_links = true;         ///< attach frames directly below the frame of their link's joint
  bool prune_non_contact_shapes = false;  ///< remove leaves whose shape never collides, except markers
  bool prune_transparent = false;         ///< remove leaves whose shape has an alpha below 1
};

/// Removes frames without effect on motion: empty shapes and leaves without joint, shape and inertia, named ones
/// included. A child with only a shape at its parent's pose passes the shape to the parent. Then sorts the frames by
/// depth, roots first, and the joints in q with them. World poses and joint values are unchanged.
void simplifyStructure(SceneTree& scene, const Simplification& options = {});

/// Throws Error at the first inconsistency: ids, parents and children, loops, mimics, dofs, non-finite numbers, or
/// quaternions that are not unit. Edits by functions of this library keep a scene consistent.
void checkConsistency(const SceneTree& scene);

}  // namespace kinegraph::inline scene_internal
