#pragma once

#include <map>
#include <set>
#include <string>

#include "kinegraph/exporters/mjcf_writer.h"

namespace kinegraph {

/// Writes shapes as the geoms of an MJCF text, and the meshes that they need as its assets.
class MjcfGeoms {
 public:
  MjcfGeoms(const MjcfOptions& options, std::vector<std::string>* warnings) : options_(options), warnings_(warnings) {}

  /// The element for the shape of a frame, which is at `pose` in its body. Empty if there is none for it.
  std::string geom(const FrameData& frame, const std::string& name, const Pose& pose, bool moves);

  const std::string& assets() const { return assets_; }

 private:
  std::string primitive(const Geometry& geometry, bool moves) const;
  std::string mesh(const FrameData& frame);
  std::string meshSource(const FrameData& frame);

  const MjcfOptions& options_;
  std::vector<std::string>* warnings_;
  std::map<const Geometry*, std::string> names_;  ///< of the meshes
  std::set<std::string> taken_;
  std::string assets_;
};

/// ` pos="..." quat="..."`, as far as they differ from the identity.
std::string mjcfPose(const Pose& pose);

/// Numbers with blanks between them, exact.
std::string mjcfNumbers(const std::vector<double>& numbers);
std::string mjcfVector(const Vector3d& v);

}  // namespace kinegraph
