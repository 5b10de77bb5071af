#pragma once

#include <string>
#include <vector>

#include "kinegraph/parsers/findings.h"
#include "kinegraph/parsers/mjcf_document.h"

namespace kinegraph {

/// The frame that a joint of an MJCF file has become, and how many numbers of qpos are its own.
struct MjcfJointPlace {
  std::string frame;
  int numbers;
};

/// Enters the keyframes of a file as named states of the joints (the attribute `joint_states`) into the frames of
/// `graph`. `joints` are all joints in the order of qpos. Keyframes without a name or without qpos say nothing here.
void addKeyframes(const MjcfDocument& document, const std::vector<MjcfJointPlace>& joints, Graph& graph,
                  Findings& findings);

}  // namespace kinegraph
