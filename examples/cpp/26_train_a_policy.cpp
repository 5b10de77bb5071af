// Part 26: a policy learns to push a box to the center of a table, in many simulations at once. The cross-entropy
// method finds its ten weights. The environment variable GENERATIONS=5 shortens the training.
#include <kinegraph/kinegraph.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <numeric>
#include <optional>

using namespace kinegraph;
using Weights = Eigen::Matrix<double, 10, 1>;

namespace {

constexpr int kSamples = 32, kElite = 6, kEpisodes = 4;  // sampled and selected weights; episodes per sample
constexpr int kSteps = 40;                               // decisions in an episode
constexpr double kTau = .1, kNear = .05, kFastest = .3;  // their period, s; m from the center; m/s

struct Start {
  Vector3d finger, box;
};

/// Returns the velocity of the finger, symmetric about the line from the box to the center.
Vector3d policy(const Weights& weights, const Vector3d& finger, const Vector3d& box) {
  const double distance = box.norm() + 1e-9;
  const Vector3d along = -box / distance, left(-along.y(), along.x(), 0);
  const double ahead = (finger - box).dot(along), aside = (finger - box).dot(left);
  const std::array<double, 5> seen{10 * ahead, 10 * std::abs(aside), std::exp(-std::abs(aside) / .03), 10 * distance,
                                   1};
  double forward = 0, sideward = 0;
  for (int i = 0; i < 5; ++i) forward += seen[i] * weights[2 * i], sideward += seen[i] * weights[2 * i + 1];
  return kFastest * (std::tanh(forward) * along + (aside < 0 ? -1 : 1) * std::tanh(sideward) * left);
}

Vector3d around(const Vector3d& middle, double low, double high, Rng& rng) {
  const double angle = rng.uniform(-M_PI, M_PI), radius = rng.uniform(low, high);
  return middle + radius * Vector3d(std::cos(angle), std::sin(angle), 0);
}

Start randomStart(Rng& rng) {
  const Vector3d box = around(Vector3d::Zero(), .15, .3, rng);
  return {around(box, .12, .25, rng), box};
}

struct Episode {
  double reward = 0;    // mean over the steps
  double distance = 0;  // of the box from the center at the end, m
};

/// Runs one episode per environment.
std::vector<Episode> play(SimulationBatch& batch, const std::vector<Weights>& weights,
                          const std::vector<Start>& starts) {
  const int count = batch.size();
  MatrixXd q(count, 2), poses(count, 7), u(count, 2);
  for (int i = 0; i < count; ++i) {
    q.row(i) = starts[i].finger.head<2>().transpose();
    poses.row(i) << starts[i].box.x(), starts[i].box.y(), .03, 1, 0, 0, 0;
  }
  batch.place(std::nullopt, q, poses);
  std::vector<Episode> episodes(count);
  for (int step = 0; step < kSteps; ++step) {
    for (int i = 0; i < count; ++i) {
      const Vector3d finger(q(i, 0), q(i, 1), 0), box(poses(i, 0), poses(i, 1), 0);
      u.row(i) = policy(weights[i], finger, box).head<2>().transpose();
    }
    batch.step(u, kTau, ControlMode::velocity);
    q = batch.q(), poses = batch.freePoses();
    for (int i = 0; i < count; ++i) {
      const double to_finger = (poses.row(i).head<2>() - q.row(i)).norm();
      episodes[i].distance = poses.row(i).head<2>().norm();
      episodes[i].reward -= (episodes[i].distance + .2 * to_finger) / kSteps;
    }
  }
  return episodes;
}

/// Returns the share of 100 new episodes, in %, that end near the center.
double success(const Config& C, const SimulationOptions& options, const Weights& weights, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Start> starts(100);
  for (Start& start : starts) start = randomStart(rng);
  SimulationBatch batch(C, 100, 2, SimulationEngine::physx, options);
  int near = 0;
  for (const Episode& episode : play(batch, std::vector<Weights>(100, weights), starts)) {
    near += episode.distance < kNear;
  }
  return near;
}

Weights drawn(const Weights& mean, const Weights& spread, Rng& rng) {
  Weights weights;
  for (int i = 0; i < 10; ++i) weights[i] = mean[i] + spread[i] * rng.normal();
  return weights;
}

}  // namespace

int main() try {
  Config C;
  C.addFrame("table").setShape(ST::box, {1.6, 1.6, .1}).setPosition({0, 0, -.05}).setContact(1);
  C.addFrame("base").setPosition({0, 0, .03});
  Frame finger = C.addFrame("finger", "base").setJoint(JT::transXY, {-.7, -.7, .7, .7});
  finger.setShape(ST::sphere, {.02}).setColor({1, .5, 0}).setMass(.2).setContact(1);
  C.addFrame("box").setShape(ST::ssBox, {.08, .08, .06, .01}).setMass(.1).setContact(1);

  SimulationOptions options;  // coarse steps are enough to push
  options.inner_step = .01;
  options.servo_frequency = 50;

  const char* const asked = std::getenv("GENERATIONS");
  const int generations = asked ? std::atoi(asked) : 20;
  Rng rng(0);
  Weights mean = Weights::Zero(), spread = Weights::Ones();
  const double before = success(C, options, drawn(mean, spread, rng), 1000);
  SimulationBatch batch(C, kSamples * kEpisodes, 2, SimulationEngine::physx, options);
  for (int generation = 0; generation < generations; ++generation) {
    std::array<Start, kEpisodes> starts;  // common to all samples, for a fair comparison
    for (Start& start : starts) start = randomStart(rng);
    std::vector<Weights> samples(kSamples), weights;
    std::vector<Start> all;
    for (Weights& sample : samples) {
      sample = drawn(mean, spread, rng);
      weights.insert(weights.end(), kEpisodes, sample);
      all.insert(all.end(), starts.begin(), starts.end());
    }
    const std::vector<Episode> episodes = play(batch, weights, all);
    std::vector<double> gained(kSamples, 0);
    for (int i = 0; i < kSamples * kEpisodes; ++i) gained[i / kEpisodes] += episodes[i].reward / kEpisodes;
    std::vector<int> best(kSamples);
    std::iota(best.begin(), best.end(), 0);
    std::stable_sort(best.begin(), best.end(), [&](int a, int b) { return gained[a] > gained[b]; });
    best.resize(kElite);
    mean.setZero(), spread.setZero();
    for (const int i : best) mean += samples[i] / kElite;
    for (const int i : best) spread += (samples[i] - mean).cwiseAbs2() / kElite;
    spread = spread.cwiseSqrt().array() + .5 * std::pow(.85, generation);
    const double reward = std::accumulate(gained.begin(), gained.end(), 0.) / kSamples;
    std::cout << "generation " << generation + 1 << ": mean reward " << reward << "\n";
  }
  const double after = success(C, options, mean, 1001);
  std::cout << "within 5 cm of the center, from 100 new starts: before " << before << " %, after " << after << " %\n";
  return generations < 10 || after > 50 ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
