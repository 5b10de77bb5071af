#include "kinegraph/collision/edge_check.h"

#include "kinegraph/collision/edge_engine.h"
#include "kinegraph/collision/motion_check.h"

namespace kinegraph {

static_assert(EdgeChecker::kLanes == EdgeEngine::kLanes);

EdgeChecker::EdgeChecker(const State& scene, double margin, double tolerance)
    : state_(std::make_unique<const State>(scene)),
      margin_(margin),
      tolerance_(tolerance),
      engine_(std::make_unique<EdgeEngine>(scene, tolerance)) {}

EdgeChecker::EdgeChecker(const EdgeChecker& other) : EdgeChecker(*other.state_, other.margin_, other.tolerance_) {}

EdgeChecker::~EdgeChecker() = default;

void EdgeChecker::setTolerance(double tolerance) {
  tolerance_ = tolerance;
  engine_->setTolerance(tolerance);
}

bool EdgeChecker::isFree(const double* q) {
  bool free = true;
  engine_->areFree(&q, 1, margin_, &free);
  return free;
}

void EdgeChecker::areFree(std::span<const double* const> Q, bool* free) {
  engine_->areFree(Q.data(), int(Q.size()), margin_, free);
}

bool EdgeChecker::areAllFree(std::span<const double* const> Q) {
  return engine_->areAllFree(Q.data(), int(Q.size()), margin_);
}

void EdgeChecker::forget() { engine_->forget(); }

bool EdgeChecker::isFree(const double* from, const double* to) { return engine_->isFree(from, to, margin_); }

const std::optional<MotionContact>& EdgeChecker::lastHit() const { return engine_->measuredHit(); }

const std::optional<MotionContact>& EdgeChecker::lastHitPair() const { return engine_->lastHit(); }

std::optional<MotionContact> EdgeChecker::firstContact(const double* from, const double* to) {
  if (!motions_) motions_ = std::make_unique<MotionChecker>(*state_);
  return motions_->firstContact(from, to, margin_, tolerance_);
}

double EdgeChecker::clearance(const double* q, double most) { return engine_->clearance(q, most); }

double EdgeChecker::clearance(const double* from, const double* to, double most) {
  return engine_->clearance(from, to, most);
}

const std::vector<MotionContact>& EdgeChecker::approaches(const double* from, const double* to, double most) {
  engine_->findApproaches(from, to, most, approaches_);
  return approaches_;
}

}  // namespace kinegraph
