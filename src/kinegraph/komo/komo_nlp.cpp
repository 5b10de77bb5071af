#include "kinegraph/komo/komo_nlp.h"

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/komo/collision/alternative_path.h"
#include "kinegraph/komo/collision_report.h"
#include "kinegraph/komo/continuous_collisions.h"
#include "kinegraph/komo/komo.h"
#include "kinegraph/komo/path_components.h"
#include "kinegraph/komo/path_description.h"
#include "kinegraph/nlp/evaluation_sizes.h"
#include "kinegraph/nlp/initial_guesses.h"
#include "kinegraph/nlp/lazy_constraints.h"

namespace kinegraph {

namespace {

constexpr int kMostSeparateRows = 100000;

/// Returns true if the objective requires a sum of overlaps to be zero.
bool isSumOfOverlaps(const Objective& objective) {
  return objective.feature == FeatureSymbol::accumulatedCollisions &&
         (objective.order == 0 || objective.between_slices) && objective.scale.size() <= 1 &&
         objective.target.isZero(0.) && (objective.scale.size() == 0 || objective.scale(0) > 0.) &&
         (objective.type == ObjectiveType::eq || objective.type == ObjectiveType::ineq);
}

bool isBetweenSlices(const Objective& objective) { return objective.between_slices; }

/// Returns true if the objective has rows for samples that are not known yet.
bool hasSpareSamples(const Objective& objective) {
  return objective.between_slices && objective.feature == FeatureSymbol::pairCollisions;
}

class KomoNlp final : public Nlp, public InitialGuesses, public LazyConstraints {
 public:
  explicit KomoNlp(std::shared_ptr<Komo> komo) : KomoNlp(komo, komo->objectives().all()) {}

  KomoNlp(std::shared_ptr<Komo> komo, std::vector<Objective> objectives)
      : komo_(std::move(komo)),
        problem_(komo_->path(), komo_->contacts(), std::move(objectives)),
        structure_(komo_->path().revision()) {
    types_ = problem_.types();
    linear_ = problem_.linearRows();
    lower_ = komo_->path().layout().lower;
    upper_ = komo_->path().layout().upper;
  }

  const std::shared_ptr<Komo>& komo() const { return komo_; }
  const PathProblem& problem() const { return problem_; }
  void evaluateTerms(const std::vector<int>& terms, VectorXd& phi, Jacobian& J) {
    requireStructure();
    problem_.evaluateTerms(komo_->path(), terms, phi, &J);
  }

  Jacobian makeJacobian() const override {
    requireStructure();
    return problem_.makeJacobian(komo_->path());
  }

  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override {
    requireStructure();
    prepareEvaluation(*this, x, phi, J);
    komo_->path().setVariables(x);
    problem_.evaluate(komo_->path(), phi, J);
  }

  std::span<const CurvedRows> curvedRows() const override { return problem_.curvedRows(); }

  void addCurvature(int k, std::span<const double> weights, Eigen::Ref<MatrixXd> H) override {
    requireStructure();
    problem_.addCurvature(komo_->path(), k, weights, H);
  }

  bool mayBeQuadratic() const override { return problem_.isLinear(); }

  bool mayBeCancelled() const override {
    return std::ranges::any_of(problem_.objectives(), [](const Objective& o) { return o.feature.maker() != nullptr; });
  }

  void leaveAt(const VectorXd& x) override { komo_->path().setVariables(x); }

  /// Replaces sums of overlaps by the overlaps of pairs.
  Separation separation() override {
    if (separation_is_known_) return separation_;
    separation_is_known_ = true;
    if (std::ranges::none_of(problem_.objectives(), isSumOfOverlaps)) return separation_;
    std::vector<Objective> objectives = problem_.objectives();
    for (Objective& objective : objectives) {
      if (!isSumOfOverlaps(objective)) continue;
      if (objective.between_slices) reserveSamples(objective, kSpareSamplesPerMotion);
      objective.feature = FeatureSymbol::pairCollisions;
      objective.type = ObjectiveType::ineq;
      if (const double apart = objective.margin + objective.slack; apart != 0.)
        objective.target = VectorXd::Constant(1, -apart);
    }
    const auto separate = std::make_shared<KomoNlp>(komo_, std::move(objectives));
    if (separate->problem_.rows() > std::max(kMostSeparateRows, 2 * problem_.rows())) return separation_;
    for (std::size_t i = 0; i < problem_.terms().size(); ++i) {  // the same objectives in the same slices
      const PathProblem::Term &sum = problem_.terms()[i], &term = separate->problem_.terms()[i];
      const bool is_sum = isSumOfOverlaps(problem_.objectives()[sum.objective]);
      for (int row = 0; row < term.rows; ++row) {
        separation_.row_of.push_back(is_sum ? sum.first_row : sum.first_row + row);
        separation_.is_term.push_back(is_sum);
      }
    }
    separation_.problem = separate;
    return separation_;
  }

  std::shared_ptr<const LazyValidity> validity(const VectorXd& x) override {
    if (!constrainsAnyMotion(komo_->path(), problem_.objectives())) return nullptr;
    komo_->path().setVariables(x);
    std::vector<SliceMotion> motions = constrainedMotions(komo_->path(), problem_.objectives());
    if (motions.empty()) return nullptr;
    return std::make_shared<LazyValidity>([motions = std::move(motions)](const CancellationToken& cancellation) {
      return reportCollisions(motions, cancellation);
    });
  }

  Refinement refine(const VectorXd& x, VectorXd& dual) override {
    if (std::ranges::none_of(problem_.objectives(), isBetweenSlices)) return Refinement::none;
    requireStructure();
    komo_->path().setVariables(x);
    std::vector<Objective> objectives = problem_.objectives();
    if (const KomoNlp* solved = separate()) {
      if (solved->free_at_.size() == x.size() && solved->free_at_ == x) return Refinement::none;
      for (std::size_t i = 0; i < objectives.size(); ++i)
        if (objectives[i].between_slices) objectives[i].samples = solved->problem_.objectives()[i].samples;
    }
    const double lack = addSamplesTo(objectives);
    if (lack == 0.) return Refinement::none;
    const Separation before = separation();
    takeUp(std::move(objectives));
    const Separation now = separation();
    if (before.problem && now.problem && dual.size() == Eigen::Index(before.row_of.size()))
      dual = carriedOver(dual, before, now);
    return refinementOf(lack);
  }

  bool hasCapacity() const override { return std::ranges::any_of(problem_.objectives(), hasSpareSamples); }

  Refinement activate(const VectorXd& x, bool is_solution, VectorXd& phi, Jacobian& J,
                      std::vector<int>& rows) override {
    requireStructure();
    komo_->path().setVariables(x);
    double lack = 0.;
    checked_.resize(problem_.objectives().size());
    LinearSliceMotions lines(komo_->path(), probe_);
    for (std::size_t o = 0; o < problem_.objectives().size(); ++o) {
      if (!hasSpareSamples(problem_.objectives()[o])) continue;
      Objective objective = problem_.objectives()[o];
      const FilledSamples filled = fillSamples(objective, lines, is_solution, checked_[o]);
      lack = std::max(lack, filled.violation);
      for (const int motion : filled.motions) fillMotion(o, objective, motion, phi, J, rows);
    }
    if (is_solution && lack == 0.) free_at_ = x;
    return refinementOf(lack);
  }

  InitialGuesses* initialGuesses() override { return this; }
  LazyConstraints* lazyConstraints() override { return this; }

  GuessKind guessKind(const VectorXd& x) override {
    requireStructure();
    komo_->path().setVariables(x);
    LinearSliceMotions lines(komo_->path(), probe_);
    return guessKindOf(lines, firstMotion(komo_->path()), komo_->slices() - 1);
  }

  /// Returns a path in another homotopy class, with samples at its closest approaches, so that a step does not lead
  /// through an obstacle.
  std::optional<VectorXd> initialGuess(const VectorXd& x, int number) override {
    std::vector<Objective> objectives = problem_.objectives();
    const auto between_slices = std::ranges::find_if(objectives, isBetweenSlices);
    if (between_slices == objectives.end()) return std::nullopt;
    requireStructure();
    komo_->path().setVariables(x);
    const double apart = between_slices->margin + between_slices->slack;
    std::optional<VectorXd> way = alternativePath(komo_->path(), apart, probe_, number);
    if (!way) return std::nullopt;
    *way = way->cwiseMax(lower_).cwiseMin(upper_);
    komo_->path().setVariables(*way);
    LinearSliceMotions lines(komo_->path(), probe_);
    for (Objective& objective : objectives) {
      if (!objective.between_slices) continue;
      objective.samples.clear();
      addApproaches(objective, lines, kAlternativePathReach);
    }
    addSamplesTo(objectives);
    takeUp(std::move(objectives));
    return way;
  }

  /// Returns the present path with a little noise, to avoid exact singularities, clipped to the bounds.
  VectorXd initialPoint(Rng& rng) override {
    requireStructure();
    VectorXd x = komo_->path().variables();
    for (double& value : x) value += .01 * rng.normal();
    return x.cwiseMax(lower_).cwiseMin(upper_);
  }

  std::string rowName(int row) const override {
    if (row < 0 || row >= problem_.rows()) return Nlp::rowName(row);
    const PathProblem::Term& term = problem_.termOf(row);
    const Objective& objective = problem_.objectives()[term.objective];
    return cat(objectiveName(objective), ", row ", row - term.first_row, ", slice ", term.slice, " (",
               objectiveTypeName(objective.type), ")");
  }

  RowDescription describeRow(int row) const override { return describePathComponent(komo_->path(), problem_, row); }
  VariableDescription describeVariable(int variable) const override {
    return describePathVariable(komo_->path(), variable);
  }
  std::vector<std::string> detailsOf(int row) const override {
    return pathComponentDetails(komo_->path(), problem_, row);
  }

  std::string report(int) const override {
    return cat("KOMO: ", komo_->slices(), " slices of ", komo_->dofs(), " dofs, order ", komo_->order(), ", ",
               dimension(), " variables, ", problem_.objectives().size(), " objectives with ", types_.size(),
               " residuals");
  }

 private:
  void requireStructure() const {
    if (komo_->path().revision() == structure_) return;
    throw Error("KOMO: a mode switch or frame was added after this nlp() was made; make a new one");
  }

  /// Adds samples at which the path violates the objectives; returns the largest violation, m.
  double addSamplesTo(std::vector<Objective>& objectives) {
    double lack = 0.;
    LinearSliceMotions lines(komo_->path(), probe_);
    for (Objective& objective : objectives) {
      if (objective.between_slices) lack = std::max(lack, addSamples(objective, lines));
    }
    return lack;
  }

  /// The separate form, if it is known.
  const KomoNlp* separate() const { return static_cast<const KomoNlp*>(separation_.problem.get()); }

  /// Replaces the samples of one motion of an objective.
  void fillMotion(std::size_t number, const Objective& objective, int motion, VectorXd& phi, Jacobian& J,
                  std::vector<int>& rows) {
    const auto isIt = [&](const PathProblem::Term& term) {
      return term.objective == int(number) && term.slice == objective.from + motion;
    };
    const auto term = std::ranges::find_if(problem_.terms(), isIt);
    const std::vector<CollisionSample>&now = objective.samples[std::size_t(motion)],
          &before = problem_.objectives()[number].samples[std::size_t(motion)];
    for (int row = 0; row < term->rows; ++row)
      if (before[std::size_t(row)].isEmpty() && !now[std::size_t(row)].isEmpty()) rows.push_back(term->first_row + row);
    problem_.setSamples(komo_->path(), komo_->contacts(), *term, now);
    problem_.evaluateTerm(komo_->path(), std::size_t(term - problem_.terms().begin()), phi, J);
  }

  void takeUp(std::vector<Objective> objectives) {
    problem_ = PathProblem(komo_->path(), komo_->contacts(), std::move(objectives));
    separation_ = {};
    separation_is_known_ = false;
  }

  /// Transfers multipliers between separate forms. The new one has the same terms as the old one, each with the old
  /// rows first.
  static VectorXd carriedOver(const VectorXd& dual, const Separation& before, const Separation& now) {
    const auto& old_terms = static_cast<const KomoNlp&>(*before.problem).problem_.terms();
    const auto& terms = static_cast<const KomoNlp&>(*now.problem).problem_.terms();
    VectorXd carried = VectorXd::Zero(Eigen::Index(now.row_of.size()));
    for (std::size_t i = 0; i < terms.size(); ++i)
      carried.segment(terms[i].first_row, old_terms[i].rows) = dual.segment(old_terms[i].first_row, old_terms[i].rows);
    return carried;
  }

  std::shared_ptr<Komo> komo_;
  PathProblem problem_;
  MotionProbe probe_{kFreeTolerance};
  std::vector<std::vector<CheckedMotion>> checked_;  ///< per objective and motion
  VectorXd free_at_;                                 ///< solution at which a solver found no further violations
  int structure_;
  Separation separation_;
  bool separation_is_known_ = false;
};

}  // namespace

std::shared_ptr<Nlp> makeNlp(std::shared_ptr<Komo> komo) {
  if (!komo) throw ValueError("makeNlp: the Komo is null");
  if (komo->slices() == 0) throw Error("KOMO: there is no problem yet; call setConfig and setTiming first");
  return std::make_shared<KomoNlp>(std::move(komo));
}

std::shared_ptr<Nlp> komo_internal::makeNlp(std::shared_ptr<Komo> komo, std::vector<Objective> objectives) {
  return std::make_shared<KomoNlp>(std::move(komo), std::move(objectives));
}

std::shared_ptr<Komo> komoOf(const Nlp& nlp) {
  const auto* problem = dynamic_cast<const KomoNlp*>(&nlp);
  return problem ? problem->komo() : nullptr;
}

const std::vector<Objective>* komo_internal::objectivesOf(const Nlp& nlp) {
  const auto* of_komo = dynamic_cast<const KomoNlp*>(&nlp);
  return of_komo ? &of_komo->problem().objectives() : nullptr;
}

std::vector<PathComponent> komo_internal::pathComponents(const Nlp& nlp) {
  std::vector<PathComponent> rows;
  const auto* of_komo = dynamic_cast<const KomoNlp*>(&nlp);
  if (!of_komo) return rows;
  rows.reserve(nlp.types().size());
  for (const PathProblem::Term& term : of_komo->problem().terms()) {
    for (int row = 0; row < term.rows; ++row) rows.push_back({term.objective, term.slice, row});
  }
  return rows;
}

std::vector<PathTerm> komo_internal::pathTerms(const Nlp& nlp) {
  std::vector<PathTerm> terms;
  const auto* of_komo = dynamic_cast<const KomoNlp*>(&nlp);
  if (!of_komo) return terms;
  const PathProblem& problem = of_komo->problem();
  for (const PathProblem::Term& term : problem.terms())
    terms.push_back(
        {term.objective, term.slice, term.first_row, term.rows, problem.isLinear(term), !problem.storesAllRows(term)});
  return terms;
}

void komo_internal::evaluatePathTerms(Nlp& nlp, const std::vector<int>& terms, VectorXd& phi, Jacobian& J) {
  dynamic_cast<KomoNlp&>(nlp).evaluateTerms(terms, phi, J);
}

}  // namespace kinegraph
