#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "kinegraph/common/errors.h"

namespace kinegraph {

struct Node;
struct Value;

/// The entries of a `{ ... }` or of a whole file, in order. Keys may repeat; look-ups find the first.
struct Graph {
  std::vector<Node> nodes;

  Graph();  // defined out of line because clang needs a complete Node
  Graph(const Graph& other);
  Graph(Graph&& other) noexcept;
  Graph& operator=(const Graph& other);
  Graph& operator=(Graph&& other) noexcept;
  ~Graph();

  const Node* find(std::string_view key) const;
  Node* find(std::string_view key);
  void set(Node node);               ///< replaces the first node of that key, or appends
  void erase(std::string_view key);  ///< removes all nodes of that key
  bool operator==(const Graph& other) const;
};

/// `<text>`: a file, or a pose in older files; the reader of the key decides.
struct AngleText {
  std::string text;
  bool operator==(const AngleText&) const = default;
};

/// `(a b)`: names.
struct NameTuple {
  std::vector<std::string> names;
  bool operator==(const NameTuple&) const = default;
};

/// `[1 2; 3 4]`: numbers in row-major order; `rows` is 1 unless `;` separates rows of equal length.
struct NumberArray {
  std::vector<double> numbers;
  int rows = 1;
  bool operator==(const NumberArray&) const = default;
};

using StringArray = std::vector<std::string>;
using ValueList = std::vector<Value>;  ///< arrays of arrays, and mixed ones

/// A value with its position in the text. Comparisons ignore positions.
struct Value {
  std::variant<bool, double, std::string, NumberArray, StringArray, ValueList, AngleText, NameTuple, Graph> data = true;
  SourcePosition where;

  template <class T>
  const T* as() const {
    return std::get_if<T>(&data);
  }
  bool operator==(const Value& other) const { return data == other.data; }
};

/// One entry: `tags key (parents) : value`. Only graphs have tags.
struct Node {
  std::string key;
  std::vector<std::string> tags;
  std::vector<std::string> parents;
  Value value;
  SourcePosition where;

  bool operator==(const Node& other) const {
    return key == other.key && tags == other.tags && parents == other.parents && value == other.value;
  }
};

/// Describes a value for messages: "the number 1", "a list of 3 numbers", "the text 'a'".
std::string describe(const Value& value);

}  // namespace kinegraph
