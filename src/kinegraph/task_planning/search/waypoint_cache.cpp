#include "kinegraph/task_planning/search/waypoint_cache.h"

#include <optional>

namespace kinegraph::inline task_planning_internal {

WaypointCache::WaypointCache(SpeculativeExecutor& executor, const WaypointSolver::Settings& settings,
                             std::shared_ptr<const Config> scene, std::vector<TaskDoor> doors)
    : executor_(executor), settings_(settings), scene_(std::move(scene)), doors_(std::move(doors)) {}

const FutureFailure& WaypointCache::failureOf(const Actions& actions, const SceneVariant& variant) {
  const Key key(actions, variant);
  const auto known = failures_.find(key);
  if (known != failures_.end()) return known->second;
  return failures_.emplace(key, solve(key).failure).first->second;
}

bool WaypointCache::isKnownToFail(const Actions& actions) const {
  const auto known = failures_.find({actions, {}});
  return known != failures_.end() && known->second;
}

void WaypointCache::setFailure(const Actions& actions, FutureFailure failure) {
  failures_[{actions, {}}] = std::move(failure);
}

std::vector<WaypointCache::Actions> WaypointCache::unknownPrefixes(const Actions& actions) const {
  std::vector<Actions> unknown;
  for (std::size_t count = 1; count < actions.size(); ++count) {
    Actions prefix(actions.begin(), actions.begin() + std::ptrdiff_t(count));
    const auto known = failures_.find({prefix, {}});
    if (known == failures_.end())
      unknown.push_back(std::move(prefix));
    else if (known->second)
      break;
  }
  return unknown;
}

void WaypointCache::prefetch(const std::vector<Actions>& all, Priority first) {
  if (settings_.threads == 1) return;
  for (const Actions& actions : all) {
    const Key key(actions, {});
    const std::scoped_lock lock(mutex_);
    auto found = prefetched_.find(key);
    if (found == prefetched_.end())
      found = prefetched_.try_emplace(key, executor_, settings_, scene_, actions, 0).first;
    found->second.begin(first, Priority::low);
  }
}

void WaypointCache::dropPrefetched() {
  const std::scoped_lock lock(mutex_);
  prefetched_.clear();
}

WaypointSolver::Result WaypointCache::solve(const Key& key) {
  std::optional<WaypointSolver> own;
  WaypointSolver* solver = nullptr;
  {
    const std::scoped_lock lock(mutex_);
    const auto found = prefetched_.find(key);
    solver = found != prefetched_.end() ? &found->second
                                        : &own.emplace(executor_, settings_, sceneOf(key.second), key.first, 0);
  }
  WaypointSolver::Result result = solver->solve();
  evaluations_ += result.evaluations;
  return result;
}

std::shared_ptr<const Config> WaypointCache::sceneOf(const SceneVariant& variant) const {
  if (variant == SceneVariant()) return scene_;
  auto scene = std::make_shared<Config>(*scene_);
  for (const std::string& name : variant.without) scene->getFrame(name).setContact(0);
  VectorXd q = scene->getJointState();  // compiles the scene once for all copies
  if (variant.doors.empty()) return scene;
  for (std::size_t i = 0; i < doors_.size(); ++i) q[doors_[i].dof] = variant.doors[i];
  scene->setJointState(q);
  return scene;
}

}  // namespace kinegraph::inline task_planning_internal
