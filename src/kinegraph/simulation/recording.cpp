#include "kinegraph/simulation/simulation_data.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <sstream>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/scene/tree/scene_bytes.h"
#include "kinegraph/simulation/simulation_impl.h"

namespace kinegraph {

namespace {

constexpr char kRecordingMark[] = "kinegraph recording 2\n";
using CallKind = Recording::Call::Kind;

class RecordWriter {
 public:
  void number(double value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); }
  void count(std::size_t value) {
    const auto wide = std::uint64_t(value);
    bytes.append(reinterpret_cast<const char*>(&wide), sizeof wide);
  }
  void text(const std::string& value) {
    count(value.size());
    bytes += value;
  }
  void matrix(const MatrixXd& value) {
    count(std::size_t(value.rows()));
    count(std::size_t(value.cols()));
    bytes.append(reinterpret_cast<const char*>(value.data()), std::size_t(value.size()) * sizeof(double));
  }
  void state(const SimulationState& s) {
    number(s.time);
    matrix(s.q);
    matrix(s.qDot);
    matrix(s.freePos);
    matrix(s.freeVel);
    text(s.remainder);
  }
  std::string bytes = kRecordingMark;
};

class RecordReader {
 public:
  explicit RecordReader(const std::string& bytes) : bytes_(bytes) {
    const std::string_view mark = kRecordingMark;
    if (bytes.compare(0, mark.size(), mark) != 0) fail();
    at_ = mark.size();
  }
  double number() {
    double value = 0.;
    std::memcpy(&value, take(sizeof value), sizeof value);
    return value;
  }
  std::size_t count() {
    std::uint64_t value = 0;
    std::memcpy(&value, take(sizeof value), sizeof value);
    if (value > bytes_.size()) fail();
    return std::size_t(value);
  }
  std::string text() {
    const std::size_t size = count();
    return {take(size), size};
  }
  MatrixXd matrix() {
    const std::size_t rows = count(), columns = count();
    if (columns > 0 && rows > bytes_.size() / columns / sizeof(double)) fail();
    MatrixXd value(rows, columns);
    const std::size_t size = rows * columns * sizeof(double);
    if (size > 0) std::memcpy(value.data(), take(size), size);
    return value;
  }
  SimulationState state() {
    SimulationState s;
    s.time = number();
    s.q = matrix().reshaped();
    s.qDot = matrix().reshaped();
    s.freePos = matrix();
    s.freeVel = matrix();
    s.remainder = text();
    return s;
  }
  [[noreturn]] static void fail() { throw ValueError("Recording: the bytes are not a recording of this version"); }

 private:
  const char* take(std::size_t size) {
    if (size > bytes_.size() - at_) fail();
    at_ += size;
    return bytes_.data() + at_ - size;
  }
  const std::string& bytes_;
  std::size_t at_ = 0;
};

void repeatCall(Simulation& simulation, const Recording::Call& call) {
  const std::vector<double>& n = call.numbers;
  const auto vector = [&](std::size_t from, std::size_t size) -> VectorXd {
    return Eigen::Map<const VectorXd>(n.data() + from, long(size));
  };
  switch (call.kind) {
    case CallKind::step:
      return simulation.step(vector(2, n.size() - 2), n[0], ControlMode(int(n[1])));
    case CallKind::gripper:
      return simulation.closeGripper(call.names[0], n[0], n[1], n[2]);
    case CallKind::attach:
      return simulation.attach(call.names[0], call.names[1]);
    case CallKind::detach:
      return simulation.detach(call.names[0], call.names[1]);
    case CallKind::spline: {
      const auto rows = std::size_t(n[1]), columns = std::size_t(n[2]), times = n.size() - 3 - rows * columns;
      const MatrixXd path = vector(3, rows * columns).reshaped(long(rows), long(columns));
      return simulation.setSplineRef(path, vector(3 + rows * columns, times), n[0] != 0.);
    }
    case CallKind::reset_spline:
      return simulation.resetSplineRef(n[0]);
    case CallKind::reset_time:
      return simulation.resetTime(n[0]);
    case CallKind::set_state:
      return simulation.setState(RecordReader(call.names[0]).state());
    case CallKind::apply_force:
      return simulation.applyForce(call.names[0], vector(0, 3), vector(3, 3),
                                   n.size() > 6 ? std::optional<Vector3d>(vector(6, 3)) : std::nullopt);
    case CallKind::clear_forces:
      return simulation.clearForces();
    case CallKind::perturb:
      return simulation.perturb(call.names[0], vector(0, 3), vector(3, 3));
    case CallKind::end_perturbation:
      return simulation.endPerturbation();
  }
}

}  // namespace

std::string Recording::toBytes() const {
  RecordWriter write;
  write.text(scene);
  write.count(std::size_t(engine));
  for (const auto& row : simulationOptionTable().rows()) {
    std::visit(
        [&](auto member) {
          if constexpr (std::is_arithmetic_v<std::decay_t<decltype(options.*member)>>)
            write.number(double(options.*member));
        },
        row.member);
  }
  write.state(start);
  write.state(end);
  write.count(calls.size());
  for (const Call& call : calls) {
    write.count(std::size_t(call.kind));
    write.matrix(Eigen::Map<const VectorXd>(call.numbers.data(), long(call.numbers.size())));
    write.count(call.names.size());
    for (const std::string& name : call.names) write.text(name);
  }
  write.count(times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    write.number(times[i]);
    write.matrix(q[i]);
    write.matrix(freePos[i]);
    write.matrix(motions[i]);
  }
  write.count(is_cut);
  return std::move(write.bytes);
}

Recording Recording::fromBytes(const std::string& bytes) {
  RecordReader read(bytes);
  Recording made;
  made.scene = read.text();
  made.engine = SimulationEngine(int(read.count()));
  for (const auto& row : simulationOptionTable().rows()) {
    std::visit(
        [&](auto member) {
          using Value = std::decay_t<decltype(made.options.*member)>;
          if constexpr (std::is_arithmetic_v<Value>) made.options.*member = Value(read.number());
        },
        row.member);
  }
  made.start = read.state();
  made.end = read.state();
  for (std::size_t left = read.count(); left > 0; --left) {
    Call call;
    const std::size_t kind = read.count();
    if (kind > std::size_t(CallKind::end_perturbation)) RecordReader::fail();
    call.kind = CallKind(int(kind));
    const MatrixXd numbers = read.matrix();
    call.numbers.assign(numbers.data(), numbers.data() + numbers.size());
    for (std::size_t names = read.count(); names > 0; --names) call.names.push_back(read.text());
    made.calls.push_back(std::move(call));
  }
  for (std::size_t left = read.count(); left > 0; --left) {
    made.times.push_back(read.number());
    made.q.emplace_back(read.matrix().reshaped());
    made.freePos.push_back(read.matrix());
    made.motions.emplace_back(read.matrix().reshaped());
  }
  made.is_cut = read.count() != 0;
  return made;
}

void Recording::save(const std::string& path) const {
  std::ofstream file(path, std::ios::binary);
  const std::string bytes = toBytes();
  file.write(bytes.data(), std::streamsize(bytes.size()));
  if (!file.flush()) throw FileError(cat("Recording.save: '", path, "' cannot be written"));
}

Recording Recording::load(const std::string& path) {
  const std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(cat("Recording.load: '", path, "' cannot be read"));
  std::ostringstream all;
  all << file.rdbuf();
  return fromBytes(all.str());
}

Config Recording::makeConfig() const { return Config(sceneFromBytes(scene)); }

std::vector<std::vector<Pose>> Recording::framePoses(const std::vector<std::size_t>& steps) const {
  Config config = makeConfig();
  Simulation simulation(config, engine, options);
  std::vector<std::vector<Pose>> poses;
  for (const std::size_t step : steps) {
    if (step >= motions.size())
      throw ValueError(cat("Recording: there is no step ", step, "; number of steps: ", motions.size()));
    simulation.show(motions[step]);
    std::vector<Pose>& all = poses.emplace_back();
    for (int i = 0; i < config.getFrameDimension(); ++i) all.emplace_back(config.state().pose(i));
  }
  return poses;
}

Simulation Recording::replay(Config& config) const {
  Simulation simulation(config, engine, options);
  simulation.setState(start);
  for (const Call& call : calls) repeatCall(simulation, call);
  if (!(simulation.getState() == end))
    throw Error(
        "Recording.replay: the run ends in another state than recorded; the recording may come from another version or "
        "machine");
  return simulation;
}

void Simulation::show(const VectorXd& motions) {
  World& world = *impl_->world;
  if (motions.size() != world.model().nq) throw ValueError("Recording: its states do not fit its scene");
  std::copy_n(motions.data(), motions.size(), world.positions());
  publish();
}

void Simulation::startRecording() {
  update();
  auto begun = std::make_unique<Recording>();
  begun->scene = sceneToBytes(*impl_->config.scene());
  begun->engine = impl_->engine;
  begun->options = impl_->options;
  begun->start = getState();
  impl_->recording = std::move(begun);
}

bool Simulation::isRecording() const { return impl_->recording && !impl_->recording->is_cut; }

Recording Simulation::stopRecording() {
  if (!impl_->recording) throw ValueError("Simulation.stopRecording: startRecording was not called");
  if (!impl_->recording->is_cut) impl_->recording->end = getState();
  Recording done = std::move(*impl_->recording);
  impl_->recording.reset();
  return done;
}

void Simulation::Impl::record(CallKind kind, std::vector<double> numbers, std::vector<std::string> names) {
  if (recording && !recording->is_cut) recording->calls.push_back({kind, std::move(numbers), std::move(names)});
}

void Simulation::Impl::recordState(const SimulationState& state) {
  if (!recording || recording->is_cut) return;
  RecordWriter write;
  write.state(state);
  record(CallKind::set_state, {}, {write.bytes});
}

void Simulation::Impl::recordPoses() {
  if (!recording || recording->is_cut) return;
  recording->times.push_back(world->time());
  recording->q.push_back(q());
  recording->freePos.push_back(freePoses());
  recording->motions.emplace_back(Eigen::Map<const VectorXd>(world->positions(), world->model().nq));
}

}  // namespace kinegraph
