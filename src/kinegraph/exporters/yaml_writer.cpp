#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "kinegraph/common/text.h"
#include "kinegraph/exporters/writers.h"

namespace kinegraph {

namespace {

/// Writes values in YAML's flow style that the .g language reads identically.
struct YamlWriter {
  std::string operator()(bool b) const { return b ? "true" : "false"; }

  /// With a decimal point: YAML 1.1 needs one for a floating-point number.
  std::string operator()(double x) const {
    if (std::isnan(x)) return "+nan";
    if (std::isinf(x)) return x > 0 ? "+inf" : "-inf";
    std::string text = exact(x);
    if (text.find('.') == std::string::npos) text.insert(std::min(text.find('e'), text.size()), ".0");
    return text;
  }

  std::string operator()(const std::string& s) const {
    static const std::set<std::string> words = {"true", "false", "yes", "no",  "on", "off",
                                                "null", "y",     "n",   "inf", "nan"};
    std::string lower = s;
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
    const bool is_plain =
        !s.empty() && !std::isdigit(static_cast<unsigned char>(s[0])) && std::all_of(s.begin(), s.end(), plain);
    return is_plain && !words.contains(lower) ? s : quoted(s);
  }

  std::string operator()(const NumberArray& a) const {
    return list(a.numbers, [&](double x) { return (*this)(x); });
  }
  std::string operator()(const StringArray& a) const {
    return list(a, [&](const std::string& s) { return quoted(s); });
  }
  std::string operator()(const ValueList& l) const {
    return list(l, [&](const Value& v) { return std::visit(*this, v.data); });
  }
  std::string operator()(const AngleText& t) const { return quoted(cat("<", t.text, ">")); }
  std::string operator()(const NameTuple& t) const {
    return list(t.names, [&](const std::string& s) { return quoted(s); });
  }

  std::string operator()(const Graph& graph) const {
    std::string out = "{";
    for (const Node& node : graph.nodes) {
      out += out.size() > 1 ? ", " : "";
      out += cat(key(node), ": ", std::visit(*this, node.value.data));
    }
    return out + "}";
  }

  static std::string key(const Node& node) {
    if (!node.parents.empty()) return cat(node.key, "(", join(node.parents, " "), ")");
    const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c == '/' || c == '.'; };
    const bool is_plain = !node.key.empty() && std::isalpha(static_cast<unsigned char>(node.key[0])) &&
                          std::all_of(node.key.begin(), node.key.end(), plain);
    return is_plain ? node.key : cat('"', node.key, '"');
  }

  /// The escapes of YAML and .g differ, so the text uses none.
  static std::string quoted(const std::string& s) {
    const bool has_single = s.find('\'') != std::string::npos;
    const bool needs_single = s.find_first_of("\"\\") != std::string::npos;
    if (has_single && needs_single)
      throw ValueError(cat("text with both kinds of quotes, or a backslash, cannot be written as YAML: ", s));
    return needs_single ? cat('\'', s, '\'') : cat('"', s, '"');
  }

  template <class Range, class Function>
  static std::string list(const Range& range, Function text) {
    std::vector<std::string> words;
    for (const auto& element : range) words.push_back(text(element));
    return cat("[", join(words), "]");
  }
};

}  // namespace

std::string writeYaml(const Config& config, bool one_line, std::vector<std::string>* warnings) {
  const Graph graph = describeScene(config, NameRule::plain, warnings);
  if (one_line) return YamlWriter{}(graph);
  std::string out;
  for (const Node& node : graph.nodes) {
    out += cat(YamlWriter::key(node), ": ", std::visit(YamlWriter{}, node.value.data), "\n");
  }
  return out;
}

}  // namespace kinegraph
