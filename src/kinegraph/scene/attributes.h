#pragma once

#include <string>
#include <vector>

#include "kinegraph/gfile/value.h"
#include "kinegraph/scene/scene_tree.h"

namespace kinegraph {

/// The attributes of one frame, read with checks. Mistakes are collected, so that all of a file are reported together.
class AttributeReader {
 public:
  AttributeReader(const Graph& attributes, const std::string& folder, const std::string& frame_name,
                  const SourcePosition& where, std::vector<ParseError>& errors, std::vector<std::string>& warnings);

  /// Joint, pose, shape and inertia, in that order; `joint_keys` false leaves joint, pose and `pre`, `post` to others.
  void apply(FrameData& frame, bool joint_keys = true);

  std::optional<Joint> readJoint();
  std::optional<Pose> readPose(std::initializer_list<const char*> keys);

  /// Warns of attributes that look like misspelt ones.
  void checkSpelling();

 private:
  const Node* find(std::initializer_list<const char*> keys) const;
  void error(const Node& node, const std::string& message);
  std::optional<double> number(const Node& node);
  std::optional<std::vector<double>> numbers(const Node& node);
  std::optional<std::string> text(const Node& node);
  std::string path(const Node& node);
  void applyPose(FrameData& frame);
  void applyShape(FrameData& frame);
  std::shared_ptr<Geometry> readGeometry();
  void applyInertia(FrameData& frame);
  template <class Function>
  void guarded(const Node& node, Function function);

  const Graph& attributes_;
  std::string folder_, frame_name_;
  SourcePosition where_;
  std::vector<ParseError>& errors_;
  std::vector<std::string>& warnings_;
};

}  // namespace kinegraph
