#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// How an object is held from a mode switch on. The numbers are those of the Python enum `ry.SY`.
enum class SwitchMode : int {
  touch = 0,
  above = 1,
  inside = 2,
  oppose = 3,
  restingOn = 4,
  poseEq = 5,
  positionEq = 6,
  stableRelPose = 7,
  stablePose = 8,
  stable = 9,
  stableOn = 10,
  dynamic = 11,
  dynamicOn = 12,
  dynamicTrans = 13,
  quasiStatic = 14,
  quasiStaticOn = 15,
  downUp = 16,
  stableZero = 18,
  contact = 19,
  contactStick = 20,
  contactComplementary = 21,
  bounce = 22,
  push = 23,
  magic = 24,
  magicTrans = 25,
  pushAndPlace = 26,
  topBoxGrasp = 27,
  topBoxPlace = 28,
  dampMotion = 29,
  identical = 30,
  alignByInt = 31,
  makeFree = 32,
  forceBalance = 33,
  relPosY = 34,
  touchBoxNormalX = 35,
  touchBoxNormalY = 36,
  touchBoxNormalZ = 37,
  boxGraspX = 38,
  boxGraspY = 39,
  boxGraspZ = 40,
  lift = 41,
  stableYPhi = 42,
  stableOnX = 43,
  stableOnY = 44,
  end = 46,
};

const std::vector<std::pair<std::string, SwitchMode>>& switchModeNames();
std::string switchModeName(SwitchMode mode);

/// A joint that a motion problem adds to the scene.
struct Attachment {
  JointType type = JointType::rigid;
  bool stable = true;        ///< one set of dofs for all slices that have it; else one per slice
  bool starts_here = false;  ///< starts at the pose that the object has; else at zero
  bool zero_home = true;     ///< home is zero; else where the joint starts
  bool uniform = false;      ///< sampled uniformly within its limits
  VectorXd lower, upper;     ///< both empty: no limits
  std::optional<Pose> base;  ///< of the joint in the parent frame
};

/// Is it a mode in which an object hangs below another frame? Others are conditions and contacts.
bool isAttachment(SwitchMode mode);

/// Extent of a frame's shape along its own z axis, m; 0 without one.
double height(const Frame& frame);

/// The attachment of `object` to `parent` in a mode. Throws ValueError for modes that are not attachments and for
/// parents without the box that the mode needs.
Attachment attachmentOf(SwitchMode mode, const Frame& parent, const Frame& object);

/// Limits of a free joint below `parent` for an object: the sizes of both bound its position. Empty if neither has a
/// size.
void limitFreeJoint(Attachment& attachment, const Frame& parent, const Frame* object);

/// Limits of a transXYPhi joint that slides on a face with these half extents.
void limitSliding(Attachment& attachment, double half_x, double half_y);

/// Limits of a joint of its type that a frame is given below `parent`: two turns of a hinge, the face of a box for
/// joints that slide in the plane, the size of the parent for free ones. Empty where nothing suggests any.
void limitByType(Attachment& attachment, const Frame& parent);

/// The structure of the scene in some slices of a motion: a scene, and which of its joints the motion problem has
/// added. All modes of a problem have the same frames in the same order.
struct Mode {
  struct Added {
    int id = 0;           ///< equal in all modes that have the same joint
    bool stable = false;  ///< its dofs are shared by the slices that have it
    std::string parent;
  };
  Config config;
  std::map<int, Added> added;  ///< by frame id

  /// The frame that moves with `object` and is attached to the rest: the first one upwards that has a joint, or the
  /// root. Where `parent` hangs below that one too, it is the object itself.
  const FrameData& movableRoot(const std::string& object, const std::string& parent) const;

  /// Cuts the object's movable root off, makes the object its root, and attaches it below `parent`. `base_frame` is the
  /// id of a frame to carry the attachment's base, if it has one.
  void attach(const std::string& parent, const std::string& object, const Attachment& attachment, int base_frame,
              int id);
};

/// Gives `frame`, which has a parent, the joint of an attachment.
void addJoint(FrameData& frame, const Attachment& attachment, const Pose& relative);

}  // namespace kinegraph
