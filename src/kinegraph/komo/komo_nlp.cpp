#include <algorithm>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/komo/komo.h"

namespace kinegraph {

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// x holds the slices one after the other; phi the objectives in order, each slice by slice.
class KomoNlp final : public Nlp {
 public:
  explicit KomoNlp(std::shared_ptr<Komo> komo) : komo_(std::move(komo)), objectives_(komo_->objectives().size()) {
    const int n = komo_->dofs(), T = komo_->slices();
    lower_ = komo_->program().lower.replicate(T, 1);
    upper_ = komo_->program().upper.replicate(T, 1);
    int widest = 0;
    for (const Komo::Objective& objective : komo_->objectives()) {
      const int rows = objective.residual.rows(), order = objective.residual.order();
      for (int t = objective.from; t <= objective.to; ++t) types_.insert(types_.end(), rows, objective.type);
      widest = std::max(widest, rows * (order + 1) * n);
    }
    beyond_start_.resize(std::size_t(widest));
  }

  Jacobian makeJacobian() const override {
    const int n = komo_->dofs();
    Jacobian J;
    J.columns = n * komo_->slices();
    for (std::size_t o = 0; o < objectives_; ++o) {
      const Komo::Objective& objective = komo_->objectives()[o];
      const int order = objective.residual.order();
      for (int t = objective.from; t <= objective.to; ++t) {
        const int first = std::max(t - order, 0);
        for (int row = 0; row < objective.residual.rows(); ++row) J.addRow({{first * n, (t - first + 1) * n}});
      }
    }
    return J;
  }

  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override {
    const int n = komo_->dofs();
    if (komo_->objectives().size() < objectives_) throw Error("KOMO: its objectives were cleared; make a new nlp()");
    for (int t = 0; t < komo_->slices(); ++t) komo_->setSlice(t, x.data() + t * n);
    if (J) std::fill(J->values.begin(), J->values.end(), 0.);
    int row = 0;
    for (std::size_t o = 0; o < objectives_; ++o) {
      Komo::Objective& objective = komo_->objectives()[o];
      const int rows = objective.residual.rows(), order = objective.residual.order();
      for (int t = objective.from; t <= objective.to; ++t, row += rows) {
        if (!J) {
          komo_->evaluate(objective, t, phi.segment(row, rows), nullptr);
          continue;
        }
        if (rows == 0) continue;
        const int missing = std::max(order - t, 0) * n, width = (order + 1) * n;  // columns before the first slice
        double* values = J->values.data() + J->segments[J->row_start[row]].offset;
        if (missing == 0) {
          JacobianRows block = Eigen::Map<RowMajor>(values, rows, width);
          komo_->evaluate(objective, t, phi.segment(row, rows), &block);
        } else {
          Eigen::Map<RowMajor> whole(beyond_start_.data(), rows, width);
          whole.setZero();
          JacobianRows block = whole;
          komo_->evaluate(objective, t, phi.segment(row, rows), &block);
          Eigen::Map<RowMajor>(values, rows, width - missing) = whole.rightCols(width - missing);
        }
      }
    }
  }

  /// The present path, moved by a little noise so that it is not exactly at a singular posture, within the bounds.
  VectorXd initialPoint(Rng& rng) override {
    const int n = komo_->dofs();
    VectorXd x(dimension());
    for (int t = 0; t < komo_->slices(); ++t) x.segment(t * n, n) = komo_->state(t).q();
    for (double& value : x) value += .01 * rng.normal();
    return x.cwiseMax(lower_).cwiseMin(upper_);
  }

  std::string rowName(int wanted) const override {
    int row = 0;
    for (std::size_t o = 0; o < objectives_; ++o) {
      const Komo::Objective& objective = komo_->objectives()[o];
      for (int t = objective.from; t <= objective.to; ++t) {
        const int rows = objective.residual.rows();
        if (wanted < row + rows) {
          std::string name = objective.residual.name();
          if (!objective.frames.empty()) name += cat(" of ", join(objective.frames, ", "));
          return cat(name, ", row ", wanted - row, ", slice ", t, " (", objectiveTypeName(objective.type), ")");
        }
        row += rows;
      }
    }
    return Nlp::rowName(wanted);
  }

  std::string report(int) const override {
    return cat("KOMO: ", komo_->slices(), " slices of ", komo_->dofs(), " dofs, order ", komo_->order(), ", ", objectives_,
               " objectives with ", types_.size(), " residuals");
  }

 private:
  std::shared_ptr<Komo> komo_;
  std::size_t objectives_;  ///< those that existed when this was made
  std::vector<double> beyond_start_;
};

}  // namespace

std::shared_ptr<Nlp> makeNlp(std::shared_ptr<Komo> komo) {
  if (komo->slices() == 0) throw Error("KOMO: there is no problem yet; call setConfig and setTiming first");
  return std::make_shared<KomoNlp>(std::move(komo));
}

}  // namespace kinegraph
