#include "kinegraph/parsers/mjcf_check.h"

#include <algorithm>
#include <map>

#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

using Words = std::vector<std::string>;

bool contains(const Words& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

void checkChildren(const XmlElement& element, const Words& known, Findings& findings) {
  for (const XmlElement& child : element.children) {
    if (!contains(known, child.name))
      findings.error(child.where,
                     cat("unknown element <", child.name, "> in <", element.name, ">", similarHint(child.name, known)));
  }
}

}  // namespace

void checkMjcfSections(const MjcfDocument& document, Findings& findings) {
  static const Words sections = {"compiler", "option",   "size",      "visual",   "statistic",  "default",
                                 "custom",   "asset",    "worldbody", "contact",  "deformable", "equality",
                                 "tendon",   "actuator", "sensor",    "keyframe", "extension"};
  static const Words read = {"equality joint", "contact exclude", "keyframe key"};
  static const Words of_interest = {"equality", "contact", "deformable", "tendon", "actuator", "sensor", "keyframe"};
  static const Words assets = {"texture", "material", "mesh", "hfield", "skin", "model"};
  checkChildren(document.root(), sections, findings);
  for (const XmlElement* asset : document.root().all("asset")) checkChildren(*asset, assets, findings);
  std::map<std::string, int> ignored;
  SourcePosition first;
  for (const XmlElement& section : document.root().children) {
    if (!contains(of_interest, section.name)) continue;
    for (const XmlElement& element : section.children) {
      if (contains(read, cat(section.name, " ", element.name))) continue;
      if (!first.known()) first = element.where;
      ++ignored[cat(section.name, "/", element.name)];
    }
  }
  Words list;
  for (const auto& [name, count] : ignored) list.push_back(cat(name, " (", count, ")"));
  if (!list.empty()) findings.warn(first, cat("ignored elements: ", join(list)));
}

void checkMjcfBody(const XmlElement& body, Findings& findings) {
  static const Words read = {"body", "frame", "inertial", "joint", "freejoint", "geom", "site", "camera", "light"};
  static const Words left_out = {"composite", "flexcomp", "plugin", "attach", "replicate"};
  Words known = read;
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
  static const std::map<std::string, Words> known = {
      {"body", {"name", "childclass", "pos", "quat", "axisangle", "xyaxes", "zaxis", "euler"}},
      {"joint", {"name", "class", "type", "pos", "axis", "ref", "range", "limited"}},
      {"geom",
       {"name", "class", "type", "pos", "quat", "axisangle", "xyaxes", "zaxis", "euler", "size", "fromto", "mesh",
        "rgba", "material", "contype", "conaffinity", "group", "mass", "density"}},
      {"site", {"name", "class", "pos", "quat", "axisangle", "xyaxes", "zaxis", "euler", "fromto", "rgba", "group"}},
      {"camera",
       {"name", "class", "pos", "quat", "axisangle", "xyaxes", "zaxis", "euler", "fovy", "resolution", "mode"}},
      {"inertial", {"pos", "quat", "axisangle", "xyaxes", "zaxis", "euler", "mass", "diaginertia", "fullinertia"}}};
  const auto words = known.find(element.name);
  if (words == known.end()) return;
  for (const XmlAttribute& attribute : element.attributes) {
    if (contains(words->second, attribute.name)) continue;
    for (const std::string& word : words->second) {
      if (editDistance(attribute.name, word) > 1.2) continue;
      findings.error(attribute.where, cat("unknown attribute '", attribute.name, "' of <", element.name,
                                          ">; did you mean '", word, "'?"));
      break;
    }
  }
}

}  // namespace kinegraph
