#include "kinegraph/exporters/mjcf_geoms.h"

#include <algorithm>
#include <filesystem>

#include "kinegraph/common/file_paths.h"
#include "kinegraph/common/text.h"
#include "kinegraph/exporters/stl_writer.h"
#include "kinegraph/geometry/shapes/shape_types.h"
#include "kinegraph/geometry/shapes/tessellation.h"
#include "kinegraph/parsers/xml/xml.h"

namespace kinegraph::inline exporters_internal {

namespace fs = std::filesystem;

namespace {

constexpr double kThin = 1e-3;                    // m, half the thickness of a moving quad
constexpr std::size_t kMaxStlTriangles = 200000;  // MuJoCo's limit

/// Returns whether MuJoCo reads the file itself. STL counts as unreadable because MuJoCo reads only its binary form.
bool readableByMujoco(const std::string& path) {
  const std::string extension = lowerExtension(path);
  return extension == ".obj" || extension == ".msh";
}

}  // namespace

std::string mjcfNumbers(const std::vector<double>& numbers) {
  std::vector<std::string> texts;
  for (const double x : numbers) texts.push_back(exact(x));
  return join(texts, " ");
}

std::string mjcfVector(const Vector3d& v) { return mjcfNumbers({v[0], v[1], v[2]}); }

std::string mjcfPose(const Pose& pose) {
  std::string text;
  if (!pose.p.isZero(0.)) text += cat(" pos=\"", mjcfVector(pose.p), "\"");
  if (!pose.q.vec().isZero(0.))
    text += cat(" quat=\"", mjcfNumbers({pose.q.w(), pose.q.x(), pose.q.y(), pose.q.z()}), "\"");
  return text;
}

std::string MjcfGeoms::geom(const FrameData& frame, const std::string& name, const Pose& pose, bool moves) {
  const Shape& shape = *frame.shape;
  std::string form = primitive(*shape.geometry, moves);
  if (form.empty()) form = mesh(frame);
  if (form.empty()) return "";
  std::string text = cat("<geom name=\"", xmlEscaped(name), "\" ", form, mjcfPose(pose));
  if (shape.color) {
    const Vector4d c = shape.color->cwiseMax(0.).cwiseMin(1.);
    text += cat(" rgba=\"", mjcfNumbers({c[0], c[1], c[2], c[3]}), "\"");
  }
  const Node* node = frame.attributes->find("friction");
  if (const double* friction = node ? node->value.as<double>() : nullptr; options_.motors && friction)
    text += cat(" friction=\"", exact(*friction), " 0.005 0.0001\"");
  if (shape.contact == 0) text += " contype=\"0\" conaffinity=\"0\"";
  return text + "/>";
}

std::string MjcfGeoms::primitive(const Geometry& geometry, bool moves) const {
  const std::vector<double>& s = geometry.size;
  if (std::any_of(s.begin(), s.end(), [](double x) { return !(x > 0.); }) && geometry.type != ShapeType::ssBoxElip &&
      geometry.type != ShapeType::ssBox && geometry.type != ShapeType::ssCylinder) {
    return "";
  }
  const auto element = [](const char* type, std::vector<double> size) {
    return cat("type=\"", type, "\" size=\"", mjcfNumbers(size), "\"");
  };
  switch (geometry.type) {
    case ShapeType::box:
    case ShapeType::ssBox:
      return element("box", {.5 * s[0], .5 * s[1], .5 * s[2]});
    case ShapeType::sphere:
      return element("sphere", {s[0]});
    case ShapeType::capsule:
      return element("capsule", {s[1], .5 * s[0]});
    case ShapeType::cylinder:
    case ShapeType::ssCylinder:
      return element("cylinder", {s[1], .5 * s[0]});
    case ShapeType::ssBoxElip:
      if (s[0] != 0. || s[1] != 0. || s[2] != 0. || s[6] != 0.) return "";
      return element("ellipsoid", {s[3], s[4], s[5]});
    case ShapeType::plane:
      return moves ? "" : element("plane", {.5 * s[0], .5 * s[1], 1.});
    case ShapeType::quad:
      return moves ? element("box", {.5 * s[0], .5 * s[1], kThin}) : element("plane", {.5 * s[0], .5 * s[1], 1.});
    default:
      return "";
  }
}

std::string MjcfGeoms::mesh(const FrameData& frame) {
  const Geometry* geometry = frame.shape->geometry.get();
  if (const auto known = names_.find(geometry); known != names_.end())
    return cat("type=\"mesh\" mesh=\"", xmlEscaped(known->second), "\"");
  std::string name = geometry->mesh_file.empty() ? frame.name : fs::path(geometry->mesh_file).stem().string();
  if (name.empty()) name = "mesh";
  const std::string stem = name;
  for (int i = 2; !taken_.insert(name).second; ++i) name = cat(stem, "_", i);
  const std::string source = meshSource(frame);
  if (source.empty()) return "";
  assets_ += cat("    <mesh name=\"", xmlEscaped(name), "\" ", source, " inertia=\"shell\"/>\n");
  names_[geometry] = name;
  return cat("type=\"mesh\" mesh=\"", xmlEscaped(name), "\"");
}

/// The attributes of a <mesh>: a file, or inline numbers.
std::string MjcfGeoms::meshSource(const FrameData& frame) {
  const Geometry& geometry = *frame.shape->geometry;
  if (!geometry.mesh_file.empty() && readableByMujoco(geometry.mesh_file)) {
    const Vector3d& s = geometry.mesh_scale;
    return cat("file=\"", xmlEscaped(geometry.mesh_file), "\"",
               s == Vector3d::Ones() ? "" : cat(" scale=\"", mjcfVector(s), "\""));
  }
  const Mesh surface = tessellate(geometry);
  if (surface.triangles.empty() || surface.vertices.size() < 4) {
    if (warnings_) {
      warnings_->push_back(
          cat("the ", shapeTypeName(geometry.type), " of frame '", frame.name, "' is omitted: MJCF has no such shape"));
    }
    return "";
  }
  if (!options_.mesh_folder.empty() && surface.triangles.size() <= kMaxStlTriangles) {
    fs::create_directories(options_.mesh_folder);
    const fs::path path = fs::absolute(options_.mesh_folder) / cat(frame.id, ".stl");
    writeStl(surface, path.string());
    return cat("file=\"", xmlEscaped(path.string()), "\"");
  }
  std::vector<double> vertices, faces;
  for (const Vector3d& p : surface.vertices) vertices.insert(vertices.end(), p.begin(), p.end());
  for (const auto& face : surface.triangles) faces.insert(faces.end(), face.begin(), face.end());
  return cat("vertex=\"", mjcfNumbers(vertices), "\" face=\"", mjcfNumbers(faces), "\"");
}

}  // namespace kinegraph::inline exporters_internal
