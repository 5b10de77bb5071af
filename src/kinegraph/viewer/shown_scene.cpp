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

/// kind, number, vertices, triangles, colors (0, 1 or as many as vertices), then float32 positions, uint32 indices, rgba bytes.
std::string encodeMesh(int number, const Mesh& mesh) {
  std::string data;
  const std::size_t vertices = mesh.vertices.size();
  const std::size_t colors = mesh.colors.size() == vertices || mesh.colors.size() == 1 ? mesh.colors.size() : 0;
  append(data, BinaryKind::mesh);
  append(data, std::uint32_t(number));
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

std::shared_ptr<const ShownScene::SentMesh> ShownScene::meshOf(const ViewItem& item) {
  if (!item.geometry || !isSentAsMesh(item.geometry->type)) return nullptr;
  const auto [place, is_new] = meshes_.try_emplace(item.geometry);
  if (is_new) {
    const bool has_own = item.geometry->type != ShapeType::ssCvx && item.geometry->mesh;
    const Mesh& mesh = has_own ? *item.geometry->mesh : tessellate(*item.geometry);
    place->second = std::make_shared<SentMesh>(SentMesh{next_mesh_, std::make_shared<std::string>(encodeMesh(next_mesh_, mesh))});
    ++next_mesh_;
  }
  return place->second;
}

bool ShownScene::update(std::span<const ViewItem> items) {
  const std::uint64_t next = revision_ + 1;
  bool changed = false, looks_changed = false;
  if (frames_.size() != items.size()) {
    frames_.resize(items.size());
    count_revision_ = next;
    changed = looks_changed = true;
  }
  for (std::size_t i = 0; i < items.size(); ++i) {
    Shown& shown = frames_[i];
    const ViewItem& item = items[i];
    const bool same_look = shown.look_revision > 0 && shown.item.geometry == item.geometry && shown.item.color == item.color &&
                           shown.item.parent == item.parent && shown.item.name == item.name;
    if (!same_look) {
      shown.mesh = meshOf(item);
      shown.look_revision = next;
      changed = looks_changed = true;
    }
    if (!same_look || shown.item.pose.p != item.pose.p || shown.item.pose.q.coeffs() != item.pose.q.coeffs()) {
      shown.pose_revision = next;
      changed = true;
      shown.item = item;
    }
  }
  if (looks_changed) std::erase_if(meshes_, [](const auto& entry) { return entry.second.use_count() == 1; });
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
    out.push_back({std::make_shared<std::string>(json.text()), false});
  };
  if (text_revision_ > seen.revision) send(TextMessage{title, message, error});
  if (camera_revision_ > seen.revision) {
    const Vector3d &p = camera_position_, &t = camera_target_;
    send(CameraMessage{{p.x(), p.y(), p.z()}, {t.x(), t.y(), t.z()}});
  }
  SceneMessage scene;
  scene.count = int(frames_.size());
  std::set<int> meshes;
  std::string poses;
  std::uint32_t moved = 0;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    const Shown& shown = frames_[i];
    if (shown.look_revision > seen.revision) {
      FrameMessage frame{int(i), shown.item.name, shown.item.parent, std::nullopt};
      if (shown.item.geometry && shown.item.geometry->type != ShapeType::none) {
        const Vector4d& c = shown.item.color;
        frame.shape = ShapeMessage{shapeTypeName(shown.item.geometry->type), shown.item.geometry->size, {c[0], c[1], c[2], c[3]},
                                   shown.mesh ? shown.mesh->number : -1};
      }
      scene.frames.push_back(frame);
    }
    if (shown.mesh && meshes.insert(shown.mesh->number).second && !seen.meshes.contains(shown.mesh->number)) {
      out.push_back({shown.mesh->data, true});
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
    out.push_back({std::make_shared<std::string>(data + poses), true});
  }
  seen.meshes = std::move(meshes);
  seen.revision = revision_;
  return out;
}

}  // namespace kinegraph
