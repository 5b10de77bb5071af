#include "kinegraph/parsers/urdf/urdf_spelling.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "kinegraph/common/text.h"

namespace kinegraph::inline parsers_internal {

namespace {

using UrdfNames = std::vector<std::string>;

struct Known {
  UrdfNames attributes, elements;
};

const std::map<std::string, Known>& knownNames() {
  static const std::map<std::string, Known> known = {
      {"link", {{"name"}, {"inertial", "visual", "collision"}}},
      {"inertial", {{}, {"origin", "mass", "inertia"}}},
      {"mass", {{"value"}, {}}},
      {"inertia", {{"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}, {}}},
      {"visual", {{"name"}, {"origin", "geometry", "material"}}},
      {"collision", {{"name"}, {"origin", "geometry"}}},
      {"geometry", {{}, {"box", "sphere", "cylinder", "capsule", "mesh"}}},
      {"box", {{"size"}, {}}},
      {"sphere", {{"radius"}, {}}},
      {"cylinder", {{"radius", "length"}, {}}},
      {"capsule", {{"radius", "length"}, {}}},
      {"mesh", {{"filename", "scale"}, {}}},
      {"material", {{"name"}, {"color", "texture"}}},
      {"color", {{"rgba"}, {}}},
      {"texture", {{"filename"}, {}}},
      {"joint",
       {{"name", "type"},
        {"origin", "parent", "child", "axis", "limit", "mimic", "dynamics", "calibration", "safety_controller"}}},
      {"origin", {{"xyz", "rpy", "quat_xyzw"}, {}}},
      {"parent", {{"link"}, {}}},
      {"child", {{"link"}, {}}},
      {"axis", {{"xyz"}, {}}},
      {"limit", {{"lower", "upper", "effort", "velocity"}, {}}},
      {"mimic", {{"joint", "multiplier", "offset"}, {}}},
      {"dynamics", {{"damping", "friction"}, {}}},
  };
  return known;
}

class Spelling {
 public:
  explicit Spelling(std::vector<Diagnostic>& found) : found_(found) {}

  /// Checks a child of <robot>.
  void check(const XmlElement& part) {
    if (part.name == "link" || part.name == "joint") return checkPart(part);
    if (part.name.starts_with("xacro:"))
      return warn(part.where, cat("<", part.name, "> is a macro and is ignored; a file with macros ends in .xacro"));
    for (const char* known : {"link", "joint", "material"}) {
      if (part.name != known && editDistance(part.name, known) <= 1.2)
        warn(part.where, cat("unknown element <", part.name, "> is ignored; did you mean <", known, ">?"));
    }
  }

 private:
  void warn(const SourcePosition& where, std::string message) {
    found_.push_back({Diagnostic::Severity::warning, where, std::move(message)});
  }

  void checkPart(const XmlElement& part) {
    const XmlAttribute* name = part.attribute("name");
    part_ = cat(part.name, " '", name ? name->value : "", "': ");
    checkBelow(part);
  }

  void checkBelow(const XmlElement& element) {
    const auto known = knownNames().find(element.name);
    if (known == knownNames().end()) return;
    UrdfNames attributes, elements;
    for (const XmlAttribute& attribute : element.attributes) attributes.push_back(attribute.name);
    for (const XmlElement& child : element.children) elements.push_back(child.name);
    for (const XmlAttribute& attribute : element.attributes)
      ask(element, cat("attribute '", attribute.name, "'"), attribute.name, attribute.where, known->second.attributes,
          attributes);
    for (const XmlElement& child : element.children) {
      ask(element, cat("element <", child.name, ">"), child.name, child.where, known->second.elements, elements);
      checkBelow(child);
    }
  }

  void ask(const XmlElement& element, const std::string& what, const std::string& name, const SourcePosition& where,
           const UrdfNames& known, const UrdfNames& present) {
    if (std::ranges::count(known, name) || !said_.insert(cat(element.name, " ", what)).second) return;
    for (const std::string& meant : known) {
      const double limit = std::max(1., double(meant.size()) / 3.);
      if (std::ranges::count(present, meant) || editDistance(name, meant) > limit) continue;
      warn(where, cat(part_, "unknown ", what, " of <", element.name, "> is ignored; did you mean '", meant, "'?"));
      return;
    }
  }

  std::vector<Diagnostic>& found_;
  std::string part_;            ///< "link 'x': ", for messages
  std::set<std::string> said_;  ///< each name is asked about once
};

}  // namespace

void askAboutSpelling(const XmlElement& robot, std::vector<Diagnostic>& found) {
  Spelling spelling(found);
  for (const XmlElement& part : robot.children) spelling.check(part);
}

}  // namespace kinegraph::inline parsers_internal
