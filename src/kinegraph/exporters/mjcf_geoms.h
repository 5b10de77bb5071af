#pragma once

#include <map>
#include <set>
#include <string>

#include "kinegraph/exporters/writers.h"

namespace kinegraph::inline exporters_internal {

/// Writes shapes as geoms of an MJCF text, and their meshes as its assets.
class MjcfGeoms {
 public:
  MjcfGeoms(const MjcfOptions& options, std::vector<std::string>* warnings) : options_(options), warnings_(warnings) {}

  /// The element for the shape of a frame at `pose` in its body; empty if MJCF has none.
  std::string geom(const FrameData& frame, const std::string& name, const Pose& pose, bool moves);

  const std::string& assets() const { return assets_; }

 private:
  std::string primitive(const Geometry& geometry, bool moves) const;
  std::string mesh(const FrameData& frame);
  std::string meshSource(const FrameData& frame);

  const MjcfOptions& options_;
  std::vector<std::string>* warnings_;
  std::map<const Geometry*, std::string> names_;  ///< mesh names by geometry
  std::set<std::string> taken_;
  std::string assets_;
};

/// ` pos="..." quat="..."`, omitting identity parts.
std::string mjcfPose(const Pose& pose);

/// Exact numbers separated by blanks.
std::string mjcfNumbers(const std::vector<double>& numbers);
std::string mjcfVector(const Vector3d& v);

}  // namespace kinegraph::inline exporters_internal
