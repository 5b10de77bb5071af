#include "kinegraph/gfile/parser.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kinegraph/common/random.h"
#include "kinegraph/common/text.h"
#include "kinegraph/gfile/writer.h"

using namespace kinegraph;

namespace {

/// The one value of `a: { x<text> }`, as text.
std::string valueOf(const std::string& text) {
  const Graph graph = parse("a: { " + text + " }", "");
  std::string out;
  for (const Node& node : graph.nodes.at(0).value.as<Graph>()->nodes) {
    out += (out.empty() ? "" : " | ") + node.key + "=" + write(node.value);
  }
  return out;
}

std::string errorOf(const std::string& text) {
  for (const Diagnostic& d : parseAll(text, "f.g").diagnostics) {
    if (d.severity == Diagnostic::Severity::error) return cat(d.where.str(), ": ", d.message);
  }
  return "";
}

}  // namespace

TEST(Parser, ReadsTheValuesOfTheSpecification) {
  EXPECT_EQ(valueOf("x"), "x=true");
  EXPECT_EQ(valueOf("x!"), "x=false");
  EXPECT_EQ(valueOf("x:!"), "x=false");
  EXPECT_EQ(valueOf("x:~"), "x=true");
  EXPECT_EQ(valueOf("-x"), "-x=true");
  EXPECT_EQ(valueOf("!x"), "x=false");
  EXPECT_EQ(valueOf("x y z"), "x y z=true");
  EXPECT_EQ(valueOf("x, y; z"), "x=true | y=true | z=true");
  EXPECT_EQ(valueOf("x=1 y:2, z = 3; w : 4"), "x=1 | y=2 | z=3 | w=4");
  EXPECT_EQ(valueOf("\"k 1\": 3"), "k 1=3");
  EXPECT_EQ(valueOf("3: 5 k-2: 4"), "3=5 | k-2=4");
  EXPECT_EQ(valueOf("s:hello t:a/b.c-d u:/abs"), "s=hello | t=a/b.c-d | u=\"/abs\"");
  EXPECT_EQ(valueOf("a: true b: True c: false d: yes"), "a=true | b=true | c=false | d=yes");
  EXPECT_EQ(valueOf("y:+3 z:-.5e1"), "y=3 | z=-5");
  EXPECT_EQ(valueOf("x: foo(1) y: a=b"), "x=\"foo(1)\" | y=\"a=b\"");
  EXPECT_EQ(valueOf("x: 'a \"b\"'"), "x='a \"b\"'");
  EXPECT_EQ(valueOf("shape:box size:[1 1 1]"), "shape=box | size=[1 1 1]");
  EXPECT_EQ(valueOf("x: <a/b.g> y: \"<c.g>\" z: (a b)"), "x=<a/b.g> | y=<c.g> | z=(a b)");
  EXPECT_EQ(valueOf("x:\ny: 2"), "x=true | y=2") << "a value stands on the line of its key";
  EXPECT_EQ(valueOf("foo#bar: 1").substr(0, 8), "foo=true") << "in a key, # starts a comment";
  EXPECT_EQ(valueOf("x: foo#bar"), "x=\"foo#bar\"") << "in a word it does not";
}

TEST(Parser, ReadsArraysOverLinesAndOfAllKinds) {
  EXPECT_EQ(valueOf("x: [0, 0.008 .045]"), "x=[0 0.008 0.045]");
  EXPECT_EQ(valueOf("x: [1,\n1,\n1]"), "x=[1 1 1]");
  EXPECT_EQ(valueOf("x: [1 2; 3 4]"), "x=[1 2; 3 4]");
  EXPECT_EQ(valueOf("x:\n[1 2]"), "x=[1 2]") << "nothing else can start with [";
  EXPECT_EQ(valueOf("x: []"), "x=[]");
  EXPECT_EQ(valueOf("x: [a, b c]"), "x=[\"a\" \"b\" \"c\"]");
  EXPECT_EQ(valueOf("x: [a, 1]"), "x=[\"a\" \"1\"]");
  EXPECT_EQ(valueOf("x: [\"a\", \"b\"]"), "x=[\"a\" \"b\"]");
  EXPECT_EQ(valueOf("x: [\"abc\", \"d e\"]"), "x=[\"abc\" \"d e\"]");
  EXPECT_EQ(valueOf("x: [[1 2 3], [4 5]]"), "x=[[1 2 3], [4 5]]");
  EXPECT_EQ(valueOf("x: [[[1] [2]] [3]]"), "x=[[[1], [2]], [3]]");
  EXPECT_EQ(valueOf("x: [1 2 # comment\n 3]"), "x=[1 2 3]");
  EXPECT_EQ(valueOf("x: [<d 2 2> 1 2 3 4]"), "x=[1 2 3 4]");
}

TEST(Parser, ReadsHeadsWithParentsAndTags) {
  const Graph graph = parse("a: {}\n b (a) {x}\n (a b) { y }\n body c(a): {}\n Edit(a): {}\n d(a, b): {}", "");
  ASSERT_EQ(graph.nodes.size(), 6u);
  EXPECT_EQ(graph.nodes[1].parents, std::vector<std::string>{"a"});
  EXPECT_EQ(graph.nodes[2].key, "");
  EXPECT_EQ(graph.nodes[2].parents, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(graph.nodes[3].tags, std::vector<std::string>{"body"});
  EXPECT_EQ(graph.nodes[3].key, "c");
  EXPECT_EQ(graph.nodes[4].key, "Edit");
  EXPECT_EQ(graph.nodes[5].parents, (std::vector<std::string>{"a", "b"}));
}

TEST(Parser, SkipsByteOrderMarksCarriageReturnsAndOuterBraces) {
  EXPECT_EQ(parse("\xEF\xBB\xBF{ a: {x: 1}\r\nb: {}\r\n}", "").nodes.size(), 2u);
  EXPECT_EQ(parse("\xEF\xBB\xBF"
                  "a: {}",
                  "")
                .nodes[0]
                .key,
            "a");
  EXPECT_EQ(parse("{ a } b", "").nodes.size(), 2u) << "a first entry without a name";
}

TEST(Parser, ErrorsSayWhereAndWhat) {
  EXPECT_EQ(errorOf("a: { x: 1.2.3 }"), "f.g:1:9: '1.2.3' is not a number");
  EXPECT_EQ(errorOf("a: { x: 0x10 }"), "f.g:1:9: '0x10' is not a number");
  EXPECT_EQ(errorOf("a: { x: 1f }"), "f.g:1:9: '1f' is not a number");
  EXPECT_EQ(errorOf("a: { x: - }"), "f.g:1:9: '-' is not a number");
  EXPECT_EQ(errorOf("a: {x:1} } b: {}"), "f.g:1:10: this '}' closes nothing; is an earlier '}' superfluous?");
  EXPECT_EQ(errorOf("a: {\n s: \"abc\n }"), "f.g:2:5: this \" is never closed");
  EXPECT_EQ(errorOf("a: { s: [1 2 }"), "f.g:1:14: '}' in an array; expected numbers or strings up to ']'");
  EXPECT_EQ(errorOf("a: { s: [1 a] }"), "f.g:1:12: 'a' in an array of numbers");
  EXPECT_EQ(errorOf("a: { s: [1 2; 3] }"), "f.g:1:9: rows of different length in an array: 2 and 1");
  EXPECT_NE(errorOf("a: { x: \"a\\\"b\" }"), "");
}

TEST(Parser, GoesOnBehindAnErrorAndReportsAll) {
  const ParseResult result = parseAll("a: { x: 1.2.3 }\nb: { y: 0x10 }\nc: { z: 1 }", "f.g");
  ASSERT_EQ(result.diagnostics.size(), 2u);
  EXPECT_EQ(result.diagnostics[1].where.line, 2);
  EXPECT_EQ(result.graph.nodes.size(), 3u);
}

TEST(Parser, ExceptionsShowTheLineAndACaret) {
  try {
    parse("a: {}\nb: { x: 1.2.3 }", "f.g");
    FAIL();
  } catch (const ParseError& error) {
    EXPECT_STREQ(error.what(), "f.g:2:9: '1.2.3' is not a number\n    b: { x: 1.2.3 }\n            ^");
    EXPECT_EQ(error.where().column, 9);
  }
}

TEST(Parser, AMissingLastBraceIsAWarning) {
  std::vector<std::string> warnings;
  EXPECT_EQ(parse("a: { x: 1", "f.g", &warnings).nodes.size(), 1u);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("f.g:1:4: this '{' is never closed"), std::string::npos) << warnings[0];
}

namespace {

Value randomValue(Rng& rng, int depth);

std::string randomWord(Rng& rng) {
  static const char letters[] = "abcXYZ_ 09/.-";
  std::string word(1, letters[int(rng.uniform(0, 7))]);
  for (int i = int(rng.uniform(0, 8)); i > 0; --i) word += letters[int(rng.uniform(0, 13))];
  while (word.back() == ' ') word.pop_back();
  return word;
}

Graph randomGraph(Rng& rng, int depth) {
  Graph graph;
  for (int i = int(rng.uniform(0, 5)); i > 0; --i) {
    Node node;
    node.value = randomValue(rng, depth - 1);
    node.key = randomWord(rng);
    if (node.value.as<Graph>()) {
      std::erase(node.key, ' ');
      if (rng.uniform() < .3) node.tags = {"tag"};
      if (rng.uniform() < .5) node.parents = {"p1"};
    }
    graph.nodes.push_back(node);
  }
  return graph;
}

Value randomValue(Rng& rng, int depth) {
  Value value;
  switch (int(rng.uniform(0, depth > 0 ? 9 : 7))) {
    case 0:
      value.data = rng.uniform() < .5;
      break;
    case 1:
      value.data = std::ldexp(rng.normal(), int(rng.uniform(-60, 60)));
      break;
    case 2:
      value.data = randomWord(rng);
      break;
    case 3: {
      NumberArray array;
      for (int i = int(rng.uniform(0, 6)); i > 0; --i) array.numbers.push_back(rng.normal());
      if (array.numbers.size() == 4) array.rows = 2;
      value.data = array;
      break;
    }
    case 4:
      value.data = StringArray{randomWord(rng), randomWord(rng)};
      break;
    case 5:
      value.data = AngleText{randomWord(rng)};
      break;
    case 6:
      value.data = NameTuple{{"a", "b_c"}};
      break;
    case 7: {
      ValueList list(1 + std::size_t(rng.uniform(0, 3)));
      for (Value& element : list) element.data = NumberArray{{rng.normal(), rng.normal()}, 1};
      value.data = list;
      break;
    }
    default:
      value.data = randomGraph(rng, depth);
      break;
  }
  return value;
}

}  // namespace

TEST(Writer, WhatItWritesParsesToTheSame) {
  Rng rng(7);
  for (int i = 0; i < 500; ++i) {
    const Graph graph = randomGraph(rng, 4);
    const std::string text = writeFile(graph);
    EXPECT_EQ(parse(text, ""), graph) << text;
  }
}

TEST(Parser, SurvivesRandomMutationsOfSceneText) {
  const std::string samples[] = {
      "zero { X:\"T t(0 0 0) d(180 0 0 1)\" shape:sphere mass=1 size=[0. 0. .2 .05]}\n(a b) { joint:hingeX, pre:\"T "
      "t(0 0 .00)\" }",
      "# comment\nInclude: <x.g>\nPrefix!\nEdit a(b): { color: [1 2; 3 4], s: ['a', \"b\"], f: [[1 2] [3]] }\n{ x: ~, "
      "y!, z: (a b) }"};
  const std::string alphabet = "{}[]()<>:=,;!~#'\"\\ \n\t.+-e09azT_\xff";
  Rng rng(11);
  for (int i = 0; i < 20000; ++i) {
    std::string text = samples[i % 2];
    for (int k = int(rng.uniform(1, 8)); k > 0; --k) {
      const std::size_t at = std::size_t(rng.uniform(0, double(text.size())));
      const char c = alphabet[std::size_t(rng.uniform(0, double(alphabet.size())))];
      if (rng.uniform() < .4) {
        text[at] = c;
      } else if (rng.uniform() < .5) {
        text.insert(at, 1, c);
      } else {
        text.erase(at, 1 + std::size_t(rng.uniform(0, 6)));
      }
      if (text.empty()) text = "a";
    }
    for (const Diagnostic& d : parseAll(text, "").diagnostics) ASSERT_TRUE(d.where.known());
  }
  std::string deep(100000, '[');
  EXPECT_FALSE(parseAll("a: " + deep, "").diagnostics.empty());
  EXPECT_FALSE(parseAll(std::string(100000, '{'), "").diagnostics.empty());
}

namespace {

std::string block(const std::string& text, const std::string& file = "b.yml") { return writeFile(parse(text, file)); }

}  // namespace

TEST(Blocks, MapsByIndentationAreGraphs) {
  EXPECT_EQ(block("a(b):\n  shape: box\n  size: [1, 2,\n     3]\n\nc: {}\n"),
            "a (b): { shape: box, size: [1 2 3] }\nc: {  }\n");
  EXPECT_EQ(block("a:\n  logical:\n    deep: 1\n  x: 2\n# end\nb:\n\n   y: 3"),
            "a: { logical: { deep: 1 }, x: 2 }\nb: { y: 3 }\n");
  EXPECT_EQ(block("---\na:\n  flag:\n  x: ~\n...\n"), "a: { flag, x }\n") << "an empty value is true";
  EXPECT_EQ(block("a:\n  { x: 1,\n y: 2 }\nb:\n  [1, 2]"), "a: { x: 1, y: 2 }\nb: [1 2]\n")
      << "braces may follow on the next line";
  EXPECT_EQ(block("a: { k:\n  x: 1 }"), "a: { k, x: 1 }\n") << "within braces, lines mean nothing";
  EXPECT_EQ(block("a:\n  x: 1\n", "scene.g"), "a: { x: 1 }\n") << "whatever the file is called";
}

TEST(Blocks, SequencesAreArrays) {
  EXPECT_EQ(block("a:\n  size:\n    - 1\n    - 2.5\n  words:\n  - x\n  - y z\n  q: 3"),
            "a: { size: [1 2.5], words: [\"x\" \"y z\"], q: 3 }\n");
  EXPECT_EQ(block("a:\n  rows:\n    - [1, 2]\n    - [3]\n"), "a: { rows: [[1 2], [3]] }\n");
  EXPECT_NE(parseAll("a:\n  x:\n    - k: 1\n", "b.yml").diagnostics.size(), 0u)
      << "maps in a sequence mean nothing in a scene";
}

TEST(Blocks, PlainTextOfYamlMayHaveBlanks) {
  EXPECT_EQ(block("a:\n  note: two words # comment\n  version: 1.2.3\n  shape: box size: [1]"),
            "a: { note: \"two words\", version: \"1.2.3\", shape: box, size: [1] }\n");
  EXPECT_NE(parseAll("a: { version: 1.2.3 }", "b.yml").diagnostics.size(), 0u);
}

TEST(Parser, ReadsHeadsThatOtherProgramsWrite) {
  EXPECT_EQ(block("\"b(a)\": {}, \"c (a, b)\": {}, 'x': 1", "f.json").substr(0, 12), "b (a): {  }\n");
  EXPECT_EQ(parse("j(a>b): {}", "").nodes[0].parents, std::vector<std::string>{"a>b"});
}

TEST(Parser, TheBraceOfAFrameMayStandOnTheNextLine) {
  EXPECT_EQ(writeFile(parse("body a\n{ x: 1 }\nb (a)\n  { y }\n", "")), "body a: { x: 1 }\nb (a): { y }\n");
  EXPECT_EQ(valueOf("x\n y: 3"), "x=true | y=3");
}

TEST(Parser, DecodesTypedArrays) {
  EXPECT_EQ(valueOf("x: [\"float64\", [2], \"AAAAAAAA4D8AAAAAAADwPw==\"]"), "x=[0.5 1]");
  EXPECT_EQ(valueOf("x: [\"uint8\", [2, 2], \"AQIDBA==\"]"), "x=[1 2; 3 4]");
  EXPECT_EQ(valueOf("x: [\"double\", [2, 1], [5 6]]"), "x=[5; 6]");
  EXPECT_EQ(valueOf("x: [\"other\", [2], [5 6]]"), "x=[other, [2], [5 6]]");
  EXPECT_EQ(errorOf("a: { x: [\"float64\", [3], \"AAAAAAAA4D8=\"] }"), "f.g:1:9: an array of 3 entries has data for 1");
}

TEST(Parser, AMistakeInAHeadDoesNotMakeItsBracesMistakes) {
  const ParseResult result = parseAll("a(b=): { x: 1,\n y: { z: 2 }\n}\nb: {}\nc(: {}", "f.g");
  ASSERT_EQ(result.diagnostics.size(), 2u);
  EXPECT_EQ(result.diagnostics[0].where.line, 1);
  EXPECT_EQ(result.diagnostics[1].where.line, 5);
}

TEST(Parser, AnExcerptOfALongLineIsThePartAroundThePlace) {
  const std::string line = std::string(500, 'a') + "!" + std::string(500, 'b');
  EXPECT_EQ(excerpt("\n" + line, {"f.xml", 2, 501}),
            "    ..." + std::string(60, 'a') + "!" + std::string(59, 'b') + "...\n    " + std::string(63, ' ') + "^");
  EXPECT_EQ(excerpt("short", {"f.xml", 1, 3}), "    short\n      ^");
}

TEST(Parser, StopsAtAHundredErrors) {
  std::string text;
  for (int i = 0; i < 100000; ++i) text += "a: { x: 1.2.3 }\n";
  EXPECT_EQ(parseAll(text, "f.g").diagnostics.size(), 100u);
}

TEST(Parser, ErrorsDoNotUseUpTheDepthOfNesting) {
  std::string text;
  for (int i = 0; i < 90; ++i) text += "a: { b: { c: { x: [[1 2} } } }\n";
  for (const Diagnostic& d : parseAll(text, "f.g").diagnostics)
    EXPECT_EQ(d.message.find("nested"), std::string::npos) << d.message;
}
