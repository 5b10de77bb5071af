#include "kinegraph/geometry/shapes/shape_types.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "kinegraph/common/errors.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"

using namespace kinegraph;

namespace {

using Sizes = std::vector<double>;

std::string messageOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const ValueError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST(ShapeTypes, NamesAndTypesAreARoundTripWithAndWithoutThePrefix) {
  EXPECT_EQ(shapeTypeNames().size(), shapeKinds().size());
  for (const auto& [name, type] : shapeTypeNames()) {
    EXPECT_EQ(shapeTypeFromName(name), type);
    EXPECT_EQ(shapeTypeFromName("ST_" + name), type);
    EXPECT_EQ(shapeTypeName(type), name);
  }
  EXPECT_EQ(shapeTypeName(ShapeType::none), "none");
}

TEST(ShapeTypes, AMisspelledNameGivesTheValidAndTheMostSimilarNames) {
  const std::string message = messageOf([] { shapeTypeFromName("ssBax"); });
  EXPECT_NE(message.find("'ssBax'"), std::string::npos) << message;
  EXPECT_NE(message.find("cylinder"), std::string::npos) << message;
  EXPECT_NE(message.find("similar names: ssBox"), std::string::npos) << message;
  EXPECT_THROW(shapeTypeFromName(""), ValueError);
  EXPECT_THROW(shapeTypeFromName("none"), ValueError);
}

TEST(ShapeTypes, ANumberThatIsNoTypeIsRefused) { EXPECT_THROW(shapeTypeName(ShapeType(77)), ValueError); }

TEST(CheckedSize, SizesOfTheRightCountStayAsTheyAre) {
  const std::vector<std::pair<ShapeType, Sizes>> shapes = {{ShapeType::box, {1, 2, 3}},
                                                           {ShapeType::sphere, {.2}},
                                                           {ShapeType::capsule, {.3, .05}},
                                                           {ShapeType::cylinder, {.3, .05}},
                                                           {ShapeType::ssBox, {1, 2, 3, .1}},
                                                           {ShapeType::ssCylinder, {.4, .2, .05}},
                                                           {ShapeType::ssBoxElip, {1, 2, 3, .1, .2, .3, .05}},
                                                           {ShapeType::ssCvx, {.01}},
                                                           {ShapeType::quad, {1, 2}},
                                                           {ShapeType::plane, {1, 2}},
                                                           {ShapeType::marker, {.3}},
                                                           {ShapeType::sdf, {1, 2, 3}},
                                                           {ShapeType::mesh, {}}};
  for (const auto& [type, size] : shapes) EXPECT_EQ(checkedSize(type, size, nullptr), size) << shapeTypeName(type);
}

TEST(CheckedSize, CountsOfOlderFilesAreUnderstood) {
  EXPECT_EQ(checkedSize(ShapeType::sphere, {0, 0, .2, .05}, nullptr), Sizes{.05});
  EXPECT_EQ(checkedSize(ShapeType::capsule, {0, 0, .3, .05}, nullptr), (Sizes{.3, .05}));
  EXPECT_EQ(checkedSize(ShapeType::cylinder, {0, 0, .3, .05}, nullptr), (Sizes{.3, .05}));
  EXPECT_EQ(checkedSize(ShapeType::box, {1, 2, 3, 0}, nullptr), (Sizes{1, 2, 3}));
  EXPECT_EQ(checkedSize(ShapeType::sphere, {}, nullptr), Sizes{1.});
  EXPECT_EQ(checkedSize(ShapeType::marker, {}, nullptr), Sizes{.1});
}

TEST(CheckedSize, AnotherCountIsRefusedWithTheMeaningOfTheNumbers) {
  const std::string message = messageOf([] { checkedSize(ShapeType::ssBox, {1, 2}, nullptr); });
  EXPECT_NE(message.find("ssBox has 4 numbers [x y z radius], not 2"), std::string::npos) << message;
  EXPECT_THROW(checkedSize(ShapeType::box, {}, nullptr), ValueError);
  EXPECT_THROW(checkedSize(ShapeType::capsule, {1, 2, 3}, nullptr), ValueError);
}

TEST(CheckedSize, NegativeAndNonFiniteNumbersAndCapsulesWithoutRadiusAreRefused) {
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(checkedSize(ShapeType::box, {1, -1, 1}, nullptr), ValueError);
  EXPECT_THROW(checkedSize(ShapeType::sphere, {nan}, nullptr), ValueError);
  EXPECT_THROW(checkedSize(ShapeType::sphere, {infinity}, nullptr), ValueError);
  EXPECT_THROW(checkedSize(ShapeType::capsule, {1, 0}, nullptr), ValueError);
  EXPECT_THROW(checkedSize(ShapeType::cylinder, {1, 0}, nullptr), ValueError);
  EXPECT_EQ(checkedSize(ShapeType::sphere, {0}, nullptr), Sizes{0.});
}

TEST(CheckedSize, ARoundedShapeThinnerThanItsRoundingIsEnlargedAndTheWarningNamesTheSide) {
  std::string warning;
  EXPECT_EQ(checkedSize(ShapeType::ssBox, {1, .1, 1, .1}, &warning), (Sizes{1, .2, 1, .1}));
  EXPECT_NE(warning.find("side of 0.1"), std::string::npos) << warning;
  EXPECT_NE(warning.find("enlarged to 0.2"), std::string::npos) << warning;
  EXPECT_EQ(checkedSize(ShapeType::ssCylinder, {.1, .05, .1}, nullptr), (Sizes{.2, .1, .1}));
  warning.clear();
  checkedSize(ShapeType::ssBox, {1, 1, 1, .5}, &warning);
  EXPECT_EQ(warning, "");
}
