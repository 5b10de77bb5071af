#include "kinegraph/scene/collisions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "tests/support/expect_error.h"

namespace kinegraph {
namespace {

using Reason = SelfCollisionPair::Reason;

/// A chain of balls of radius .1 on hinges about z, 1 m apart; a plate at the first one that the third never meets, and
/// a knob in the plate.
Config chain() {
  Config config;
  config.addText(
      "base { shape: sphere, size: [.1], contact: 1 }\n"
      "a (base) { joint: hingeZ, limits: [-3 3], shape: sphere, size: [.1], contact: 1 }\n"
      "tip_a (a) { pose: [1 0 0], shape: sphere, size: [.2], contact: 1 }\n"
      "b (tip_a) { joint: hingeZ, limits: [-3.1415 3.1415] }\n"
      "ball_b (b) { pose: [1 0 0], shape: sphere, size: [.2], contact: 1 }\n"
      "slide (base) { joint: transZ }\n"
      "ball_slide (slide) { pose: [0 0 5], shape: sphere, size: [.1], contact: 1 }\n"
      "wall { pose: [1 0 0], shape: box, size: [.1 .1 .1], contact: 1 }\n");
  return config;
}

std::map<std::pair<std::string, std::string>, SelfCollisionPair> byName(const Config& config,
                                                                        const SelfCollisionMatrix& matrix) {
  std::map<std::pair<std::string, std::string>, SelfCollisionPair> pairs;
  for (const SelfCollisionPair& pair : matrix.pairs)
    pairs.insert({{config.getFrame(pair.a).getName(), config.getFrame(pair.b).getName()}, pair});
  return pairs;
}

TEST(SelfCollisions, AreOfTheShareOfAnglesThatTrigonometrySays) {
  const Config config = chain();
  const SelfCollisionMatrix matrix = selfCollisionMatrix(config, {.samples = 20000, .root = "base"});
  const auto pairs = byName(config, matrix);
  // The ball at b is 2 cos(angle / 2) from the base's, and touches it (and that of a) within .3.
  const double touching = 2. * (std::numbers::pi - 2. * std::acos(.15)) / (2. * std::numbers::pi);
  const SelfCollisionPair& folded = pairs.at({"base", "b"});
  EXPECT_EQ(folded.reason, Reason::sometimes);
  EXPECT_NEAR(folded.collisions / 20000., touching, 4. * std::sqrt(touching / 20000.));
}

TEST(SelfCollisions, EveryPairHasItsReason) {
  const Config config = chain();
  const auto pairs = byName(config, selfCollisionMatrix(config, {.samples = 3000, .root = "base"}));
  EXPECT_EQ(pairs.at({"base", "a"}).reason, Reason::adjacent);
  EXPECT_EQ(pairs.at({"base", "slide"}).reason, Reason::adjacent);
  EXPECT_EQ(pairs.at({"a", "slide"}).reason, Reason::sometimes) << "it slides without limits: anything may happen";
  EXPECT_EQ(pairs.count({"base", "wall"}), 0u) << "no part of the robot";
}

TEST(SelfCollisions, PairsThatAlwaysOrNeverCollideAreClassified) {
  Config config;
  config.addText(
      "base { }\n"
      "a (base) { joint: hingeZ, limits: [-1 1], shape: sphere, size: [.1], contact: 1 }\n"
      "b (a) { joint: hingeX, limits: [-1 1], shape: sphere, size: [.1] }\n"
      "c (b) { joint: hingeY, limits: [-1 1], shape: sphere, size: [.1], contact: 1 }\n"
      "far (c) { pose: [1 0 0] }\n"
      "d (far) { joint: hingeZ, limits: [-1 1], shape: sphere, size: [.1], contact: 1 }\n");
  const auto pairs = byName(config, selfCollisionMatrix(config, {.samples = 500}));
  EXPECT_EQ(pairs.at({"a", "c"}).reason, Reason::always);
  EXPECT_EQ(pairs.at({"a", "c"}).collisions, 500);
  EXPECT_EQ(pairs.at({"a", "d"}).reason, Reason::never);
  EXPECT_EQ(pairs.at({"c", "d"}).reason, Reason::adjacent);
  const auto wide = byName(config, selfCollisionMatrix(config, {.samples = 500, .margin = .9}));
  EXPECT_EQ(wide.at({"a", "d"}).reason, Reason::always) << "nearer than the margin counts";
}

TEST(SelfCollisions, AreTheSameAtAnyNumberOfThreadsAndOtherForAnotherSeed) {
  const Config config = chain();
  const auto counts = [&](std::uint64_t seed, int threads) {
    std::vector<int> result;
    for (const SelfCollisionPair& pair :
         selfCollisionMatrix(config, {.samples = 1000, .seed = seed, .root = "base", .threads = threads}).pairs)
      result.push_back(pair.collisions);
    return result;
  };
  EXPECT_EQ(counts(1, 1), counts(1, 4));
  EXPECT_NE(counts(1, 1), counts(2, 1));
}

TEST(SelfCollisions, ThoseThatAreIgnoredAreInNoPairAnyMore) {
  Config config = chain();
  const std::size_t before = config.getCollidablePairs().size();
  const SelfCollisionMatrix matrix = selfCollisionMatrix(config, {.samples = 1000, .root = "base"});
  ignoreSelfCollisions(config, matrix);
  const auto ignored = std::ranges::count_if(matrix.pairs, [](const SelfCollisionPair& p) { return !p.matters(); });
  EXPECT_GT(ignored, 0);
  EXPECT_LT(config.getCollidablePairs().size(), before);
  const SelfCollisionMatrix again = selfCollisionMatrix(config, {.samples = 1000, .root = "base"});
  EXPECT_EQ(again.pairs.size(), matrix.pairs.size() - std::size_t(ignored));
  for (const SelfCollisionPair& pair : again.pairs) EXPECT_TRUE(pair.matters());
}

TEST(SelfCollisions, WhatCannotBeAskedIsAnError) {
  const Config config = chain();
  expectError<ValueError>([&] { selfCollisionMatrix(config, {.samples = 0}); }, {"samples is 0"});
  expectError<ValueError>([&] { selfCollisionMatrix(config, {.always = 2.}); }, {"always is 2"});
  expectError<FrameNotFound>([&] { selfCollisionMatrix(config, {.root = "bse"}); }, {"similar names: base"});
  expectError<ValueError>([&] { selfCollisionMatrix(config, {.root = "wall"}); },
                          {"frame 'wall' has no collidable pair of shapes", "`contact`"});
}

}  // namespace
}  // namespace kinegraph
