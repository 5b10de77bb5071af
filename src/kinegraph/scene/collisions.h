#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kinegraph/scene/config.h"
#include "kinegraph/scene/frame.h"

namespace kinegraph {

/// Excludes all pairs closer than `margin` (m) at the current q from collision, as `contact_exclude` of a scene file
/// does, and returns them with their distances. Useful for models with overlapping parts at their joints. A shape that
/// is fixed to its parent excludes the parent's shapes, too.
std::vector<Config::NearPair> ignoreCollisionsNow(Config& config, double margin = 0.);

struct SelfCollisionOptions {
  int samples = 10000;     ///< configurations sampled within the limits
  std::uint64_t seed = 0;  ///< seed of the samples
  double margin = 0.;      ///< shapes closer than this count as colliding, m
  double always = .95;     ///< in (0, 1]: fraction of samples from which a pair counts as always colliding
  std::string root;        ///< first frame of the robot, checked with its subtree; "": all moving links
  int threads = 1;

  void validate() const;  ///< throws ValueError
};

/// Two frames of a robot that carry shapes on different links.
struct SelfCollisionPair {
  enum class Reason {
    adjacent,   ///< one joint connects their links
    always,     ///< they collide in nearly all samples: the model overlaps by design
    never,      ///< they collide in no sample
    sometimes,  ///< all others; also pairs with an unlimited sliding joint between them
  };
  int a, b;  ///< ids, a < b
  Reason reason;
  int collisions;  ///< samples in collision; 0 to `samples`

  bool matters() const { return reason == Reason::sometimes; }
};

const char* selfCollisionReasonName(SelfCollisionPair::Reason reason);

/// Self-collision classes of the pairs of a robot's frames.
struct SelfCollisionMatrix {
  std::vector<SelfCollisionPair> pairs;  ///< sorted by a, then b; only pairs that may collide by the scene's rules
  int samples = 0;

  std::string str() const;  ///< number of pairs of each class
};

/// Classifies the pairs of a robot by sampling random configurations, as the setup assistant of MoveIt does, to find
/// pairs that need no collision checks. All shapes carried by one frame are taken together. A pair that collides with
/// probability p is missed with probability (1 - p)^samples: 37 % for p = 1e-4 and 10000 samples. Results are bit-equal
/// for any number of threads. Throws FrameNotFound for `root`, and ValueError for invalid options or if no pair exists.
SelfCollisionMatrix selfCollisionMatrix(const Config& config, const SelfCollisionOptions& options = {});

/// Excludes all pairs from collision except those of class `sometimes`, as `contact_exclude` of a scene file does. The
/// matrix must belong to this scene.
void ignoreSelfCollisions(Config& config, const SelfCollisionMatrix& matrix);

/// Sets the shape to the solid cubes of a grid of cells, in a box of that size (m). A value of 0 is a free cell, 1 an
/// occupied one, 2 one that no camera has seen (CellKind); the last two are solid. Throws ValueError for an invalid
/// grid or size, and for cells that are not cubes.
void setCells(Frame& frame, Grid grid, const Vector3d& size);

}  // namespace kinegraph
