#pragma once

#include <map>
#include <optional>
#include <string>

#include "kinegraph/parsers/mjcf/mjcf_document.h"
#include "kinegraph/parsers/mjcf/mjcf_mass.h"
#include "kinegraph/parsers/mjcf/mjcf_values.h"
#include "kinegraph/parsers/xml/findings.h"
#include "kinegraph/parsers/xml/frame_attributes.h"

namespace kinegraph::inline parsers_internal {

/// Converts geoms, sites and cameras of an MJCF file to frames.
class MjcfShapes {
 public:
  MjcfShapes(const MjcfDocument& document, MjcfValues& values, Findings& findings);

  struct Placed {
    Pose pose;  ///< in the body
    FrameAttributes attributes;
  };

  /// `contact` is the flag of the geom, 0 for one that collides with nothing; `with_mass` gives it a mass.
  Placed geom(const MjcfElement& element, int contact, bool with_mass);
  Placed site(const MjcfElement& element);
  Placed camera(const MjcfElement& element);

 private:
  /// Maps a vertex to scale * rotation * (vertex - origin).
  struct VertexMap {
    Quaterniond rotation;
    Vector3d origin, scale;
  };

  void addMesh(const MjcfElement& element, Placed& placed);
  void addHeightField(const MjcfElement& element, Placed& placed);
  void addInlineMesh(const MjcfElement& mesh, const VertexMap& map, Placed& placed);
  void addVertices(std::vector<double> points, std::vector<double> corners, const VertexMap& map, Placed& placed);
  void addPrimitive(const MjcfElement& element, const std::string& type, double line_length, Placed& placed);
  void addSized(const std::string& type, const std::vector<double>& size, Placed& placed);
  void addFitted(const MjcfElement& element, const std::string& type, Placed& placed);
  MeshMassMode massMode(const MjcfElement& mesh);
  std::optional<UniformMass> massOf(const MjcfElement& element, const Placed& placed);
  std::optional<Mesh> meshOf(const MjcfElement& element, const Placed& placed);
  void addMass(const MjcfElement& element, Placed& placed);
  void addLooks(const MjcfElement& element, int contact, Placed& placed);
  const MjcfElement* materialOf(const MjcfElement& element);
  const MjcfElement* textureOf(const MjcfElement& material);
  std::vector<double> color(const MjcfElement& element);
  void addTexture(const MjcfElement& element, Placed& placed);

  const MjcfDocument& document_;
  MjcfValues& values_;
  Findings& findings_;
  std::map<std::string, MjcfElement> meshes_, materials_, textures_, height_fields_;
};

}  // namespace kinegraph::inline parsers_internal
