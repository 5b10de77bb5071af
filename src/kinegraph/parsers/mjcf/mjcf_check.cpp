#include "kinegraph/parsers/mjcf/mjcf_check.h"

#include <algorithm>
#include <map>

#include "kinegraph/common/text.h"

namespace kinegraph::inline parsers_internal {

namespace {

using Names = std::vector<std::string>;

bool contains(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void checkChildren(const XmlElement& element, const Names& known, Findings& findings) {
  for (const XmlElement& child : element.children) {
    if (!contains(known, child.name))
      findings.error(child.where,
                     cat("unknown element <", child.name, "> in <", element.name, ">", similarHint(child.name, known)));
  }
}

}  // namespace

void checkMjcfSections(const MjcfDocument& document, Findings& findings) {
  static const Names sections = {"compiler", "option",   "size",      "visual",   "statistic",  "default",
                                 "custom",   "asset",    "worldbody", "contact",  "deformable", "equality",
                                 "tendon",   "actuator", "sensor",    "keyframe", "extension"};
  static const Names read = {"equality joint", "contact exclude", "contact pair", "keyframe key"};
  static const Names of_interest = {"equality", "contact", "deformable", "tendon", "actuator", "sensor", "keyframe"};
  static const Names assets = {"texture", "material", "mesh", "hfield", "skin", "model"};
  for (const XmlElement& child : document.root().children) {  // MuJoCo reads files of such parts, too
    static const Names parts = {"body", "geom", "site", "camera", "light", "frame"};
    if (contains(parts, child.name))
      findings.warn(child.where, cat("<", child.name, "> outside of <worldbody> is ignored"));
    else if (!contains(sections, child.name))
      findings.error(child.where,
                     cat("unknown element <", child.name, "> in <mujoco>", similarHint(child.name, sections)));
  }
  for (const XmlElement* asset : document.root().all("asset")) checkChildren(*asset, assets, findings);
  std::map<std::string, int> ignored;
  SourcePosition first;
  for (const XmlElement& section : document.root().children) {
    if (!contains(of_interest, section.name)) continue;
    for (const XmlElement& element : section.children) {
      if (contains(read, cat(section.name, " ", element.name))) continue;
      if (section.name == "actuator" && element.attribute("joint")) continue;  // mjcfMotors reads it
      if (!first.known()) first = element.where;
      ++ignored[cat(section.name, "/", element.name)];
    }
  }
  Names list;
  for (const auto& [name, count] : ignored) list.push_back(cat(name, " (", count, ")"));
  if (!list.empty()) findings.warn(first, cat("ignored elements: ", join(list)));
}

void checkMjcfBody(const XmlElement& body, Findings& findings) {
  static const Names read = {"body", "frame", "inertial", "joint", "freejoint", "geom", "site", "camera", "light"};
  static const Names left_out = {"composite", "flexcomp", "plugin"};
  Names known = read;
  known.insert(known.end(), left_out.begin(), left_out.end());
  checkChildren(body, known, findings);
  for (const XmlElement& child : body.children) {
    if (contains(left_out, child.name))
      findings.warn(child.where, cat("<", child.name, "> is not supported and is ignored"));
    if (body.name == "worldbody" && (child.name == "joint" || child.name == "freejoint" || child.name == "inertial"))
      findings.error(child.where, cat("<", child.name, "> must be inside a <body>; the world does not move"));
  }
}

void checkMjcfAttributes(const XmlElement& element, Findings& findings) {
  static const std::map<std::string, Names> known = {
      {"body", {"name", "childclass", "pos", "quat", "axisangle", "xyaxes", "zaxis", "euler", "gravcomp"}},
      {"joint",
       {"name", "class", "type", "pos", "axis", "ref", "range", "limited", "damping", "stiffness", "springref",
        "frictionloss", "armature"}},
      {"geom", {"name",    "class",       "type",  "pos",    "quat",    "axisangle", "xyaxes",
                "zaxis",   "euler",       "size",  "fromto", "mesh",    "rgba",      "material",
                "contype", "conaffinity", "group", "mass",   "density", "friction",  "shellinertia"}},
      {"site", {"name", "class", "pos", "quat", "axisangle", "xyaxes", "zaxis", "euler", "fromto", "rgba", "group"}},
      {"camera",
       {"name", "class", "pos", "quat", "axisangle", "xyaxes", "zaxis", "euler", "fovy", "resolution", "mode"}},
      {"inertial", {"pos", "quat", "axisangle", "xyaxes", "zaxis", "euler", "mass", "diaginertia", "fullinertia"}}};
  const auto names = known.find(element.name);
  if (names == known.end()) return;
  for (const XmlAttribute& attribute : element.attributes) {
    if (contains(names->second, attribute.name)) continue;
    for (const std::string& name : names->second) {
      if (editDistance(attribute.name, name) > 1.2) continue;
      findings.error(attribute.where, cat("unknown attribute '", attribute.name, "' of <", element.name,
                                          ">; did you mean '", name, "'?"));
      break;
    }
  }
}

}  // namespace kinegraph::inline parsers_internal
