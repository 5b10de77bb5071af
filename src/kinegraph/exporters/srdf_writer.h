#pragma once

#include <map>
#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph::inline exporters_internal {

/// Names of frames as links and joints of a URDF text.
struct UrdfNames {
  std::map<int, std::string> link_of_shape;   ///< by ids of frames with a collidable shape
  std::map<int, std::string> joint_of_frame;  ///< for frames that are exactly one URDF joint
  std::map<std::string, std::string> parent_of_link;
};

/// An SRDF text for a URDF text with these names; see writeSrdf. Inexpressible content is listed in `warnings`.
std::string srdfText(const Config& config, const std::string& robot_name, const UrdfNames& names,
                     std::vector<std::string>* warnings);

/// Joins the first items of a list, and adds the number of the others.
std::string joinFirst(const std::vector<std::string>& items, std::size_t count = 8);

}  // namespace kinegraph::inline exporters_internal
