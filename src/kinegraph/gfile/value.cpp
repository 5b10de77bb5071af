#include "kinegraph/gfile/value.h"

#include <algorithm>
#include <utility>

#include "kinegraph/common/text.h"

namespace kinegraph {

Graph::Graph() = default;
Graph::Graph(const Graph& other) = default;
Graph::Graph(Graph&& other) noexcept = default;
Graph& Graph::operator=(const Graph& other) = default;
Graph& Graph::operator=(Graph&& other) noexcept = default;
Graph::~Graph() = default;

const Node* Graph::find(std::string_view key) const {
  for (const Node& node : nodes) {
    if (node.key == key) return &node;
  }
  return nullptr;
}

Node* Graph::find(std::string_view key) { return const_cast<Node*>(std::as_const(*this).find(key)); }

void Graph::set(Node node) {
  if (Node* existing = find(node.key)) {
    *existing = std::move(node);
  } else {
    nodes.push_back(std::move(node));
  }
}

void Graph::erase(std::string_view key) {
  std::erase_if(nodes, [&](const Node& node) { return node.key == key; });
}

bool Graph::operator==(const Graph& other) const { return nodes == other.nodes; }

std::string describe(const Value& value) {
  struct Describer {
    std::string operator()(bool b) const { return b ? "a flag (true)" : "a flag (false)"; }
    std::string operator()(double x) const { return cat("the number ", x); }
    std::string operator()(const std::string& s) const { return cat("the text '", s, "'"); }
    std::string operator()(const NumberArray& a) const { return cat("a list of ", a.numbers.size(), " numbers"); }
    std::string operator()(const StringArray& a) const { return cat("a list of ", a.size(), " strings"); }
    std::string operator()(const ValueList& l) const { return cat("a list of ", l.size(), " lists"); }
    std::string operator()(const AngleText& t) const { return cat("<", t.text, ">"); }
    std::string operator()(const NameTuple& t) const { return cat("(", join(t.names, " "), ")"); }
    std::string operator()(const Graph&) const { return "a graph {...}"; }
  };
  return std::visit(Describer{}, value.data);
}

}  // namespace kinegraph
