#pragma once

namespace kinegraph {

class Simulation;

/// Who looks at a simulation while it is stepped, and may hold it up or change it in between.
struct SimulationWatcher {
  virtual ~SimulationWatcher() = default;

  /// Before each step. False: not yet; rest, and ask again.
  virtual bool mayStep(Simulation& simulation) = 0;

  /// Waits a little, 20 ms at most. May throw, so that the step does not take place.
  virtual void rest() = 0;

  /// After each step, when the Config has followed.
  virtual void hasStepped(Simulation& simulation) = 0;
};

}  // namespace kinegraph
