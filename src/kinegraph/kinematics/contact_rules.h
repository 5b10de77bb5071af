#pragma once

#include <utility>
#include <vector>

namespace kinegraph {

/// Which shapes may collide; the rule is at Config::getCollidablePairs. Pairs are not listed, as there are many.
struct ContactRules {
  /// A frame with a joint, or a root, and all that is rigidly fixed to it.
  struct Part {
    int parent = -1;  ///< the part it hangs on, or -1
    bool jointed = false;
  };
  /// A frame with a shape that takes part.
  struct Body {
    int frame = 0;
    int part = 0;
    int flag = 0;   ///< of contact
    int owner = 0;  ///< the frame whose exclusions hold for it, too
  };

  std::vector<Part> parts;
  std::vector<Body> bodies;                   ///< by frame
  std::vector<std::pair<int, int>> excluded;  ///< pairs of frames (a < b), ascending

  /// May these two bodies collide? They are places in `bodies`.
  bool allow(std::size_t i, std::size_t j) const;

 private:
  bool excludedByFlag(const Body& a, const Body& b) const;
};

}  // namespace kinegraph
