#include "kinegraph/trajectory_optimization/spline_constraints.h"

#include <algorithm>

#include "kinegraph/komo/continuous_collisions.h"

namespace kinegraph::inline trajectory_optimization_internal {

namespace {

using MapEntry = Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator;

/// Groups consecutive columns: first, width.
std::vector<std::pair<int, int>> segmentsOf(std::vector<int> columns) {
  std::ranges::sort(columns);
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
  std::vector<std::pair<int, int>> segments;
  for (const int column : columns) {
    if (!segments.empty() && segments.back().first + segments.back().second == column)
      ++segments.back().second;
    else
      segments.emplace_back(column, 1);
  }
  return segments;
}

}  // namespace

SplineConstraints::SplineConstraints(const Path& path, std::shared_ptr<const SplineLayout> layout,
                                     std::vector<Objective> objectives, bool is_separate)
    : layout_(std::move(layout)),
      objectives_(std::move(objectives)),
      is_separate_(is_separate),
      tau_(path.grid().tau()),
      row_(VectorXd::Zero(layout_->lower.size())) {
  std::vector<Motion> motions;
  for (int slice = 0; slice < path.grid().slices() && !objectives_.empty(); ++slice)
    motions.push_back(motionInto(path, slice));
  motions_ = std::make_shared<const std::vector<Motion>>(std::move(motions));
  layOut(path);
}

SplineConstraints::SplineConstraints(const Path& path, const SplineConstraints& other,
                                     std::vector<Objective> objectives, bool is_separate)
    : layout_(other.layout_),
      objectives_(std::move(objectives)),
      is_separate_(is_separate),
      tau_(other.tau_),
      motions_(other.motions_),
      row_(other.row_) {
  layOut(path);
}

void SplineConstraints::layOut(const Path& path) {
  for (std::size_t o = 0; o < objectives_.size(); ++o) {
    Objective& objective = objectives_[o];
    reserveSamples(objective, is_separate_ ? kSpareSamplesPerMotion : 0);
    for (int slice = objective.from; slice <= objective.to; ++slice) {
      std::vector<CollisionSample> samples = objective.samples[std::size_t(slice - objective.from)];
      const int rows = is_separate_ ? int(samples.size()) : 1;
      terms_.push_back({int(o), slice, rows_, rows});
      samples_.emplace_back();
      setSamples(path, int(terms_.size()) - 1, std::move(samples));
      rows_ += rows;
    }
  }
}

SplineConstraints::Motion SplineConstraints::motionInto(const Path& path, int slice) const {
  Motion motion;
  std::vector<int> columns;
  const std::vector<int> all = path.dofsOf(path.initial().joint_frames, slice - 1), same = sameDofs(path, slice);
  for (const int j : layout_->splined) motion.splined.push_back(all[std::size_t(j)]);
  const auto entriesOf = [&](int of_slice, int dof) {
    std::vector<Entry> entries;
    const int column = columnOf(path, of_slice, dof);
    if (column < 0) return entries;
    for (MapEntry entry(layout_->map->M, column); entry; ++entry) {
      entries.push_back({int(entry.col()), entry.value()});
      columns.push_back(int(entry.col()));
    }
    return entries;
  };
  for (int dof = 0; dof < int(same.size()); ++dof) {
    if (std::ranges::find(motion.splined, dof) != motion.splined.end()) continue;
    OtherDof other{dof, same[std::size_t(dof)], entriesOf(slice - 1, dof), {}};
    if (other.same >= 0) other.after = entriesOf(slice, other.same);
    motion.others.push_back(std::move(other));
  }
  for (const double time : {0., .25, .5, .75, 1.}) {  // there is at most one knot inside of a motion
    const VectorXd weights = layout_->weightsAt((slice + time) * tau_);
    for (Eigen::Index i = 1; i < weights.size(); ++i)
      for (Eigen::Index d = 0; d < layout_->columns.cols() && weights[i] != 0.; ++d)
        columns.push_back(layout_->columns(i - 1, d));
  }
  motion.segments = segmentsOf(std::move(columns));
  return motion;
}

void SplineConstraints::setSamples(const Path& path, int number, std::vector<CollisionSample> samples) {
  const Term& term = terms_[std::size_t(number)];
  Objective& objective = objectives_[std::size_t(term.objective)];
  objective.samples[std::size_t(term.slice - objective.from)] = samples;
  SampleWeights& of_term = samples_[std::size_t(number)];
  of_term.pairs.reset();
  of_term.weights.assign(samples.size(), VectorXd());
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (!samples[i].isEmpty()) of_term.weights[i] = layout_->weightsAt((term.slice + samples[i].time) * tau_);
  if (!std::ranges::all_of(samples, &CollisionSample::isEmpty))
    of_term.pairs = std::make_unique<SampledPairs>(
        std::move(samples), is_separate_ ? cutoffDistance(objective) : objective.margin, path.state(term.slice - 1));
}

const SplineConstraints::Term& SplineConstraints::termOf(int row) const {
  return *std::ranges::find_if(terms_, [&](const Term& term) { return row < term.first_row + term.rows; });
}

void SplineConstraints::addTo(Jacobian& J) const {
  for (const Term& term : terms_) {
    for (int row = 0; row < term.rows; ++row) {
      for (const auto& [column, width] : (*motions_)[std::size_t(term.slice)].segments) {
        J.segments.push_back({column, width, int(J.values.size())});
        J.values.resize(J.values.size() + std::size_t(width), 0.);
      }
      J.row_start.push_back(int(J.segments.size()));
      J.zero_row.push_back(1);
    }
  }
}

void SplineConstraints::place(const Path& path, const Term& term, double time, const VectorXd& weights,
                              VectorXd& q) const {
  const VectorXd &from = path.state(term.slice - 1).q(), &to = path.state(term.slice).q();
  const Motion& motion = (*motions_)[std::size_t(term.slice)];
  for (const OtherDof& other : motion.others) {
    const double at_begin = from[other.dof];
    q[other.dof] = other.same < 0 ? at_begin : (1. - time) * at_begin + time * to[other.same];
  }
  for (std::size_t d = 0; d < motion.splined.size(); ++d)
    q[motion.splined[d]] = weights.dot(points_.col(Eigen::Index(d)));
}

/// Adds a gradient by q, times a factor, to the row by c.
void SplineConstraints::addGradient(const Motion& motion, double time, const VectorXd& weights, double factor,
                                    const SampledPairs::Gradient& gradient) {
  for (std::size_t d = 0; d < motion.splined.size(); ++d) {
    const double value = factor * gradient(0, motion.splined[d]);
    if (value == 0.) continue;
    for (Eigen::Index i = 1; i < weights.size(); ++i)
      if (weights[i] != 0.) row_[layout_->columns(i - 1, Eigen::Index(d))] += value * weights[i];
  }
  for (const OtherDof& other : motion.others) {
    const double value = factor * gradient(0, other.dof);
    if (value == 0.) continue;
    for (const Entry& entry : other.before)
      row_[entry.column] += (other.same < 0 ? 1. : 1. - time) * value * entry.weight;
    for (const Entry& entry : other.after) row_[entry.column] += time * value * entry.weight;
  }
}

/// Moves the row by c into the Jacobian and clears it.
void SplineConstraints::collect(const Motion& motion, int row, Jacobian& J) {
  const auto to = J.row_segments(row);
  for (std::size_t k = 0; k < motion.segments.size(); ++k) {
    auto values = row_.segment(motion.segments[k].first, motion.segments[k].second);
    Eigen::Map<VectorXd>(J.values.data() + to[k].offset, values.size()) = values;
    values.setZero();
  }
  J.zero_row[std::size_t(row)] = 0;
}

void SplineConstraints::evaluate(const Path& path, const VectorXd& c, int first_row, VectorXd& phi, Jacobian* J) {
  for (int term = 0; term < int(terms_.size()); ++term) evaluateTerm(term, path, c, first_row, phi, J);
}

void SplineConstraints::evaluateTerm(int number, const Path& path, const VectorXd& c, int first_row, VectorXd& phi,
                                     Jacobian* J) {
  const Term& term = terms_[std::size_t(number)];
  const Objective& objective = objectives_[std::size_t(term.objective)];
  const Motion& motion = (*motions_)[std::size_t(term.slice)];
  SampleWeights& samples = samples_[std::size_t(number)];
  const double scale = objective.scale(0, 0), aim = objective.margin + objective.slack;
  const int first = first_row + term.first_row;
  phi.segment(first, term.rows).setConstant(is_separate_ ? scale * (aim - cutoffDistance(objective)) : 0.);
  if (J) {
    for (int row = first; row < first + term.rows; ++row) {
      if (J->zero_row[std::size_t(row)]) continue;
      collect(motion, row, *J);  // clears it: row_ is zero
      J->zero_row[std::size_t(row)] = 1;
    }
  }
  if (!samples.pairs) return;
  points_ = layout_->pointsOf(c);
  const std::vector<CollisionSample>& all = objective.samples[std::size_t(term.slice - objective.from)];
  const auto weightsOf = [&](double time) -> const VectorXd& {
    const auto at = std::ranges::find_if(all, [&](const CollisionSample& i) { return !i.isEmpty() && i.time == time; });
    return samples.weights[std::size_t(at - all.begin())];
  };
  const auto place_at = [&](double time, VectorXd& q) { place(path, term, time, weightsOf(time), q); };
  bool any = false;
  const auto report = [&](int i, double distance, const SampledPairs::Gradient& gradient) {
    const int row = is_separate_ ? first + i : first;
    phi[row] = is_separate_ ? scale * (aim - distance) : phi[row] + scale * (objective.margin - distance);
    if (!J) return;
    addGradient(motion, all[std::size_t(i)].time, samples.weights[std::size_t(i)], -scale, gradient);
    if (is_separate_) collect(motion, row, *J);
    any = true;
  };
  samples.pairs->visit(path.state(term.slice - 1).sharedParameters(), J != nullptr, place_at, report);
  if (J && any && !is_separate_) collect(motion, first, *J);
}

}  // namespace kinegraph::inline trajectory_optimization_internal
