#include "kinegraph/logic/domain.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <utility>

#include "kinegraph/common/text.h"
#include "kinegraph/logic/logic_scanner.h"

namespace kinegraph {

namespace {

using Token = LogicScanner::Token;

const std::vector<std::string> kBlocks = {"START_STATE", "DecisionRule", "Rule", "FOL_World", "REWARD"};
const std::vector<std::string> kReserved = {"QUIT", "WAIT", "Terminate", "ANY", "INFEASIBLE"};

/// `(p a b)`, `(p a b)!`, `(p a b)=2`; commas are spaces.
Literal readLiteral(LogicScanner& scan) {
  Literal literal;
  literal.where = scan.expect('(', "of a literal such as (on table cup)").where;
  while (scan.takeIf(',')) {
  }
  literal.predicate = scan.expectWord("a predicate").text;
  while (scan.peek().isWord() || scan.peek().kind == Token::Kind::number || scan.peek().is(',')) {
    const Token word = scan.take();
    if (!word.is(',')) literal.arguments.push_back(word.text);
  }
  scan.expect(')', "after the arguments of a literal");
  literal.negated = scan.takeIf('!');
  if (!scan.takeIf('=')) return literal;
  if (literal.negated) throw ParseError(literal.where, cat(literal.str(), "= has both '!' and a value"));
  const Token value = scan.take();
  if (value.isWord() && (value.text == "true" || value.text == "false")) {
    literal.negated = value.text == "false";
  } else if (value.kind == Token::Kind::number) {
    literal.predicate += "=";
    literal.arguments.push_back(exact(readNumber(value.text.c_str())));  // 2, 2. and 2.0 are one value
    literal.negated = scan.takeIf('!');
  } else {
    throw ParseError(value.where,
                     cat("expected a number, true or false behind ", literal.str(), "=, found ", value.str()));
  }
  return literal;
}

/// An effect that sets a value deletes the value before.
std::vector<Literal> withValuesReplaced(const std::vector<Literal>& effects) {
  std::vector<Literal> all;
  for (const Literal& effect : effects) {
    if (hasValue(effect.predicate) && !effect.negated) {
      Literal before = effect;
      before.negated = true;
      before.arguments.back() = std::string(kAny);
      all.push_back(std::move(before));
    }
    all.push_back(effect);
  }
  return all;
}

/// The inverse, for writing.
std::vector<Literal> withoutReplacedValues(const std::vector<Literal>& effects) {
  std::vector<Literal> all;
  for (const Literal& effect : effects) {
    const bool replaces = hasValue(effect.predicate) && effect.negated && effect.arguments.back() == kAny;
    if (!replaces) all.push_back(effect);
  }
  return all;
}

std::string folText(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw FileError(cat("readFol: cannot read '", path, "'"));
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

class FolReader {
 public:
  FolReader() { known_.insert(kReserved.begin(), kReserved.end()); }

  LogicDomain read(std::string_view text, const std::string& file) {
    readEntries(text, file);
    return std::move(domain_);
  }

 private:
  void readEntries(std::string_view text, const std::string& file) {
    LogicScanner outer = std::exchange(scan_, LogicScanner(text, file, '#'));
    const std::string outer_file = std::exchange(file_, file);
    files_.push_back(std::filesystem::weakly_canonical(file).string());
    while (scan_.peek().kind != Token::Kind::end) readEntry();
    files_.pop_back();
    file_ = outer_file;
    scan_ = std::move(outer);
  }

  /// Reads `Include = 'words.g'`, a path relative to this file.
  void include(const Token& word) {
    scan_.takeIf('=') || scan_.takeIf(':');
    const bool angle = scan_.takeIf('<');
    Token name = scan_.take();
    if (name.kind != Token::Kind::text && name.kind != Token::Kind::word)
      throw ParseError(name.where, cat("expected the name of a file behind Include, found ", name.str()));
    std::string& path = name.text;
    if (path.size() > 1 && path.front() == '\'' && path.back() == '\'') path = path.substr(1, path.size() - 2);
    if (angle) scan_.expect('>', "after the name of the file");
    const std::filesystem::path full = std::filesystem::path(file_).parent_path() / path;
    if (!std::filesystem::is_regular_file(full))
      throw ParseError(name.where, cat("Include: there is no file '", full.lexically_normal().string(), "'"));
    if (std::ranges::find(files_, std::filesystem::weakly_canonical(full).string()) != files_.end())
      throw ParseError(word.where, cat("'", path, "' includes itself"));
    const std::string text = folText(full.string());
    readEntries(text, full.lexically_normal().string());
  }

  void readEntry() {
    if (scan_.takeIf(',')) return;
    const Token word = scan_.expectWord("a symbol, START_STATE, DecisionRule or Rule");
    if (word.text == "Include") {
      include(word);
    } else if (word.text == "START_STATE") {
      scan_.takeIf(':');
      for (Literal& fact : readBlock({})) domain_.start.push_back(std::move(fact));
    } else if (word.text == "DecisionRule" || word.text == "Rule") {
      readRule(word);
    } else if (word.text == "FOL_World" || word.text == "REWARD") {
      skipBlock();
    } else if (scan_.peek().is('{') || scan_.peek().is(':')) {
      refuseBlock(word);
    } else {
      if (known_.insert(word.text).second) domain_.symbols.push_back(word.text);
      last_symbol_ = word;
    }
  }

  /// Refuses `word {`. In `DecisonRule pick {` the word before it on the line is the misspelled one.
  [[noreturn]] void refuseBlock(const Token& word) const {
    const SourcePosition& before = last_symbol_.where;
    const bool has_name = before.known() && before.file == word.where.file && before.line == word.where.line &&
                          similarNames(word.text, kBlocks).empty();
    const Token& kind = has_name ? last_symbol_ : word;
    if (kind.text.starts_with("BELIEF") || kind.text.starts_with("Belief")) refuseBelief(kind);
    throw ParseError(kind.where, cat("unknown block '", kind.text, "'; expected one of ", join(kBlocks),
                                     similarHint(kind.text, kBlocks)));
  }

  [[noreturn]] static void refuseBelief(const Token& at) {
    throw ParseError(at.where, "several states with probabilities (beliefs) are not supported; expected one state");
  }

  void skipBlock() {
    scan_.takeIf(':');
    scan_.expect('{', "of the block");
    for (int depth = 1; depth > 0;) {
      const Token token = scan_.take();
      if (token.kind == Token::Kind::end) throw ParseError(token.where, "expected '}' of the block, found the end");
      depth += token.is('{') ? 1 : token.is('}') ? -1 : 0;
    }
  }

  /// Reads `{ (p a) (q b)! }`. Words have to be declared or among `variables`.
  std::vector<Literal> readBlock(const std::vector<std::string>& variables) {
    scan_.expect('{', "of a list of literals");
    std::vector<Literal> literals;
    while (!scan_.takeIf('}')) {
      if (scan_.takeIf(',')) continue;
      if (scan_.peek().isWord()) refuseWord();
      if (scan_.peek().is('{')) refuseBelief(scan_.peek());
      literals.push_back(readLiteral(scan_));
      requireKnown(literals.back(), variables);
    }
    if (scan_.peek().is('[')) throw ParseError(scan_.peek().where, "rules with probabilities are not supported");
    return literals;
  }

  void refuseWord() {
    if (scan_.peek().text == "aggregate") throw ParseError(scan_.peek().where, "aggregate is not supported");
    scan_.fail("a literal such as (on table cup), or '}'");
  }

  void requireKnown(const Literal& literal, const std::vector<std::string>& variables) {
    const auto require = [&](const std::string& word, const char* what) {
      if (known_.contains(word) || std::ranges::find(variables, word) != variables.end()) return;
      if (variables.empty()) return;  // START_STATE names frames of the scene
      std::vector<std::string> near(known_.begin(), known_.end());
      near.insert(near.end(), variables.begin(), variables.end());
      throw ParseError(literal.where, cat("unknown ", what, " '", word, "' in ", literal.str(),
                                          "; declare it in a line of its own", similarHint(word, near)));
    };
    const bool valued = hasValue(literal.predicate);
    const std::string predicate = literal.predicate.substr(0, literal.predicate.size() - (valued ? 1 : 0));
    if (!known_.contains(predicate)) {
      throw ParseError(literal.where, cat("unknown predicate '", predicate, "' in ", literal.str(),
                                          "; declare it in a line of its own",
                                          similarHint(predicate, {known_.begin(), known_.end()})));
    }
    for (std::size_t i = 0; i + (valued ? 1 : 0) < literal.arguments.size(); ++i)
      require(literal.arguments[i], "symbol or variable");
  }

  void takeLabel(const char* label) {
    if (scan_.peek().isWord() && scan_.peek().text == label) {
      scan_.take();
      scan_.takeIf(':');
    }
  }

  void readRule(const Token& kind) {
    LogicRule rule;
    rule.where = kind.where;
    rule.is_decision = kind.text == "DecisionRule";
    if (scan_.peek().isWord()) rule.name = scan_.take().text;
    if (rule.name.empty() && rule.is_decision) scan_.fail("the name of the DecisionRule");
    scan_.takeIf(':');
    scan_.expect('{', "of the rule");
    while (!scan_.peek().is('{')) {
      if (scan_.takeIf(',')) continue;
      takeLabel("pre");
      if (scan_.peek().is('{')) break;
      const Token variable = scan_.expectWord("a variable, or '{' of the precondition");
      if (std::ranges::find(rule.variables, variable.text) != rule.variables.end())
        throw ParseError(variable.where, cat("variable '", variable.text, "' occurs twice"));
      rule.variables.push_back(variable.text);
    }
    rule.pre = readBlock(rule.variables);
    scan_.takeIf(',');
    takeLabel("eff");
    rule.eff = withValuesReplaced(readBlock(rule.variables));
    scan_.takeIf(',');
    if (scan_.peek().isWord() || scan_.peek().is('[')) scan_.fail("'}' of the rule; further entries are not supported");
    scan_.expect('}', "of the rule");
    requireBound(rule);
    domain_.rules.push_back(std::move(rule));
  }

  void requireBound(const LogicRule& rule) {
    if (rule.pre.empty()) {
      throw ParseError(rule.where, cat("the precondition of '", rule.name, "' is empty; it would never fire"));
    }
    for (const std::string& variable : rule.variables) {
      const bool bound = std::ranges::any_of(rule.pre, [&](const Literal& literal) {
        return !literal.negated && std::ranges::find(literal.arguments, variable) != literal.arguments.end();
      });
      if (bound) continue;
      throw ParseError(rule.where,
                       cat("rule '", rule.name, "': no literal of the precondition that has to hold has the variable '",
                           variable, "'; it could be anything"));
    }
  }

  LogicScanner scan_{"", "", '#'};
  std::string file_;
  std::vector<std::string> files_;  ///< that are being read
  Token last_symbol_;
  LogicDomain domain_;
  std::set<std::string> known_;
};

std::string writeBlock(const std::vector<Literal>& literals) {
  std::string text = "  {\n";
  for (const Literal& literal : literals) text += "    " + literal.str() + "\n";
  return text + "  }\n";
}

}  // namespace

LogicDomain readFol(std::string_view text, const std::string& file) { return FolReader().read(text, file); }

LogicDomain readFolFile(const std::string& path) { return readFol(folText(path), path); }

std::vector<Literal> readLiterals(std::string_view text, const std::string& file) {
  LogicScanner scan(text, file, '#');
  std::vector<Literal> literals;
  const bool braces = scan.takeIf('{');
  while (scan.peek().kind != Token::Kind::end && !scan.peek().is('}')) {
    if (!scan.takeIf(',')) literals.push_back(readLiteral(scan));
  }
  if (braces) scan.expect('}', "of the list of literals");
  if (scan.peek().kind != Token::Kind::end) scan.fail("a literal such as (on table cup)");
  return literals;
}

std::string writeFol(const LogicDomain& domain) {
  std::string text;
  for (const std::string& symbol : domain.symbols) text += symbol + "\n";
  text += "START_STATE {" + std::string(domain.start.empty() ? "" : "\n");
  for (const Literal& literal : domain.start) text += "  " + literal.str() + "\n";
  text += "}\n";
  for (const LogicRule& rule : domain.rules) {
    if (rule.is_derived)
      throw ValueError(cat("writeFol: '", rule.name, "' is a derived predicate; .fol files have none"));
    if (!rule.conditions.empty() || !rule.conditional.empty()) {
      throw ValueError(cat("writeFol: action '", rule.name,
                           "' has conditions with or, forall or exists, or effects with when; .fol files have none"));
    }
    text += cat(rule.is_decision ? "DecisionRule " : "Rule ", rule.name, " {\n  ", join(rule.variables), "\n");
    text += writeBlock(rule.pre) + writeBlock(withoutReplacedValues(rule.eff)) + "}\n";
  }
  return text;
}

void addAction(LogicDomain& domain, const std::string& name, const std::vector<std::string>& variables,
               std::string_view pre, std::string_view eff) {
  // The reader checks the new rule, too.
  LogicDomain alone;
  LogicRule rule{name, variables, {}, readLiterals(pre, "pre"), withValuesReplaced(readLiterals(eff, "eff"))};
  for (const auto* list : {&rule.pre, &rule.eff}) {
    for (const Literal& literal : *list) {
      const std::size_t value = hasValue(literal.predicate) ? 1 : 0;
      alone.symbols.push_back(literal.predicate.substr(0, literal.predicate.size() - value));
      for (const std::string& word : literal.arguments) {
        if (std::ranges::find(variables, word) == variables.end()) alone.symbols.push_back(word);
      }
    }
  }
  alone.rules.push_back(rule);
  const LogicDomain checked = readFol(writeFol(alone), "addAction " + name);
  for (const std::string& symbol : checked.symbols) {
    if (std::ranges::find(domain.symbols, symbol) == domain.symbols.end()) domain.symbols.push_back(symbol);
  }
  domain.rules.push_back(std::move(rule));
}

}  // namespace kinegraph
