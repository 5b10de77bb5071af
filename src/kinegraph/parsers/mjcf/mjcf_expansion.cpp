#include "kinegraph/parsers/mjcf/mjcf_expansion.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "kinegraph/common/text.h"

namespace kinegraph::inline parsers_internal {

namespace {

constexpr double kMaxCopies = 10000.;

/// Sections whose elements refer to bodies, joints, geoms and sites.
const std::vector<std::string> kReferringSections = {"contact", "equality", "tendon", "actuator", "sensor"};

std::string kindOfElement(const std::string& element) {
  return element == "freejoint" ? "joint" : element == "default" ? "class" : element;
}

/// The kind of name that an attribute refers to, or "".
std::string kindOfReference(const XmlElement& element, const std::string& attribute) {
  static const std::map<std::string, std::string> kinds = {
      {"mesh", "mesh"},     {"material", "material"},   {"texture", "texture"}, {"hfield", "hfield"},
      {"class", "class"},   {"childclass", "class"},    {"joint", "joint"},     {"joint1", "joint"},
      {"joint2", "joint"},  {"jointinparent", "joint"}, {"body", "body"},       {"body1", "body"},
      {"body2", "body"},    {"target", "body"},         {"geom", "geom"},       {"geom1", "geom"},
      {"geom2", "geom"},    {"sidesite", "site"},       {"site", "site"},       {"site1", "site"},
      {"site2", "site"},    {"cranksite", "site"},      {"slidersite", "site"}, {"refsite", "site"},
      {"tendon", "tendon"}, {"tendon1", "tendon"},      {"tendon2", "tendon"},  {"actuator", "actuator"}};
  if (attribute == "objname" || attribute == "refname") {
    const XmlAttribute* type = element.attribute(attribute == "objname" ? "objtype" : "reftype");
    return !type ? "" : type->value == "xbody" ? "body" : type->value;
  }
  const auto found = kinds.find(attribute);
  return found == kinds.end() ? "" : found->second;
}

/// Tendons, actuators and sensors have elements of many names.
std::string kindOfSectionElement(const std::string& section, const std::string& element) {
  return section == "tendon" || section == "actuator" || section == "sensor" ? section : kindOfElement(element);
}

void setAttribute(XmlElement& element, const char* name, const std::string& value) {
  for (XmlAttribute& attribute : element.attributes) {
    if (attribute.name == name) {
      attribute.value = value;
      return;
    }
  }
  element.attributes.push_back({name, value, element.where});
}

void visitNames(const XmlElement& element, const std::string& section,
                const std::function<void(const MjcfName&, bool defines)>& visit) {
  for (const XmlAttribute& attribute : element.attributes) {
    if (attribute.name == "name") {
      visit({kindOfSectionElement(section, element.name), attribute.value}, true);
    } else if (const std::string kind = kindOfReference(element, attribute.name); !kind.empty()) {
      visit({kind, attribute.value}, false);
    }
  }
  for (const XmlElement& child : element.children) visitNames(child, element.name, visit);
}

void rename(XmlElement& element, const std::string& section,
            const std::function<std::string(const MjcfName&)>& change) {
  for (XmlAttribute& attribute : element.attributes) {
    if (attribute.value.empty()) continue;
    const std::string kind = attribute.name == "name" ? kindOfSectionElement(section, element.name)
                                                      : kindOfReference(element, attribute.name);
    if (!kind.empty()) attribute.value = change({kind, attribute.value});
  }
  for (XmlElement& child : element.children) rename(child, element.name, change);
}

class Replicator {
 public:
  using RotationOf = std::function<Quaterniond(const std::vector<double>&)>;

  Replicator(XmlElement& root, const RotationOf& rotationOf, Findings& findings)
      : root_(root), rotationOf_(rotationOf), findings_(findings) {}

  void run() {
    for (XmlElement& child : root_.children) {
      if (child.name == "worldbody") expandIn(child);
    }
  }

 private:
  void expandIn(XmlElement& container) {
    std::vector<XmlElement> children;
    for (XmlElement& child : container.children) {
      expandIn(child);  // inner replicates first
      if (child.name == "replicate") {
        replicate(child, children);
      } else {
        children.push_back(std::move(child));
      }
    }
    container.children = std::move(children);
  }

  void replicate(const XmlElement& element, std::vector<XmlElement>& into) {
    const XmlAttribute* const given = element.attribute("count");
    const auto count = given ? numbersIn(given->value) : std::nullopt;
    const bool good = count && count->size() == 1 && (*count)[0] >= 0. && (*count)[0] == std::floor((*count)[0]);
    copies_ += good ? (*count)[0] : 0.;
    if (!good || copies_ > kMaxCopies) {
      return findings_.error(given ? given->where : element.where,
                             cat("<replicate>: expected a 'count' of copies, at most ", kMaxCopies, " in all"));
    }
    const XmlAttribute* const separator = element.attribute("sep");
    const std::size_t digits = std::to_string(int((*count)[0])).size();
    std::set<MjcfName> names;
    for (const XmlElement& child : element.children) names.merge(mjcfDefinitions(child));
    std::vector<std::string> suffixes;
    for (int i = 0; i < int((*count)[0]); ++i) {
      std::string number = std::to_string(i);
      number.insert(0, digits - number.size(), '0');
      suffixes.push_back((separator ? separator->value : "") + number);
    }
    const std::vector<double> offset = triple(element, "offset"), euler = triple(element, "euler");
    Pose pose;
    for (std::size_t i = 0; i < suffixes.size(); ++i) {
      XmlElement frame{"frame", {}, element.children, element.where};
      if (!pose.isIdentity(0.)) {
        const auto text = [](const auto& v) { return cat(exact(v[0]), " ", exact(v[1]), " ", exact(v[2])); };
        frame.attributes = {{"pos", text(pose.p), element.where},
                            {"quat", cat(exact(pose.q.w()), " ", text(pose.q.vec())), element.where}};
      }
      for (XmlElement& child : frame.children) rename(child, "", withSuffix(names, suffixes[i]));
      into.push_back(std::move(frame));
      pose.p += pose.q * Vector3d(offset[0], offset[1], offset[2]);
      const double times = double(i + 1);  // MuJoCo multiplies the angles, which differs from repeated rotations
      pose.q = rotationOf_({times * euler[0], times * euler[1], times * euler[2]});
    }
    replicateReferences(names, suffixes);
  }

  /// Three numbers, 0 by default.
  std::vector<double> triple(const XmlElement& element, const char* name) {
    const XmlAttribute* const attribute = element.attribute(name);
    if (!attribute) return {0., 0., 0.};
    const auto given = numbersIn(attribute->value);
    if (given && given->size() == 3) return *given;
    findings_.error(attribute->where, cat("<replicate> ", name, "=\"", attribute->value, "\": expected 3 numbers"));
    return {0., 0., 0.};
  }

  static std::function<std::string(const MjcfName&)> withSuffix(const std::set<MjcfName>& names,
                                                                const std::string& suffix) {
    return
        [&names, &suffix](const MjcfName& name) { return names.contains(name) ? name.second + suffix : name.second; };
  }

  void replicateReferences(std::set<MjcfName> names, const std::vector<std::string>& suffixes) {
    for (const std::string& section : kReferringSections) {
      for (XmlElement& part : root_.children) {
        if (part.name != section) continue;
        std::vector<XmlElement> elements;
        for (XmlElement& element : part.children) {
          const std::set<MjcfName> references = mjcfReferences(element);
          const auto is_copied = [&](const MjcfName& name) { return names.contains(name); };
          if (std::none_of(references.begin(), references.end(), is_copied)) {
            elements.push_back(std::move(element));
            continue;
          }
          std::set<MjcfName> changed = names;
          if (const XmlAttribute* own = element.attribute("name")) {
            changed.insert({kindOfSectionElement(section, element.name), own->value});
            if (section == "tendon") names.insert({"tendon", own->value});  // actuators of the tendon follow
          }
          for (const std::string& suffix : suffixes) {
            elements.push_back(element);
            rename(elements.back(), section, withSuffix(changed, suffix));
          }
        }
        part.children = std::move(elements);
      }
    }
  }

  XmlElement& root_;
  const RotationOf& rotationOf_;
  Findings& findings_;
  double copies_ = 0.;
};

/// The path of elements from `container` to the body of that name, the body last; empty if there is none.
std::vector<const XmlElement*> pathToBody(const XmlElement& container, const std::string& name) {
  for (const XmlElement& child : container.children) {
    if (child.name != "body" && child.name != "frame") continue;
    const XmlAttribute* const own = child.attribute("name");
    if (child.name == "body" && own && own->value == name) return {&child};
    if (std::vector<const XmlElement*> path = pathToBody(child, name); !path.empty()) {
      path.insert(path.begin(), &child);
      return path;
    }
  }
  return {};
}

}  // namespace

void renameMjcf(XmlElement& element, const std::function<std::string(const MjcfName&)>& change) {
  rename(element, "", change);
}

std::set<MjcfName> mjcfReferences(const XmlElement& element) {
  std::set<MjcfName> names;
  visitNames(element, "", [&](const MjcfName& name, bool defines) {
    if (!defines && name.first != "class") names.insert(name);
  });
  return names;
}

std::set<MjcfName> mjcfDefinitions(const XmlElement& element) {
  std::set<MjcfName> names;
  visitNames(element, "", [&](const MjcfName& name, bool defines) {
    if (defines && !name.second.empty()) names.insert(name);
  });
  return names;
}

void expandReplicates(XmlElement& root, const std::function<Quaterniond(const std::vector<double>&)>& rotationOf,
                      Findings& findings) {
  Replicator(root, rotationOf, findings).run();
}

bool cutOutModel(const XmlElement& attach, XmlElement& model, Findings& findings) {
  const XmlAttribute* const prefix = attach.attribute("prefix");
  const XmlAttribute* const body = attach.attribute("body");
  if (!prefix) findings.error(attach.where, "<attach> has no attribute 'prefix'");
  if (!prefix) return false;
  XmlElement bodies{"worldbody", {}, {}, model.where};
  for (const XmlElement* world : model.all("worldbody")) {
    if (!body) {
      bodies.children.insert(bodies.children.end(), world->children.begin(), world->children.end());
      continue;
    }
    const std::vector<const XmlElement*> path = pathToBody(*world, body->value);
    if (path.empty()) continue;
    bodies.children.push_back(*path.back());
    for (const XmlElement* element : path) {  // the innermost class around the body
      const XmlAttribute* const childclass = element->attribute("childclass");
      if (childclass) setAttribute(bodies.children.back(), "childclass", childclass->value);
    }
  }
  if (bodies.children.empty() && body) {
    findings.error(body->where, cat("<attach>: its model has no body '", body->value, "'"));
    return false;
  }
  std::set<MjcfName> known = mjcfDefinitions(bodies);
  known.insert({"body", "world"});
  std::vector<XmlElement> parts;
  for (XmlElement& part : model.children) {
    const bool refers =
        std::find(kReferringSections.begin(), kReferringSections.end(), part.name) != kReferringSections.end();
    if (part.name != "asset" && part.name != "default" && !refers) continue;
    if (part.name == "asset") {
      std::erase_if(part.children, [](const XmlElement& asset) { return asset.name == "model"; });
      for (XmlElement& asset : part.children) {  // a file gives its name to an asset without one
        const XmlAttribute* const file = asset.attribute("file");
        if (!asset.attribute("name") && file)
          setAttribute(asset, "name", std::filesystem::path(file->value).stem().string());
      }
    }
    if (refers) {
      std::erase_if(part.children, [&](const XmlElement& element) {
        const std::set<MjcfName> names = mjcfReferences(element);
        const bool all = std::all_of(names.begin(), names.end(), [&](const MjcfName& name) {
          return known.contains(name) || name.first == "actuator" || name.first == "material";
        });
        if (all) known.merge(mjcfDefinitions(XmlElement{part.name, {}, {element}, element.where}));
        return !all;
      });
    }
    parts.push_back(std::move(part));
  }
  parts.push_back(std::move(bodies));
  model.children = std::move(parts);
  for (XmlElement& part : model.children) {
    rename(part, "", [&](const MjcfName& name) {
      return name == MjcfName("body", "world") ? name.second : prefix->value + name.second;
    });
  }
  return true;
}

}  // namespace kinegraph::inline parsers_internal
