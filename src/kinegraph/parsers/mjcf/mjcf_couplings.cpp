#include "kinegraph/parsers/mjcf/mjcf_couplings.h"

#include <algorithm>

#include "kinegraph/common/text.h"

namespace kinegraph::inline parsers_internal {

namespace {

std::string typeOf(const MjcfElement& joint, MjcfValues& values) {
  if (joint.xml().name == "freejoint") return "free";
  return values.keyword(joint, "type", {"hinge", "slide", "ball", "free"}, "hinge");
}

/// Replaces a source that itself follows a joint by that joint's source. Breaks cycles by removing one coupling.
void resolveChains(std::map<std::string, MjcfCoupling>& couplings, Findings& findings) {
  for (auto entry = couplings.begin(); entry != couplings.end();) {
    auto& [name, coupling] = *entry;
    std::size_t steps = 0;
    auto next = couplings.find(coupling.source);
    while (next != couplings.end() && steps++ <= couplings.size()) {
      if (next->first == name) break;
      coupling.offset += coupling.factor * next->second.offset;
      coupling.factor *= next->second.factor;
      coupling.source = next->second.source;
      next = couplings.find(coupling.source);
    }
    if (next == couplings.end()) {
      ++entry;
      continue;
    }
    findings.warn(coupling.where,
                  cat("joint '", name, "' follows itself through other joints; it is read as an independent joint"));
    entry = couplings.erase(entry);
  }
}

}  // namespace

double mjcfReference(const MjcfElement& joint, MjcfValues& values) {
  const std::string type = typeOf(joint, values);
  const double reference = values.number(joint, "ref", 0.);
  return type == "hinge" ? values.radians(joint, reference) : type == "slide" ? reference : 0.;
}

std::map<std::string, MjcfCoupling> mjcfCouplings(const MjcfDocument& document,
                                                  const std::map<std::string, MjcfElement>& joints, MjcfValues& values,
                                                  Findings& findings) {
  std::vector<std::string> names;
  for (const auto& [name, element] : joints) names.push_back(name);
  std::map<std::string, MjcfCoupling> couplings;
  for (const XmlElement* xml : document.inSections("equality", "joint")) {
    const MjcfElement element(*xml, {});
    if (values.keyword(element, "active", {"true", "false"}, "true") == "false") continue;
    const auto find = [&](const char* role) -> const MjcfElement* {
      const XmlAttribute* name = xml->attribute(role);
      if (!name) return nullptr;
      const auto found = joints.find(name->value);
      if (found != joints.end()) return &found->second;
      findings.warn(name->where, cat("<equality>: there is no joint '", name->value, "'; the element is left out",
                                     similarHint(name->value, names)));
      return nullptr;
    };
    const MjcfElement* first = find("joint1");
    const MjcfElement* second = find("joint2");
    if (!first && !xml->attribute("joint1"))
      findings.warn(xml->where, "<joint> in <equality> has no attribute 'joint1'; the element is left out");
    if (!first || (!second && xml->attribute("joint2"))) continue;
    const std::string name = first->name();
    std::vector<double> c = {0., 1., 0., 0., 0.};
    const std::vector<double> given = values.upTo(element, "polycoef", 5);
    std::copy(given.begin(), given.end(), c.begin());
    const auto readIndependently = [&](const std::string& why) {
      findings.warn(xml->where, cat("<equality>: ", why, "; joint '", name, "' is read as an independent joint"));
    };
    const auto has_one_dof = [&](const MjcfElement& joint) {
      const std::string type = typeOf(joint, values);
      return type == "hinge" || type == "slide";
    };
    if (second && (c[2] != 0. || c[3] != 0. || c[4] != 0.)) {
      readIndependently("the polynomial is not linear");
    } else if (!has_one_dof(*first) || (second && !has_one_dof(*second))) {
      readIndependently("only hinge and slide joints can follow each other");
    } else if (couplings.contains(name)) {
      readIndependently(cat("joint '", name, "' follows another joint already"));
    } else if (!second || c[1] == 0.) {
      couplings[name] = {"", mjcfReference(*first, values) + c[0], 0., xml->where};
    } else {
      const double offset = mjcfReference(*first, values) + c[0] - c[1] * mjcfReference(*second, values);
      couplings[name] = {second->name(), offset, c[1], xml->where};
    }
  }
  resolveChains(couplings, findings);
  return couplings;
}

void addActuators(const MjcfDocument& document, const std::function<std::string(const MjcfName&)>& frameOf,
                  Graph& graph) {
  static const std::pair<const char*, const char*> targets[] = {{"joint", "joint"},   {"jointinparent", "joint"},
                                                                {"tendon", "tendon"}, {"site", "site"},
                                                                {"body", "body"},     {"cranksite", "site"}};
  static const char* const numbers[] = {"gear", "ctrlrange", "forcerange", "kp", "kv", "gainprm", "biasprm"};
  std::map<std::string, Graph*> lists;  // by frame
  for (const XmlElement* section : document.root().all("actuator")) {
    for (const XmlElement& xml : section->children) {
      const MjcfElement actuator = document.element(xml);
      Graph entry;
      const auto add = [&](const char* key, auto data) {
        Node node;
        node.key = key;
        node.where = node.value.where = xml.where;
        node.value.data = std::move(data);
        entry.nodes.push_back(std::move(node));
      };
      add("type", xml.name);
      std::string frame = "world", target;
      for (const auto& [attribute, kind] : targets) {
        const XmlAttribute* const reference = actuator.attribute(attribute);
        if (!reference || !target.empty()) continue;
        target = reference->value;
        if (const std::string found = frameOf({kind, target}); !found.empty()) frame = found;
        add(kind, target);
      }
      for (const char* key : numbers) {
        const XmlAttribute* const given = actuator.attribute(key);
        const auto values = given ? numbersIn(given->value) : std::nullopt;
        if (values && !values->empty()) add(key, NumberArray{*values, 1});
      }
      Graph*& list = lists[frame];
      if (!list) {
        const auto owner =
            std::find_if(graph.nodes.begin(), graph.nodes.end(), [&](const Node& node) { return node.key == frame; });
        if (owner == graph.nodes.end()) continue;
        Graph& attributes = *std::get_if<Graph>(&owner->value.data);
        attributes.set({"actuators", {}, {}, {Graph(), xml.where}, xml.where});
        list = std::get_if<Graph>(&attributes.find("actuators")->value.data);
      }
      const std::string name = actuator.name().empty() ? cat(target, "_", xml.name) : actuator.name();
      list->set({name, {}, {}, {std::move(entry), xml.where}, xml.where});
    }
  }
}

}  // namespace kinegraph::inline parsers_internal
