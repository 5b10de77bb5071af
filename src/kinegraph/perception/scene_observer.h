#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/perception/occupancy_map.h"

namespace kinegraph {

/// Looks with cameras: sees where the things of a scene are, and keeps a map of all else.
///
///     OccupancyMap map(C, {-.5, 0., .66}, {.5, .7, 1.1}, .02);
///     SceneObserver observer(take, {"cup"}, {.support = "table"}, &map);
///     observer.observe(C);                                  // look once, and plan
///     planTask(C, "(on tray cup)").execute(bot, observer);  // in Python: execute(bot, observe=observer)
class SceneObserver {
 public:
  /// `take` returns depth images of this moment, from cameras whose frames or poses they name. `frames` are the things
  /// that registerScene looks for. The `map`, if given, has to live as long as the observer.
  SceneObserver(std::function<std::vector<DepthView>()> take, std::vector<std::string> frames,
                RegisterOptions options = {}, OccupancyMap* map = nullptr, Unseen unseen = Unseen::shadows);

  /// Takes images, moves the things to where they are seen, and attaches the updated map. The scene must have the joint
  /// angles of this moment, and objects in hands attached to these: they are not looked for. Returns the poses (world)
  /// of the things; nothing for those not seen. With Prior::anywhere, later looks search near the last poses first.
  /// Throws what registerScene and OccupancyMap::update throw.
  std::map<std::string, std::optional<Pose>> observe(Config& scene);

  /// Returns the result of registerScene for the last images.
  const SeenScene& seen() const { return seen_; }

 private:
  SeenScene lookFor(Config& scene, std::vector<DepthView>& views, const std::vector<std::string>& names) const;

  std::function<std::vector<DepthView>()> take_;
  std::vector<std::string> frames_;
  RegisterOptions options_;
  OccupancyMap* map_;
  Unseen unseen_;
  SeenScene seen_;
  bool has_seen_ = false;  ///< one of the things
};

}  // namespace kinegraph
