#pragma once

#include <string>
#include <vector>

#include "kinegraph/parsers/mjcf/mjcf_document.h"
#include "kinegraph/parsers/xml/findings.h"

namespace kinegraph::inline parsers_internal {

/// The frame of a joint of an MJCF file, and the number of its coordinates in qpos.
struct MjcfJointPlace {
  std::string frame;
  int numbers;
};

/// Stores the keyframes of a file as named joint states (attribute `joint_states`) of the frames in `graph`. `joints`
/// are all joints in the order of qpos. Keyframes without a name or without qpos are skipped.
void addKeyframes(const MjcfDocument& document, const std::vector<MjcfJointPlace>& joints, Graph& graph,
                  Findings& findings);

}  // namespace kinegraph::inline parsers_internal
