#include "kinegraph/common/option_table.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

enum class Color { red, green };

struct Paint {
  double thickness = .5;
  int layers = 2;
  bool shines = false;
  std::string finish = "matt";
  Color color = Color::red;
};

const OptionTable<Paint, Color>& paintTable() {
  using R = OptionRange;
  static const OptionTable<Paint, Color> table("paint",
                                               {{"thickness", &Paint::thickness, "mm", "Of a layer.", R::positive()},
                                                {"layers", &Paint::layers, "", "One on the other.", R::atLeastOne()},
                                                {"shines", &Paint::shines, "", "In the sun."},
                                                {"finish", &Paint::finish, "", "Of the last layer.", {"matt", "gloss"}},
                                                {"color", &Paint::color, "", "Of all layers."}});
  return table;
}

}  // namespace

TEST(OptionTable, TakesDefaults) { EXPECT_NO_THROW(paintTable().validate({})); }

TEST(OptionTable, NamesTheFirstFieldThatMakesNoSense) {
  Paint paint;
  paint.finish = "velvet";
  expectError<ValueError>([&] { paintTable().validate(paint); },
                          {"paint: option finish is 'velvet'; expected one of matt, gloss"});
  paint.layers = 0;
  expectError<ValueError>([&] { paintTable().validate(paint); }, {"paint: option layers is 0; expected at least 1"});
  paint.thickness = -1.;
  expectError<ValueError>([&] { paintTable().validate(paint); },
                          {"paint: option thickness is -1; expected a positive number, in mm"});
}

TEST(OptionTable, FindsRowsAndTellsNamesThatAreNear) {
  EXPECT_STREQ(paintTable().row("shines").doc, "In the sun.");
  expectError<ValueError>([&] { paintTable().row("layer"); }, {"paint: there is no option 'layer'", "layers"});
  expectError<ValueError>([&] { paintTable().row("colour", {"colours"}); }, {"colours"});
}

TEST(OptionRange, ContainsWhatItSays) {
  using R = OptionRange;
  const double values[] = {-1., 0., .5, 1., 2., INFINITY, NAN};
  const auto contained = [&](const R& range) {
    std::string out;
    for (const double value : values) out += range.contains(value) ? '1' : '0';
    return out;
  };
  EXPECT_EQ(contained(R::any()), "1111110");
  EXPECT_EQ(contained(R::finite()), "1111100");
  EXPECT_EQ(contained(R::positive()), "0011100");
  EXPECT_EQ(contained(R::notNegative()), "0111100");
  EXPECT_EQ(contained(R::atLeastOne()), "0001100");
  EXPECT_EQ(contained(R::aboveOne()), "0000100");
  EXPECT_EQ(contained(R::belowOne()), "0110000");
  EXPECT_EQ(contained(R::betweenZeroAndOne()), "0010000");
}
