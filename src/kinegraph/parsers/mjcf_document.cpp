#include "kinegraph/parsers/mjcf_document.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "kinegraph/common/file_paths.h"
#include "kinegraph/common/text.h"
#include "kinegraph/common/utf8.h"

namespace kinegraph {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxBytes = std::size_t(64) << 20;  // of all included files together
constexpr const char* kOutermost = "main";                // class

}  // namespace

const XmlAttribute* MjcfElement::attribute(std::string_view name) const {
  if (const XmlAttribute* found = xml_->attribute(name)) return found;
  for (const XmlElement* element : defaults_) {
    if (const XmlAttribute* found = element->attribute(name)) return found;
  }
  return nullptr;
}

std::vector<const XmlAttribute*> MjcfElement::layers(std::string_view name) const {
  std::vector<const XmlAttribute*> found;
  for (auto element = defaults_.rbegin(); element != defaults_.rend(); ++element) {
    if (const XmlAttribute* attribute = (*element)->attribute(name)) found.push_back(attribute);
  }
  if (const XmlAttribute* attribute = xml_->attribute(name)) found.push_back(attribute);
  return found;
}

std::string MjcfElement::name() const {
  const XmlAttribute* name = xml_->attribute("name");
  return name ? name->value : "";
}

std::string MjcfElement::describe() const {
  const std::string given = name();
  return given.empty() ? cat("<", xml_->name, ">") : cat("<", xml_->name, " name=\"", given, "\">");
}

MjcfDocument::MjcfDocument(std::string_view text, const std::string& file, const std::string& folder,
                           Findings& findings)
    : findings_(findings), main_folder_(folder) {
  try {
    root_ = parseXml(text, file);
  } catch (const ParseError& e) {
    findings_.error(e.where(), e.reason());
    return;
  }
  if (root_.name != "mujoco") {
    findings_.error(root_.where,
                    cat("the root of an XML scene is <mujoco> (MJCF) or <robot> (URDF), not <", root_.name, ">"));
    return;
  }
  std::vector<std::string> open = {fs::absolute(file).lexically_normal().string()};
  expand(root_, folder, open);
  readSettings();
  classes_[kOutermost];
  for (const XmlElement* element : root_.all("default")) collectClasses(*element, nullptr);
}

/// Replaces each <include> by the content of its file.
void MjcfDocument::expand(XmlElement& element, const std::string& folder, std::vector<std::string>& open) {
  std::vector<XmlElement> children;
  for (XmlElement& child : element.children) {
    if (child.name == "include") {
      include(child, folder, open, children);
    } else {
      expand(child, folder, open);
      children.push_back(std::move(child));
    }
  }
  element.children = std::move(children);
}

void MjcfDocument::include(const XmlElement& element, const std::string& folder, std::vector<std::string>& open,
                           std::vector<XmlElement>& into) {
  const XmlAttribute* file = element.attribute("file");
  if (!file) return findings_.error(element.where, "<include> has no attribute 'file'");
  std::error_code ignored;
  std::string path = resolvePath(file->value, main_folder_);
  if (!fs::is_regular_file(path, ignored)) {
    const std::string beside = resolvePath(file->value, folder);
    if (fs::is_regular_file(beside, ignored)) path = beside;
  }
  const std::string absolute = fs::absolute(path).lexically_normal().string();
  const auto same = [&](const SourceText& other) { return other.file == path; };
  if (std::find(open.begin(), open.end(), absolute) != open.end())
    return findings_.error(file->where, cat("'", file->value, "' includes itself"));
  if (std::any_of(included_.begin(), included_.end(), same))
    return findings_.error(file->where, cat("'", file->value, "' is included twice; MJCF allows that once"));
  included_.push_back({path, ""});
  if (!fs::is_regular_file(path, ignored)) {
    return findings_.error(file->where,
                           cat("file '", file->value, "' does not exist (", path, ")", similarFilesHint(path)));
  }
  std::size_t bytes = std::size_t(fs::file_size(path, ignored));
  for (const SourceText& text : included_) bytes += text.text.size();
  if (bytes > kMaxBytes) {
    return findings_.error(file->where, cat("including '", file->value, "' exceeds the limit for included files of ",
                                            kMaxBytes >> 20, " MB"));
  }
  std::ifstream stream(path, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  included_.back().text = validUtf8(toUtf8(text.str()));
  try {
    XmlElement root = parseXml(included_.back().text, path);
    open.push_back(absolute);
    expand(root, fs::path(path).parent_path().string(), open);
    open.pop_back();
    std::move(root.children.begin(), root.children.end(), std::back_inserter(into));
  } catch (const ParseError& e) {
    findings_.error(e.where(), e.reason());
  }
}

void MjcfDocument::readSettings() {
  const auto flag = [&](const XmlAttribute& attribute) {
    if (attribute.value != "true" && attribute.value != "false")
      findings_.error(attribute.where,
                      cat("<compiler> ", attribute.name, "=\"", attribute.value, "\": expected true or false"));
    return attribute.value == "true";
  };
  bool mesh_folder_given = false, texture_folder_given = false;
  for (const XmlElement* compiler : root_.all("compiler")) {
    for (const XmlAttribute& attribute : compiler->attributes) {
      const std::string& value = attribute.value;
      const auto refuse = [&](const char* expected) {
        findings_.error(attribute.where, cat("<compiler> ", attribute.name, "=\"", value, "\": expected ", expected));
      };
      if (attribute.name == "angle") {
        settings_.degrees = value != "radian";
        if (value != "radian" && value != "degree") refuse("degree or radian");
      } else if (attribute.name == "eulerseq") {
        const bool legal = value.size() == 3 && value.find_first_not_of("xyzXYZ") == std::string::npos;
        if (legal) settings_.euler_order = value;
        if (!legal) refuse("three letters of x y z (axes of the rotated frame) or X Y Z (fixed axes)");
      } else if (attribute.name == "coordinate") {
        if (value != "local") refuse("local; MuJoCo removed 'global', and its older versions convert such files");
      } else if (attribute.name == "autolimits") {
        settings_.limited_by_range = flag(attribute);
      } else if (attribute.name == "strippath") {
        settings_.strip_mesh_path = flag(attribute);
      } else if (attribute.name == "meshdir") {
        settings_.mesh_folder = value;
        mesh_folder_given = true;
      } else if (attribute.name == "texturedir") {
        settings_.texture_folder = value;
        texture_folder_given = true;
      } else if (attribute.name == "assetdir") {
        if (!mesh_folder_given) settings_.mesh_folder = value;
        if (!texture_folder_given) settings_.texture_folder = value;
      } else if (attribute.name == "inertiafromgeom") {
        settings_.masses_of_geoms = value != "false";
        settings_.masses_only_of_geoms = value == "true";
        if (value != "auto" && value != "false" && value != "true") refuse("auto, false or true");
      }
    }
  }
}

void MjcfDocument::collectClasses(const XmlElement& element, const Class* outer) {
  const XmlAttribute* name = element.attribute("class");
  if (!name && outer) return findings_.error(element.where, "a <default> inside another has no attribute 'class'");
  const std::string key = name && outer ? name->value : kOutermost;
  if (const auto known = classes_.find(key); known != classes_.end() && known->second.outer != outer)
    return findings_.error(name->where, cat("the default class '", key, "' already exists below another class"));
  Class& entry = classes_[key];
  entry.elements.push_back(&element);
  if (outer) entry.outer = outer;
  if (name && !outer && name->value != kOutermost) classes_[name->value].outer = &entry;  // an alias of it
  for (const XmlElement* inner : element.all("default")) collectClasses(*inner, &entry);
}

std::vector<const XmlElement*> MjcfDocument::inSections(std::string_view section, std::string_view name) const {
  std::vector<const XmlElement*> found;
  for (const XmlElement* part : root_.all(section)) {
    for (const XmlElement* element : part->all(name)) found.push_back(element);
  }
  return found;
}

MjcfElement MjcfDocument::element(const XmlElement& xml, const std::string& childclass) const {
  const XmlAttribute* own = xml.attribute("class");
  auto found = classes_.find(own ? own->value : childclass);
  if (found == classes_.end()) found = classes_.find(kOutermost);
  std::vector<const XmlElement*> defaults;
  const Class* entry = found == classes_.end() ? nullptr : &found->second;
  for (; entry; entry = entry->outer) {
    for (auto element = entry->elements.rbegin(); element != entry->elements.rend(); ++element) {
      const std::vector<const XmlElement*> same = (*element)->all(xml.name);
      defaults.insert(defaults.end(), same.rbegin(), same.rend());
    }
  }
  return {xml, std::move(defaults)};
}

bool MjcfDocument::checkClass(const XmlAttribute& reference) const {
  if (classes_.contains(reference.value)) return true;
  std::vector<std::string> known;
  for (const auto& [name, entry] : classes_) known.push_back(name);
  findings_.error(reference.where,
                  cat("no default class '", reference.value, "'", similarHint(reference.value, known)));
  return false;
}

}  // namespace kinegraph
