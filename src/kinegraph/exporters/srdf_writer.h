#pragma once

#include <map>
#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// What a URDF text calls the links and joints that frames became.
struct UrdfNames {
  std::map<int, std::string> link_of_shape;   ///< by the ids of frames with a shape that may collide
  std::map<int, std::string> joint_of_frame;  ///< of joints that are one joint there
  std::map<std::string, std::string> parent_of_link;
};

/// An SRDF text for a URDF text with these names; see writeSrdf. What SRDF cannot say goes to `warnings`.
std::string srdfText(const Config& config, const std::string& robot_name, const UrdfNames& names,
                     std::vector<std::string>* warnings);

/// The first words of a list, and how many more there are.
std::string joinFirst(const std::vector<std::string>& words, std::size_t count = 8);

}  // namespace kinegraph
