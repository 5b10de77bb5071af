#include "kinegraph/parsers/mjcf/mjcf_keyframes.h"

#include <unordered_map>

#include "kinegraph/common/text.h"

namespace kinegraph::inline parsers_internal {

namespace {

/// The named states of a frame with independent dofs; null for others.
Graph* statesOf(Node& frame) {
  Graph& attributes = *std::get_if<Graph>(&frame.value.data);
  if (!attributes.find("joint") || attributes.find("mimic")) return nullptr;
  if (!attributes.find("joint_states")) attributes.set({"joint_states", {}, {}, {Graph(), frame.where}, frame.where});
  return std::get_if<Graph>(&attributes.find("joint_states")->value.data);
}

}  // namespace

void addKeyframes(const MjcfDocument& document, const std::vector<MjcfJointPlace>& joints, Graph& graph,
                  Findings& findings) {
  const std::vector<const XmlElement*> keys = document.inSections("keyframe", "key");
  if (keys.empty()) return;
  std::unordered_map<std::string, Node*> frames;
  for (Node& frame : graph.nodes) frames.emplace(frame.key, &frame);
  std::size_t count = 0;
  for (const MjcfJointPlace& joint : joints) count += std::size_t(joint.numbers);
  for (const XmlElement* key : keys) {
    const XmlAttribute* name = key->attribute("name");
    const XmlAttribute* qpos = key->attribute("qpos");
    if (!name || name->value.empty() || !qpos) continue;
    const auto numbers = numbersIn(qpos->value);
    if (!numbers || numbers->size() != count) {
      findings.warn(
          qpos->where,
          cat("keyframe '", name->value, "': expected qpos to be ", count, " numbers, one per coordinate of a joint",
              numbers ? cat(", not ", numbers->size()) : std::string(), "; the keyframe is ignored"));
      continue;
    }
    const double* next = numbers->data();
    for (const MjcfJointPlace& joint : joints) {
      const auto frame = frames.find(joint.frame);
      Graph* states = frame == frames.end() ? nullptr : statesOf(*frame->second);
      Value value;
      value.where = qpos->where;
      if (joint.numbers == 1) {
        value.data = *next;
      } else {
        value.data = NumberArray{{next, next + joint.numbers}, 1};
      }
      next += joint.numbers;
      if (states) states->set({name->value, {}, {}, std::move(value), name->where});
    }
  }
}

}  // namespace kinegraph::inline parsers_internal
