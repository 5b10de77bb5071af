// Measures the speed of reading `.g` texts, and whether the time is linear in their length.
//     parsing [ROUNDS]
// Texts of three kinds, each in three lengths: a handwritten scene, a mesh written by `write` (numbers), and
// block-style YAML. Prints MB/s of the whole parser with its tree of values, and of the scanner alone, which only finds
// the words and numbers. Times are the best of some rounds, in processor time.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "kinegraph/common/text.h"
#include "kinegraph/gfile/parser.h"
#include "kinegraph/gfile/scanner.h"

using namespace kinegraph;

namespace {

std::string sceneText(std::size_t bytes) {
  std::string text = "base: { X: \"t(0 0 .5)\", shape: ssBox, size: [1.2 .8 .1 .02], color: [.3 .3 .3] }\n";
  for (int i = 1; text.size() < bytes; ++i) {
    text += cat("link", i, " (base): { joint: hingeX, pre: [0, 0, 0.", i % 97, "], limits: [-2.9 2.9], q: -0.", i,
                ", # of the arm\n  shape: capsule, size: [.3 .05], color: [.9 .9 .9], contact: -2, mass: 1.", i,
                ", logical: { is_object } }\n");
  }
  return text;
}

std::string meshText(std::size_t bytes) {
  std::string text = "mesh: { shape: mesh, vertices: [";
  for (int i = 1; text.size() < bytes; ++i) text += exact(1. / i) + (i % 3 ? " " : "\n");
  return text + "] }\n";
}

std::string yamlText(std::size_t bytes) {
  std::string text;
  for (int i = 1; text.size() < bytes; ++i) {
    text += cat("link", i, ":\n  shape: box\n  size: [1, .5, 0.", i, "]\n  tags:\n    - one\n    - two\n");
  }
  return text;
}

/// Scans a text token by token: names, words, numbers, strings, brackets.
class Tokens : private Scanner {
 public:
  Tokens(std::string_view text, const std::string& file) : Scanner(text, file) {}

  std::size_t count() {
    static constexpr CharSet kWordEnds(" \t\r\n,;:=#[](){}<>\"'"), kNumberEnds(" \t\r\n,;#])}");
    std::size_t count = 0;
    for (skipSeparators(); !atEnd(); skipSeparators(), ++count) {
      if (peek() == '"' || peek() == '\'') {
        parseQuoted(peek());
      } else if (peek() == '<') {
        parseAngle();
      } else if (startsNumber(peek()) && !(peek() == '-' && text_.substr(at_, 2) == "- ")) {
        parseNumber(kNumberEnds);
      } else if (startsWord(peek())) {
        parseWord(kWordEnds);
      } else {
        ++at_;  // a bracket or a colon
      }
    }
    return count;
  }
};

double seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

/// Returns MB/s of `read`, the best of some rounds.
template <class Read>
double speed(const std::string& text, int rounds, const Read& read) {
  double best = 1e9;
  for (int round = 0; round < rounds; ++round) {
    const double start = seconds();
    read(text);
    best = std::min(best, seconds() - start);
  }
  return double(text.size()) * 1e-6 / best;
}

}  // namespace

int main(int count, char** arguments) {
  const int rounds = count > 1 ? std::max(std::atoi(arguments[1]), 1) : 5;
  struct Kind {
    const char* name;
    std::string (*make)(std::size_t bytes);
    const char* file;
  };
  std::printf("%-6s %8s %10s %10s\n", "text", "MB", "parse MB/s", "scan MB/s");
  for (const Kind& kind : {Kind{"scene", sceneText, "models/scenarios/scene.g"},
                           {"mesh", meshText, "models/scenarios/scene.g"},
                           {"yaml", yamlText, "models/scenarios/scene.yml"}}) {
    for (const std::size_t bytes : {1000000, 2000000, 4000000}) {
      const std::string text = kind.make(bytes);
      const double parsed = speed(text, rounds, [&](const std::string& t) {
        if (!parseAll(t, kind.file).diagnostics.empty()) std::abort();
      });
      const double scanned = speed(text, rounds, [&](const std::string& t) {
        if (Tokens(t, kind.file).count() == 0) std::abort();
      });
      std::printf("%-6s %8.1f %10.1f %10.1f\n", kind.name, double(text.size()) * 1e-6, parsed, scanned);
    }
  }
}
