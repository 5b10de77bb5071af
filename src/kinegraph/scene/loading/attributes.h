#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/gfile/value.h"
#include "kinegraph/scene/tree/diagnostics.h"
#include "kinegraph/scene/tree/frame_data.h"

namespace kinegraph::inline scene_internal {

/// Returns "unknown attribute 'mas'; did you mean 'mass'?" for a word that the library does not read and that is a near
/// miss of one that it reads; otherwise "".
std::string askAboutAttribute(const Node& attribute);

/// Reads the attributes of one frame and checks them. Collects errors, to report all errors of a file together.
class AttributeReader {
 public:
  /// File names in the attributes are relative to `folder`.
  AttributeReader(const Graph& attributes, const std::string& folder, const std::string& frame_name,
                  SceneDiagnostics& diagnostics)
      : attributes_(attributes), folder_(folder), frame_name_(frame_name), diagnostics_(diagnostics) {}

  /// The joint, and the constant transforms before and behind it, if present.
  std::optional<Joint> readJoint();
  std::optional<Pose> readBefore() { return readPose({"pre", "A", "origin"}); }
  std::optional<Pose> readBehind();

  /// Sets joint and pose.
  void applyJoint(FrameData& frame);

  /// Sets shape and inertia, and warns of misspelled attributes.
  void applyBody(FrameData& frame);

  const Node* find(std::initializer_list<const char*> keys) const;
  std::optional<Pose> readPose(std::initializer_list<const char*> keys);

  /// Returns a name: a bare word, or one name in parentheses.
  std::optional<std::string> text(const Node& node);
  void error(const Node& node, const std::string& message);

 private:
  void warning(const Node& node, const std::string& message);
  std::optional<double> number(const Node& node);
  double numberOr(const char* key, double otherwise);
  std::optional<std::vector<double>> numbers(const Node& node);
  std::optional<Vector3d> vector3(const Node& node);
  static std::string bracketHint(const Node& node);
  static std::string pathText(const Node& node);
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
  void judgeInertia(const Node& node, Inertia& inertia, const Matrix3d& otherwise);
  void checkSpelling();
  template <class Function>
  bool guarded(const Node& node, Function function);

  const Graph& attributes_;
  const std::string& folder_;
  const std::string& frame_name_;
  SceneDiagnostics& diagnostics_;
};

/// Runs a function and reports its errors at `node`. Returns whether it succeeded.
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

}  // namespace kinegraph::inline scene_internal
