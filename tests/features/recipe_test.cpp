#include "kinegraph/features/recipe.h"

#include <gtest/gtest.h>

#include "kinegraph/features/feature_source.h"
#include "tests/support/expect_error.h"

namespace kinegraph {
namespace {

ContactForce someContact() { return {0, 1, 2, 3, 2., true}; }

TEST(Recipe, EachNameMakesAFeature) {
  for (const std::string& name : recipeNames()) {
    const FeatureRecipe recipe{name, someContact(), 1.};
    const std::vector<int> frames = name == "pairNormalsOppose" ? std::vector<int>{0, 1, 2} : std::vector<int>{0, 1};
    const auto feature = makeFeature(recipe, frames);
    ASSERT_NE(feature, nullptr) << name;
    EXPECT_GT(feature->rows(), 0) << name;
    EXPECT_EQ(FeatureSource(recipe).name(), name);
    EXPECT_EQ(FeatureSource(recipe).recipe()->contact->point, 2);
  }
  EXPECT_EQ(makeFeature({"elasticBounce", someContact(), .9}, {})->order(), 2);
}

TEST(Recipe, MistakesAreExplained) {
  expectError<NameError>(
      [] {
        makeFeature({"pulingForce", someContact()}, {});
      },
      {"pulingForce", "similar names: pullingForce"});
  expectError<ValueError>([] { makeFeature({"pullingForce"}, {0, 1}); }, {"pullingForce", "contact force"});
  expectError<ValueError>(
      [] {
        makeFeature({"pairNormalsOppose"}, {0, 1});
      },
      {"pairNormalsOppose takes 3 frames, got 2"});
}

}  // namespace
}  // namespace kinegraph
