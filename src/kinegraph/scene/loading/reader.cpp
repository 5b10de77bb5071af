#include "kinegraph/scene/loading/reader.h"

#include "kinegraph/common/errors.h"
#include "kinegraph/gfile/parser.h"
#include "kinegraph/scene/loading/robot_semantics.h"
#include "kinegraph/scene/loading/scene_builder.h"
#include "kinegraph/scene/loading/scene_source.h"

namespace kinegraph::inline scene_internal {

namespace {

/// Builds the scene, unless the grammar has errors: they would cause spurious further errors.
void build(SceneSource source, SceneTree& scene, SceneDiagnostics& diagnostics, std::vector<std::string>& warnings,
           const FileOptions& options) {
  diagnostics.throwErrors();
  SceneBuilder(scene, diagnostics, options.orphans).build(source);
  diagnostics.throwErrors(options.strict);
  for (std::string& warning : diagnostics.warnings()) warnings.push_back(std::move(warning));
}

}  // namespace

void readSceneFile(const std::string& path, SceneTree& scene, std::vector<std::string>& warnings,
                   const FileOptions& options) {
  SceneDiagnostics diagnostics;
  build(readSource(path, diagnostics, options.xacro), scene, diagnostics, warnings, options);
}

void readSceneText(std::string_view text, const std::string& name, const std::string& folder, SceneTree& scene,
                   std::vector<std::string>& warnings, bool strict) {
  SceneDiagnostics diagnostics;
  FileOptions options;
  options.strict = strict;
  build(readSource(text, name, folder, diagnostics), scene, diagnostics, warnings, options);
}

void readSemanticsFile(const std::string& path, const std::string& prefix, SceneTree& scene,
                       std::vector<std::string>& warnings, const FileOptions& options) {
  SceneDiagnostics diagnostics;
  SceneSource source = readSource(path, diagnostics, options.xacro);
  diagnostics.throwErrors();
  for (RobotSemantics& semantics : source.semantics) {
    semantics.prefix = prefix;
    if (options.strict) {
      SceneTree trial;
      trial.append(scene, "");
      applySemantics(semantics, trial, diagnostics);
      diagnostics.throwErrors(true);
    }
    applySemantics(semantics, scene, diagnostics);
  }
  diagnostics.throwErrors();
  for (std::string& warning : diagnostics.warnings()) warnings.push_back(std::move(warning));
}

SceneCheck checkSceneFile(const std::string& path) {
  SceneDiagnostics diagnostics;
  SceneTree scene;
  SceneSource source = readSource(path, diagnostics);
  if (!diagnostics.failed()) SceneBuilder(scene, diagnostics).build(source);
  using Severity = Diagnostic::Severity;
  return {diagnostics.report(), diagnostics.count(Severity::error), diagnostics.count(Severity::warning),
          int(scene.frames().size())};
}

void readAttributes(std::string_view text, const std::string& folder, FrameData& frame,
                    std::vector<std::string>& warnings) {
  SceneDiagnostics diagnostics;
  SourceFrame source{{}, folder, ""};
  const std::string name = "attributes of '" + frame.name + "'";
  diagnostics.addText(name, std::string(text));
  ParseResult parsed = parseAll(text, name);
  for (Diagnostic& diagnostic : parsed.diagnostics) diagnostics.add(std::move(diagnostic));
  diagnostics.throwErrors();
  source.node.key = frame.name;
  source.node.value.data = std::move(parsed.graph);
  SceneTree& scene = *frame.tree;
  const std::size_t former_count = scene.frames().size();
  FrameData* const parent = frame.parent;
  SceneBuilder(scene, diagnostics).interpretExisting(frame, source);
  scene.structureChanged();
  if (diagnostics.failed()) {
    if (parent && frame.parent != parent) scene.link(frame, *parent);
    while (scene.frames().size() > former_count) scene.remove(*scene.frames().back());
  }
  diagnostics.throwErrors();
  for (std::string& warning : diagnostics.warnings()) warnings.push_back(std::move(warning));
}

}  // namespace kinegraph::inline scene_internal
