#include "kinegraph/viewer/shown_scene.h"

#include <cstring>

#include "kinegraph/geometry/shape_types.h"
#include "kinegraph/geometry/tessellation.h"
#include "kinegraph/viewer/messages.h"

namespace kinegraph {

namespace {

template <class T>
void append(std::string& data, const T& value) {
  data.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// kind, index, vertices, triangles, colors (0, 1 or as many as vertices), then float32 positions, uint32 indices, rgba bytes.
std::string encodeMesh(int index, const Mesh& mesh) {
  std::string data;
  const std::size_t vertices = mesh.vertices.size();
  const std::size_t colors = mesh.colors.size() == vertices || mesh.colors.size() == 1 ? mesh.colors.size() : 0;
  append(data, BinaryKind::mesh);
  append(data, std::uint32_t(index));
  append(data, std::uint32_t(vertices));
  append(data, std::uint32_t(mesh.triangles.size()));
  append(data, std::uint32_t(colors));
  for (const Vector3d& p : mesh.vertices) {
    for (int i = 0; i < 3; ++i) append(data, float(p[i]));
  }
  for (const auto& triangle : mesh.triangles) append(data, triangle);
  for (std::size_t i = 0; i < colors; ++i) append(data, mesh.colors[i]);
  return data;
}

/// Shapes that the client does not build by itself are sent as triangles.
bool isSentAsMesh(ShapeType type) {
  switch (type) {
    case ShapeType::mesh:
    case ShapeType::pointCloud:
    case ShapeType::lines:
    case ShapeType::ssCvx:
    case ShapeType::ssBoxElip: return true;
    default: return false;
  }
}

}  // namespace

int ShownScene::meshOf(const ViewItem& item) {
  if (!item.geometry || !isSentAsMesh(item.geometry->type)) return -1;
  const auto [place, is_new] = mesh_index_.try_emplace(item.geometry, int(meshes_.size()));
  if (is_new) {
    const bool has_own = item.geometry->type != ShapeType::ssCvx && item.geometry->mesh;
    meshes_.push_back(encodeMesh(place->second, has_own ? *item.geometry->mesh : tessellate(*item.geometry)));
  }
  return place->second;
}

bool ShownScene::update(std::span<const ViewItem> items) {
  const std::uint64_t next = revision_ + 1;
  bool changed = false;
  if (frames_.size() != items.size()) {
    frames_.resize(items.size());
    count_revision_ = next;
    changed = true;
  }
  for (std::size_t i = 0; i < items.size(); ++i) {
    Shown& shown = frames_[i];
    const ViewItem& item = items[i];
    const bool same_look = shown.look_revision > 0 && shown.item.geometry == item.geometry && shown.item.color == item.color &&
                           shown.item.parent == item.parent && shown.item.name == item.name;
    if (!same_look) {
      shown.mesh = meshOf(item);
      shown.look_revision = next;
      changed = true;
    }
    if (!same_look || shown.item.pose.p != item.pose.p || shown.item.pose.q.coeffs() != item.pose.q.coeffs()) {
      shown.pose_revision = next;
      changed = true;
      shown.item = item;
    }
  }
  if (changed) revision_ = next;
  return changed;
}

bool ShownScene::setText(std::string ShownScene::*field, const std::string& text) {
  if (this->*field == text) return false;
  this->*field = text;
  text_revision_ = ++revision_;
  return true;
}

void ShownScene::setCamera(const Vector3d& position, const Vector3d& target) {
  camera_position_ = position;
  camera_target_ = target;
  camera_revision_ = ++revision_;
}

std::vector<Outgoing> ShownScene::messagesSince(Seen& seen) const {
  std::vector<Outgoing> out;
  const auto send = [&](const auto& message) {
    JsonWriter json;
    writeJson(json, message);
    out.push_back({json.text(), false});
  };
  if (text_revision_ > seen.revision) send(TextMessage{title, message, error});
  if (camera_revision_ > seen.revision) {
    const Vector3d &p = camera_position_, &t = camera_target_;
    send(CameraMessage{{p.x(), p.y(), p.z()}, {t.x(), t.y(), t.z()}});
  }
  SceneMessage scene;
  scene.count = int(frames_.size());
  seen.meshes.resize(meshes_.size());
  std::string poses;
  std::uint32_t moved = 0;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    const Shown& shown = frames_[i];
    if (shown.look_revision > seen.revision) {
      FrameMessage frame{int(i), shown.item.name, shown.item.parent, std::nullopt};
      if (shown.item.geometry && shown.item.geometry->type != ShapeType::none) {
        const Vector4d& c = shown.item.color;
        frame.shape = ShapeMessage{shapeTypeName(shown.item.geometry->type), shown.item.geometry->size, {c[0], c[1], c[2], c[3]}, shown.mesh};
      }
      scene.frames.push_back(frame);
      if (shown.mesh >= 0 && !seen.meshes[shown.mesh]) {
        seen.meshes[shown.mesh] = true;
        out.push_back({meshes_[shown.mesh], true});
      }
    }
    if (shown.pose_revision > seen.revision) {
      append(poses, std::uint32_t(i));
      const Vector7d numbers = shown.item.pose.numbers();
      for (int k = 0; k < 7; ++k) append(poses, float(numbers[k]));
      ++moved;
    }
  }
  if (!scene.frames.empty() || count_revision_ > seen.revision) send(scene);
  if (moved > 0) {
    std::string data;
    append(data, BinaryKind::poses);
    append(data, moved);
    out.push_back({data + poses, true});
  }
  seen.revision = revision_;
  return out;
}

}  // namespace kinegraph
