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

/// Many simulations of one scene, stepped by threads. Environment i does the same as a Simulation that gets the same calls, bit
/// for bit, at any number of threads. The Config is not changed, and later changes of it do not count.
class SimulationBatch {
 public:
  /// Throws as Simulation, and ValueError for less than one environment or thread.
  SimulationBatch(const Config& config, int count, int threads = 1, SimulationEngine engine = SimulationEngine::physx,
                  const SimulationOptions& options = {});
  ~SimulationBatch();
  SimulationBatch(SimulationBatch&&) noexcept;
  SimulationBatch& operator=(SimulationBatch&&) noexcept;

  int size() const;
  int dofs() const;  ///< n, of q
  std::vector<std::string> freeFrames() const;

  /// All environments go on by `tau` s in `repeat` steps; a row of `u` (size x n) for each. `cancellation` is called now and then on
  /// the calling thread and may throw. Throws ValueError for a matrix that does not fit; nothing has changed then. Where numbers
  /// of an environment leave all bounds, it stays as it was before, and Error says which one after all others have stepped.
  void step(const MatrixXd& u = {}, double tau = .01, ControlMode mode = ControlMode::none, int repeat = 1,
            const CancellationToken& cancellation = {});

  VectorXd times() const;           ///< s
  MatrixXd q() const;               ///< size x n
  MatrixXd qDot() const;            ///< size x n
  MatrixXd freePoses() const;       ///< size x 7F, free frames one after the other
  MatrixXd freeVelocities() const;  ///< size x 6F

  SimulationState getState(int environment) const;
  void setState(int environment, const SimulationState& state);

  /// Back to how the Config was. Throws ValueError for numbers that are no environments; so do all calls below.
  void reset(const std::vector<int>& environments);

  /// Puts joints (a row of `q` each) and free frames (of `poses`, 7F; empty: they stay) somewhere else, at rest.
  void place(const std::vector<int>& environments, const MatrixXd& q, const MatrixXd& poses = {});

  /// As Simulation::closeGripper, with a width (m) for each environment.
  void closeGrippers(const std::string& gripper, const VectorXd& widths, double speed = .3, double force = 20.);

  /// Other masses (kg, > 0) for the free frame or link of a frame, one for each environment; its inertia grows with it.
  void setMasses(const std::string& frame, const VectorXd& masses);

  /// Other frictions (>= 0) of the shape of a frame with the attribute `friction`, one for each environment.
  void setFrictions(const std::string& frame, const VectorXd& frictions);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kinegraph
