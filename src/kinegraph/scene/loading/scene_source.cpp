#include "kinegraph/scene/loading/scene_source.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/file_paths.h"
#include "kinegraph/common/text.h"
#include "kinegraph/common/utf8.h"
#include "kinegraph/parsers/scene_formats.h"

namespace kinegraph::inline scene_internal {

namespace fs = std::filesystem;

namespace {

// Limits for all files of one scene together, against runaway includes.
constexpr std::size_t kMaxNesting = 50, kMaxFiles = 2000, kMaxBytes = std::size_t(64) << 20;

/// Returns why a file with an extension of meshes or of other programs is no scene, as the end of a sentence, or "".
std::string noSceneFile(const std::string& extension) {
  static const std::set<std::string> meshes{".obj", ".stl", ".dae", ".ply", ".glb", ".gltf", ".msh", ".off"};
  const char* const scenes = "scenes are .g, .urdf, .xacro and .xml (MJCF) files";
  if (meshes.contains(extension))
    return cat("is a mesh; ", scenes,
               ". A frame shows it by setMeshFile, or by the attribute mesh: <file> in a .g file");
  if (extension == ".sdf" || extension == ".world")
    return cat("is SDFormat, which is not read; ", scenes, ". Convert it to URDF");
  if (extension.starts_with(".usd")) return cat("is USD, which is not read; ", scenes, ". Convert it to MJCF or URDF");
  if (extension == ".mjb")
    return "is a compiled model of MuJoCo, which is not read; load the .xml file (MJCF) that it was made of";
  return "";
}

/// Reads scene files one after the other and applies their special keys.
class SourceReader {
 public:
  explicit SourceReader(SceneDiagnostics& diagnostics, XacroArguments arguments = {})
      : diagnostics_(diagnostics), arguments_(std::move(arguments)) {}

  std::vector<Node> joint_states;
  std::vector<RobotSemantics> semantics;
  std::vector<std::string> files;  ///< requested files in order, existing or not

  /// `given`: the path as the user wrote it. `included_at`: the position of the include, if any.
  std::vector<SourceFrame> readFile(const std::string& path, const std::string& given,
                                    const SourcePosition& included_at) {
    files.push_back(path);
    std::error_code error;
    const fs::path absolute = fs::absolute(path, error).lexically_normal();
    const auto refuse = [&](const std::string& message) {
      if (!included_at.known()) throw FileError(message);
      diagnostics_.error(included_at, message);
      return std::vector<SourceFrame>();
    };
    if (!fs::is_regular_file(absolute, error)) {
      return refuse(cat("scene file '", path, "' ", fs::exists(absolute, error) ? "is not a file" : "does not exist",
                        similarFilesHint(absolute.string()), shippedFilesHint(given)));
    }
    if (const std::string otherwise = noSceneFile(lowerExtension(path)); !otherwise.empty())
      return refuse(cat("'", path, "' ", otherwise));
    if (std::find(open_.begin(), open_.end(), absolute.string()) != open_.end())
      return refuse(cat("'", path, "' includes itself"));
    if (open_.size() == kMaxNesting) return refuse(cat("files are included deeper than ", kMaxNesting, " levels"));
    bytes_ += fs::file_size(absolute, error);
    if (files.size() > kMaxFiles || error || bytes_ > kMaxBytes) {
      return refuse(cat("the scene has grown beyond ", kMaxFiles, " files or ", kMaxBytes >> 20, " MB of text with '",
                        path, "'"));
    }
    std::ifstream stream(absolute, std::ios::binary);
    std::stringstream text;
    text << stream.rdbuf();
    if (!stream) return refuse(cat("scene file '", path, "' cannot be read"));
    open_.push_back(absolute.string());
    std::vector<SourceFrame> frames;
    if (lowerExtension(path) == ".xacro") {
      std::string expanded;
      try {
        expanded = expandXacro(absolute.string(), arguments_);
      } catch (const FileError& e) {
        open_.pop_back();
        return refuse(e.what());
      }
      frames =
          readText(expanded, path + " (expanded)", absolute.parent_path().string(), fs::path(path).stem().string());
    } else {
      frames = readText(text.str(), path, absolute.parent_path().string());
    }
    open_.pop_back();
    if (const std::string beside = semanticsBeside(absolute.string()); !beside.empty()) readBeside(beside, frames);
    return frames;
  }

  /// `name` stands for the file in messages; `file`, if given, is the name whose extension selects the format.
  std::vector<SourceFrame> readText(const std::string& bytes, const std::string& name, std::string folder,
                                    const std::string& file = {}) {
    std::size_t replaced = 0;
    const std::string text = validUtf8(toUtf8(bytes), &replaced);
    if (replaced > 0) {
      diagnostics_.warning({name, 1, 1}, cat("the text is not UTF-8; ", replaced,
                                             replaced == 1 ? " byte of it is" : " bytes of it are", " read as '?'"));
    }
    diagnostics_.addText(name, text);
    if (isSemanticsFile(file.empty() ? name : file)) {
      std::vector<Diagnostic> found;
      semantics.push_back(readSemantics(text, name, found));
      for (Diagnostic& diagnostic : found) diagnostics_.add(std::move(diagnostic));
      return {};
    }
    const SceneFormat* format = sceneFormatOf(file.empty() ? name : file);
    if (!format && !file.empty()) format = sceneFormatOf(".urdf");  // robot.xacro
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    if (!format && begin != std::string::npos &&
        (text.compare(begin, 5, "<?xml") == 0 || text.compare(begin, 6, "<robot") == 0 ||
         text.compare(begin, 7, "<mujoco") == 0)) {
      diagnostics_.error(
          {name, 1, 1},
          "the text is XML, not a .g scene; URDF files end in .urdf, MJCF files in .xml, SRDF files in .srdf");
      return {};
    }
    ParseResult parsed = format ? format->read(text, name, folder) : parseAll(text, name);
    for (SourceText& included : parsed.included) {
      files.push_back(included.file);
      diagnostics_.addText(included.file, std::move(included.text));
    }
    for (Diagnostic& diagnostic : parsed.diagnostics) diagnostics_.add(std::move(diagnostic));
    std::vector<SourceFrame> frames;
    std::vector<Node> edits;
    std::string prefix;
    scopes_.push_back(&frames);
    for (Node& node : parsed.graph.nodes) {
      if (node.key == "Include") {
        const std::size_t former = semantics.size();
        std::vector<SourceFrame> included = include(node, folder);
        if (!prefix.empty()) addPrefix(included, prefix);
        for (std::size_t i = former; i < semantics.size(); ++i) semantics[i].prefix = prefix + semantics[i].prefix;
        prefix.clear();
        std::move(included.begin(), included.end(), std::back_inserter(frames));
      } else if (node.key == "Prefix") {
        const std::string* text_value = node.value.as<std::string>();
        prefix = text_value ? *text_value : "";
      } else if (node.key == "ChDir") {
        if (const std::string* given = textOf(node, "a folder: 'ChDir: <folder/>'"))
          folder = resolvePath(*given, folder);
      } else if (isDeletion(node, "DeleteBranch") || isDeletion(node, "Delete")) {
        deleteFrames(node);
      } else if (isEdit(node)) {
        edits.push_back(std::move(node));
      } else if (node.key == "Quit" && !node.value.as<Graph>()) {
        diagnostics_.warning(node.where, "'Quit' has no effect; the rest of the file is read");
      } else if (node.key == "q" && (node.value.as<NumberArray>() || node.value.as<double>())) {
        joint_states.push_back(std::move(node));
      } else if (const Graph* attributes = node.value.as<Graph>()) {
        const bool nothing = attributes->nodes.empty() && node.key.empty() && node.parents.empty();
        if (nothing && node.where.str() == node.value.where.str()) continue;  // { } without a colon
        checkTags(node);
        node.key = prefix + node.key;
        frames.push_back({std::move(node), folder, prefix});
      } else {
        refuseEntry(node);
      }
    }
    for (const Node& edit : edits) applyEdit(edit);
    scopes_.pop_back();
    return frames;
  }

 private:
  /// Reads an SRDF file that was not requested; errors in it become warnings and do not reject the robot.
  void readBeside(const std::string& path, const std::vector<SourceFrame>& robot) {
    std::vector<Diagnostic> found;
    std::ifstream stream(path, std::ios::binary);
    std::stringstream bytes;
    std::error_code error;
    bytes_ += fs::file_size(path, error);
    if (error || bytes_ > kMaxBytes) return;
    files.push_back(path);
    bytes << stream.rdbuf();
    std::string text = validUtf8(toUtf8(bytes.str()), nullptr);
    RobotSemantics read = readSemantics(text, path, found);
    diagnostics_.addText(path, std::move(text));
    const bool failed = std::any_of(found.begin(), found.end(),
                                    [](const Diagnostic& d) { return d.severity == Diagnostic::Severity::error; });
    if (!failed) {
      read.requested = false;
      for (const SourceFrame& frame : robot) read.robot.push_back(frame.node.key);
      semantics.push_back(std::move(read));
    }
    for (Diagnostic& diagnostic : found) {
      if (!failed) diagnostics_.add(std::move(diagnostic));
      if (!failed || diagnostic.severity != Diagnostic::Severity::error) continue;
      diagnostics_.warning(diagnostic.where, "the SRDF file beside the robot's file is ignored: " + diagnostic.message);
      return;
    }
  }

  std::vector<SourceFrame> include(const Node& node, const std::string& folder) {
    const std::string* file = textOf(node, "a file: 'Include: <path>'");
    if (!file) return {};
    std::string path = resolvePath(*file, folder);
    std::error_code error;
    if (std::string shipped = fs::exists(path, error) ? "" : shippedFile(*file); !shipped.empty())
      path = std::move(shipped);
    if (!path.empty()) return readFile(path, *file, node.value.where);
    diagnostics_.error(node.value.where, missingPackageMessage(*file));
    return {};
  }

  /// Returns the text of a name, a string or <...>; reports an error for anything else.
  const std::string* textOf(const Node& node, const char* expected) {
    if (const AngleText* angle = node.value.as<AngleText>()) return &angle->text;
    if (const std::string* text = node.value.as<std::string>()) return text;
    diagnostics_.error(node.where, cat(node.key, " takes ", expected, ", not ", describe(node.value)));
    return nullptr;
  }

  void refuseEntry(const Node& node) {
    std::string hint = similarHint(node.key, {"Include", "Prefix", "Edit", "Delete", "DeleteBranch", "ChDir"});
    if (node.key.find(' ') != std::string::npos && hint.empty()) hint = "; is a line end or a comma missing?";
    if (!node.parents.empty()) {
      return diagnostics_.error(
          node.where, cat("'", node.key, " (", join(node.parents, " "), ")' has no attributes; write '", node.key, " (",
                          join(node.parents, " "), "): { ... }', the { on the same line"));
    }
    diagnostics_.error(node.where,
                       cat("'", node.key, "' is ", describe(node.value),
                           "; expected a frame 'name (parent): { ... }', q: [joint state], or Include, Prefix, "
                           "Edit, Delete",
                           hint));
  }

  /// Warns of tags such as `edit`, a misspelling of `Edit` that would silently create a frame.
  void checkTags(const Node& node) {
    static const std::set<std::string> tags = {"frame", "body", "shape", "joint"};
    static const std::vector<std::string> words = {"Edit", "Include", "Prefix", "Delete", "DeleteBranch"};
    for (const std::string& tag : node.tags) {
      if (tags.contains(tag)) continue;
      const auto meant = std::find_if(words.begin(), words.end(),
                                      [&](const std::string& word) { return editDistance(tag, word) < 1.2; });
      if (meant != words.end()) {
        diagnostics_.warning(node.where,
                             cat("'", tag, "' before a frame's name has no effect; did you mean '", *meant, "'?"));
      } else {
        diagnostics_.warning(node.where, cat("names contain no blanks: this is frame '", node.key, "' with the tag '",
                                             tag, "'; parents are in parentheses, as in ", tag, " (", node.key, ")"));
      }
    }
  }

  static bool isEdit(const Node& node) {
    return node.value.as<Graph>() &&
           ((!node.tags.empty() && node.tags.front() == "Edit") || (node.key == "Edit" && !node.parents.empty()));
  }

  /// `Delete: name`, or just `Delete name`.
  static bool isDeletion(const Node& node, const std::string& word) {
    if (node.value.as<Graph>()) return false;
    return node.key == word || (node.value.as<bool>() && node.key.starts_with(word + " "));
  }

  static void addPrefix(std::vector<SourceFrame>& frames, const std::string& prefix) {
    std::set<std::string> names;
    for (const SourceFrame& frame : frames) names.insert(frame.node.key);
    const auto rename = [&](std::string& name) {
      if (names.contains(name)) name = prefix + name;
    };
    for (SourceFrame& frame : frames) {
      frame.node.key = prefix + frame.node.key;
      frame.prefix = prefix + frame.prefix;
      for (std::string& parent : frame.node.parents) rename(parent);
      for (const char* key : {"mimic", "mimic_shape", "contact_exclude", "parent"}) {
        Node* reference = std::get_if<Graph>(&frame.node.value.data)->find(key);
        if (!reference) continue;
        if (auto* text = std::get_if<std::string>(&reference->value.data)) rename(*text);
        if (auto* list = std::get_if<StringArray>(&reference->value.data))
          std::for_each(list->begin(), list->end(), rename);
        if (auto* tuple = std::get_if<NameTuple>(&reference->value.data))
          std::for_each(tuple->names.begin(), tuple->names.end(), rename);
      }
    }
  }

  /// Removes the frames named by a deletion; DeleteBranch also removes all frames below them.
  void deleteFrames(const Node& node) {
    const bool branch = node.key.starts_with("DeleteBranch");
    std::string name;
    if (const std::size_t space = node.key.find(' '); space != std::string::npos) {
      name = node.key.substr(space + 1);
    } else if (const std::string* text = textOf(node, "the name of a frame: 'Delete: name'")) {
      name = *text;
    } else {
      return;
    }
    std::vector<SourceFrame>& frames = scopeOf(name);
    std::set<std::string> doomed = {name};
    for (bool grew = branch; grew;) {
      grew = false;
      for (const SourceFrame& frame : frames) {
        for (const std::string& parent : frame.node.parents) {
          if (doomed.contains(parent) && doomed.insert(frame.node.key).second) grew = true;
        }
      }
    }
    const auto known = names(frames);
    if (std::erase_if(frames, [&](const SourceFrame& frame) { return doomed.contains(frame.node.key); }) == 0) {
      diagnostics_.warning(node.where, cat(branch ? "DeleteBranch" : "Delete", ": no frame '", name,
                                           "' before this line", similarHint(name, known)));
    }
    for (SourceFrame& frame : frames) std::erase(frame.node.parents, name);
    deleted_.insert(name);
  }

  /// Returns the frames of the innermost file that contains the name, searching from the current file outwards through
  /// the including files.
  std::vector<SourceFrame>& scopeOf(const std::string& name) {
    for (auto scope = scopes_.rbegin(); scope != scopes_.rend(); ++scope) {
      for (const SourceFrame& frame : **scope) {
        if (frame.node.key == name) return **scope;
      }
    }
    return *scopes_.back();
  }

  static std::vector<std::string> names(const std::vector<SourceFrame>& frames) {
    std::vector<std::string> list;
    for (const SourceFrame& frame : frames) list.push_back(frame.node.key);
    return list;
  }

  /// Applies `Edit name (new parent): {}`, `Edit (name): {}` or `Edit (name new_parent): {}`.
  void applyEdit(const Node& edit) {
    std::vector<std::string> parents = edit.parents;
    std::string name = edit.key;
    if (edit.key == "Edit") {
      name = parents.front();
      parents.erase(parents.begin());
    }
    std::vector<SourceFrame>& frames = scopeOf(name);
    bool found = false;
    for (SourceFrame& frame : frames) {
      if (frame.node.key != name) continue;
      found = true;
      if (!parents.empty()) frame.node.parents = parents;
      for (const Node& attribute : edit.value.as<Graph>()->nodes)
        std::get_if<Graph>(&frame.node.value.data)->set(attribute);
    }
    if (!found && !deleted_.contains(name))
      diagnostics_.warning(edit.where, cat("Edit: no frame '", name, "'", similarHint(name, names(frames))));
  }

  SceneDiagnostics& diagnostics_;
  XacroArguments arguments_;
  std::vector<std::string> open_;                  ///< files being read
  std::vector<std::vector<SourceFrame>*> scopes_;  ///< the frames of each of them so far
  std::set<std::string> deleted_;                  ///< names removed by Delete: later edits of them are not reported
  std::size_t bytes_ = 0;
};

}  // namespace

SceneSource readSource(const std::string& path, SceneDiagnostics& diagnostics, const XacroArguments& arguments) {
  SourceReader reader(diagnostics, arguments);
  SceneSource source;
  source.frames = reader.readFile(resolvePath(path, ""), path, {});
  source.joint_states = std::move(reader.joint_states);
  source.semantics = std::move(reader.semantics);
  return source;
}

SceneSource readSource(std::string_view text, const std::string& name, const std::string& folder,
                       SceneDiagnostics& diagnostics) {
  SourceReader reader(diagnostics);
  SceneSource source;
  source.frames = reader.readText(std::string(text), name, folder.empty() ? fs::current_path().string() : folder);
  source.joint_states = std::move(reader.joint_states);
  source.semantics = std::move(reader.semantics);
  return source;
}

std::vector<std::string> sourceFiles(const std::string& path) {
  SceneDiagnostics diagnostics;
  SourceReader reader(diagnostics);
  try {
    reader.readFile(resolvePath(path, ""), path, {});
  } catch (const Error&) {  // reported by the caller that reads the scene
  }
  return std::move(reader.files);
}

}  // namespace kinegraph::inline scene_internal
