#include <algorithm>

#include "kinegraph/common/text.h"
#include "kinegraph/gfile/grammar.h"

namespace kinegraph::inline gfile_internal {

/// After `key:` at `key_at`: returns whether the rest of its line is empty and the next nonempty line is indented
/// deeper.
/// Only for keys at the start of their line, outside of braces.
bool Grammar::blockFollows(std::size_t key_at, std::size_t& indent) {
  std::size_t key_indent = 0, next = at_;
  if (braces_ > 0 || (!atEnd() && !isOneOf(peek(), "\n#"))) return false;
  if (!startsLine(key_at, key_indent)) return false;
  while (next < text_.size() && (isSpace(text_[next]) || text_[next] == '#')) {
    if (text_[next] == '#') {
      next = std::min(text_.find('\n', next), text_.size());
    } else {
      ++next;
    }
  }
  if (next >= text_.size() || !startsLine(next, indent)) return false;
  const bool item_below_key =
      indent == key_indent && text_.substr(next, 2) == "- ";  // YAML allows "- " at the indentation of its key
  if (indent <= key_indent && !item_below_key) return false;
  at_ = next;
  return true;
}

Value Grammar::parseBlock(std::size_t indent) {
  const Level level(*this, false);
  if (isOneOf(peek(), "{[<'(")) return parseScalar();
  if (startsItem()) return parseSequence(indent);
  Value value;
  value.where = position(at_);
  Graph graph;
  parseBlockEntries(graph, indent);
  value.data = std::move(graph);
  return value;
}

/// Parses entries down to the first line with less indentation.
void Grammar::parseBlockEntries(Graph& graph, std::size_t indent) {
  for (;;) {
    skipSeparators();
    std::size_t here = 0;
    if (atEnd() || (startsLine(at_, here) && here < indent)) return;
    parseEntryInto(graph);
  }
}

bool Grammar::startsItem() const { return peek() == '-' && at_ + 1 < text_.size() && isSpace(text_[at_ + 1]); }

Value Grammar::parseSequence(std::size_t indent) {
  Value value;
  value.where = position(at_);
  NumberArray numbers;
  StringArray strings;
  ValueList list;
  for (;;) {
    skipSeparators();
    std::size_t here = 0;
    if (atEnd() || !startsLine(at_, here) || here != indent || !startsItem()) break;
    ++at_;
    skipBlanks();
    Value item = parseScalar();
    if (const double* number = item.as<double>()) numbers.numbers.push_back(*number);
    if (const std::string* word = item.as<std::string>()) strings.push_back(*word);
    list.push_back(std::move(item));
    skipBlanks();
    if (!atEnd() && !isOneOf(peek(), "\n,#"))
      fail(at_, "expected one number, string or [array] per item of a sequence");
  }
  if (numbers.numbers.size() == list.size()) {
    value.data = std::move(numbers);
  } else if (strings.size() == list.size()) {
    value.data = std::move(strings);
  } else {
    value.data = std::move(list);
  }
  return value;
}

Value Grammar::parseScalar() {
  if (!yaml_ || !(startsWord(peek()) || startsNumber(peek()))) return parseValue();
  static constexpr CharSet kFlow(",;:{}[]\n");
  const std::size_t start = at_;
  std::size_t end = start;  // end of the scalar, or start of flow style
  while (end < text_.size() && !kFlow[text_[end]] && text_.substr(end, 2) != " #") ++end;
  std::size_t rest = end;  // commas may end a line
  while (rest < text_.size() && (isBlank(text_[rest]) || text_[rest] == ',')) ++rest;
  const bool has_flow = rest < text_.size() && text_[rest] != '\n' && text_[rest] != '#';
  std::string_view line = text_.substr(start, end - start);
  while (!line.empty() && isBlank(line.back())) line.remove_suffix(1);
  const bool has_more = has_flow || line.find_first_of(" \t") != std::string_view::npos;
  const bool is_text = has_more && !has_flow;
  if (!is_text) {
    try {
      return parseValue();
    } catch (const Failure&) {
      if (has_more) throw;
    }
  }
  Value value;
  value.where = position(start);
  value.data = std::string(line);
  at_ = start + line.size();
  return value;
}

/// Skips a line "---" or "..." between YAML documents.
bool Grammar::skipDocumentMark() {
  std::size_t indent = 0;
  const std::string_view mark = text_.substr(at_, 3);
  if (!(mark == "---" || mark == "...") || !startsLine(at_, indent) || indent != 0) return false;
  const std::size_t line_end = std::min(text_.find('\n', at_), text_.size());
  const std::string_view rest = text_.substr(at_ + 3, line_end - at_ - 3);
  if (!std::all_of(rest.begin(), rest.end(), isBlank)) return false;
  at_ = line_end;
  return true;
}

}  // namespace kinegraph::inline gfile_internal
