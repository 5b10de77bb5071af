#pragma once

namespace kinegraph {

class Simulation;

/// Observes the steps of a simulation, and may delay them or change the simulation in between.
struct SimulationObserver {
  virtual ~SimulationObserver() = default;

  /// Called before each step. Returns false to delay it: the caller then calls `rest` and asks again.
  virtual bool mayStep(Simulation& simulation) = 0;

  /// Waits for at most 20 ms. May throw to prevent the step.
  virtual void rest() = 0;

  /// Called after each step, when the Config is up to date.
  virtual void afterStep(Simulation& simulation) = 0;
};

}  // namespace kinegraph
