#include "kinegraph/parsers/urdf/srdf_reader.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "kinegraph/common/file_paths.h"
#include "kinegraph/common/text.h"
#include "kinegraph/parsers/xml/findings.h"
#include "kinegraph/parsers/xml/xml.h"

namespace kinegraph::inline parsers_internal {

namespace {

using Member = RobotSemantics::Member;

// Elements written by MoveIt, Pinocchio and HPP; only the first line of them is used here.
const std::vector<std::string> kElements = {"group",
                                            "group_state",
                                            "disable_collisions",
                                            "enable_collisions",
                                            "disable_default_collisions",
                                            "virtual_joint",
                                            "end_effector",
                                            "passive_joint",
                                            "joint_property",
                                            "link_sphere_approximation",
                                            "rotor_params",
                                            "specifications",
                                            "gripper",
                                            "handle",
                                            "contact",
                                            "position",
                                            "global_position",
                                            "mask",
                                            "clearance"};

class SrdfReader {
 public:
  explicit SrdfReader(std::vector<Diagnostic>& found) : found_(found) {}

  RobotSemantics read(const XmlElement& robot) {
    if (robot.name != "robot") {
      found_.error(robot.where, cat("the root of an SRDF file is <robot>, not <", robot.name, ">"));
      return {};
    }
    for (const XmlElement& element : robot.children) readElement(element);
    checkGroups();
    return std::move(semantics_);
  }

 private:
  void readElement(const XmlElement& element) {
    if (element.name == "group") {
      readGroup(element);
    } else if (element.name == "group_state") {
      readState(element);
    } else if (element.name == "disable_collisions" || element.name == "enable_collisions") {
      const std::string a = text(element, "link1"), b = text(element, "link2");
      auto& pairs = element.name == "enable_collisions" ? semantics_.contact : semantics_.no_contact;
      if (!a.empty() && !b.empty()) pairs.push_back({a, b, element.where});
    } else if (element.name == "disable_default_collisions") {
      if (const std::string link = text(element, "link"); !link.empty())
        semantics_.no_contact.push_back({link, "", element.where});
    } else if (element.name == "virtual_joint") {
      if (const std::string name = text(element, "name"); !name.empty()) semantics_.outside.push_back(name);
    } else {
      checkElement(element, kElements);
    }
  }

  void checkElement(const XmlElement& element, const std::vector<std::string>& known) {
    if (std::find(known.begin(), known.end(), element.name) != known.end()) return;
    if (element.name.starts_with("xacro:")) {
      found_.error(element.where,
                   cat("<", element.name, "> is a macro; expand the file first: xacro in.xacro > out.srdf"));
    } else {
      found_.warn(element.where, cat("unknown element <", element.name, ">", similarHint(element.name, known)));
    }
  }

  /// The text of a required attribute; "" and an error if it is missing.
  std::string text(const XmlElement& element, const char* name) {
    const XmlAttribute* attribute = element.attribute(name);
    if (attribute && !attribute->value.empty()) return attribute->value;
    std::vector<std::string> names;
    for (const XmlAttribute& given : element.attributes) names.push_back(given.name);
    found_.error(element.where, cat("<", element.name, "> has no attribute '", name, "'", similarHint(name, names)));
    return "";
  }

  void readGroup(const XmlElement& element) {
    RobotSemantics::Group group{text(element, "name"), {}};
    for (const XmlElement& child : element.children) {
      if (child.name == "joint" || child.name == "link" || child.name == "group") {
        const auto kind = child.name == "joint"  ? Member::Kind::joint
                          : child.name == "link" ? Member::Kind::link
                                                 : Member::Kind::group;
        if (const std::string name = text(child, "name"); !name.empty())
          group.members.push_back({kind, name, "", child.where});
      } else if (child.name == "chain") {
        const std::string base = text(child, "base_link"), tip = text(child, "tip_link");
        if (!base.empty() && !tip.empty()) group.members.push_back({Member::Kind::chain, base, tip, child.where});
      } else {
        checkElement(child, {"joint", "link", "chain", "group", "passive_joint"});
      }
    }
    if (group.name.empty()) return;
    const auto [first, is_new] = group_at_.emplace(group.name, element.where);
    if (is_new) {
      semantics_.groups.push_back(std::move(group));
    } else {
      found_.error(element.where, cat("the group '", group.name, "' is already defined at ", first->second.str()));
    }
  }

  void readState(const XmlElement& element) {
    RobotSemantics::State state{text(element, "name"), "", {}};
    if (const XmlAttribute* group = element.attribute("group")) {
      state.group = group->value;
      state_groups_.push_back(group);
    }
    for (const XmlElement& child : element.children) {
      if (child.name != "joint") {
        checkElement(child, {"joint"});
        continue;
      }
      const std::string joint = text(child, "name"), value = text(child, "value");
      if (joint.empty() || value.empty()) continue;
      auto numbers = numbersIn(value);
      if (!numbers || numbers->empty()) {
        found_.error(child.attribute("value")->where,
                     cat("state '", state.name, "', joint '", joint, "': value=\"", value, "\" is not a number"));
        continue;
      }
      state.joints.push_back({joint, std::move(*numbers), child.where});
    }
    if (!state.name.empty()) semantics_.states.push_back(std::move(state));
  }

  /// Checks that referenced groups exist and do not contain themselves.
  void checkGroups() {
    std::vector<std::string> names;
    std::map<std::string, const RobotSemantics::Group*> groups;
    for (const auto& group : semantics_.groups) {
      names.push_back(group.name);
      groups[group.name] = &group;
    }
    const auto check = [&](const std::string& name, const SourcePosition& where) {
      if (!groups.contains(name)) found_.warn(where, cat("no group '", name, "'", similarHint(name, names)));
    };
    for (const XmlAttribute* attribute : state_groups_) check(attribute->value, attribute->where);
    for (const auto& group : semantics_.groups) {
      for (const Member& member : group.members) {
        if (member.kind == Member::Kind::group) check(member.name, member.where);
      }
    }
    if (found_.failed()) return;
    std::set<std::string> done;
    for (const auto& group : semantics_.groups) {
      std::vector<std::string> open;
      checkCycle(group, groups, open, done);
    }
  }

  void checkCycle(const RobotSemantics::Group& group, const std::map<std::string, const RobotSemantics::Group*>& groups,
                  std::vector<std::string>& open, std::set<std::string>& done) {
    if (done.contains(group.name) || found_.failed()) return;
    open.push_back(group.name);
    for (const Member& member : group.members) {
      if (member.kind != Member::Kind::group) continue;
      if (std::find(open.begin(), open.end(), member.name) != open.end()) {
        found_.error(member.where,
                     cat("group '", member.name, "' contains itself: ", join(open, " > "), " > ", member.name));
      } else {
        if (const auto inner = groups.find(member.name); inner != groups.end())
          checkCycle(*inner->second, groups, open, done);
      }
    }
    open.pop_back();
    done.insert(group.name);
  }

  Findings found_;
  RobotSemantics semantics_;
  std::map<std::string, SourcePosition> group_at_;
  std::vector<const XmlAttribute*> state_groups_;
};

}  // namespace

RobotSemantics readSemantics(std::string_view text, const std::string& file, std::vector<Diagnostic>& found) {
  try {
    const XmlElement robot = parseXml(text, file);
    RobotSemantics semantics = SrdfReader(found).read(robot);
    semantics.outside.push_back("root_joint");  // Pinocchio's name for the joint of a floating base
    semantics.file = file;
    return semantics;
  } catch (const ParseError& error) {
    found.push_back({Diagnostic::Severity::error, error.where(), error.reason()});
    return {};
  }
}

bool isSemanticsFile(const std::string& file) {
  const std::string extension = lowerExtension(file);
  return extension == ".srdf" || (extension == ".xacro" && isSemanticsFile(file.substr(0, file.size() - 6)));
}

std::string semanticsBeside(const std::string& file) {
  namespace fs = std::filesystem;
  const fs::path path(file);
  if (lowerExtension(file) != ".urdf") return "";
  const std::string name = path.stem().string() + ".srdf";
  std::error_code error;
  for (const fs::path& place : {path.parent_path() / name, path.parent_path().parent_path() / "srdf" / name}) {
    if (fs::is_regular_file(place, error)) return place.string();
  }
  return "";
}

}  // namespace kinegraph::inline parsers_internal
