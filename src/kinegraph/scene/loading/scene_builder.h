#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/loading/attributes.h"
#include "kinegraph/scene/loading/scene_source.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline scene_internal {

/// Creates the frames of a SceneSource in five passes: frames, parents, attributes, joints between two frames, and
/// references to other frames by name.
class SceneBuilder {
 public:
  /// `orphans`: a frame whose parent is unknown has no parent, and a warning, instead of an error.
  SceneBuilder(SceneTree& scene, SceneDiagnostics& diagnostics, bool orphans = false)
      : scene_(scene), diagnostics_(diagnostics), orphans_(orphans) {}

  /// Adds all frames of a source to an empty scene.
  void build(SceneSource& source);

  /// Applies attributes to a frame that already exists.
  void interpretExisting(FrameData& frame, const SourceFrame& source);

 private:
  static bool isTuple(const SourceFrame& source) { return source.node.parents.size() == 2; }
  static const Graph& attributes(const SourceFrame& source) { return *source.node.value.as<Graph>(); }
  AttributeReader reader(const FrameData& frame, const SourceFrame& source) {
    return {attributes(source), source.folder, frame.name, diagnostics_};
  }

  void addFrame(SourceFrame& source);
  FrameData* find(const std::string& name, const std::string& prefix, const SourcePosition& where,
                  const std::string& role, bool last = false);
  void linkToParent(FrameData& frame, const SourceFrame& source, int place);
  FrameData* findParent(const std::string& name, const FrameData& frame, const SourceFrame& source,
                        const SourcePosition& where, int place);
  bool link(FrameData& frame, FrameData& parent, const SourcePosition& where);
  FrameData& addOrigin(FrameData& joint_frame, const Pose& before);
  void interpret(FrameData& frame, const SourceFrame& source);
  void insertJoint(FrameData& frame, const SourceFrame& source);
  void keepWorldPose(FrameData& frame, const SourceFrame& source);
  void resolveMimicShape(FrameData& frame, const SourceFrame& source);
  void resolveContactExclude(FrameData& frame, const SourceFrame& source);
  void resolveMimic(FrameData& frame, const SourceFrame& source);
  void setJointState(const Node& node);

  SceneTree& scene_;
  SceneDiagnostics& diagnostics_;
  bool orphans_ = false;
  std::vector<FrameData*> frames_;  ///< one per source frame
};

}  // namespace kinegraph::inline scene_internal
