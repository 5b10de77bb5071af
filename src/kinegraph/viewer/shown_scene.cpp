#include "kinegraph/viewer/shown_scene.h"

#include <numeric>
#include <utility>

#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/geometry/shapes/shape_types.h"
#include "kinegraph/geometry/shapes/tessellation.h"
#include "kinegraph/viewer/messages/binary_messages.h"
#include "kinegraph/viewer/messages/merged_lines.h"
#include "kinegraph/viewer/messages/messages.h"

namespace kinegraph::inline viewer_internal {

namespace {

CameraMessage messageOf(const PageCamera& camera) {
  const Vector7d pose = camera.pose.numbers();
  return {{pose.begin(), pose.end()},
          camera.distance,
          camera.focal_length,
          camera.ortho_height,
          camera.aspect,
          camera.near,
          camera.far};
}

LinesMessage messageOf(const std::vector<NearLine>& lines) {
  LinesMessage message;
  for (const NearLine& line : lines) {
    message.points.insert(message.points.end(),
                          {line.a.x(), line.a.y(), line.a.z(), line.b.x(), line.b.y(), line.b.z()});
    message.distances.push_back(line.distance);
    message.names.push_back(line.names);
  }
  return message;
}

MotionMessage headOf(const ShownMotion& motion) {
  const char* start = motion.start == ShownMotion::Start::all    ? "all"
                      : motion.start == ShownMotion::Start::play ? "play"
                                                                 : "pause";
  std::vector<TraceMessage> traces;
  for (const ShownMotion::Trace& trace : motion.traces) traces.push_back({trace.name, trace.type, trace.values});
  std::vector<LinesMessage> touching;
  for (const std::vector<NearLine>& lines : motion.touching) touching.push_back(messageOf(lines));
  return {int(motion.poses.size()), motion.seconds, start,    motion.first, motion.prefix, motion.texts,
          motion.violations,        motion.marked,  touching, traces};
}

WarningsMessage messageOf(const std::vector<SceneWarning>& warnings) {
  WarningsMessage message;
  for (const SceneWarning& warning : warnings)
    message.warnings.push_back({warning.text, warning.frames, warning.ignored});
  return message;
}

RunMessage messageOf(const ShownRun& run) {
  RunMessage message{1, run.is_steered, run.time, run.factor, run.is_paused, {}, {}};
  for (const auto& [position, force] : run.contacts) {
    message.contacts.insert(message.contacts.end(), position.begin(), position.end());
    message.contacts.insert(message.contacts.end(), force.begin(), force.end());
  }
  if (run.perturbation) {
    const auto& [from, to, force] = *run.perturbation;
    message.perturbation = {from.x(), from.y(), from.z(), to.x(), to.y(), to.z(), force};
  }
  return message;
}

/// Returns the triangles that stand for a shape on the page.
std::shared_ptr<const Mesh> surfaceOf(const Geometry& geometry) {
  const bool has_own = shapeKind(geometry.type).data == ShapeKind::Data::mesh && geometry.mesh;
  return has_own ? geometry.mesh : std::make_shared<const Mesh>(tessellate(geometry));
}

template <class T>
Outgoing textOf(const T& message) {
  return {std::make_shared<std::string>(jsonText(message)), false};
}

}  // namespace

std::shared_ptr<const ShownScene::SentMesh> ShownScene::meshOf(const ViewItem& item) {
  if (!item.geometry || item.geometry->type == ShapeType::none) return nullptr;
  const ShapeKind& kind = shapeKind(item.geometry->type);
  if (kind.is_drawn_by_page) return nullptr;
  const auto [place, is_new] = meshes_.try_emplace(item.geometry);
  if (is_new) {
    SentMesh sent{next_mesh_++, nullptr};
    const std::shared_ptr<const Mesh> mesh = surfaceOf(*item.geometry);
    std::vector<int> numbers;
    for (const TexturedTriangles& textured : mesh->textures) {
      sent.images.push_back(sentImage(textured.image));
      numbers.push_back(sent.images.back()->number);
    }
    sent.data = std::make_shared<std::string>(encodeMesh(sent.number, *mesh, numbers));
    place->second = std::make_shared<SentMesh>(std::move(sent));
  }
  return place->second;
}

/// Encodes kind, number, then the bytes of the image's file.
std::shared_ptr<const ShownScene::SentImage> ShownScene::sentImage(const std::shared_ptr<const Image>& image) {
  const auto [place, is_new] = images_.try_emplace(image);
  if (is_new) {
    std::string data;
    appendBytes(data, BinaryKind::image);
    appendBytes(data, std::uint32_t(next_image_));
    place->second =
        std::make_shared<SentImage>(SentImage{next_image_++, std::make_shared<std::string>(data + image->bytes)});
  }
  return place->second;
}

/// Takes an item over if it differs from the shown one.
void ShownScene::take(std::size_t index, const ViewItem& item, std::uint64_t next, bool& changed,
                      bool& looks_different) {
  Shown& shown = frames_[index];
  const bool same_appearance = shown.appearance_revision > 0 && shown.item.geometry == item.geometry &&
                               shown.item.color == item.color && shown.item.collides == item.collides &&
                               shown.item.parent == item.parent && shown.item.name == item.name &&
                               shown.item.details == item.details;
  if (!same_appearance) {
    shown.mesh = meshOf(item);
    shown.appearance_revision = next;
    changed = looks_different = true;
  }
  if (!same_appearance || shown.item.pose.p != item.pose.p || shown.item.pose.q.coeffs() != item.pose.q.coeffs()) {
    shown.pose_revision = next;
    changed = true;
    shown.item = item;
  }
}

bool ShownScene::update(std::span<const ViewItem> items) {
  std::vector<int> all(items.size());
  std::iota(all.begin(), all.end(), 0);
  return update(items, all);
}

bool ShownScene::update(std::span<const ViewItem> items, std::span<const int> changed_items) {
  if (frames_.size() != items.size() && changed_items.size() != items.size()) return update(items);
  const std::uint64_t next = revision_ + 1;
  bool changed = false, looks_different = false;
  if (frames_.size() != items.size()) {
    frames_.resize(items.size());
    count_revision_ = next;
    changed = looks_different = true;
  }
  const std::vector<int> edited = std::exchange(edited_, {});
  for (const std::span<const int> indices : {changed_items, std::span<const int>(edited)}) {
    for (const int i : indices) {
      if (std::size_t(i) < items.size()) take(std::size_t(i), items[std::size_t(i)], next, changed, looks_different);
    }
  }
  if (looks_different) {
    std::erase_if(meshes_, [](const auto& entry) { return entry.second.use_count() == 1; });
    std::erase_if(images_, [](const auto& entry) { return entry.second.use_count() == 1; });
  }
  if (changed) revision_ = next;
  return changed;
}

bool ShownScene::setJoints(int structure, const ShownJoints& joints, const VectorXd& q) {
  const std::uint64_t before = revision_;
  if (structure != structure_ || joints != joints_) {
    structure_ = structure;
    joints_ = joints;
    joints_revision_ = ++revision_;
    setWarnings({});  // the former ones refer to other frames
  }
  if (q.size() != q_.size() || q != q_) {
    q_ = q;
    q_revision_ = ++revision_;
  }
  return revision_ != before;
}

void ShownScene::setEdited(const EditedScene& edited) {
  if (edited.poses.size() != frames_.size()) return;
  ++revision_;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    Shown& shown = frames_[i];
    const Pose& pose = edited.poses[i];
    if (shown.item.pose.p == pose.p && shown.item.pose.q.coeffs() == pose.q.coeffs()) continue;
    shown.item.pose = pose;
    shown.pose_revision = revision_;
    edited_.push_back(int(i));
  }
  setJoints(structure_, joints_, edited.q);
  setNear(edited.near);
  if (edited.warnings) setWarnings(*edited.warnings);
}

void ShownScene::select(int frame) {
  selected_ = frame;
  select_revision_ = ++revision_;
}

void ShownScene::setMotion(const ShownMotion& motion) {
  motion_ = {textOf(headOf(motion)), {std::make_shared<std::string>(encodeMotion(motion)), true}};
  motion_revision_ = ++revision_;
}

bool ShownScene::endMotion() {
  if (motion_.empty()) return false;
  motion_.clear();
  motion_revision_ = ++revision_;
  return true;
}

void ShownScene::setRun(const ShownRun& run) {
  run_ = run;
  run_revision_ = ++revision_;
}

bool ShownScene::endRun() {
  if (!run_) return false;
  run_.reset();
  run_revision_ = ++revision_;
  return true;
}

bool ShownScene::setText(std::string ShownScene::*field, const std::string& text) {
  if (this->*field == text) return false;
  this->*field = text;
  text_revision_ = ++revision_;
  return true;
}

bool ShownScene::setNear(const std::vector<NearLine>& lines) {
  const Outgoing near = textOf(NearMessage{messageOf(lines)});
  if (near_ ? *near_ == *near.data : lines.empty()) return false;
  near_ = near.data;
  near_revision_ = ++revision_;
  return true;
}

bool ShownScene::setWarnings(const std::vector<SceneWarning>& warnings) {
  if (warnings == warnings_) return false;
  warnings_ = warnings;
  warnings_revision_ = ++revision_;
  return true;
}

void ShownScene::setQuad(const Quad& quad) {
  quads_[quad.id] = {++revision_, {std::make_shared<std::string>(encodeQuad(quad)), true}};
}

bool ShownScene::setAppearance(const Appearance& appearance) {
  if (appearance == appearance_) return false;
  appearance_ = appearance;
  appearance_revision_ = ++revision_;
  return true;
}

bool ShownScene::requestEvents(int kind) {
  if (std::exchange(events_, kind) == kind) return false;
  appearance_revision_ = ++revision_;
  return true;
}

bool ShownScene::requestDigits(bool yes) {
  if (std::exchange(digits_, yes) == yes) return false;
  appearance_revision_ = ++revision_;
  return true;
}

bool ShownScene::requestCursor() {
  if (std::exchange(cursor_, true)) return false;
  appearance_revision_ = ++revision_;
  return true;
}

void ShownScene::setCamera(const PageCamera& camera) {
  camera_ = camera;
  camera_revision_ = ++revision_;
}

std::string ShownScene::nameOf(int item) const {
  return item >= 0 && item < int(frames_.size()) ? frames_[std::size_t(item)].item.name : "";
}

FrameMessage ShownScene::frameMessage(std::size_t index) const {
  const Shown& shown = frames_[index];
  const ViewItem& item = shown.item;
  FrameMessage frame{int(index), item.name, item.parent, item.collides, item.details, std::nullopt};
  if (item.geometry && item.geometry->type != ShapeType::none) {
    const Vector4d& c = item.color;
    frame.shape = ShapeMessage{shapeTypeName(item.geometry->type),
                               item.geometry->size,
                               {c[0], c[1], c[2], c[3]},
                               shown.mesh ? shown.mesh->number : -1};
  }
  return frame;
}

/// Returns the message of a mesh; vertices of one without images are merged if `cell` > 0, those of lines more, because
/// plans may have very many.
std::shared_ptr<const std::string> ShownScene::meshData(const Shown& shown, double cell) const {
  if (!(cell > 0.) || !shown.mesh->images.empty()) return shown.mesh->data;
  constexpr double kCoarserLines = 8.;
  std::shared_ptr<const Mesh> mesh = surfaceOf(*shown.item.geometry);
  if (shown.item.geometry->type == ShapeType::lines)
    mesh = std::make_shared<const Mesh>(mergedLines(*mesh, kCoarserLines * cell));
  return std::make_shared<std::string>(encodeMesh(shown.mesh->number, *mesh, {}, cell));
}

double ShownScene::largestMesh() const {
  double largest = 0.;
  for (const Shown& shown : frames_) {
    if (!shown.mesh) continue;
    Eigen::AlignedBox3d box;
    for (const Vector3d& p : surfaceOf(*shown.item.geometry)->vertices) box.extend(p);
    if (!box.isEmpty()) largest = std::max(largest, box.diagonal().norm());
  }
  return largest;
}

/// Adds the meshes and images that the browser lacks, then frames, then poses.
void ShownScene::addFrames(Seen& seen, double cell, std::vector<Outgoing>& out) const {
  SceneMessage scene;
  scene.count = int(frames_.size());
  std::set<int> meshes, images;
  std::string poses;
  std::uint32_t moved = 0;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    const Shown& shown = frames_[i];
    if (shown.appearance_revision > seen.revision) scene.frames.push_back(frameMessage(i));
    if (shown.mesh && meshes.insert(shown.mesh->number).second) {
      for (const auto& image : shown.mesh->images) {
        if (images.insert(image->number).second && !seen.images.contains(image->number))
          out.push_back({image->data, true});
      }
      if (!seen.meshes.contains(shown.mesh->number)) out.push_back({meshData(shown, cell), true});
    }
    if (shown.pose_revision > seen.revision) {
      appendBytes(poses, std::uint32_t(i));
      appendPose(poses, shown.item.pose);
      ++moved;
    }
  }
  seen.meshes = std::move(meshes);
  seen.images = std::move(images);
  if (!scene.frames.empty() || count_revision_ > seen.revision) out.push_back(textOf(scene));
  if (moved == 0) return;
  std::string data;
  appendBytes(data, BinaryKind::poses);
  appendBytes(data, moved);
  out.push_back({std::make_shared<std::string>(data + poses), true});
}

JointsMessage ShownScene::jointsMessage() const {
  JointsMessage message{structure_, {}, {}};
  for (const ShownJoint& j : joints_.dofs) message.joints.push_back({j.name, j.frame, j.unit, j.lower, j.upper});
  for (const MovingItem& m : joints_.moving) message.moving.push_back({m.item, m.dof, m.scale, m.steps, m.axes});
  return message;
}

AppearanceMessage ShownScene::appearanceMessage() const {
  AppearanceMessage appearance{appearance_.visuals_only,
                               {},
                               {},
                               appearance_.shadows,
                               appearance_.text,
                               {},
                               appearance_.flat_colors,
                               appearance_.wireframe,
                               digits_,
                               events_,
                               cursor_};
  for (const Vector3d& light : appearance_.lights)
    appearance.lights.insert(appearance.lights.end(), light.begin(), light.end());
  if (appearance_.background)
    appearance.background.assign(appearance_.background->data(), appearance_.background->data() + 3);
  if (appearance_.floor) appearance.floor.assign(appearance_.floor->data(), appearance_.floor->data() + 3);
  if (!appearance_.has_floor) appearance.floor = {-1.};
  return appearance;
}

std::vector<Outgoing> ShownScene::messages(double cell) const {
  Seen nothing;
  return messagesSince(nothing, cell);
}

std::vector<Outgoing> ShownScene::messagesSince(Seen& seen, double cell) const {
  std::vector<Outgoing> out;
  const auto send = [&](const auto& message) { out.push_back(textOf(message)); };
  if (text_revision_ > seen.revision) send(TextMessage{title, message, error});
  if (camera_revision_ > seen.revision) send(messageOf(camera_));
  addFrames(seen, cell, out);
  if (joints_revision_ > seen.revision) send(jointsMessage());
  if (q_revision_ > seen.revision) out.push_back({std::make_shared<std::string>(encodeJoints(q_)), true});
  if (appearance_revision_ > seen.revision) send(appearanceMessage());
  if (near_revision_ > seen.revision) out.push_back({near_, false});
  if (warnings_revision_ > seen.revision) send(messageOf(warnings_));
  if (run_revision_ > seen.revision) send(run_ ? messageOf(*run_) : RunMessage{});
  for (const auto& [id, quad] : quads_) {
    if (quad.first > seen.revision) out.push_back(quad.second);
  }
  if (select_revision_ > seen.revision) send(SelectMessage{selected_});
  if (motion_revision_ > seen.revision) {
    if (motion_.empty()) send(MotionMessage{});
    out.insert(out.end(), motion_.begin(), motion_.end());
  }
  if (content) content->addMessages(seen.content, out);
  seen.revision = revision_;
  return out;
}

}  // namespace kinegraph::inline viewer_internal
