// The methods of Komo that need the upper rooms.
#include "kinegraph/api/komo_motion.h"
#include "kinegraph/api/solutions.h"
#include "kinegraph/common/text.h"
#include "kinegraph/komo/path/path.h"
#include "kinegraph/trajectory_optimization/motion_problems.h"
#include "kinegraph/viewer/config_viewer.h"

namespace kinegraph {

namespace {

int show(Komo& komo, const ShownMotion& motion, bool pause, const std::string& message) {
  ConfigViewer& viewer = komo.viewer();
  if (!viewer.isOpen()) viewer.setTitle("KOMO Viewer");
  return viewer.showMotion(komo.configuration(-komo.order()), motion, pause, message, [] { return false; });
}

}  // namespace

std::shared_ptr<Nlp> Komo::nlp() { return makeNlp(sharing()); }

SolverResult Komo::solve() {
  SolverOptions quiet;
  quiet.verbose = 0;
  return solve(quiet);
}

SolverResult Komo::solve(const SolverOptions& options) {
  NlpSolver solver(nlp(), options.verbose);
  solver.options = options;
  solver.setInitialization(path().variables());
  return solver.solve();
}

SolveManyResult Komo::solveFromMany(int starts, const SolveManyOptions& options, std::uint64_t seed) {
  return kinegraph::solveFromMany(sharing(), sampleStarts(*this, starts, seed), {}, options);
}

int Komo::view(bool pause, const std::string& message) {
  const std::string text = message.empty() ? cat("all ", slices() + order(), " slices") : message;
  return show(*this, motionOf(*this), pause, text);
}

int Komo::viewPlay(bool pause, const std::string& message, double seconds_per_slice) {
  ShownMotion motion = motionOf(*this);
  motion.start = ShownMotion::Start::play;
  motion.seconds = seconds_per_slice * double(motion.poses.size());
  return show(*this, motion, pause, message.empty() ? cat(motion.poses.size(), " slices") : message);
}

ConfigViewer& Komo::viewer() {
  if (!viewer_) viewer_ = std::make_shared<ConfigViewer>();
  return *viewer_;
}

SolveManyResult solveAll(std::span<Komo> problems, const SolveManyOptions& options) {
  std::vector<NlpSolver> solvers;
  std::vector<NlpSolver*> pointers;
  solvers.reserve(problems.size());
  for (Komo& komo : problems) {
    NlpSolver& solver = solvers.emplace_back(komo.nlp(), 0);
    solver.options.verbose = 0;
    solver.keeps_memory = false;  // for the next call
    solver.setInitialization(komo.path().variables());
    pointers.push_back(&solver);
  }
  return solveAll(pointers, options);
}

}  // namespace kinegraph
