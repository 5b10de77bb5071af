#pragma once

#include <set>
#include <string>
#include <vector>

#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

/// What moves as one in a simulation: a frame and all that is fixed to it.
struct SceneBody {
  enum class Kind {
    world,    ///< never moves; body 0
    jointed,  ///< moved by the joint of its frame
    free,     ///< moves freely
    fixed,    ///< fixed to its parent, and a body of its own because forces between the two are measured
  };
  Kind kind = Kind::world;
  const FrameData* frame = nullptr;  ///< whose axes it has; null for the world
  int parent = 0;                    ///< a body that comes before it
  Pose X_PB;                         ///< in its parent, before the joint; of a free body: in the world
  int robot = -1;                    ///< which one it belongs to
  bool has_gravity = true;
  LinkInertia inertia{};  ///< of all its frames, in its axes
};

/// Where a frame is in a simulation.
struct PlacedFrame {
  int body = 0;
  Pose X_BF;
  int robot = -1;  ///< of its body; those of a robot's base, which is fixed to the world, have theirs, too
};

/// A scene divided into bodies.
struct SceneBodies {
  std::vector<SceneBody> bodies;
  std::vector<PlacedFrame> frames;  ///< by id
  int robots = 0;
  std::vector<std::string> warnings;
};

/// Divides a scene. A frame without parent or with a joint begins a link, to which all belongs that hangs below it without a
/// joint. A link moves by its joint. Without one, or with a rigid one, it moves freely if it has a mass and hangs on nothing
/// that belongs to a robot; else it is part of what it hangs on. A robot begins at a frame with the attribute `multibody`,
/// or at the first joint of a chain; its base stays where it is unless `multibody_fixedBase` is false. `measured` are
/// frames that become bodies of their own. Throws ValueError, which names the frame, for masses that are none.
SceneBodies divideScene(const SceneTree& scene, const std::set<int>& measured = {});

/// An attribute of a frame as a truth value or number; `otherwise` if it is not there. Throws ValueError for other kinds.
bool attributeFlag(const FrameData& frame, const char* key, bool otherwise);
double attributeNumber(const FrameData& frame, const char* key, double otherwise);

/// Does the shape of a frame take part: opaque and a body, or told to by `simulate`?
bool takesPart(const FrameData& frame);

}  // namespace kinegraph
