#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/simulation/simulation_options.h"
#include "kinegraph/simulation/simulation_state.h"

namespace kinegraph {

/// Steps many simulations of one scene in parallel threads. Environment i behaves like a Simulation with the same
/// calls, bit for bit, for any number of threads. The Config is copied: it is not changed, and later changes of it have
/// no effect.
class SimulationBatch {
 public:
  /// Throws the errors of Simulation, and ValueError for less than one environment or thread.
  SimulationBatch(const Config& config, int count, int threads = 1, SimulationEngine engine = SimulationEngine::physx,
                  const SimulationOptions& options = {});
  ~SimulationBatch();
  SimulationBatch(SimulationBatch&&) noexcept;
  SimulationBatch& operator=(SimulationBatch&&) noexcept;

  int size() const;
  int dofs() const;  ///< n, of q
  std::vector<std::string> freeFrames() const;

  /// Advances all environments by `repeat` steps of `tau` s; row i of `u` (size x n) controls environment i.
  /// `cancellation` is checked repeatedly on the calling thread and may throw. Throws ValueError for a matrix of wrong
  /// shape, before any change. An environment that diverges keeps its previous state; Error names it after all others
  /// have stepped.
  void step(const MatrixXd& u = {}, double tau = .01, ControlMode mode = ControlMode::none, int repeat = 1,
            const CancellationToken& cancellation = {});

  VectorXd times() const;           ///< s
  MatrixXd q() const;               ///< size x n
  MatrixXd qDot() const;            ///< size x n
  MatrixXd freePoses() const;       ///< size x 7F, concatenated free frames
  MatrixXd freeVelocities() const;  ///< size x 6F

  SimulationState getState(int environment) const;
  void setState(int environment, const SimulationState& state);

  /// Resets environments to the initial Config. This and all calls below throw ValueError for unknown environments.
  void reset(const std::vector<int>& environments);

  /// Sets joints (a row of `q` each) and free frames (a row of `poses`, 7F; empty: unchanged) at rest.
  void place(const std::vector<int>& environments, const MatrixXd& q, const MatrixXd& poses = {});

  /// Like Simulation::closeGripper, with a width (m) per environment.
  void closeGrippers(const std::string& gripper, const VectorXd& widths, double speed = .3, double force = 20.);

  /// Sets the mass (kg, > 0) of a frame's free body or link per environment; its inertia scales with the mass.
  void setMasses(const std::string& frame, const VectorXd& masses);

  /// Sets the friction (>= 0) of the shape of a frame with the attribute `friction`, per environment.
  void setFrictions(const std::string& frame, const VectorXd& frictions);

 private:
  struct Impl;
  Held<std::unique_ptr<Impl>> impl_;
};

}  // namespace kinegraph
