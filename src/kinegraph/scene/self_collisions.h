#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

struct SelfCollisionOptions {
  int samples = 10000;     ///< postures that are drawn within the limits
  std::uint64_t seed = 0;  ///< of the postures
  double margin = 0.;      ///< shapes nearer than that count as colliding, m
  double always = .95;     ///< share of the postures from which on a pair counts as always colliding
  std::string root;        ///< the robot's first frame: it and what hangs on it; "": all that joints move
  int threads = 1;

  void validate() const;  ///< throws ValueError
};

/// Two frames of a robot that carry shapes on different links.
struct SelfCollisionPair {
  enum class Reason {
    adjacent,   ///< one joint connects their links
    always,     ///< they collide in nearly all postures: so they are modeled
    never,      ///< they collide in none of the postures
    sometimes,  ///< all others, and those with a joint between them that slides without limits
  };
  int a, b;  ///< ids, a < b
  Reason reason;
  int collisions;  ///< postures in which they collide

  bool matters() const { return reason == Reason::sometimes; }
};

const char* selfCollisionReasonName(SelfCollisionPair::Reason reason);

/// Which parts of a robot may collide with one another.
struct SelfCollisionMatrix {
  std::vector<SelfCollisionPair> pairs;  ///< by a, then b; only those that may collide by the scene's rules
  int samples = 0;

  std::string str() const;  ///< how many pairs there are of each kind
};

/// Finds which pairs of a robot need no looking at, from random postures, as the setup assistant of MoveIt does. All
/// shapes that one frame carries are taken together. A pair that collides in a share p of all postures is missed with
/// the probability (1 - p)^samples: of 10000 samples 37 % for p = 1e-4. The same bits at any number of threads. Throws
/// FrameNotFound for `root`, and ValueError for options that make no sense and where nothing is to be looked at.
SelfCollisionMatrix selfCollisionMatrix(const Config& config, const SelfCollisionOptions& options = {});

/// Lets all pairs never collide from now on but those that do so sometimes, as `contact_exclude` of a scene file does.
/// The matrix is of this scene.
void ignoreSelfCollisions(Config& config, const SelfCollisionMatrix& matrix);

}  // namespace kinegraph
