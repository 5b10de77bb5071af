#pragma once

namespace kinegraph {

/// Stands for a field of any type.
struct AnyField {
  template <class T>
  operator T() const;  // only its type is asked for
};

/// How many fields an aggregate has, at compile time.
template <class Aggregate, class... Fields>
constexpr int fieldCount() {
  if constexpr (requires { Aggregate{Fields{}..., AnyField{}}; }) {
    return fieldCount<Aggregate, Fields..., AnyField>();
  } else {
    return int(sizeof...(Fields));
  }
}

}  // namespace kinegraph
