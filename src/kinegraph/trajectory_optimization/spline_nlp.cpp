#include "kinegraph/trajectory_optimization/spline_nlp.h"

#include <algorithm>
#include <numeric>

#include "kinegraph/common/text.h"
#include "kinegraph/komo/collision/alternative_path.h"
#include "kinegraph/komo/collision_report.h"
#include "kinegraph/komo/komo_nlp.h"
#include "kinegraph/komo/path_description.h"
#include "kinegraph/nlp/evaluation_sizes.h"
#include "kinegraph/trajectory_optimization/spline_motions.h"

namespace kinegraph::inline trajectory_optimization_internal {

namespace {

std::vector<Objective> objectivesOf(const Komo& komo, bool between_slices) {
  std::vector<Objective> objectives = komo.objectives().all();
  std::erase_if(objectives, [&](const Objective& objective) { return objective.between_slices != between_slices; });
  return objectives;
}

std::shared_ptr<MappedNlp> inControlPoints(const std::shared_ptr<Komo>& komo, const SplineLayout& layout) {
  return std::make_shared<MappedNlp>(makeNlp(komo, objectivesOf(*komo, false)), layout.map, layout.lower, layout.upper);
}

ValidityReport judge(SplineCurve& curve, const std::vector<SliceMotion>& motions,
                     const CancellationToken& cancellation) {
  MotionProbe probe(kFreeTolerance);
  SplineMotions spline(curve, probe);
  std::vector<PathContact> contacts;
  for (const SliceMotion& motion : motions) {
    cancellation.check();
    std::ranges::copy(spline.contacts(motion, 0.), std::back_inserter(contacts));
  }
  if (contacts.empty()) return {};
  return {false, std::ranges::min_element(contacts, {}, &PathContact::distance)->str()};
}

}  // namespace

SplineNlp::SplineNlp(std::shared_ptr<Komo> komo, std::shared_ptr<const SplineLayout> layout)
    : komo_(std::move(komo)),
      layout_(std::move(layout)),
      slices_(inControlPoints(komo_, *layout_)),
      is_separate_(false),
      rows_(komo_->path(), layout_, objectivesOf(*komo_, true), false),
      curve_(komo_->path(), layout_) {
  layOut();
}

SplineNlp::SplineNlp(const SplineNlp& summed, std::shared_ptr<MappedNlp> slices)
    : komo_(summed.komo_),
      layout_(summed.layout_),
      slices_(std::move(slices)),
      is_separate_(true),
      rows_(komo_->path(), summed.rows_, summed.rows_.objectives(), true),
      curve_(summed.curve_) {
  layOut();
}

void SplineNlp::layOut() {
  lower_ = layout_->lower, upper_ = layout_->upper;
  types_ = slices_->types();
  linear_.clear();
  for (int row = 0; row < rowsOfSlices(); ++row) linear_.push_back(slices_->isLinear(row));
  types_.insert(types_.end(), std::size_t(rows_.rows()), ObjectiveType::ineq);
  linear_.resize(types_.size(), false);
  phi_.resize(rowsOfSlices());
}

Jacobian SplineNlp::makeJacobian() const {
  Jacobian J = slices_->makeJacobian();
  rows_.addTo(J);
  return J;
}

void SplineNlp::evaluate(const VectorXd& c, VectorXd& phi, Jacobian* J) {
  prepareEvaluation(*this, c, phi, J);
  slices_->evaluateRows(c, phi_, J);
  phi.head(rowsOfSlices()) = phi_;
  rows_.evaluate(komo_->path(), c, rowsOfSlices(), phi, J);
}

Separation SplineNlp::separation() {
  if (separation_is_known_) return separation_;
  separation_is_known_ = true;
  separation_ = slices_->separation();
  if (rows_.rows() == 0 && !separation_.problem) return separation_;
  auto slices = std::static_pointer_cast<MappedNlp>(separation_.problem);
  if (!slices) {  // only rows between slices are separable
    slices = slices_;
    separation_.row_of.resize(std::size_t(rowsOfSlices()));
    std::iota(separation_.row_of.begin(), separation_.row_of.end(), 0);
    separation_.is_term.assign(std::size_t(rowsOfSlices()), false);
  }
  const std::shared_ptr<SplineNlp> separate(new SplineNlp(*this, slices));
  for (std::size_t i = 0; i < rows_.terms().size(); ++i) {
    const int row = rowsOfSlices() + rows_.terms()[i].first_row, rows = separate->rows_.terms()[i].rows;
    separation_.row_of.insert(separation_.row_of.end(), std::size_t(rows), row);
    separation_.is_term.insert(separation_.is_term.end(), std::size_t(rows), true);
  }
  separation_.problem = separate;
  return separation_;
}

std::shared_ptr<const LazyValidity> SplineNlp::validity(const VectorXd& c) {
  const std::vector<Objective>& objectives = komo_->objectives().all();
  if (!constrainsAnyMotion(komo_->path(), objectives)) return nullptr;
  moveTo(c);
  std::vector<SliceMotion> motions = constrainedMotions(komo_->path(), objectives);
  if (motions.empty()) return nullptr;
  return std::make_shared<LazyValidity>(
      [motions = std::move(motions), curve = curve_](const CancellationToken& cancellation) mutable {
        return judge(curve, motions, cancellation);
      });
}

void SplineNlp::moveTo(const VectorXd& c) {
  slices_->leaveAt(c);
  curve_.moveTo(komo_->path(), c);
}

/// Adds samples at which the spline violates the objectives; returns the largest violation, m.
double SplineNlp::addSamplesTo(std::vector<Objective>& objectives) {
  SplineMotions spline(curve_, probe_);
  double lack = 0.;
  for (Objective& objective : objectives) lack = std::max(lack, addSamples(objective, spline));
  return lack;
}

void SplineNlp::replace(std::vector<Objective> objectives) {
  rows_ = SplineConstraints(komo_->path(), rows_, std::move(objectives), is_separate_);
  separation_ = {};
  separation_is_known_ = false;
  layOut();
}

Refinement SplineNlp::refine(const VectorXd& c, VectorXd& dual) {
  if (rows_.rows() == 0) return Refinement::none;
  const Separation before = separation();
  const auto& solved = static_cast<const SplineNlp&>(*before.problem);
  if (solved.free_at_.size() == c.size() && solved.free_at_ == c) return Refinement::none;
  moveTo(c);
  std::vector<Objective> objectives = solved.rows_.objectives();
  const double lack = addSamplesTo(objectives);
  if (lack == 0.) return Refinement::none;
  replace(std::move(objectives));
  const auto& next = static_cast<const SplineNlp&>(*separation().problem);
  if (dual.size() == Eigen::Index(before.row_of.size())) dual = next.carriedOver(dual, solved.rows_, next.rows_);
  return refinementOf(lack);
}

/// Transfers multipliers to terms with additional rows.
VectorXd SplineNlp::carriedOver(const VectorXd& dual, const SplineConstraints& before,
                                const SplineConstraints& now) const {
  const int first = rowsOfSlices();
  VectorXd carried = VectorXd::Zero(first + now.rows());
  carried.head(first) = dual.head(first);
  for (std::size_t i = 0; i < now.terms().size(); ++i) {
    const SplineConstraints::Term& old = before.terms()[i];
    carried.segment(first + now.terms()[i].first_row, old.rows) = dual.segment(first + old.first_row, old.rows);
  }
  return carried;
}

Refinement SplineNlp::activate(const VectorXd& c, bool is_solution, VectorXd& phi, Jacobian& J,
                               std::vector<int>& rows) {
  moveTo(c);
  SplineMotions spline(curve_, probe_);
  double lack = 0.;
  checked_.resize(rows_.objectives().size());
  for (std::size_t o = 0; o < rows_.objectives().size(); ++o) {
    Objective objective = rows_.objectives()[o];
    const FilledSamples filled = fillSamples(objective, spline, is_solution, checked_[o]);
    lack = std::max(lack, filled.violation);
    for (int number = 0; number < int(rows_.terms().size()); ++number) {
      const SplineConstraints::Term& term = rows_.terms()[std::size_t(number)];
      const int motion = term.slice - objective.from;
      if (term.objective != int(o) || std::ranges::find(filled.motions, motion) == filled.motions.end()) continue;
      const std::vector<CollisionSample>&before = rows_.objectives()[o].samples[std::size_t(motion)],
            &now = objective.samples[std::size_t(motion)];
      for (std::size_t i = 0; i < now.size(); ++i)
        if (before[i].isEmpty() && !now[i].isEmpty()) rows.push_back(rowsOfSlices() + term.first_row + int(i));
      rows_.setSamples(komo_->path(), number, now);
      rows_.evaluateTerm(number, komo_->path(), c, rowsOfSlices(), phi, &J);
    }
  }
  if (is_solution && lack == 0.) free_at_ = c;
  return refinementOf(lack);
}

GuessKind SplineNlp::guessKind(const VectorXd& c) {
  moveTo(c);
  SplineMotions spline(curve_, probe_);
  return guessKindOf(spline, 0, komo_->slices() - 1);
}

/// Returns the spline nearest to an alternative path, with samples at its closest approaches.
std::optional<VectorXd> SplineNlp::initialGuess(const VectorXd& c, int number) {
  std::vector<Objective> objectives = rows_.objectives();
  if (objectives.empty()) return std::nullopt;
  slices_->leaveAt(c);
  const double apart = objectives[0].margin + objectives[0].slack;
  const std::optional<VectorXd> way = alternativePath(komo_->path(), apart, probe_, number);
  if (!way) return std::nullopt;
  VectorXd of_spline = slices_->fitted(*way);
  moveTo(of_spline);
  SplineMotions spline(curve_, probe_);
  for (Objective& objective : objectives) {
    objective.samples.clear();
    addApproaches(objective, spline, kAlternativePathReach);
  }
  addSamplesTo(objectives);
  replace(std::move(objectives));
  return of_spline;
}

std::string SplineNlp::rowName(int row) const {
  const int own = row - rowsOfSlices();
  if (own < 0) return slices_->rowName(row);
  if (own >= rows_.rows()) return Nlp::rowName(row);
  const SplineConstraints::Term& term = rows_.termOf(own);
  const Objective& objective = rows_.objectives()[std::size_t(term.objective)];
  return cat(objectiveName(objective), ", row ", own - term.first_row, ", slice ", term.slice, " (",
             objectiveTypeName(objective.type), ")");
}

/// Objectives between slices form groups after those of the slices.
RowDescription SplineNlp::describeRow(int row) const {
  const int own = row - rowsOfSlices();
  if (own < 0) return slices_->describeRow(row);
  const SplineConstraints::Term& term = rows_.termOf(own);
  const Objective& objective = rows_.objectives()[std::size_t(term.objective)];
  RowDescription out;
  out.objective = objectiveName(objective);
  out.group = int(komo_->objectives().all().size()) + term.objective;
  out.slice = term.slice;
  out.measure = Measure::length;
  out.scale = objective.scale(0, 0);
  return out;
}

std::vector<std::string> SplineNlp::detailsOf(int row) const {
  const int own = row - rowsOfSlices();
  if (own < 0) return slices_->detailsOf(row);
  const SplineConstraints::Term& term = rows_.termOf(own);
  SplineCurve curve = curve_;
  curve.moveTo(komo_->path(), layout_->map->fit(komo_->path().variables()));
  MotionProbe probe(kFreeTolerance);
  std::vector<std::string> details;
  for (const PathContact& contact :
       SplineMotions(curve, probe)
           .contacts(curve.motionInto(term.slice), rows_.objectives()[std::size_t(term.objective)].margin))
    details.push_back(contact.str());
  return details;
}

}  // namespace kinegraph::inline trajectory_optimization_internal
