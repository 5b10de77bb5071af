#include "kinegraph/parsers/mjcf/mjcf_shapes.h"

#include <algorithm>
#include <filesystem>

#include "kinegraph/common/file_paths.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/files/mesh_cache.h"
#include "kinegraph/geometry/shapes/scale_mesh.h"
#include "kinegraph/parsers/mjcf/mjcf_dynamics.h"
#include "kinegraph/parsers/mjcf/mjcf_height_field.h"

namespace kinegraph::inline parsers_internal {

namespace fs = std::filesystem;

namespace {

constexpr double kEndlessPlane = 20.;  // m, full width of an infinite plane
constexpr int kFirstHiddenGroup = 3;   // MuJoCo's viewer hides groups from here on
constexpr double kMarkerLength = .05;  // m

std::vector<std::string> namesIn(const std::map<std::string, MjcfElement>& assets) {
  std::vector<std::string> names;
  for (const auto& [name, element] : assets) names.push_back(name);
  return names;
}

}  // namespace

MjcfShapes::MjcfShapes(const MjcfDocument& document, MjcfValues& values, Findings& findings)
    : document_(document), values_(values), findings_(findings) {
  for (const XmlElement* xml : document_.inSections("asset", "mesh")) {
    const MjcfElement mesh = document_.element(*xml);
    const XmlAttribute* file = mesh.own("file");
    const std::string name = mesh.name().empty() && file ? fs::path(file->value).stem().string() : mesh.name();
    const auto [other, is_new] = meshes_.emplace(name, mesh);
    if (!is_new)
      findings_.warn(xml->where, cat("mesh '", name, "' is already defined at ", other->second.where().str(),
                                     "; this definition is ignored"));
  }
  for (const XmlElement* xml : document_.inSections("asset", "hfield")) {
    const MjcfElement field = document_.element(*xml);
    const XmlAttribute* file = field.own("file");
    height_fields_.emplace(field.name().empty() && file ? fs::path(file->value).stem().string() : field.name(), field);
  }
  for (const XmlElement* xml : document_.inSections("asset", "texture")) {
    const MjcfElement texture = document_.element(*xml);
    const XmlAttribute* file = texture.own("file");
    textures_.emplace(texture.name().empty() && file ? fs::path(file->value).stem().string() : texture.name(), texture);
  }
  for (const XmlElement* xml : document_.inSections("asset", "material"))
    materials_.emplace(document_.element(*xml).name(), document_.element(*xml));
}

MjcfShapes::Placed MjcfShapes::geom(const MjcfElement& element, int contact, bool with_mass) {
  static const std::vector<std::string> types = {"plane",    "hfield", "sphere", "capsule", "ellipsoid",
                                                 "cylinder", "box",    "mesh",   "sdf"};
  Placed placed{values_.pose(element), FrameAttributes(element.where())};
  const std::string type = values_.keyword(element, "type", types, "sphere");
  const auto line = element.attribute("fromto") ? values_.line(element) : std::nullopt;
  if (line) placed.pose = line->first;
  if (type == "hfield") {
    addHeightField(element, placed);
  } else if (type == "mesh" || type == "sdf") {
    addMesh(element, placed);
  } else if (element.attribute("mesh")) {
    addFitted(element, type, placed);
  } else {
    addPrimitive(element, type, line ? line->second : 0., placed);
  }
  const MjcfSettings& settings = document_.settingsAt(element.where());
  const double group = values_.number(element, "group", 0.);
  if (with_mass && type != "plane" && type != "hfield" && group >= settings.first_mass_group &&
      group <= settings.last_mass_group)
    addMass(element, placed);
  if (placed.attributes.find("shape") || placed.attributes.find("mesh")) addLooks(element, contact, placed);
  return placed;
}

void MjcfShapes::addPrimitive(const MjcfElement& element, const std::string& type, double line_length, Placed& placed) {
  std::vector<double> size = values_.upTo(element, "size", 3);
  const std::size_t given = size.size(), radial = type == "box" || type == "ellipsoid" ? 2 : 1;
  std::size_t needed = type == "sphere" ? 1 : type == "plane" || radial == 1 ? 2 : 3;
  if (line_length > 0.) {  // `size` gives only the thickness
    needed = 1;
    size.resize(3);
    if (radial == 2) size[1] = size[0];
    size[radial] = .5 * line_length;
  }
  if (given < needed) {
    const SourcePosition where = given > 0 ? element.attribute("size")->where : element.where();
    return findings_.error(where, cat(element.describe(), ": a ", type, " has a size of ", needed,
                                      needed == 1 ? " number, got " : " numbers, got ", given));
  }
  const bool endless = type == "plane";
  for (std::size_t i = 0; i < needed; ++i) {
    if (size[i] > 0. || (endless && size[i] == 0.)) continue;
    return findings_.error(element.attribute("size")->where,
                           cat(element.describe(), ": a size of ", size[i], " m; expected a positive number"));
  }
  addSized(type, size, placed);
}

/// Adds the shape with MuJoCo's sizes, which are half of ours.
void MjcfShapes::addSized(const std::string& type, const std::vector<double>& size, Placed& placed) {
  const auto add = [&](const char* shape, std::vector<double> full) {
    placed.attributes.add("shape", std::string(shape));
    placed.attributes.addNumbers("size", std::move(full));
  };
  if (type == "plane") {
    const auto width = [](double half) { return half > 0. ? 2. * half : kEndlessPlane; };
    add("plane", {width(size[0]), width(size[1])});
  } else if (type == "sphere") {
    add("sphere", {size[0]});
  } else if (type == "ellipsoid") {
    add("ssBoxElip", {0., 0., 0., size[0], size[1], size[2], 0.});
  } else if (type == "box") {
    add("box", {2. * size[0], 2. * size[1], 2. * size[2]});
  } else {
    add(type.c_str(), {2. * size[1], size[0]});
  }
}

void MjcfShapes::addMesh(const MjcfElement& element, Placed& placed) {
  const XmlAttribute* reference = element.attribute("mesh");
  if (!reference) return findings_.error(element.where(), cat(element.describe(), " has no attribute 'mesh'"));
  const auto found = meshes_.find(reference->value);
  if (found == meshes_.end()) {
    return findings_.warn(reference->where,
                          cat(element.describe(), ": there is no mesh '", reference->value,
                              "' in <asset>; the geom has no shape", similarHint(reference->value, namesIn(meshes_))));
  }
  const MjcfElement& mesh = found->second;
  const XmlAttribute* file = mesh.own("file");
  const Vector3d scale = values_.vector(mesh, "scale", Vector3d::Ones());
  const Vector3d moved = values_.vector(mesh, "refpos", Vector3d::Zero());
  const std::vector<double> rotated = values_.numbers(mesh, "refquat", 4);
  Quaterniond back = Quaterniond::Identity();
  if (!rotated.empty()) back = Quaterniond(rotated[0], rotated[1], rotated[2], rotated[3]).normalized().conjugate();
  if (!back.coeffs().allFinite()) back = Quaterniond::Identity();
  const bool is_sheared = !rotated.empty() && scale != Vector3d::Constant(scale[0]);
  const VertexMap map{is_sheared ? back : Quaterniond::Identity(), is_sheared ? moved : Vector3d::Zero(), scale};
  if (!is_sheared) placed.pose = placed.pose * Pose(back * Vector3d(-scale.cwiseProduct(moved)), back);
  if (!file) return addInlineMesh(mesh, map, placed);
  const LocatedFile found_file = document_.locateAsset(*file, document_.settingsAt(file->where).mesh_folder);
  const std::string& path = found_file.path;
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) {
    return findings_.warn(file->where,
                          cat("mesh '", file->value, "' does not exist (", path, ")", similarFilesHint(path)));
  }
  std::shared_ptr<const Mesh> content;
  try {
    content = sharedMeshFile(path);
  } catch (const FileError& e) {
    return findings_.warn(file->where, cat(e.what(), "; its geoms have no shape"));
  }
  if (!found_file.assumption.empty())
    findings_.warn(file->where, cat("mesh '", file->value, "': ", found_file.assumption));
  if (is_sheared) {
    std::vector<double> points, corners;
    for (const Vector3d& vertex : content->vertices) points.insert(points.end(), vertex.begin(), vertex.end());
    for (const auto& triangle : content->triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
    return addVertices(std::move(points), std::move(corners), map, placed);
  }
  placed.attributes.add("mesh", AngleText{path});
  if (scale != Vector3d::Ones()) placed.attributes.addNumbers("meshscale", {scale.begin(), scale.end()});
}

/// A primitive geom with a mesh: the primitive of the mesh's inertia, or of its bounding box (`fitaabb`).
void MjcfShapes::addFitted(const MjcfElement& element, const std::string& type, Placed& placed) {
  Placed whole{placed.pose, FrameAttributes(element.where())};
  addMesh(element, whole);
  const std::optional<Mesh> mesh = whole.attributes.empty() ? std::nullopt : meshOf(element, whole);
  const auto solid = mesh ? uniformMass(*mesh, massMode(meshes_.at(element.attribute("mesh")->value))) : std::nullopt;
  if (!solid) {  // without a mesh or a volume
    placed = std::move(whole);
    return;
  }
  const bool to_bounds = document_.settingsAt(element.where()).fit_bounds;
  const FittedBox box = fitBox(*mesh, *solid, to_bounds);
  const Vector3d h = values_.number(element, "fitscale", 1.) * box.half_sides;
  const double radius = to_bounds ? std::max(h[0], h[1]) : .5 * (h[0] + h[1]);
  placed.pose = whole.pose * box.pose;
  if (type == "sphere") {
    addSized(type, {to_bounds ? h.maxCoeff() : h.mean()}, placed);
  } else if (type == "capsule") {
    addSized(type, {radius, std::max(h[2] - (to_bounds ? radius : .5 * radius), 0.)}, placed);
  } else if (type == "cylinder") {
    addSized(type, {radius, h[2]}, placed);
  } else {
    addSized(type, {h[0], h[1], h[2]}, placed);
  }
}

void MjcfShapes::addHeightField(const MjcfElement& element, Placed& placed) {
  const XmlAttribute* reference = element.attribute("hfield");
  const auto found = reference ? height_fields_.find(reference->value) : height_fields_.end();
  if (found == height_fields_.end()) {
    return findings_.warn(reference ? reference->where : element.where(),
                          cat(element.describe(), ": there is no height field '", reference ? reference->value : "",
                              "' in <asset>; the geom has no shape"));
  }
  std::optional<HeightFieldMesh> mesh = readHeightField(found->second, document_, values_, findings_);
  if (!mesh) return;
  placed.attributes.add("shape", std::string("mesh"));
  placed.attributes.addNumbers("vertices", std::move(mesh->vertices));
  placed.attributes.addNumbers("triangles", std::move(mesh->triangles));
  placed.attributes.addNumbers("mesh_parts", std::move(mesh->parts));
}

/// Adds the vertices and triangles of a mesh, or the hull of its vertices if it has no triangles.
void MjcfShapes::addVertices(std::vector<double> points, std::vector<double> corners, const VertexMap& map,
                             Placed& placed) {
  for (std::size_t i = 0; i + 2 < points.size(); i += 3) {
    Eigen::Map<Vector3d> vertex(&points[i]);
    vertex = map.scale.cwiseProduct(map.rotation * (vertex - map.origin)).eval();
  }
  if (map.scale.prod() < 0.) {  // stays outside out
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) std::swap(corners[i + 1], corners[i + 2]);
  }
  placed.attributes.add("shape", std::string(corners.empty() ? "ssCvx" : "mesh"));
  placed.attributes.addNumbers(corners.empty() ? "core" : "vertices", std::move(points));
  if (corners.empty()) placed.attributes.addNumbers("size", {0.});
  if (!corners.empty()) placed.attributes.addNumbers("triangles", std::move(corners));
}

/// Reads a mesh with inline numbers.
void MjcfShapes::addInlineMesh(const MjcfElement& mesh, const VertexMap& map, Placed& placed) {
  const auto list = [&](const char* name) {
    const XmlAttribute* attribute = mesh.own(name);
    const auto numbers = attribute ? numbersIn(attribute->value) : std::vector<double>();
    if (!numbers || numbers->size() % 3 != 0)
      findings_.error(attribute->where, cat(mesh.describe(), " ", name, ": expected n x 3 numbers"));
    return numbers.value_or(std::vector<double>{});
  };
  std::vector<double> points = list("vertex"), faces = list("face");
  if (points.empty()) {
    const char* const why = mesh.own("builtin")
                                ? " has the attribute 'builtin', whose meshes are not made; the geoms have no shape"
                                : " has neither 'file' nor 'vertex'";
    return findings_.warn(mesh.where(), cat(mesh.describe(), why));
  }
  addVertices(std::move(points), std::move(faces), map, placed);
}

/// The mesh of a geom as the frame will have it; nullopt if it cannot be read.
std::optional<Mesh> MjcfShapes::meshOf(const MjcfElement& element, const Placed& placed) {
  const auto list = [&](const char* key) {
    const Node* node = placed.attributes.find(key);
    return node ? node->value.as<NumberArray>()->numbers : std::vector<double>{};
  };
  Mesh mesh;
  if (const Node* file = placed.attributes.find("mesh")) {
    try {
      mesh = *sharedMeshFile(file->value.as<AngleText>()->text);
    } catch (const Error& e) {
      findings_.warn(element.where(), cat(element.describe(), ": its mass is unknown: ", e.what()));
      return std::nullopt;
    }
    const std::vector<double> scale = list("meshscale");
    if (scale.size() == 3) scaleMesh(mesh, {scale[0], scale[1], scale[2]});
    return mesh;
  }
  const std::vector<double> points = placed.attributes.find("vertices") ? list("vertices") : list("core"),
                            corners = list("triangles");
  for (std::size_t i = 0; i + 2 < points.size(); i += 3)
    mesh.vertices.emplace_back(points[i], points[i + 1], points[i + 2]);
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    mesh.triangles.push_back({std::uint32_t(corners[i]), std::uint32_t(corners[i + 1]), std::uint32_t(corners[i + 2])});
    for (const std::uint32_t corner : mesh.triangles.back()) {
      if (corner >= mesh.vertices.size()) return std::nullopt;  // reported where the shape is made
    }
  }
  return mesh;
}

MeshMassMode MjcfShapes::massMode(const MjcfElement& mesh) {
  static const std::vector<std::string> modes = {"legacy", "exact", "convex", "shell"};
  const std::string word = values_.keyword(mesh, "inertia", modes, "legacy");
  return MeshMassMode(std::find(modes.begin(), modes.end(), word) - modes.begin());
}

/// Volume or area of a geom, and its inertia per mass.
std::optional<UniformMass> MjcfShapes::massOf(const MjcfElement& element, const Placed& placed) {
  const bool is_shell = values_.keyword(element, "shellinertia", {"true", "false"}, "false") == "true";
  const Node* shape = placed.attributes.find("shape");
  const Node* size = placed.attributes.find("size");
  const std::string name = shape ? *shape->value.as<std::string>() : "";
  if (shape && size && name != "ssCvx") return uniformMass(name, size->value.as<NumberArray>()->numbers, is_shell);
  const XmlAttribute* reference = element.attribute("mesh");
  const auto asset = reference ? meshes_.find(reference->value) : meshes_.end();
  if (asset == meshes_.end() || (!shape && !placed.attributes.find("mesh"))) return std::nullopt;
  const MeshMassMode mode = is_shell ? MeshMassMode::shell : massMode(asset->second);
  const std::optional<Mesh> mesh = meshOf(element, placed);
  return mesh ? uniformMass(*mesh, mode) : std::nullopt;
}

/// For bodies without <inertial>. A stated mass counts without a shape, too.
void MjcfShapes::addMass(const MjcfElement& element, Placed& placed) {
  const bool given = element.attribute("mass") != nullptr;
  const double stated = values_.number(element, "mass", 0.), density = values_.number(element, "density", 1000.);
  if (given && stated < 0.)
    return findings_.error(element.where(), cat(element.describe(), ": its mass, ", stated, " kg, is negative"));
  if (given ? stated == 0. : density == 0.) return;
  const std::optional<UniformMass> uniform = massOf(element, placed);
  if (!given && !uniform) {
    return findings_.warn(element.where(), cat(element.describe(), ": its mass cannot be computed, because its ",
                                               "mesh is missing or has no volume; give its 'mass', or an <inertial>"));
  }
  const double mass = given ? stated : density * uniform->measure;
  placed.attributes.add("mass", mass);
  if (!uniform) return;
  const Matrix3d m = mass * uniform->inertia_per_mass;
  placed.attributes.addNumbers("com", {uniform->com.begin(), uniform->com.end()});
  if (m.isDiagonal(0.)) {
    placed.attributes.addNumbers("inertia", {m(0, 0), m(1, 1), m(2, 2)});
  } else {
    placed.attributes.addNumbers("inertia", {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)});
  }
}

/// Sets color and contact flag.
void MjcfShapes::addLooks(const MjcfElement& element, int contact, Placed& placed) {
  std::vector<double> rgba = color(element);
  const bool hidden = values_.number(element, "group", 0.) >= kFirstHiddenGroup;
  if (hidden && rgba[3] > .2) rgba = {1., 0., 0., .2};
  placed.attributes.addNumbers("color", std::move(rgba));
  if (!hidden) addTexture(element, placed);
  if (contact == 0) return placed.attributes.add("visual", true);
  placed.attributes.add("contact", double(contact));
  addMjcfFriction(element, values_, placed.attributes);
}

/// The material of a geom, or null. An unknown material causes a warning.
const MjcfElement* MjcfShapes::materialOf(const MjcfElement& element) {
  const XmlAttribute* reference = element.attribute("material");
  if (!reference) return nullptr;
  const auto found = materials_.find(reference->value);
  if (found != materials_.end()) return &found->second;
  findings_.warn(reference->where, cat(element.describe(), ": there is no material '", reference->value, "' in <asset>",
                                       similarHint(reference->value, namesIn(materials_))));
  return nullptr;
}

/// The color texture of a material: an attribute, or a <layer role="rgb">.
const MjcfElement* MjcfShapes::textureOf(const MjcfElement& material) {
  const XmlAttribute* reference = material.attribute("texture");
  for (const XmlElement* layer : material.xml().all("layer")) {
    const XmlAttribute* role = layer->attribute("role");
    if (!reference && (!role || role->value == "rgb")) reference = layer->attribute("texture");
  }
  if (!reference) return nullptr;
  const auto found = textures_.find(reference->value);
  if (found != textures_.end()) return &found->second;
  findings_.warn(reference->where, cat(material.describe(), ": there is no texture '", reference->value, "' in <asset>",
                                       similarHint(reference->value, namesIn(textures_))));
  return nullptr;
}

/// A texture without a file contributes its mean color.
std::vector<double> MjcfShapes::color(const MjcfElement& element) {
  if (const std::vector<double> own = values_.color(element); !own.empty()) return own;
  const MjcfElement* material = materialOf(element);
  if (!material) return {.5, .5, .5, 1.};
  std::vector<double> rgba = values_.color(*material);
  if (rgba.empty()) rgba = {1., 1., 1., 1.};
  const MjcfElement* texture = textureOf(*material);
  if (!texture || !texture->attribute("builtin") || texture->attribute("builtin")->value == "none") return rgba;
  const Vector3d first = values_.vector(*texture, "rgb1", Vector3d::Constant(.8)),
                 second = values_.vector(*texture, "rgb2", Vector3d::Constant(.5));
  const Vector3d mean = texture->attribute("builtin")->value == "flat" ? first : Vector3d(.5 * (first + second));
  for (int i = 0; i < 3; ++i) rgba[std::size_t(i)] *= mean[i];
  return rgba;
}

/// Adds the picture of a geom. The repetition applies if the geom has no texture coordinates of its own: to planes and
/// boxes.
void MjcfShapes::addTexture(const MjcfElement& element, Placed& placed) {
  const XmlAttribute* reference = element.attribute("material");
  const auto found = reference ? materials_.find(reference->value) : materials_.end();  // color() has warned
  const MjcfElement* material = found != materials_.end() ? &found->second : nullptr;
  const MjcfElement* texture = material ? textureOf(*material) : nullptr;
  const XmlAttribute* file = texture ? texture->own("file") : nullptr;
  if (!file) return;
  const LocatedFile found_file = document_.locateAsset(*file, document_.settingsAt(file->where).texture_folder);
  placed.attributes.add("texture", AngleText{found_file.path});
  const std::vector<double> repeat = values_.numbers(*material, "texrepeat", 2);
  const Node* size = placed.attributes.find("size");
  if (repeat.empty() || !size || placed.attributes.find("mesh")) return;
  const XmlAttribute* uniform = material->attribute("texuniform");
  const std::vector<double>& extent = size->value.as<NumberArray>()->numbers;
  std::vector<double> times = repeat;
  for (std::size_t i = 0; i < 2 && uniform && uniform->value == "true" && extent.size() > 1; ++i) times[i] *= extent[i];
  placed.attributes.addNumbers("texture_repeat", std::move(times));
}

MjcfShapes::Placed MjcfShapes::site(const MjcfElement& element) {
  Placed placed{values_.pose(element), FrameAttributes(element.where())};
  const auto line = element.attribute("fromto") ? values_.line(element) : std::nullopt;
  if (line) placed.pose = line->first;
  const std::vector<double> rgba = values_.color(element);
  const bool hidden = values_.number(element, "group", 0.) >= kFirstHiddenGroup || (!rgba.empty() && rgba[3] == 0.);
  if (!hidden) {
    placed.attributes.add("shape", std::string("marker"));
    placed.attributes.addNumbers("size", {kMarkerLength});
  }
  return placed;
}

MjcfShapes::Placed MjcfShapes::camera(const MjcfElement& element) {
  Placed placed{values_.pose(element), FrameAttributes(element.where())};
  placed.pose.q = placed.pose.q * Quaterniond(0., 1., 0., 0.);  // MuJoCo's camera looks along -z with y up
  placed.attributes.add("shape", std::string("camera"));
  const double angle = values_.number(element, "fovy", 45.);
  if (!(angle > 0. && angle < 180.)) {
    findings_.error(element.attribute("fovy")->where,
                    cat(element.describe(), ": a vertical angle of ", angle, " degrees; expected 0 to 180"));
    return placed;
  }
  placed.attributes.add("heightAngle", angle);
  const std::vector<double> pixels = values_.numbers(element, "resolution", 2);
  if (!pixels.empty()) {
    placed.attributes.add("width", pixels[0]);
    placed.attributes.add("height", pixels[1]);
  }
  const std::string mode =
      values_.keyword(element, "mode", {"fixed", "track", "trackcom", "targetbody", "targetbodycom"}, "fixed");
  if (mode != "fixed")
    findings_.warn(element.where(),
                   cat(element.describe(), ": a camera of mode '", mode, "' is read as a fixed camera"));
  return placed;
}

}  // namespace kinegraph::inline parsers_internal
