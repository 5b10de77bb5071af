#include "kinegraph/simulation/simulation.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/parallel.h"
#include "kinegraph/common/text.h"
#include "kinegraph/rendering/mujoco.h"
#include "kinegraph/simulation/simulation_impl.h"

namespace kinegraph {

struct SimulationBatch::Impl {
  Config config;  ///< a copy
  int threads;
  std::vector<std::unique_ptr<Simulation>> environments;
  WorldState start;

  World& world(int i) const { return *environments[std::size_t(i)]->impl_->world; }
  const Simulation::Impl& first() const { return *environments.front()->impl_; }

  void check(const std::vector<int>& numbers, const char* call) const {
    for (const int i : numbers) {
      if (i < 0 || i >= int(environments.size()))
        throw ValueError(cat(call, ": there is no environment ", i, "; they are 0 to ", environments.size() - 1));
    }
  }
  std::vector<int> all() const {
    std::vector<int> numbers(environments.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
  }
  void checkSize(const char* call, const char* what, const VectorXd& values, double minimum, bool inclusive) const {
    if (values.size() != long(environments.size()))
      throw ValueError(cat(call, ": ", what, " has ", values.size(), " entries; expected ", environments.size()));
    for (const double value : values) {
      if (!std::isfinite(value) || value < minimum || (value == minimum && !inclusive))
        throw ValueError(
            cat(call, ": ", what, " has ", value, "; expected a finite number ", inclusive ? ">= " : "> ", minimum));
    }
  }
  void perform(const std::function<void(int)>& work, const CancellationToken& cancellation) const {
    const int part = std::max(1, int(environments.size()) / (8 * threads));
    parallelFor(
        int(environments.size()), part, threads,
        [&](int, int from, int to) {
          for (int i = from; i < to; ++i) work(i);
        },
        cancellation);
  }
};

SimulationBatch::SimulationBatch(const Config& config, int count, int threads, SimulationEngine engine,
                                 const SimulationOptions& options)
    : impl_("SimulationBatch", std::make_unique<Impl>()) {
  if (count < 1 || count > 1000000)
    throw ValueError(cat("SimulationBatch: ", count, " environments; expected 1 to 1000000"));
  if (threads < 1 || threads > 1024)
    throw ValueError(cat("SimulationBatch: ", threads, " threads; expected 1 to 1024"));
  impl_->config = config;
  impl_->threads = threads;
  impl_->environments.emplace_back(
      new Simulation(std::make_unique<Simulation::Impl>(impl_->config, engine, options, true)));
  impl_->start = impl_->world(0).state();
  for (int i = 1; i < count; ++i)
    impl_->environments.push_back(std::make_unique<Simulation>(*impl_->environments.front(), Simulation::SameModel{}));
}
SimulationBatch::~SimulationBatch() = default;
SimulationBatch::SimulationBatch(SimulationBatch&&) noexcept = default;
SimulationBatch& SimulationBatch::operator=(SimulationBatch&&) noexcept = default;

int SimulationBatch::size() const { return int(impl_->environments.size()); }
int SimulationBatch::dofs() const { return impl_->world(0).scene().dofs; }

std::vector<std::string> SimulationBatch::freeFrames() const {
  std::vector<std::string> names;
  for (const int id : impl_->world(0).scene().free_frames)
    names.push_back(impl_->first().frames[std::size_t(id)]->name);
  return names;
}

void SimulationBatch::step(const MatrixXd& u, double tau, ControlMode mode, int repeat,
                           const CancellationToken& cancellation) {
  const char* call = "SimulationBatch.step";
  if (repeat < 1) throw ValueError(cat(call, ": repeat is ", repeat, "; expected at minimum 1"));
  const int columns = controlSize(mode, dofs());
  if (columns == 0 ? u.size() != 0 : u.rows() != size() || u.cols() != columns)
    throw ValueError(cat(call, ": u has shape (", u.rows(), ", ", u.cols(), "); mode ", controlModeName(mode),
                         " takes ", columns == 0 ? "none" : cat("(", size(), ", ", columns, ")")));
  for (int i = 0; i < (columns == 0 ? 1 : size()); ++i)
    impl_->world(i).checkCommand(columns == 0 ? VectorXd() : VectorXd(u.row(i)), tau, mode);
  std::mutex mutex;
  int bad = size();
  std::string reason;
  impl_->perform(
      [&](int i) {
        try {
          const VectorXd row = columns == 0 ? VectorXd() : VectorXd(u.row(i));
          for (int k = 0; k < repeat; ++k) impl_->world(i).step(row, tau, mode);
        } catch (const Error& error) {
          const std::lock_guard lock(mutex);
          if (i < bad) {
            bad = i;
            reason = error.what();
          }
        }
      },
      cancellation);
  if (bad < size()) throw Error(cat(call, ": environment ", bad, ": ", reason));
}

VectorXd SimulationBatch::times() const {
  VectorXd all(size());
  for (int i = 0; i < size(); ++i) all[i] = impl_->world(i).time();
  return all;
}

MatrixXd SimulationBatch::q() const {
  MatrixXd all(size(), dofs());
  for (int i = 0; i < size(); ++i) all.row(i) = impl_->environments[std::size_t(i)]->get_q().transpose();
  return all;
}

MatrixXd SimulationBatch::qDot() const {
  MatrixXd all(size(), dofs());
  for (int i = 0; i < size(); ++i) all.row(i) = impl_->environments[std::size_t(i)]->get_qDot().transpose();
  return all;
}

MatrixXd SimulationBatch::freePoses() const {
  MatrixXd all(size(), 7 * long(impl_->world(0).scene().free_frames.size()));
  for (int i = 0; i < size(); ++i)
    all.row(i) = impl_->environments[std::size_t(i)]->impl_->freePoses().reshaped<Eigen::RowMajor>().transpose();
  return all;
}

MatrixXd SimulationBatch::freeVelocities() const {
  MatrixXd all(size(), 6 * long(impl_->world(0).scene().free_frames.size()));
  for (int i = 0; i < size(); ++i)
    all.row(i) = impl_->environments[std::size_t(i)]->impl_->freeVelocities().reshaped<Eigen::RowMajor>().transpose();
  return all;
}

SimulationState SimulationBatch::getState(int environment) const {
  impl_->check({environment}, "SimulationBatch.getState");
  return impl_->environments[std::size_t(environment)]->getState();
}

void SimulationBatch::setState(int environment, const SimulationState& state) {
  impl_->check({environment}, "SimulationBatch.setState");
  impl_->environments[std::size_t(environment)]->restore(state);
}

void SimulationBatch::reset() { reset(impl_->all()); }

void SimulationBatch::reset(const std::vector<int>& environments) {
  impl_->check(environments, "SimulationBatch.reset");
  for (const int i : environments) impl_->world(i).setState(impl_->start);
}

void SimulationBatch::place(std::nullopt_t, const MatrixXd& q, const MatrixXd& poses) { place(impl_->all(), q, poses); }

void SimulationBatch::place(const std::vector<int>& environments, const MatrixXd& q, const MatrixXd& poses) {
  const char* call = "SimulationBatch.place";
  impl_->check(environments, call);
  if (environments.empty()) return;
  const auto rows = long(environments.size());
  const auto free = long(impl_->world(0).scene().free_frames.size());
  if (q.rows() != rows || q.cols() != dofs() || !q.allFinite())
    throw ValueError(cat(call, ": q has shape (", q.rows(), ", ", q.cols(), "); expected finite numbers (", rows, ", ",
                         dofs(), ")"));
  if (poses.size() > 0 && (poses.rows() != rows || poses.cols() != 7 * free || !poses.allFinite()))
    throw ValueError(cat(call, ": poses has shape (", poses.rows(), ", ", poses.cols(), "); expected finite numbers (",
                         rows, ", ", 7 * free, ")"));
  for (long i = 0; i < rows; ++i) {
    Simulation::Impl& s = *impl_->environments[std::size_t(environments[std::size_t(i)])]->impl_;
    World& world = *s.world;
    s.setJoints(q.row(i).transpose(), nullptr);
    for (long f = 0; f < (poses.size() > 0 ? free : 0); ++f)
      writeFreePose(Pose::fromNumbers(poses.row(i).segment<7>(7 * f).transpose()),
                    world.positions() + world.scene().free_qpos[std::size_t(f)]);
    std::fill_n(world.velocities(), world.model().nv, 0.);
    world.settle();
    world.forgetForces();
  }
}

void SimulationBatch::closeGrippers(const std::string& gripper, const VectorXd& widths, double speed, double force) {
  impl_->checkSize("SimulationBatch.closeGrippers", "widths", widths, 0., true);
  for (int i = 0; i < size(); ++i) impl_->environments[std::size_t(i)]->closeGripper(gripper, widths[i], speed, force);
}

void SimulationBatch::setMasses(const std::string& frame, const VectorXd& masses) {
  const char* call = "SimulationBatch.setMasses";
  impl_->checkSize(call, "masses", masses, 0., false);
  const int body = impl_->first().body(frame, call);
  if (body == 0) throw ValueError(cat(call, ": frame '", frame, "' is fixed to the world: its mass has no effect"));
  const int id = impl_->world(0).scene().body_id[std::size_t(body)];
  const MujocoErrors thrown;
  for (int i = 0; i < size(); ++i) {
    World& world = impl_->world(i);
    mjModel& m = world.editModel();
    const double factor = masses[i] / m.body_mass[id];
    m.body_mass[id] = masses[i];
    for (int k = 0; k < 3; ++k) m.body_inertia[3 * id + k] *= factor;
    world.constantsChanged();
  }
}

void SimulationBatch::setFrictions(const std::string& frame, const VectorXd& frictions) {
  const char* call = "SimulationBatch.setFrictions";
  impl_->checkSize(call, "frictions", frictions, 0., true);
  const int id = impl_->first().frame(frame, call).id;
  const std::vector<int>& geom_frame = impl_->world(0).scene().geom_frame;
  if (std::find(geom_frame.begin(), geom_frame.end(), id) == geom_frame.end())
    throw ValueError(cat(call, ": frame '", frame, "' has no shape that collides"));
  if (!impl_->first().frame(frame, call).attributes->find("friction"))
    throw ValueError(
        cat(call, ": frame '", frame, "' has no attribute friction; only frames with this attribute can be changed"));
  for (int i = 0; i < size(); ++i) impl_->world(i).setFriction(id, frictions[i]);
}

}  // namespace kinegraph
