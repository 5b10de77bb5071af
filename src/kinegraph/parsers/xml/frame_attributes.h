#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kinegraph/gfile/value.h"
#include "kinegraph/math/pose.h"

namespace kinegraph::inline parsers_internal {

/// Builds the attributes of a frame; all get one position in the file, unless `setPlace` changes it.
class FrameAttributes {
 public:
  explicit FrameAttributes(const SourcePosition& where) : where_(where) {}

  /// Sets the position of the attributes that follow. Returns the former one.
  SourcePosition setPlace(const SourcePosition& where) { return std::exchange(where_, where); }

  template <class T>
  void add(const char* key, T data) {
    Node node;
    node.key = key;
    node.where = node.value.where = where_;
    node.value.data = std::move(data);
    graph_.nodes.push_back(std::move(node));
  }
  void addNumbers(const char* key, std::vector<double> numbers) { add(key, NumberArray{std::move(numbers), 1}); }
  void addPose(const Pose& pose) {
    if (pose.isIdentity(0.)) return;
    const Vector7d x = pose.numbers();
    addNumbers("pose", {x.begin(), x.end()});
  }
  bool empty() const { return graph_.nodes.empty(); }
  const Node* find(const char* key) const { return graph_.find(key); }
  /// Moves the attributes into a frame entry of a scene; `parent` is empty for a root.
  Node takeFrame(const std::string& name, const std::string& parent, const SourcePosition& where) {
    Node node;
    node.key = name;
    if (!parent.empty()) node.parents = {parent};
    node.where = node.value.where = where;
    node.value.data = std::move(graph_);
    return node;
  }

 private:
  SourcePosition where_;
  Graph graph_;
};

}  // namespace kinegraph::inline parsers_internal
