#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "kinegraph/parsers/mjcf/mjcf_document.h"
#include "kinegraph/parsers/mjcf/mjcf_values.h"

namespace kinegraph::inline parsers_internal {

/// Which geoms of an MJCF file collide, and which pairs do not.
struct MjcfContacts {
  std::set<const XmlElement*> colliding;                     ///< geoms that collide with something
  std::map<std::string, std::vector<std::string>> excluded;  ///< frames whose shapes do not collide, by frame
};

/// Evaluates contype, conaffinity and <contact>. Two geoms of different bodies collide if a <pair> names them, or if
/// their bits match and no <exclude> names their bodies. `frame_of` contains the frames of bodies and geoms;
/// `excluded_bodies` the pairs of <exclude>. Pairs of a body and its parent are left to contact flags.
MjcfContacts mjcfContacts(const MjcfDocument& document, MjcfValues& values,
                          const std::map<const XmlElement*, std::string>& frame_of,
                          const std::map<std::string, std::vector<std::string>>& excluded_bodies, Findings& findings);

}  // namespace kinegraph::inline parsers_internal
