#include "kinegraph/perception/scene_observer.h"

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/perception/occupancy_map.h"

namespace kinegraph {

namespace {

/// Whether an arm moves the shapes of a thing.
bool isInHand(const Config& scene, const std::string& name) {
  std::set<int> parts = {scene.getFrame(name).id()};
  for (const Frame& part : scene.getFrame(name).getSubtree()) parts.insert(part.id());
  const std::vector<KnownShape> shapes = knownShapes(scene, {});
  return std::any_of(shapes.begin(), shapes.end(),
                     [&](const KnownShape& shape) { return !shape.supports && parts.contains(shape.frame); });
}

bool isSeen(const SeenFrame& frame) { return frame.status == SeenStatus::seen; }

}  // namespace

SceneObserver::SceneObserver(std::function<std::vector<DepthView>()> take, std::vector<std::string> frames,
                             RegisterOptions options, OccupancyMap* map, Unseen unseen)
    : take_(std::move(take)), frames_(std::move(frames)), options_(std::move(options)), map_(map), unseen_(unseen) {
  if (!take_) throw ValueError("SceneObserver: take is null; expected a function that returns depth images");
  options_.validate();
}

/// Poses near the last ones come first: a symmetric thing keeps its rotation from look to look.
SeenScene SceneObserver::lookFor(Config& scene, std::vector<DepthView>& views,
                                 const std::vector<std::string>& names) const {
  if (options_.prior == Prior::last || !has_seen_) return registerScene(scene, views, names, options_);
  RegisterOptions options = options_;
  options.prior = Prior::last;
  SeenScene seen = registerScene(scene, views, names, options);
  for (std::size_t k = 0; k < seen.cameras.size(); ++k) {
    if (views[k].camera.empty()) views[k].pose = seen.cameras[k].pose;
  }
  std::vector<std::string> lost;
  for (const auto& [name, frame] : seen.frames) {
    if (!isSeen(frame)) lost.push_back(name);
  }
  if (lost.empty()) return seen;
  options = options_;
  options.estimate.clear();  // the scene is corrected already
  SeenScene elsewhere = registerScene(scene, views, lost, options);
  for (auto& [name, frame] : elsewhere.frames) {
    if (isSeen(frame)) seen.frames[name] = std::move(frame);
  }
  for (const std::string& warning : elsewhere.warnings) {
    if (std::ranges::find(seen.warnings, warning) == seen.warnings.end()) seen.warnings.push_back(warning);
  }
  return seen;
}

std::map<std::string, std::optional<Pose>> SceneObserver::observe(Config& scene) {
  std::vector<std::string> standing;
  for (const std::string& name : frames_) {
    if (!isInHand(scene, name)) standing.push_back(name);
  }
  std::vector<DepthView> views = take_();
  SeenScene seen;
  if (!standing.empty()) seen = lookFor(scene, views, standing);
  if (map_) {
    const std::vector<std::string> warnings = map_->update(scene, views, seen);
    for (const std::string& warning : warnings) seen.warnings.push_back(warning);
    map_->attach(scene, unseen_);
  }
  seen_ = std::move(seen);
  has_seen_ |= std::ranges::any_of(seen_.frames, [](const auto& entry) { return isSeen(entry.second); });
  std::map<std::string, std::optional<Pose>> poses;
  for (const std::string& name : frames_) {
    const auto found = seen_.frames.find(name);
    const bool is_seen = found != seen_.frames.end() && isSeen(found->second);
    poses[name] = is_seen ? std::optional(found->second.pose) : std::nullopt;
  }
  return poses;
}

}  // namespace kinegraph
