#include "kinegraph/scene/scene_source.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/gfile/parser.h"

namespace kinegraph {

namespace fs = std::filesystem;

namespace {

std::string environment(const std::string& name) {
  const char* value = std::getenv(name.c_str());
  return value ? value : "";
}

std::string expandEnvironment(const std::string& path) {
  std::string out;
  for (std::size_t i = 0; i < path.size();) {
    if (path[i] != '$') {
      out += path[i++];
      continue;
    }
    std::size_t end = i + 1;
    while (end < path.size() && (std::isalnum(static_cast<unsigned char>(path[end])) || path[end] == '_')) ++end;
    out += environment(path.substr(i + 1, end - i - 1));
    i = end;
  }
  return out;
}

std::string findInPackages(const std::string& rest) {
  for (const char* variable : {"KINEGRAPH_PACKAGE_PATH", "ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH"}) {
    std::stringstream folders(environment(variable));
    for (std::string folder; std::getline(folders, folder, ':');) {
      for (const fs::path& base : {fs::path(folder), fs::path(folder) / "share"}) {
        std::error_code error;
        if (!folder.empty() && fs::exists(base / rest, error)) return (base / rest).string();
      }
    }
  }
  return "";
}

/// Reads one file after the other into a SceneSource.
class SourceReader {
 public:
  explicit SourceReader(SceneSource& source) : source_(source) {}

  std::vector<SourceFrame> readFile(const std::string& path, const SourcePosition& included_at) {
    source_.files.push_back(path);
    const fs::path absolute = fs::absolute(path).lexically_normal();
    std::error_code error;
    if (!fs::is_regular_file(absolute, error)) {
      const std::string message = cat("scene file '", path, "' does not exist", similarFiles(absolute));
      if (included_at.known()) throw ParseError(included_at, withExcerpt(included_at, message));
      throw FileError(message);
    }
    if (std::find(open_.begin(), open_.end(), absolute.string()) != open_.end()) {
      throw ParseError(included_at, withExcerpt(included_at, cat("'", path, "' includes itself")));
    }
    std::ifstream stream(absolute, std::ios::binary);
    std::stringstream text;
    text << stream.rdbuf();
    if (!stream) throw FileError(cat("scene file '", path, "' cannot be read"));
    open_.push_back(absolute.string());
    auto frames = readText(text.str(), path, absolute.parent_path().string());
    open_.pop_back();
    return frames;
  }

  std::vector<SourceFrame> readText(const std::string& text, const std::string& name, std::string folder) {
    source_.texts[name] = text;
    const Graph graph = parse(text, name, &source_.warnings);
    std::vector<SourceFrame> frames;
    std::vector<Node> edits;
    std::string prefix;
    for (const Node& node : graph.nodes) {
      if (node.key == "Include") {
        std::vector<SourceFrame> included = readFile(resolvePath(fileName(node), folder), node.value.where);
        if (!prefix.empty()) addPrefix(included, prefix);
        prefix.clear();
        std::move(included.begin(), included.end(), std::back_inserter(frames));
      } else if (node.key == "Prefix") {
        const std::string* text_value = node.value.as<std::string>();
        prefix = text_value ? *text_value : "";
      } else if (node.key == "ChDir") {
        folder = resolvePath(fileName(node), folder);
      } else if (node.key == "Delete" && !node.value.as<Graph>()) {
        deleteFrames(frames, nameOf(node), node);
      } else if (node.key.starts_with("DeleteBranch")) {
        deleteBranch(frames, node);
      } else if (isEdit(node)) {
        edits.push_back(node);
      } else if (node.key == "Quit") {
        source_.warnings.push_back(cat(node.where.str(), ": 'Quit' has no effect; what follows is read"));
      } else if (node.key == "q" && (node.value.as<NumberArray>() || node.value.as<double>())) {
        source_.joint_states.push_back(node);
      } else if (node.value.as<Graph>()) {
        frames.push_back({node, folder});
        frames.back().node.key = prefix + node.key;
      } else {
        throw ParseError(node.where, withExcerpt(node.where, cat("'", node.key, "' is ", describe(node.value),
                                                                 "; at the top of a scene stand frames 'name: { ... }', q: [joint state], or Include, "
                                                                 "Prefix, Edit, Delete", similarHint(node.key, {"Include", "Prefix", "Edit", "Delete"}))));
      }
    }
    for (const Node& edit : edits) applyEdit(frames, edit);
    return frames;
  }

 private:
  std::string withExcerpt(const SourcePosition& where, const std::string& message) const {
    const auto text = source_.texts.find(where.file);
    return text == source_.texts.end() ? message : cat(message, "\n", excerpt(text->second, where));
  }

  [[noreturn]] void fail(const Node& node, const std::string& message) const {
    throw ParseError(node.where, withExcerpt(node.where, message));
  }

  static std::string similarFiles(const fs::path& path) {
    std::vector<std::string> names;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(path.parent_path(), error)) names.push_back(entry.path().filename().string());
    if (error) return cat("; there is no folder '", path.parent_path().string(), "'");
    return similarHint(path.filename().string(), names);
  }

  std::string fileName(const Node& node) const {
    if (const AngleText* angle = node.value.as<AngleText>()) return angle->text;
    if (const std::string* text = node.value.as<std::string>()) return *text;
    fail(node, cat(node.key, " takes a file: '", node.key, ": <path>', not ", describe(node.value)));
  }

  std::string nameOf(const Node& node) const {
    if (const std::string* text = node.value.as<std::string>()) return *text;
    fail(node, cat(node.key, " takes the name of a frame: '", node.key, ": name'"));
  }

  static bool isEdit(const Node& node) {
    return node.value.as<Graph>() && ((!node.tags.empty() && node.tags.front() == "Edit") || node.key == "Edit");
  }

  static void addPrefix(std::vector<SourceFrame>& frames, const std::string& prefix) {
    std::set<std::string> names;
    for (const SourceFrame& frame : frames) names.insert(frame.node.key);
    for (SourceFrame& frame : frames) {
      frame.node.key = prefix + frame.node.key;
      for (std::string& parent : frame.node.parents) {
        if (names.contains(parent)) parent = prefix + parent;
      }
      Graph& attributes = *std::get_if<Graph>(&frame.node.value.data);
      for (const char* key : {"mimic", "mimic_shape"}) {
        Node* reference = attributes.find(key);
        if (!reference) continue;
        if (auto* text = std::get_if<std::string>(&reference->value.data)) *text = prefix + *text;
        if (auto* tuple = std::get_if<NameTuple>(&reference->value.data)) {
          for (std::string& name : tuple->names) name = prefix + name;
        }
      }
    }
  }

  void deleteFrames(std::vector<SourceFrame>& frames, const std::string& name, const Node& node) {
    const auto removed = std::erase_if(frames, [&](const SourceFrame& frame) { return frame.node.key == name; });
    if (removed == 0) {
      source_.warnings.push_back(cat(node.where.str(), ": Delete: there is no frame '", name, "' up to here", similarHint(name, names(frames))));
    }
    for (SourceFrame& frame : frames) std::erase(frame.node.parents, name);
  }

  void deleteBranch(std::vector<SourceFrame>& frames, const Node& node) {
    const std::string top = node.key == "DeleteBranch" ? nameOf(node) : node.key.substr(std::string("DeleteBranch ").size());
    std::set<std::string> doomed = {top};
    for (bool grew = true; grew;) {
      grew = false;
      for (const SourceFrame& frame : frames) {
        for (const std::string& parent : frame.node.parents) {
          if (doomed.contains(parent) && doomed.insert(frame.node.key).second) grew = true;
        }
      }
    }
    if (std::erase_if(frames, [&](const SourceFrame& frame) { return doomed.contains(frame.node.key); }) == 0) {
      source_.warnings.push_back(cat(node.where.str(), ": DeleteBranch: there is no frame '", top, "' up to here"));
    }
  }

  static std::vector<std::string> names(const std::vector<SourceFrame>& frames) {
    std::vector<std::string> list;
    for (const SourceFrame& frame : frames) list.push_back(frame.node.key);
    return list;
  }

  void applyEdit(std::vector<SourceFrame>& frames, const Node& edit) {
    const bool named_in_parentheses = edit.key == "Edit";
    if (named_in_parentheses && edit.parents.size() != 1) fail(edit, "Edit takes the name of one frame: Edit name: { ... }");
    const std::string name = named_in_parentheses ? edit.parents.front() : edit.key;
    bool found = false;
    for (SourceFrame& frame : frames) {
      if (frame.node.key != name) continue;
      found = true;
      if (!named_in_parentheses && !edit.parents.empty()) frame.node.parents = edit.parents;
      for (const Node& attribute : edit.value.as<Graph>()->nodes) std::get_if<Graph>(&frame.node.value.data)->set(attribute);
    }
    if (!found) {
      source_.warnings.push_back(cat(edit.where.str(), ": Edit: there is no frame '", name, "'", similarHint(name, names(frames))));
    }
  }

  SceneSource& source_;
  std::vector<std::string> open_;  ///< files that are being read
};

}  // namespace

std::string resolvePath(const std::string& path, const std::string& folder) {
  const std::string package = "package://";
  if (path.starts_with(package)) return findInPackages(path.substr(package.size()));
  const fs::path expanded = expandEnvironment(path);
  return expanded.is_absolute() ? expanded.lexically_normal().string() : (fs::path(folder) / expanded).lexically_normal().string();
}

SceneSource readSource(const std::string& path) {
  SceneSource source;
  source.frames = SourceReader(source).readFile(expandEnvironment(path), {});
  return source;
}

std::vector<std::string> sourceFiles(const std::string& path) {
  SceneSource source;
  try {
    SourceReader(source).readFile(expandEnvironment(path), {});
  } catch (const Error&) {  // told by who reads the scene itself
  }
  return source.files;
}

SceneSource readSource(std::string_view text, const std::string& name, const std::string& folder) {
  SceneSource source;
  const std::string base = folder.empty() ? fs::current_path().string() : folder;
  source.frames = SourceReader(source).readText(std::string(text), name, base);
  return source;
}

}  // namespace kinegraph
