#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "kinegraph/simulation/simulation.h"
#include "kinegraph/viewer/config_viewer.h"
#include "kinegraph/viewer/server.h"

namespace kinegraph::inline api_internal {

/// Shows a simulation live on a page and serves the users' requests: see Simulation::view.
class SimulationView : public SimulationObserver {
 public:
  using Check = std::function<void()>;  ///< called while waiting; throws to stop

  /// The button `reset` on the page returns to the simulation's state at this call.
  SimulationView(const Simulation& simulation, std::shared_ptr<ConfigViewer> viewer, Check check);
  ~SimulationView() override;

  /// Returns the view of a simulation in a viewer, or null.
  static std::shared_ptr<SimulationView> of(const Simulation& simulation, const std::shared_ptr<ConfigViewer>& viewer);

  /// Creates a view and attaches it to the simulation.
  template <class View = SimulationView>
  static std::shared_ptr<SimulationView> begin(Simulation& simulation, const std::shared_ptr<ConfigViewer>& viewer,
                                               const Check& check) {
    simulation.update();
    auto view = std::make_shared<View>(simulation, viewer, check);
    viewer->server().endRunRequests();
    simulation.setObserver(view);
    return view;
  }

  bool mayStep(Simulation& simulation) override;
  void rest() override;
  bool replaceStep(Simulation& simulation, double tau) override;
  void afterStep(Simulation& simulation) override;

  /// Implement the calls of Simulation. `message` appears in the corner.
  int view(Simulation& simulation, bool pause, const std::optional<std::string>& message);
  int run(Simulation& simulation, double seconds, double tau, double speed);

  /// Shows the present scene, with time, contacts and perturbation.
  void show(const Simulation& simulation);

 private:
  using Clock = std::chrono::steady_clock;

  bool takeEdits(Simulation& simulation);
  bool isBeyondLimits(const Simulation& simulation) const;
  void standStill(Simulation& simulation, double time);
  bool perturb(Simulation& simulation, const std::optional<RunRequests::Perturbation>& request);
  bool isWatched();
  void measureSpeed(double time);
  void keepPace(double tau, double speed);

  std::shared_ptr<ConfigViewer> viewer_;
  Check check_;
  SimulationState start_;
  SimulationState before_;   ///< the step, if it is disturbed
  std::uint64_t structure_;  ///< of the scene in `start_`
  bool is_paused_ = false;
  double disturbed_until_ = -1.;                           ///< s: a second after the last edit or pull of a user
  std::optional<RunRequests::Perturbation> perturbation_;  ///< by a user on the page
  Clock::time_point last_seen_ = Clock::now(), due_{}, measured_{};
  double measured_time_ = 0., factor_ = 0.;
};

}  // namespace kinegraph::inline api_internal
