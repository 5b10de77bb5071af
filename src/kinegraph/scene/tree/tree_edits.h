#pragma once

#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

/// Makes a frame the root of its tree by turning the path above it around; all frames stay where they are. The joints
/// on the path are inverted and move to the frame that is below them now, so a hinge at q has -q and its limits change
/// sign and side. With `until_part_break` the path ends at the first rigid or free joint, which is cut. Throws
/// ValueError for joints on the path whose inverse is of no joint type; the scene is then unchanged.
void makeRoot(SceneTree& scene, FrameData& frame, bool until_part_break = false);

/// Makes exactly the joints at or below `root` active. A mimicking joint is active if its source is.
void selectJointsBySubtree(SceneTree& scene, const FrameData& root);

/// Where the dofs of a frame's joint begin in q; of its source if it mimics; of an inactive joint, among the dofs of
/// all inactive ones in frame order. Throws ValueError without a joint.
int dofIndex(SceneTree& scene, const FrameData& frame);

/// Makes the present q the zero of all joints: their motion goes into the frame above, limits and homes shift. Throws
/// ValueError, and changes nothing, if a joint has several dofs, or if the frame above it is a root, has a shape, an
/// inertia or a joint, or has other joints below it.
void recalibrateJointsToZero(SceneTree& scene);

struct Simplification {
  bool prune_rigid_joints = false;        ///< rigid joints are removed, so that what they join becomes one link
  bool reconnect_to_links = true;         ///< frames hang directly below the frame of their link's joint
  bool prune_non_contact_shapes = false;  ///< leaves whose shape never collides are removed, but for markers
  bool prune_transparent = false;         ///< leaves whose shape has an alpha below 1 are removed
};

/// Removes what does not matter for motion: empty shapes and leaves without joint, shape and inertia, named ones too; a
/// child that has only a shape and sits at its parent gives it the shape. Then sorts the frames, roots first, by depth;
/// the joints in q are sorted with them. World poses and the values of all joints stay.
void simplifyStructure(SceneTree& scene, const Simplification& options = {});

/// Throws Error at the first thing that contradicts another: ids, parents and children, loops, mimics, dofs, numbers
/// that are not finite, quaternions that are not unit. A scene that was edited by the functions of this library is
/// consistent.
void checkConsistency(const SceneTree& scene);

}  // namespace kinegraph
