#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/gfile/value.h"
#include "kinegraph/scene/tree/diagnostics.h"
#include "kinegraph/scene/tree/frame_data.h"

namespace kinegraph {

/// The attributes of one frame, read with checks. Mistakes are collected, so that all of a file are reported together.
class AttributeReader {
 public:
  /// `folder` is where the files that the attributes name are.
  AttributeReader(const Graph& attributes, const std::string& folder, const std::string& frame_name,
                  SceneDiagnostics& diagnostics)
      : attributes_(attributes), folder_(folder), frame_name_(frame_name), diagnostics_(diagnostics) {}

  /// What moves the frame: the joint, and the constant transforms before and behind it, where given.
  std::optional<Joint> readJoint();
  std::optional<Pose> readBefore() { return readPose({"pre", "A", "origin"}); }
  std::optional<Pose> readBehind();

  /// Sets joint and pose.
  void applyJoint(FrameData& frame);

  /// Sets shape and inertia, and warns of attributes that look misspelt.
  void applyBody(FrameData& frame);

  const Node* find(std::initializer_list<const char*> keys) const;
  std::optional<Pose> readPose(std::initializer_list<const char*> keys);

  /// A word, or one name in parentheses.
  std::optional<std::string> text(const Node& node);
  void error(const Node& node, const std::string& message);

 private:
  void warning(const Node& node, const std::string& message);
  std::optional<double> number(const Node& node);
  double numberOr(const char* key, double otherwise);
  std::optional<std::vector<double>> numbers(const Node& node);
  std::optional<Vector3d> vector3(const Node& node);
  static std::string severalHint(const Node& node);
  static std::string givenPath(const Node& node);
  std::string path(const Node& node);  ///< absolute; throws FileError for a package that is not installed
  void applyPose(FrameData& frame);
  void readLimits(Joint& joint);
  void readDofs(Joint& joint);
  std::optional<VectorXd> readDofValues(const char* key, const Joint& joint);
  void applyInertia(FrameData& frame);
  void applyShape(FrameData& frame);
  void applyTexture(Shape& shape);
  bool readGeometry(Geometry& geometry);
  bool readShapeType(Geometry& geometry);
  bool readMesh(Geometry& geometry);
  bool readCore(Geometry& geometry);
  bool readRope(Geometry& geometry);
  bool readVertices(Geometry& geometry);
  bool readGrid(Geometry& geometry);
  bool readGridOf(const Node& file, Geometry& geometry);
  bool readSize(Geometry& geometry);
  void checkSpelling();
  template <class Function>
  bool guarded(const Node& node, Function function);

  const Graph& attributes_;
  const std::string& folder_;
  const std::string& frame_name_;
  SceneDiagnostics& diagnostics_;
};

/// Runs a function whose errors belong to an attribute. Returns whether there was none.
template <class Function>
bool AttributeReader::guarded(const Node& node, Function function) {
  try {
    function();
    return true;
  } catch (const ParseError& e) {
    error(node, e.reason());
  } catch (const Error& e) {
    error(node, e.what());
  }
  return false;
}

}  // namespace kinegraph
