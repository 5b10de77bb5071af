#include "kinegraph/exporters/srdf_writer.h"

#include <algorithm>
#include <set>

#include "kinegraph/common/text.h"
#include "kinegraph/kinematics/contact_rules.h"
#include "kinegraph/parsers/xml/xml.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline exporters_internal {

namespace {

constexpr std::size_t kMaxLinks = 1000;  // pairs are omitted for more links: too many to list

using LinkPair = std::pair<std::string, std::string>;

LinkPair ordered(const std::string& a, const std::string& b) { return a < b ? LinkPair(a, b) : LinkPair(b, a); }

/// Pairs of links, by whether their shapes may collide.
struct LinkPairs {
  std::set<LinkPair> collide, spare;  ///< a pair in both sets has shapes of either kind
  std::set<LinkPair> by_rule;         ///< spare by the flags `contact`, without an entry of its own
  bool as_by_default = true;          ///< equal to the rule for URDF files without SRDF
};

LinkPairs linkPairs(const Config& config, const UrdfNames& names) {
  LinkPairs pairs;
  const ContactRules rules = contactRules(*config.scene());
  ContactRules default_rules = rules;
  default_rules.excluded.clear();
  const ContactRules flags = default_rules;
  for (ContactRules::Body& body : default_rules.bodies) body.flag = -2;
  for (std::size_t i = 0; i < rules.bodies.size(); ++i) {
    const auto a = names.link_of_shape.find(rules.bodies[i].frame);
    for (std::size_t j = 0; a != names.link_of_shape.end() && j < i; ++j) {
      const auto b = names.link_of_shape.find(rules.bodies[j].frame);
      if (b == names.link_of_shape.end() || a->second == b->second) continue;
      const bool may = rules.allow(i, j);
      (may ? pairs.collide : pairs.spare).insert(ordered(a->second, b->second));
      if (!may && !flags.allow(i, j)) pairs.by_rule.insert(ordered(a->second, b->second));
      if (may != default_rules.allow(i, j)) pairs.as_by_default = false;
    }
  }
  return pairs;
}

std::string disabledPairs(const LinkPairs& pairs, const UrdfNames& names, std::vector<std::string>* warnings) {
  std::string text;
  std::vector<std::string> mixed;
  const auto hangsOn = [&](const std::string& child, const std::string& parent) {
    const auto found = names.parent_of_link.find(child);
    return found != names.parent_of_link.end() && found->second == parent;
  };
  for (const auto& [a, b] : pairs.spare) {
    if (pairs.collide.contains({a, b})) {
      mixed.push_back(cat(a, " - ", b));
      continue;
    }
    text += cat("  <disable_collisions link1=\"", xmlEscaped(a), "\" link2=\"", xmlEscaped(b), "\" reason=\"",
                hangsOn(a, b) || hangsOn(b, a)   ? "Adjacent"
                : pairs.by_rule.contains({a, b}) ? "User"
                                                 : "Never",
                "\"/>\n");
  }
  if (warnings && !mixed.empty())
    warnings->push_back(
        cat("SRDF lists pairs of links, not of shapes; all shapes of these links may collide: ", joinFirst(mixed)));
  return text;
}

/// Colliding pairs are listed only if no pair is disabled: an entry replaces the default rules.
std::string enabledPairs(const LinkPairs& pairs) {
  std::string text;
  for (const auto& [a, b] : pairs.collide)
    text += cat("  <enable_collisions link1=\"", xmlEscaped(a), "\" link2=\"", xmlEscaped(b), "\"/>\n");
  return text;
}

std::string groups(const Config& config, const UrdfNames& names) {
  std::string text;
  for (const auto& [group, joints] : config.getJointGroups()) {
    text += cat("  <group name=\"", xmlEscaped(group), "\">\n");
    for (const std::string& joint : joints) {
      const auto found = names.joint_of_frame.find(config.getFrame(joint).id());
      if (found != names.joint_of_frame.end()) text += cat("    <joint name=\"", xmlEscaped(found->second), "\"/>\n");
    }
    text += "  </group>\n";
  }
  return text;
}

std::string valueText(const Value& value) {
  if (const double* number = value.as<double>()) return exact(*number);
  const NumberArray* array = value.as<NumberArray>();
  std::vector<std::string> texts;
  for (const double number : array ? array->numbers : std::vector<double>()) texts.push_back(exact(number));
  if (texts.size() == 7)
    std::rotate(texts.begin() + 3, texts.begin() + 4, texts.end());  // a free joint: x y z qx qy qz qw
  return join(texts, " ");
}

std::string states(const Config& config, const UrdfNames& names) {
  std::map<LinkPair, std::string> joints_of;  // by group and state
  const auto add = [&](const std::string& group, const Node& state, const std::string& joint) {
    joints_of[{group, state.key}] +=
        cat("    <joint name=\"", xmlEscaped(joint), "\" value=\"", valueText(state.value), "\"/>\n");
  };
  for (const auto& [id, joint] : names.joint_of_frame) {
    const Node* node = config.getFrame(id).attributes().find("joint_states");
    const Graph* list = node ? node->value.as<Graph>() : nullptr;
    if (!list) continue;
    for (const Node& state : list->nodes) {
      const Graph* of_group = state.value.as<Graph>();
      if (!of_group) {
        add("", state, joint);
      } else {
        for (const Node& inner : of_group->nodes) add(state.key, inner, joint);
      }
    }
  }
  std::string text;
  for (const auto& [key, joints] : joints_of) {
    text += cat("  <group_state name=\"", xmlEscaped(key.second), "\"",
                key.first.empty() ? "" : cat(" group=\"", xmlEscaped(key.first), "\""), ">\n", joints,
                "  </group_state>\n");
  }
  return text;
}

}  // namespace

std::string srdfText(const Config& config, const std::string& robot_name, const UrdfNames& names,
                     std::vector<std::string>* warnings) {
  std::string text = groups(config, names) + states(config, names);
  if (names.link_of_shape.size() > kMaxLinks) {
    if (warnings)
      warnings->push_back(cat("disabled collision pairs are omitted: the scene has ", names.link_of_shape.size(),
                              " shapes with contacts"));
  } else if (const LinkPairs pairs = linkPairs(config, names); !pairs.as_by_default) {
    const std::string disabled = disabledPairs(pairs, names, warnings);
    text += disabled.empty() ? enabledPairs(pairs) : disabled;
  }
  return text.empty()
             ? ""
             : cat("<?xml version=\"1.0\"?>\n<robot name=\"", xmlEscaped(robot_name), "\">\n", text, "</robot>\n");
}

std::string joinFirst(const std::vector<std::string>& items, std::size_t count) {
  if (items.size() <= count) return join(items);
  return cat(join({items.begin(), items.begin() + long(count)}), " and ", items.size() - count, " more");
}

}  // namespace kinegraph::inline exporters_internal
