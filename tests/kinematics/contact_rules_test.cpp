#include "kinegraph/kinematics/contact_rules.h"

#include <gtest/gtest.h>

#include "kinegraph/common/random.h"

namespace kinegraph {
namespace {

/// A chain of parts with a joint and a body each.
ContactRules chain(int parts, int flag) {
  ContactRules rules;
  for (int i = 0; i < parts; ++i) {
    rules.parts.push_back({i - 1, true});
    rules.bodies.push_back({10 * i, i, flag, 10 * i});
  }
  return rules;
}

TEST(ContactRules, AFlagBelowZeroExcludesAncestorsThatManyJointsAway) {
  for (int flag = -3; flag <= 1; ++flag) {
    const ContactRules rules = chain(6, flag);
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < 6; ++j) {
        const int apart = std::abs(int(i) - int(j));
        EXPECT_EQ(rules.allow(i, j), apart > std::max(-flag, 0)) << i << ", " << j << " with flag " << flag;
      }
    }
  }
}

TEST(ContactRules, WhoIsAskedFirstDoesNotMatter) {
  Rng rng(1);
  for (int sample = 0; sample < 50; ++sample) {
    ContactRules rules;
    for (int i = 0; i < 12; ++i) {
      rules.parts.push_back({i == 0 || rng.uniform() < .2 ? -1 : int(rng.uniform(0., i - 1e-9)), rng.uniform() < .7});
      rules.bodies.push_back({i, int(rng.uniform(0., i + .99)), int(rng.uniform(-3., 2.)), i});
    }
    for (int i = 0; i + 3 < 12; i += 2) rules.excluded.emplace_back(i, i + 3);
    for (std::size_t i = 0; i < 12; ++i) {
      EXPECT_FALSE(rules.allow(i, i));
      for (std::size_t j = 0; j < 12; ++j) {
        EXPECT_EQ(rules.allow(i, j), rules.allow(j, i));
        if (rules.bodies[i].part == rules.bodies[j].part) EXPECT_FALSE(rules.allow(i, j));
      }
    }
    for (const auto& [a, b] : rules.excluded) EXPECT_FALSE(rules.allow(std::size_t(a), std::size_t(b)));
  }
}

TEST(ContactRules, AnExclusionHoldsForAllThatItsFrameOwns) {
  ContactRules rules = chain(4, 1);
  for (ContactRules::Body& body : rules.bodies) body.owner = body.part;
  rules.excluded = {{0, 3}};  // owners instead of the bodies' own frames
  EXPECT_FALSE(rules.allow(0, 3));
  EXPECT_TRUE(rules.allow(0, 2));
  EXPECT_TRUE(rules.allow(1, 3));
}

}  // namespace
}  // namespace kinegraph
