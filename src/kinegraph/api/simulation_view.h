#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "kinegraph/simulation/simulation.h"
#include "kinegraph/viewer/config_viewer.h"

namespace kinegraph {

/// Shows a simulation live on a page, and does there what people ask for: see Simulation::view.
class SimulationView : public SimulationWatcher {
 public:
  using Check = std::function<void()>;  ///< asked while waiting; throws to stop

  /// `reset` on the page means where the simulation is now.
  SimulationView(const Simulation& simulation, std::shared_ptr<ConfigViewer> viewer, Check check);
  ~SimulationView() override;

  /// The one that watches a simulation in a viewer, or null.
  static std::shared_ptr<SimulationView> of(const Simulation& simulation, const std::shared_ptr<ConfigViewer>& viewer);

  /// Makes one that watches from now on.
  template <class View = SimulationView>
  static std::shared_ptr<SimulationView> begin(Simulation& simulation, const std::shared_ptr<ConfigViewer>& viewer,
                                               const Check& check) {
    simulation.update();
    auto view = std::make_shared<View>(simulation, viewer, check);
    viewer->server().endRunRequests();
    simulation.setWatcher(view);
    return view;
  }

  bool mayStep(Simulation& simulation) override;
  void rest() override;
  void hasStepped(Simulation& simulation) override;

  /// As the calls of Simulation. `message` is shown in the corner.
  int view(Simulation& simulation, bool pause, const std::optional<std::string>& message);
  int run(Simulation& simulation, double seconds, double tau, double speed);

  /// The scene as it is now, with time, contacts and what is pulled.
  void show(const Simulation& simulation);

 private:
  using Clock = std::chrono::steady_clock;

  bool takeEdits(Simulation& simulation);
  bool pull(Simulation& simulation, const std::optional<RunRequests::Pull>& asked);
  bool somebodyWatches();
  void measureSpeed(double time);
  void keepPace(double tau, double speed);

  std::shared_ptr<ConfigViewer> viewer_;
  Check check_;
  SimulationState start_;
  std::uint64_t structure_;  ///< of the scene, as in `start_`
  bool is_paused_ = false;
  std::optional<RunRequests::Pull> pulled_;  ///< by somebody on the page
  Clock::time_point last_seen_ = Clock::now(), due_{}, measured_{};
  double measured_time_ = 0., factor_ = 0.;
};

}  // namespace kinegraph
