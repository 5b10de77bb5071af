#include "kinegraph/gfile/writer.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "kinegraph/common/text.h"

namespace kinegraph::inline gfile_internal {

namespace {

bool isPlainWord(const std::string& text) {
  if (text.empty() || text == "true" || text == "True" || text == "false" || text == "False" || text == "inf" ||
      text == "nan") {
    return false;
  }
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '/' || c == '.' || c == '-' || c == '%';
  };
  return (std::isalpha(static_cast<unsigned char>(text[0])) || text[0] == '_') &&
         std::all_of(text.begin(), text.end(), plain);
}

std::string quoted(const std::string& text) {
  if (text.find('"') == std::string::npos) return cat('"', text, '"');
  if (text.find('\'') == std::string::npos) return cat('\'', text, '\'');
  throw ValueError(cat("text with both kinds of quotes cannot be written: ", text));
}

std::string number(double x) { return std::isnan(x) ? "+nan" : std::isinf(x) ? (x > 0 ? "+inf" : "-inf") : exact(x); }

struct Writer {
  std::string operator()(bool b) const { return b ? "true" : "false"; }
  std::string operator()(double x) const { return number(x); }
  std::string operator()(const std::string& s) const { return isPlainWord(s) ? s : quoted(s); }
  std::string operator()(const NumberArray& a) const {
    std::string out = "[";
    const std::size_t columns = a.rows > 1 ? a.numbers.size() / std::size_t(a.rows) : 0;
    for (std::size_t i = 0; i < a.numbers.size(); ++i) {
      if (i) out += columns && i % columns == 0 ? "; " : " ";
      out += number(a.numbers[i]);
    }
    return out + "]";
  }
  std::string operator()(const StringArray& a) const {
    std::string out = "[";
    for (std::size_t i = 0; i < a.size(); ++i) out += (i ? " " : "") + quoted(a[i]);
    return out + "]";
  }
  std::string operator()(const ValueList& l) const {
    std::string out = "[";
    for (std::size_t i = 0; i < l.size(); ++i) out += (i ? ", " : "") + write(l[i]);
    return out + "]";
  }
  std::string operator()(const AngleText& t) const { return cat("<", t.text, ">"); }
  std::string operator()(const NameTuple& t) const { return cat("(", join(t.names, " "), ")"); }
  std::string operator()(const Graph& g) const { return cat("{ ", writeEntries(g), " }"); }
};

std::string writeKey(const Node& node) {
  std::string key;
  for (const std::string& tag : node.tags) key += tag + " ";
  const bool needs_quotes = node.key.find_first_of(":\t\n\r,;[]{}()<=!~'#") != std::string::npos;
  key += needs_quotes ? quoted(node.key) : node.key;
  if (node.parents.empty()) return key;
  std::vector<std::string> parents;
  for (const std::string& parent : node.parents) {
    const bool special = parent.empty() || parent.find_first_of(" \t\r\n,(){}[]<>:=\"'") != std::string::npos;
    parents.push_back(special ? quoted(parent) : parent);
  }
  return cat(key, " (", join(parents, " "), ")");
}

std::string writeEntry(const Node& node) {
  if (const bool* flag = node.value.as<bool>()) return writeKey(node) + (*flag ? "" : "!");
  return cat(writeKey(node), ": ", write(node.value));
}

}  // namespace

std::string write(const Value& value) { return std::visit(Writer{}, value.data); }

std::string writeEntries(const Graph& graph) {
  std::string out;
  for (const Node& node : graph.nodes) out += (out.empty() ? "" : ", ") + writeEntry(node);
  return out;
}

std::string writeFile(const Graph& graph) {
  std::string out;
  for (const Node& node : graph.nodes) out += writeEntry(node) + "\n";
  return out;
}

}  // namespace kinegraph::inline gfile_internal
