#pragma once

#include <utility>
#include <vector>

namespace kinegraph::inline kinematics_internal {

/// Rules for the pairs of shapes that may collide; Config::getCollidablePairs documents them. Pairs are not listed,
/// because there may be many.
struct ContactRules {
  /// A frame with a joint, or a root, together with all frames fixed to it.
  struct Part {
    int parent = -1;  ///< the part that it is attached to, or -1
    bool jointed = false;
  };
  /// A frame with a shape that may collide.
  struct Body {
    int frame = 0;
    int part = 0;
    int flag = 0;   ///< contact flag
    int owner = 0;  ///< the frame whose exclusions apply to it, too
  };

  std::vector<Part> parts;
  std::vector<Body> bodies;                   ///< by frame
  std::vector<std::pair<int, int>> excluded;  ///< pairs of frames (a < b), ascending

  /// Returns true if these two bodies may collide; i and j are indices in `bodies`.
  bool allow(std::size_t i, std::size_t j) const;

 private:
  bool excludedByFlag(const Body& a, const Body& b) const;
};

}  // namespace kinegraph::inline kinematics_internal
