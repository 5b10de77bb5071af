#include "kinegraph/parsers/mjcf/mjcf_document.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "kinegraph/common/file_paths.h"
#include "kinegraph/common/text.h"
#include "kinegraph/common/utf8.h"
#include "kinegraph/parsers/mjcf/mjcf_expansion.h"

namespace kinegraph::inline parsers_internal {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxBytes = std::size_t(64) << 20;  // of all included files together
constexpr const char* kOutermost = "main";                // class
constexpr std::size_t kMaxAttached = 10;                  // models in models

/// The content of a file as UTF-8.
std::string textOfFile(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  return validUtf8(toUtf8(text.str()));
}

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

Quaterniond mjcfEuler(const std::vector<double>& angles, const MjcfSettings& settings) {
  Quaterniond q = Quaterniond::Identity();
  for (std::size_t i = 0; i < 3; ++i) {
    const char letter = settings.euler_order[i];
    const bool fixed = letter <= 'Z';
    const double angle = settings.degrees ? angles[i] / 180. * M_PI : angles[i];
    const Quaterniond step(Eigen::AngleAxisd(angle, Vector3d::Unit(letter - (fixed ? 'X' : 'x'))));
    q = fixed ? step * q : q * step;
  }
  return q;
}

MjcfDocument::MjcfDocument(std::string_view text, const std::string& file, const std::string& folder,
                           Findings& findings, std::vector<std::string> around)
    : findings_(findings), main_folder_(folder), around_(std::move(around)) {
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
  around_.push_back(open.front());
  expand(root_, folder, open);
  readSettings();
  for (const XmlElement* model : inSections("asset", "model")) models_.push_back(*model);
  attachModels(root_);
  expandReplicates(
      root_, [&](const std::vector<double>& angles) { return mjcfEuler(angles, settings_); }, findings_);
  classes_[kOutermost];
  for (const XmlElement& element : attached_defaults_) collectClasses(element, nullptr, true);
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
  included_.back().text = textOfFile(path);
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

/// Replaces each <attach> in the bodies by the parts of its model.
void MjcfDocument::attachModels(XmlElement& container) {
  std::vector<XmlElement> children;
  for (XmlElement& child : container.children) {
    if (child.name == "attach") {
      attach(child, children);
    } else {
      const bool inside =
          child.name == "worldbody" || child.name == "body" || child.name == "frame" || child.name == "replicate";
      if (inside) attachModels(child);
      children.push_back(std::move(child));
    }
  }
  container.children = std::move(children);
  if (&container != &root_) return;
  std::move(attached_parts_.begin(), attached_parts_.end(), std::back_inserter(root_.children));
  attached_parts_.clear();
}

void MjcfDocument::attach(const XmlElement& element, std::vector<XmlElement>& into) {
  const XmlAttribute* const reference = element.attribute("model");
  if (!reference) return findings_.error(element.where, "<attach> has no attribute 'model'");
  std::vector<std::string> names;
  for (const XmlElement& asset : models_) {
    const XmlAttribute* const name = asset.attribute("name");
    if (name && name->value != reference->value) names.push_back(name->value);
    if (name && name->value != reference->value) continue;
    if (const XmlAttribute* file = asset.attribute("file"); file && leavesOut(*file)) return;
    std::optional<XmlElement> model = loadModel(asset, element);
    if (findings_.failed()) return;
    if (!model) continue;  // the name in the file is another
    if (!cutOutModel(element, *model, findings_)) return;
    const std::string top = cat(element.attribute("prefix")->value, kOutermost, "@", attached_defaults_.size());
    XmlElement outermost{"default", {{"class", top, element.where}}, {}, element.where};
    const std::string outermost_alias = element.attribute("prefix")->value + kOutermost;
    if (outermost_alias != kOutermost)
      outermost.children.push_back({"default", {{"class", outermost_alias, element.where}}, {}, element.where});
    XmlElement frame{"frame", {{"childclass", top, element.where}}, {}, element.where};
    for (XmlElement& part : model->children) {
      if (part.name == "default") {
        if (const XmlAttribute* alias = part.attribute("class"); alias && alias->value != outermost_alias)
          outermost.children.push_back({"default", {*alias}, {}, part.where});
        std::move(part.children.begin(), part.children.end(), std::back_inserter(outermost.children));
      } else if (part.name == "worldbody") {
        frame.children = std::move(part.children);
      } else {
        for (XmlElement& child : part.children) {
          if (!child.attribute("class")) child.attributes.push_back({"class", top, child.where});
        }
        attached_parts_.push_back(std::move(part));
      }
    }
    attached_defaults_.push_back(std::move(outermost));
    return into.push_back(std::move(frame));
  }
  findings_.error(reference->where, cat("<attach>: there is no model '", reference->value, "' in <asset>",
                                        similarHint(reference->value, names)));
}

/// MuJoCo attaches models of URDF files, too; here a warning says that they are left out.
bool MjcfDocument::leavesOut(const XmlAttribute& file) {
  const std::string path = locateAsset(file, "").path;
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored) || xmlRootName(textOfFile(path)) != "robot") return false;
  findings_.warn(file.where, cat("model '", file.value,
                                 "' is a URDF file, which <attach> does not read; it is left out; convert it to MJCF"));
  return true;
}

/// Reads the file of a <model>; nullopt if the asset has no name and the model in the file has another one than the
/// <attach> asks for.
std::optional<XmlElement> MjcfDocument::loadModel(const XmlElement& asset, const XmlElement& attach) {
  const XmlAttribute* const file = asset.attribute("file");
  std::error_code ignored;
  const std::string path = file ? locateAsset(*file, "").path : "";
  const auto refuse = [&](std::string message) {
    findings_.error(file ? file->where : asset.where, std::move(message));
    return std::nullopt;
  };
  if (!file) return refuse("<model> has no attribute 'file'");
  if (!fs::is_regular_file(path, ignored)) return refuse(cat("model '", file->value, "' does not exist (", path, ")"));
  std::size_t bytes = std::size_t(fs::file_size(path, ignored));
  for (const SourceText& text : included_) bytes += text.text.size();
  const std::string absolute = fs::absolute(path).lexically_normal().string();
  if (std::find(around_.begin(), around_.end(), absolute) != around_.end() || around_.size() > kMaxAttached ||
      bytes > kMaxBytes)
    return refuse(cat("model '", file->value, "' attaches itself, or is too large or nested too deeply"));
  included_.push_back({path, textOfFile(path)});
  if (xmlRootName(included_.back().text) != "mujoco") {
    return refuse(cat("model '", file->value, "' is no MJCF file; only those are attached"));
  }
  MjcfDocument model(included_.back().text, path, fs::path(path).parent_path().string(), findings_, around_);
  for (SourceText& text : model.included_) included_.push_back(text);
  if (findings_.failed()) return std::nullopt;
  const XmlAttribute* const own = model.root_.attribute("model");
  if (!asset.attribute("name") && attach.attribute("model")->value != (own ? own->value : "MuJoCo Model"))
    return std::nullopt;
  const std::pair settings(model.settings_, model.main_folder_);
  other_.emplace(path, settings);
  for (const SourceText& text : model.included_) other_.emplace(text.file, settings);
  for (const auto& [inner, inner_settings] : model.other_) other_.insert_or_assign(inner, inner_settings);
  const XmlAttribute* const prefix = attach.attribute("prefix");
  for (XmlElement& classes : model.attached_defaults_) {
    renameMjcf(classes, [&](const MjcfName& name) { return (prefix ? prefix->value : "") + name.second; });
    attached_defaults_.push_back(std::move(classes));
  }
  return std::move(model.root_);
}

const MjcfSettings& MjcfDocument::settingsAt(const SourcePosition& where) const {
  const auto found = other_.find(where.file);
  return found == other_.end() ? settings_ : found->second.first;
}

LocatedFile MjcfDocument::locateAsset(const XmlAttribute& file, const std::string& folder) const {
  const auto other = other_.find(file.where.file);
  const std::string& main_folder = other == other_.end() ? main_folder_ : other->second.second;
  const std::string beside = fs::path(file.where.file).parent_path().string();
  const std::string name =
      settingsAt(file.where).strip_mesh_path ? fs::path(file.value).filename().string() : file.value;
  const std::string in_folder = (fs::path(folder) / name).string();
  LocatedFile found = locateFile(in_folder, main_folder);
  std::error_code ignored;
  for (const std::string& other_name : {name, in_folder}) {
    if (fs::is_regular_file(found.path, ignored)) break;
    if (LocatedFile next = locateFile(other_name, beside); fs::is_regular_file(next.path, ignored)) found = next;
  }
  return found;
}

void MjcfDocument::readSettings() {
  const auto massSetting = [&](const std::string& name) -> double* {
    return name == "settotalmass"   ? &settings_.total_mass
           : name == "boundmass"    ? &settings_.bound_mass
           : name == "boundinertia" ? &settings_.bound_inertia
                                    : nullptr;
  };
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
      } else if (attribute.name == "balanceinertia") {
        settings_.balance_inertia = flag(attribute);
      } else if (attribute.name == "fitaabb") {
        settings_.fit_bounds = flag(attribute);
      } else if (attribute.name == "inertiagrouprange") {
        const auto range = numbersIn(value);
        if (!range || range->size() != 2) refuse("two numbers");
        if (range && range->size() == 2)
          std::tie(settings_.first_mass_group, settings_.last_mass_group) =
              std::pair(int((*range)[0]), int((*range)[1]));
      } else if (double* number = massSetting(attribute.name)) {
        const auto numbers = numbersIn(value);
        if (!numbers || numbers->size() != 1) refuse("a number");
        if (numbers && numbers->size() == 1) *number = numbers->front();
      } else if (attribute.name == "inertiafromgeom") {
        settings_.masses_of_geoms = value != "false";
        settings_.masses_only_of_geoms = value == "true";
        if (value != "auto" && value != "false" && value != "true") refuse("auto, false or true");
      }
    }
  }
}

void MjcfDocument::collectClasses(const XmlElement& element, const Class* outer, bool attached) {
  const XmlAttribute* name = element.attribute("class");
  if (!name && outer) return findings_.error(element.where, "a <default> inside another has no attribute 'class'");
  const std::string key = name && (outer || attached) ? name->value : kOutermost;
  if (const auto known = classes_.find(key); known != classes_.end() && known->second.outer != outer)
    return findings_.error(name->where, cat("the default class '", key, "' already exists below another class"));
  Class& entry = classes_[key];
  entry.elements.push_back(&element);
  if (outer) entry.outer = outer;
  if (name && !outer && !attached && name->value != kOutermost) classes_[name->value].outer = &entry;  // an alias of it
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

}  // namespace kinegraph::inline parsers_internal
