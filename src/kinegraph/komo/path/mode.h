#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/komo/path/path_records.h"
#include "kinegraph/scene/config.h"

namespace kinegraph::inline komo_internal {

/// A joint that a trajectory optimization problem adds to the scene.
struct Attachment {
  JointType type = JointType::rigid;
  bool stable = true;             ///< one set of dofs for all slices that have it; otherwise one per slice
  bool starts_at_object = false;  ///< starts at the pose of the object; otherwise at zero
  bool zero_home = true;          ///< home is zero; otherwise the initial value
  bool uniform = false;           ///< sampled uniformly within its limits
  VectorXd lower, upper;          ///< both empty for no limits
  std::optional<Pose> base;       ///< pose of the joint in the parent frame
};

/// Returns the extent of a frame's shape along its own z axis, m; 0 without one.
double height(const Frame& frame);

/// Returns the attachment of `object` to `parent` in a mode. Throws ValueError for modes that are not attachments, and
/// for parents without the box that the mode needs.
Attachment attachmentOf(SwitchMode mode, const Frame& parent, const Frame& object);

/// Limits the position of a free joint below `parent` by the sizes of parent and object. Sets no limits if neither has
/// a size.
void limitFreeJoint(Attachment& attachment, const Frame& parent, const Frame* object);

/// Limits a transXYPhi joint that slides on a face with these half extents.
void limitSliding(Attachment& attachment, double half_x, double half_y);

/// Limits a joint below `parent` by its type: two full rotations for a hinge, the face of a box for planar joints, the
/// size of the parent for free ones. Other joints have no limits.
void limitByType(Attachment& attachment, const Frame& parent);

/// The kinematic structure in some slices of a path: a scene, and its joints that the problem has added. All modes of a
/// problem have the same frames in the same order.
struct Mode {
  struct Added {
    int id = 0;           ///< equal in all modes that share the joint
    bool stable = false;  ///< its dofs are shared by the slices that have it
    std::string parent;
  };
  Config config;
  std::map<int, Added> added;  ///< by frame id

  /// Returns the root of the rigid group of `object`: the first frame upwards that has a joint, or the root of the
  /// tree. If `parent` is below that frame too, returns the object itself.
  const FrameData& movableRoot(const std::string& object, const std::string& parent) const;

  /// Detaches the object's movable root, makes the object the root of this group, and attaches it to `parent`.
  /// `base_frame` is the id of the frame for the attachment's base, if there is one.
  void attach(const std::string& parent, const std::string& object, const Attachment& attachment, int base_frame,
              int id);
};

/// Gives `frame`, which has a parent, the joint of an attachment.
void addJoint(FrameData& frame, const Attachment& attachment, const Pose& relative);

}  // namespace kinegraph::inline komo_internal
