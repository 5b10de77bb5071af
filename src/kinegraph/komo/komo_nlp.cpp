#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/komo/path_description.h"

namespace kinegraph {

namespace {

class KomoNlp final : public Nlp {
 public:
  explicit KomoNlp(std::shared_ptr<Komo> komo)
      : komo_(std::move(komo)), problem_(*komo_), structure_(komo_->structureRevision()) {
    types_ = problem_.types();
    lower_ = komo_->layout().lower;
    upper_ = komo_->layout().upper;
  }

  const std::shared_ptr<Komo>& komo() const { return komo_; }

  Jacobian makeJacobian() const override { return problem_.makeJacobian(); }

  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override {
    requireStructure();
    komo_->setVariables(x);
    problem_.evaluate(*komo_, phi, J);
  }

  /// The present path, moved by a little noise so that it is not exactly at a singular posture, within the bounds.
  VectorXd initialPoint(Rng& rng) override {
    requireStructure();
    VectorXd x = komo_->variables();
    for (double& value : x) value += .01 * rng.normal();
    return x.cwiseMax(lower_).cwiseMin(upper_);
  }

  std::string rowName(int row) const override {
    if (row < 0 || row >= problem_.rows()) return Nlp::rowName(row);
    const PathProblem::Term& term = problem_.termOf(row);
    const Komo::Objective& objective = problem_.objectives()[term.objective];
    return cat(objectiveName(objective), ", row ", row - term.first_row, ", slice ", term.slice, " (", objectiveTypeName(objective.type), ")");
  }

  RowDescription describeRow(int row) const override { return describePathRow(*komo_, problem_, row); }
  VariableDescription describeVariable(int variable) const override { return describePathVariable(*komo_, variable); }
  std::vector<std::string> detailsOf(int row) const override { return pathRowDetails(*komo_, problem_, row); }

  std::string report(int) const override {
    return cat("KOMO: ", komo_->slices(), " slices of ", komo_->dofs(), " dofs, order ", komo_->order(), ", ", dimension(),
               " variables, ", problem_.objectives().size(), " objectives with ", types_.size(), " residuals");
  }

 private:
  void requireStructure() const {
    if (komo_->structureRevision() == structure_) return;
    throw Error("KOMO: a mode switch or frame was added after this nlp() was made; make a new one");
  }

  std::shared_ptr<Komo> komo_;
  PathProblem problem_;
  int structure_;
};

}  // namespace

std::shared_ptr<Nlp> makeNlp(std::shared_ptr<Komo> komo) {
  if (komo->slices() == 0) throw Error("KOMO: there is no problem yet; call setConfig and setTiming first");
  return std::make_shared<KomoNlp>(std::move(komo));
}

std::shared_ptr<Komo> komoOf(const Nlp& nlp) {
  const auto* problem = dynamic_cast<const KomoNlp*>(&nlp);
  return problem ? problem->komo() : nullptr;
}

}  // namespace kinegraph
