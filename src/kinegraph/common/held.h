#pragma once

#include <utility>

#include "kinegraph/common/errors.h"

namespace kinegraph {

/// The owner of what an object consists of: a std::shared_ptr or std::unique_ptr that throws ValueError if the object
/// was moved from. A moved-from object can be destroyed, and another one can be assigned to it.
template <class Pointer>
class Held {
 public:
  /// `owner` is the name of the object's class.
  Held(const char* owner, Pointer pointer) : owner_(owner), pointer_(std::move(pointer)) {}

  auto* operator->() const { return pointer().get(); }
  auto& operator*() const { return *pointer(); }
  explicit operator bool() const { return bool(pointer_); }

  const Pointer& pointer() const {
    if (!pointer_)
      throw ValueError(std::string(owner_) + ": this object was moved from; assign another one to it before its use");
    return pointer_;
  }
  operator const Pointer&() const { return pointer(); }

 private:
  const char* owner_;
  Pointer pointer_;
};

}  // namespace kinegraph
