#include "kinegraph/features/residual.h"

#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline features_internal {

Residual::Residual(std::shared_ptr<const Feature> feature, MatrixXd scale, VectorXd target, int order, std::string name)
    : feature_(std::move(feature)), name_(std::move(name)) {
  if (order < 0) order = feature_->order();
  if (order < feature_->order()) {
    throw ValueError(cat(name_, " is defined on ", feature_->order() + 1,
                         " consecutive configurations; expected an order of at least ", feature_->order(), ", got ",
                         order));
  }
  differences_ = order - feature_->order();
  raw_.resize(feature_->rows());
  setScale(std::move(scale));
  setTarget(std::move(target));
  if (differences_ == 0) return;
  values_.resize(differences_ + 1, VectorXd(feature_->rows()));
  jacobians_.resize(differences_ + 1);
}

void Residual::setScale(MatrixXd scale) {
  const int raw_rows = feature_->rows();
  const bool vector = scale.size() > 1 && scale.cols() == 1 && raw_rows != 1;
  if (scale.size() > 1 && (vector ? scale.rows() : scale.cols()) != raw_rows) {
    throw ValueError(cat("scale of ", name_, " has shape ", scale.rows(), " x ", scale.cols(), "; expected 1 number, ",
                         raw_rows, " numbers, or a matrix with ", raw_rows, " columns"));
  }
  if (!scale.allFinite()) throw ValueError(cat("scale of ", name_, " has numbers that are not finite"));
  scale_ = std::move(scale);
  scales_rows_ = vector;
  rows_ = scale_.size() > 1 && !vector ? int(scale_.rows()) : raw_rows;
  flat_value_ = differences_ == 0 && !mixesRows() ? feature_->flatValue() : std::nullopt;
}

void Residual::setTarget(VectorXd target) {
  const int raw_rows = feature_->rows();
  if (target.size() > 1 && target.size() != raw_rows) {
    throw ValueError(cat("target of ", name_, " has ", target.size(), " numbers; expected 1 or ", raw_rows));
  }
  if (!target.allFinite()) throw ValueError(cat("target of ", name_, " has numbers that are not finite"));
  target_ = std::move(target);
}

void Residual::eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J,
                    char* zero_row) {
  if (!mixesRows()) {
    evalRaw(states, tau, y, J, zero_row);
    return scaleRows(y, J);
  }
  raw_.resize(feature_->rows());
  if (J) {
    raw_jacobian_.setZero(feature_->rows(), J->cols());
    JacobianRows view = raw_jacobian_;
    evalRaw(states, tau, raw_, &view, nullptr);
    *J += scale_.lazyProduct(raw_jacobian_);
  } else {
    evalRaw(states, tau, raw_, nullptr, nullptr);
  }
  y.noalias() = scale_ * raw_;
}

void Residual::evalRaw(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J,
                       char* zero_row) {
  if (differences_ > 0) {
    evalDifference(states, tau, y, J);
  } else {
    feature_->eval(states, tau, y, J);
    alignSign(y, J);
    if (flat_value_ && zero_row) {
      for (Eigen::Index row = 0; row < y.size(); ++row) zero_row[row] = y[row] == *flat_value_;
    }
  }
  subtractTarget(y);
}

void Residual::addCurvature(const State& state, std::span<const double> weights, Eigen::Ref<MatrixXd> H) {
  const Eigen::Map<const VectorXd> weight(weights.data(), Eigen::Index(weights.size()));
  if (mixesRows()) {
    raw_.noalias() = scale_.transpose() * weight;
  } else {
    raw_ = weight;
    if (scale_.size() == 1) raw_ *= scale_(0, 0);
    if (scale_.size() > 1) raw_.array() *= scale_.col(0).array();
  }
  feature_->addCurvature(state, raw_, H);
}

void Residual::finish(Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  alignSign(y, J);
  subtractTarget(y);
  scaleRows(y, J);
}

void Residual::mix(Eigen::Ref<VectorXd> raw, JacobianRows* raw_jacobian, Eigen::Ref<VectorXd> y,
                   JacobianRows* J) const {
  alignSign(raw, raw_jacobian);
  subtractTarget(raw);
  y.noalias() = scale_ * raw;
  if (J) *J += scale_.lazyProduct(*raw_jacobian);
}

/// Chooses the sign of the quaternion that is nearer to the target.
void Residual::alignSign(Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  const int row = feature_->quaternionRow();
  if (row < 0 || target_.size() != y.size() || y.segment<4>(row).dot(target_.segment<4>(row)) >= 0.) return;
  y.segment<4>(row) *= -1.;
  if (J) J->middleRows(row, 4) *= -1.;
}

void Residual::subtractTarget(Eigen::Ref<VectorXd> y) const {
  if (target_.size() == 1) {
    y.array() -= target_[0];
  } else if (target_.size() > 1) {
    y -= target_;
  }
}

void Residual::scaleRows(Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  if (scale_.size() == 1) {
    const double factor = scale_(0, 0);
    if (factor == 1.) return;
    y *= factor;
    if (!J) return;
    if (J->outerStride() == J->cols()) {
      Eigen::Map<VectorXd>(J->data(), J->size()) *= factor;
    } else {
      *J *= factor;
    }
  } else if (scale_.size() > 1) {
    y.array() *= scale_.col(0).array();
    for (int row = 0; J && row < rows_; ++row) J->row(row) *= scale_(row, 0);
  }
}

void Residual::evalDifference(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y,
                              JacobianRows* J) {
  const int own = feature_->order(), n = J ? int(J->cols()) / int(states.size()) : 0;
  const int quaternion = feature_->quaternionRow();
  y.setZero();
  double factor = 1.;
  for (int i = 0; i < differences_; ++i) factor /= tau;
  if (time_integral_) factor *= std::sqrt(tau);
  for (int i = 0; i <= differences_; ++i) {  // from the newest back
    const int first = differences_ - i;
    VectorXd& value = values_[i];
    if (J) {
      jacobians_[i].setZero(feature_->rows(), (own + 1) * n);
      JacobianRows view = jacobians_[i];
      feature_->eval(states.subspan(first, own + 1), tau, value, &view);
    } else {
      feature_->eval(states.subspan(first, own + 1), tau, value, nullptr);
    }
    if (quaternion >= 0 && i > 0 && value.segment<4>(quaternion).dot(values_[i - 1].segment<4>(quaternion)) < 0.) {
      value.segment<4>(quaternion) *= -1.;
      if (J) jacobians_[i].middleRows(quaternion, 4) *= -1.;
    }
    y += factor * value;
    if (J) J->middleCols(first * n, (own + 1) * n) += factor * jacobians_[i];
    factor *= -double(differences_ - i) / double(i + 1);  // binomial coefficients with alternating signs
  }
}

}  // namespace kinegraph::inline features_internal
