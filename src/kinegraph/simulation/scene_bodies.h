#pragma once

#include <set>
#include <string>
#include <vector>

#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline simulation_internal {

/// A rigid body of the simulation: a frame and everything rigidly attached to it.
struct SceneBody {
  enum class Kind {
    world,    ///< never moves; body 0
    jointed,  ///< moved by the joint of its frame
    free,     ///< moves freely
    fixed,    ///< fixed to its parent, but a separate body because the force between both is measured
  };
  Kind kind = Kind::world;
  const FrameData* frame = nullptr;  ///< defines the body's axes; null for the world
  int parent = 0;                    ///< index of a preceding body
  Pose X_PB;                         ///< pose in the parent, before the joint; of a free body: in the world
  int robot = -1;                    ///< index of its robot
  bool has_gravity = true;
  LinkInertia inertia{};  ///< of all its frames, in the body's axes
};

/// The place of a frame in a simulation.
struct PlacedFrame {
  int body = 0;
  Pose X_BF;
  int robot = -1;         ///< of its body; frames of a robot's base, fixed to the world, have their robot's index, too
  bool collides = false;  ///< its shape takes part in the simulation
};

/// A scene divided into bodies.
struct SceneBodies {
  std::vector<SceneBody> bodies;
  std::vector<PlacedFrame> frames;  ///< by id
  std::vector<bool>
      declared;  ///< per robot: it starts at a frame with `multibody`, so its links pass through each other
  std::vector<std::string> warnings;
};

/// Divides a scene into bodies. A frame without parent or with a joint starts a link; everything below it without a
/// joint belongs to that link. A link with a joint moves by it. A link without a joint, or with a rigid one, moves
/// freely if it has a mass and is attached neither to a robot nor to a frame `world`; otherwise it is part of its
/// parent. A robot starts at a frame with the attribute `multibody`, or at the first joint of a chain; its base is
/// fixed unless `multibody_fixedBase` is false. `measured` frames become bodies of their own. Throws ValueError with
/// the frame's name for invalid masses.
SceneBodies divideScene(const SceneTree& scene, const std::set<int>& measured = {});

/// Returns a frame's attribute as a truth value or number, or `otherwise` without one. Throws ValueError for other
/// types.
bool attributeFlag(const FrameData& frame, const char* key, bool otherwise);
double attributeNumber(const FrameData& frame, const char* key, double otherwise);

}  // namespace kinegraph::inline simulation_internal
