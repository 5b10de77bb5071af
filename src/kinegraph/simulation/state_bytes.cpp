#include "kinegraph/simulation/state_bytes.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "kinegraph/common/errors.h"

namespace kinegraph::inline simulation_internal {

namespace {

constexpr std::uint64_t kMark = 0x33305453474b;          // "KGST03"
constexpr std::uint64_t kMarkAllAwake = 0x32305453474b;  // "KGST02": states before bodies could sleep

class StateWriter {
 public:
  template <class T>
  void operator()(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class T>
  void operator()(const std::vector<T>& values) {
    (*this)(std::uint64_t(values.size()));
    for (const T& value : values) (*this)(value);
  }
  void numbers(const double* values, std::ptrdiff_t rows, std::ptrdiff_t columns) {
    (*this)(std::int64_t(rows));
    (*this)(std::int64_t(columns));
    bytes.append(reinterpret_cast<const char*>(values), std::size_t(rows * columns) * sizeof(double));
  }
  std::string bytes;
};

class StateReader {
 public:
  explicit StateReader(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  void operator()(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::memcpy(&value, take(sizeof value), sizeof value);
  }
  template <class T>
  void operator()(std::vector<T>& values) {
    std::uint64_t size = 0;
    (*this)(size);
    if (size > bytes_.size() / sizeof(T)) fail();
    values.resize(std::size_t(size));
    for (T& value : values) (*this)(value);
  }
  MatrixXd numbers() {
    std::int64_t rows = 0, columns = 0;
    (*this)(rows);
    (*this)(columns);
    const auto max_count = std::int64_t(bytes_.size() / sizeof(double));
    if (rows < 0 || columns < 0 || rows > max_count || columns > max_count || rows * columns > max_count) fail();
    MatrixXd result(rows, columns);
    const std::size_t size = std::size_t(rows * columns) * sizeof(double);
    if (size > 0) std::memcpy(result.data(), take(size), size);
    return result;
  }
  bool isDone() const { return bytes_.empty(); }
  [[noreturn]] static void fail() {
    throw ValueError("Simulation.setState: the bytes are not a state from getState of this version");
  }

 private:
  const char* take(std::size_t size) {
    if (size > bytes_.size()) fail();
    const char* start = bytes_.data();
    bytes_.remove_prefix(size);
    return start;
  }
  std::string_view bytes_;
};

/// The numbers of a pose, because Eigen's types cannot be copied as bytes.
struct WeldBytes {
  int body_a, body_b, active, unused;
  double pose[7];
};

struct SpringBytes {
  std::int64_t body;
  double point[3], target[3];
};

/// Returns whether each tree is awake (negative) or points to the next one of its cycle of sleeping trees.
bool areSleepCycles(const std::vector<int>& sleep, std::size_t trees) {
  if (sleep.size() != trees) return false;
  std::vector<char> is_next(trees, false);
  for (const int next : sleep) {
    if (next < 0) continue;
    if (std::size_t(next) >= trees || sleep[std::size_t(next)] < 0 || is_next[std::size_t(next)]) return false;
    is_next[std::size_t(next)] = true;
  }
  return true;
}

}  // namespace

std::string stateToBytes(const WorldState& state) {
  StateWriter write;
  write(kMark);
  write(state.physics);
  write(state.sleep);
  const Reference::Parts parts = state.reference.parts();
  write(parts.dofs);
  write(parts.courses);
  write(parts.next);
  write.numbers(parts.torque.data(), parts.torque.size(), 1);
  write(parts.clock);
  const BSpline& spline = state.reference.spline;
  write(spline.degree());
  write.numbers(spline.getKnots().data(), spline.getKnots().size(), 1);
  write.numbers(spline.getCtrlPoints().data(), spline.getCtrlPoints().rows(), spline.getCtrlPoints().cols());
  write(state.reference.spline_start);
  write(state.grippers);
  std::vector<WeldBytes> welds;
  for (const WeldedPair& pair : state.welds) {
    WeldBytes weld{pair.body_a, pair.body_b, pair.active, 0, {}};
    const Vector7d pose = pair.X_AB.numbers();
    std::memcpy(weld.pose, pose.data(), sizeof weld.pose);
    welds.push_back(weld);
  }
  write(welds);
  SpringBytes spring{state.perturbation.body, {}, {}};
  std::copy_n(state.perturbation.point.data(), 3, spring.point);
  std::copy_n(state.perturbation.target.data(), 3, spring.target);
  write(spring);
  return std::move(write.bytes);
}

WorldState stateFromBytes(std::string_view bytes, const World& world) {
  StateReader read(bytes);
  std::uint64_t mark = 0;
  read(mark);
  if (mark != kMark && mark != kMarkAllAwake) StateReader::fail();
  const WorldState now = world.state();
  WorldState state = now;
  read(state.physics);
  state.sleep.clear();
  if (mark == kMark) read(state.sleep);
  Reference::Parts parts;
  read(parts.dofs);
  read(parts.courses);
  read(parts.next);
  parts.torque = read.numbers();
  read(parts.clock);
  int degree = 0;
  read(degree);
  const VectorXd knots = read.numbers();
  const MatrixXd points = read.numbers();
  const BSpline spline = points.size() == 0 ? BSpline() : BSpline::fromParts(degree, knots, points);
  read(state.reference.spline_start);
  read(state.grippers);
  std::vector<WeldBytes> welds;
  read(welds);
  SpringBytes spring{};
  read(spring);
  if (!read.isDone()) StateReader::fail();
  if (parts.dofs.size() != now.reference.dofs().size() || state.grippers.size() != now.grippers.size() ||
      welds.size() != now.welds.size())
    throw ValueError("Simulation.setState: the state belongs to a scene with other joints or free frames");
  if (state.physics.size() != now.physics.size())
    throw ValueError(
        "Simulation.setState: the state has another number of bodies: it belongs to another scene, or was taken before "
        "addForceTorqueSensor; take states after the sensors are added");
  if (mark == kMark && !areSleepCycles(state.sleep, now.sleep.size())) StateReader::fail();
  state.reference.setParts(parts);
  state.reference.spline = spline;
  const int bodies = int(world.scene().scene.bodies.size());
  if (spring.body < 0 || spring.body >= bodies) StateReader::fail();
  state.perturbation = {int(spring.body), Vector3d(spring.point), Vector3d(spring.target)};
  for (std::size_t i = 0; i < welds.size(); ++i) {
    const WeldBytes& weld = welds[i];
    if (weld.body_a < 0 || weld.body_b < 0 || weld.body_a >= bodies || weld.body_b >= bodies) StateReader::fail();
    const Eigen::Map<const Vector7d> pose(weld.pose);
    state.welds[i] = {weld.body_a, weld.body_b, Pose(pose.head<3>(), Quaterniond(pose[3], pose[4], pose[5], pose[6])),
                      weld.active != 0};
  }
  return state;
}

}  // namespace kinegraph::inline simulation_internal
