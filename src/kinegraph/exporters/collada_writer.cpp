#include <fstream>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/exporters/writers.h"
#include "kinegraph/geometry/shapes/tessellation.h"
#include "kinegraph/parsers/xml/xml.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

namespace {

/// Builds the four libraries of a COLLADA document; elements refer to each other by frame ids.
class Collada {
 public:
  explicit Collada(const SceneTree& scene) : scene_(scene) {
    for (const auto& frame : scene.frames()) {
      Mesh mesh = frame->shape ? tessellate(*frame->shape->geometry) : Mesh{};
      surfaces_.push_back(!mesh.triangles.empty());
      if (surfaces_.back()) addSurface(*frame, mesh);
    }
  }

  std::string text() const {
    std::string nodes;
    for (const auto& frame : scene_.frames()) {
      if (!frame->parent) nodes += node(*frame, "      ");
    }
    return cat(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
        "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n"
        "  <asset>\n    <contributor><authoring_tool>kinegraph</authoring_tool></contributor>\n"
        "    <created>2000-01-01T00:00:00Z</created><modified>2000-01-01T00:00:00Z</modified>\n"  // same scene, same
                                                                                                  // text
        "    <unit name=\"meter\" meter=\"1\"/>\n    <up_axis>Z_UP</up_axis>\n  </asset>\n"
        "  <library_effects>\n",
        effects_, "  </library_effects>\n  <library_materials>\n", materials_,
        "  </library_materials>\n  <library_geometries>\n", geometries_,
        "  </library_geometries>\n"
        "  <library_visual_scenes>\n    <visual_scene id=\"scene\" name=\"scene\">\n",
        nodes,
        "    </visual_scene>\n  </library_visual_scenes>\n  <scene><instance_visual_scene url=\"#scene\"/></scene>\n"
        "</COLLADA>\n");
  }

 private:
  void addSurface(const FrameData& frame, const Mesh& mesh) {
    const int id = frame.id;
    const Vector4d color = frame.shape->color.value_or(Vector4d(.8, .8, .8, 1.));
    effects_ +=
        cat("    <effect id=\"effect", id, "\"><profile_COMMON><technique sid=\"common\"><lambert><diffuse><color>",
            exact(color[0]), " ", exact(color[1]), " ", exact(color[2]), " ", exact(color[3]), "</color></diffuse>");
    if (color[3] < 1.) {
      effects_ += cat("<transparent opaque=\"A_ONE\"><color>1 1 1 1</color></transparent><transparency><float>",
                      exact(color[3]), "</float></transparency>");
    }
    effects_ += "</lambert></technique></profile_COMMON></effect>\n";
    materials_ += cat("    <material id=\"material", id, "\"><instance_effect url=\"#effect", id, "\"/></material>\n");
    std::string points, corners;
    for (const Vector3d& p : mesh.vertices) points += cat(exact(p[0]), " ", exact(p[1]), " ", exact(p[2]), " ");
    for (const auto& [a, b, c] : mesh.triangles) corners += cat(a, " ", b, " ", c, " ");
    const std::string name = cat("geometry", id);
    geometries_ +=
        cat("    <geometry id=\"", name, "\" name=\"", xmlEscaped(frame.name), "\"><mesh>\n      <source id=\"", name,
            "-points\"><float_array id=\"", name, "-array\" count=\"", 3 * mesh.vertices.size(), "\">", points,
            "</float_array>\n        <technique_common><accessor source=\"#", name, "-array\" count=\"",
            mesh.vertices.size(),
            "\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/>"
            "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source>\n      <vertices id=\"",
            name, "-vertices\"><input semantic=\"POSITION\" source=\"#", name,
            "-points\"/></vertices>\n"
            "      <triangles material=\"surface\" count=\"",
            mesh.triangles.size(), "\"><input semantic=\"VERTEX\" source=\"#", name, "-vertices\" offset=\"0\"/><p>",
            corners, "</p></triangles>\n    </mesh></geometry>\n");
  }

  std::string node(const FrameData& frame, const std::string& indent) const {
    const RigidTransform X = frame.relativePose().transform();
    std::string matrix;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) matrix += exact(X.R(row, column)) + " ";
      matrix += exact(X.p[row]) + " ";
    }
    std::string text = cat(indent, "<node id=\"frame", frame.id, "\" name=\"", xmlEscaped(frame.name), "\"><matrix>",
                           matrix, "0 0 0 1</matrix>\n");
    if (surfaces_[frame.id]) {
      text += cat(indent, "  <instance_geometry url=\"#geometry", frame.id,
                  "\"><bind_material><technique_common><instance_material symbol=\"surface\" target=\"#material",
                  frame.id, "\"/></technique_common></bind_material></instance_geometry>\n");
    }
    for (const FrameData* child : frame.children) text += node(*child, indent + "  ");
    return text + indent + "</node>\n";
  }

  const SceneTree& scene_;
  std::vector<bool> surfaces_;  ///< per frame
  std::string effects_, materials_, geometries_;
};

}  // namespace

std::string writeCollada(const Config& config) { return Collada(*config.scene()).text(); }

void saveCollada(const Config& config, const std::string& path) {
  std::ofstream stream(path, std::ios::binary);
  stream << writeCollada(config);
  stream.flush();
  if (!stream) throw FileError(cat("scene file '", path, "' cannot be written"));
}

}  // namespace kinegraph
