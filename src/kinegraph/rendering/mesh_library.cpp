#include "kinegraph/rendering/mesh_library.h"
#include "kinegraph/geometry/files/image_file.h"

#include <algorithm>

namespace kinegraph::inline rendering_internal {

namespace {

constexpr float kFloorHalf = 5.f;  // m
constexpr std::size_t kMaxImages = std::min(mjMAXTEXTURE, mjMAXMATERIAL) - 1;

RenderMesh floorMesh() {
  const float h = kFloorHalf;
  return {{-h, -h, 0, h, -h, 0, h, h, 0, -h, h, 0}, {0, 0, 1}, {0, 1, 2, 0, 2, 3}, {0, 0, 0, 0, 0, 0}, std::nullopt};
}

/// This field exists since MuJoCo 3.3.1.
template <class Model>
void setColorSpace(Model& model, int* spaces) {
  if constexpr (requires { model.tex_colorspace; }) model.tex_colorspace = spaces;
}

}  // namespace

void MeshLibrary::append(const RenderMesh& mesh) {
  vertex_start_.push_back(int(vertices_.size() / 3));
  vertex_count_.push_back(int(mesh.vertices.size() / 3));
  normal_start_.push_back(int(normals_.size() / 3));
  normal_count_.push_back(int(mesh.normals.size() / 3));
  face_start_.push_back(int(faces_.size() / 3));
  face_count_.push_back(int(mesh.faces.size() / 3));
  vertices_.insert(vertices_.end(), mesh.vertices.begin(), mesh.vertices.end());
  normals_.insert(normals_.end(), mesh.normals.begin(), mesh.normals.end());
  faces_.insert(faces_.end(), mesh.faces.begin(), mesh.faces.end());
  face_normals_.insert(face_normals_.end(), mesh.face_normals.begin(), mesh.face_normals.end());
  texcoord_start_.push_back(mesh.image ? int(texcoords_.size() / 2) : -1);
  texcoord_count_.push_back(int(mesh.texcoords.size() / 2));
  texcoords_.insert(texcoords_.end(), mesh.texcoords.begin(), mesh.texcoords.end());
  face_texcoords_.insert(face_texcoords_.end(), mesh.face_normals.begin(), mesh.face_normals.end());
}

/// Omits images beyond MuJoCo's capacity.
int MeshLibrary::materialOf(const std::shared_ptr<const Image>& image) {
  if (!image || (texture_start_.size() >= kMaxImages && !materials_.contains(image->bytes))) return -1;
  const auto [place, is_new] = materials_.try_emplace(image->bytes, int(texture_start_.size()));
  if (!is_new) return place->second;
  const Pixels picture = decodeImage(*image);
  texture_start_.push_back(decltype(texture_start_)::value_type(texture_bytes_.size()));
  texture_widths_.push_back(picture.width);
  texture_heights_.push_back(picture.height);
  texture_bytes_.insert(texture_bytes_.end(), picture.rgb.begin(), picture.rgb.end());
  return place->second;
}

bool MeshLibrary::update(const Shapes& shapes) {
  const bool known =
      std::all_of(shapes.begin(), shapes.end(), [&](const auto& shape) { return meshes_.contains(shape); });
  if (known && !vertex_start_.empty()) return false;
  std::erase_if(meshes_, [&](const auto& entry) { return !shapes.contains(entry.first); });
  for (const auto& shape : shapes) {
    if (!meshes_.contains(shape)) meshes_[shape] = renderMeshes(*shape);
  }
  for (auto* numbers :
       {&vertex_start_, &vertex_count_, &normal_start_, &normal_count_, &face_start_, &face_count_, &faces_,
        &face_normals_, &texcoord_start_, &texcoord_count_, &face_texcoords_, &texture_widths_, &texture_heights_}) {
    numbers->clear();
  }
  materials_.clear();
  texture_start_.clear();
  texture_bytes_.clear();
  texcoords_.clear();
  vertices_.clear();
  normals_.clear();
  parts_.clear();
  append(floorMesh());
  for (const auto& [shape, meshes] : meshes_) {
    std::vector<Part>& parts = parts_[shape];
    for (const RenderMesh& mesh : meshes) {
      parts.push_back({int(vertex_start_.size()), mesh.color, materialOf(mesh.image)});
      append(mesh);
    }
  }
  none_.assign(vertex_start_.size(), -1);
  const std::size_t pictures = texture_start_.size();
  texture_of_material_.assign(pictures * mjNTEXROLE, -1);
  for (std::size_t i = 0; i < pictures; ++i) texture_of_material_[i * mjNTEXROLE + mjTEXROLE_RGB] = int(i);
  texture_types_.assign(pictures, mjTEXTURE_2D);
  texture_channels_.assign(pictures, 3);
  linear_.assign(pictures, mjCOLORSPACE_LINEAR);  // colors are used unchanged
  not_uniform_ = std::make_unique<std::remove_pointer_t<decltype(mjModel::mat_texuniform)>[]>(pictures);
  ones_.assign(2 * pictures, 1.f);
  return true;
}

void MeshLibrary::fill(mjModel& model) {
  model.nmesh = decltype(model.nmesh)(vertex_start_.size());
  model.nmeshvert = decltype(model.nmeshvert)(vertices_.size() / 3);
  model.nmeshnormal = decltype(model.nmeshnormal)(normals_.size() / 3);
  model.nmeshface = decltype(model.nmeshface)(faces_.size() / 3);
  model.mesh_vertadr = vertex_start_.data();
  model.mesh_vertnum = vertex_count_.data();
  model.mesh_normaladr = normal_start_.data();
  model.mesh_normalnum = normal_count_.data();
  model.mesh_faceadr = face_start_.data();
  model.mesh_facenum = face_count_.data();
  model.mesh_texcoordadr = texcoord_start_.data();
  model.mesh_texcoordnum = texcoord_count_.data();
  model.nmeshtexcoord = decltype(model.nmeshtexcoord)(texcoords_.size() / 2);
  model.mesh_texcoord = texcoords_.data();
  model.mesh_graphadr = none_.data();
  model.mesh_vert = vertices_.data();
  model.mesh_normal = normals_.data();
  model.mesh_face = faces_.data();
  model.mesh_facenormal = face_normals_.data();
  model.mesh_facetexcoord = face_texcoords_.data();
  model.ntex = model.nmat = decltype(model.ntex)(texture_start_.size());
  model.ntexdata = decltype(model.ntexdata)(texture_bytes_.size());
  model.tex_type = texture_types_.data();
  setColorSpace(model, linear_.data());
  model.tex_width = texture_widths_.data();
  model.tex_height = texture_heights_.data();
  model.tex_nchannel = texture_channels_.data();
  model.tex_adr = texture_start_.data();
  model.tex_data = texture_bytes_.data();
  model.mat_texid = texture_of_material_.data();
  model.mat_texuniform = not_uniform_.get();
  model.mat_texrepeat = ones_.data();
}

}  // namespace kinegraph::inline rendering_internal
