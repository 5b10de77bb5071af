#include "kinegraph/exporters/writers.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/gfile/writer.h"
#include "tests/exporters/random_scene.h"
#include "tests/support/scene.h"
#include "tests/support/temporary_folder.h"

using namespace kinegraph;

namespace {

constexpr double kRounding = 1e-14;  // of a quaternion that is normalized again when it is read

void expectSameShape(const Shape& a, const Shape& b) {
  EXPECT_EQ(a.geometry->type, b.geometry->type);
  EXPECT_EQ(a.geometry->size, b.geometry->size);
  EXPECT_EQ(a.color, b.color);
  EXPECT_EQ(a.contact, b.contact);
  EXPECT_EQ(a.visual_mesh, b.visual_mesh);
  EXPECT_TRUE((a.visual_pose.inverse() * b.visual_pose).isIdentity(kRounding));
  ASSERT_EQ(a.geometry->grid != nullptr, b.geometry->grid != nullptr);
  if (a.geometry->grid) {
    EXPECT_EQ(a.geometry->grid->cells, b.geometry->grid->cells);
    EXPECT_EQ(a.geometry->grid->values, b.geometry->grid->values);
  }
  ASSERT_EQ(a.geometry->mesh != nullptr, b.geometry->mesh != nullptr);
  if (!a.geometry->mesh) return;
  EXPECT_EQ(a.geometry->mesh->parts, b.geometry->mesh->parts);
  EXPECT_EQ(a.geometry->mesh->vertices, b.geometry->mesh->vertices);
  EXPECT_EQ(a.geometry->mesh->triangles, b.geometry->mesh->triangles);
  EXPECT_EQ(a.geometry->mesh->colors, b.geometry->mesh->colors);
}

void expectSameJoint(const Joint& a, const Joint& b) {
  EXPECT_EQ(a.type, b.type);
  EXPECT_EQ(a.code, b.code);
  EXPECT_EQ(a.scale, b.scale);
  if (a.type == JointType::hinge) EXPECT_LT((a.axis - b.axis).norm(), kRounding);
  EXPECT_EQ(a.lower, b.lower);
  EXPECT_EQ(a.upper, b.upper);
  EXPECT_EQ(a.active, b.active);
  EXPECT_EQ(a.stable, b.stable);
  EXPECT_EQ(a.control_weight, b.control_weight);
  EXPECT_EQ(a.sample_uniform, b.sample_uniform);
  EXPECT_EQ(a.sample_deviation, b.sample_deviation);
  ASSERT_EQ(a.mimic != nullptr, b.mimic != nullptr);
  if (a.mimic) {
    EXPECT_EQ(a.mimic->id, b.mimic->id);
  } else {
    EXPECT_LT((a.q - b.q).norm(), kRounding);
    EXPECT_LT((a.home - b.home).norm(), kRounding);
  }
}

/// The attributes that the library does not interpret.
Graph freeAttributes(const FrameData& frame) {
  Graph free;
  for (const Node& node : frame.attributes->nodes) {
    if (node.key == "label" || node.key == "logical" || node.key == "free 1") free.nodes.push_back(node);
  }
  return free;
}

/// Everything of every frame but the names, which some texts cannot hold.
void expectSameScene(const Config& a, const Config& b) {
  ASSERT_EQ(a.getFrameDimension(), b.getFrameDimension());
  for (int i = 0; i < a.getFrameDimension(); ++i) {
    const FrameData &x = a.getFrame(i).data(), &y = b.getFrame(i).data();
    SCOPED_TRACE(x.name);
    ASSERT_EQ(x.parent != nullptr, y.parent != nullptr);
    if (x.parent) EXPECT_EQ(x.parent->id, y.parent->id);
    ASSERT_EQ(x.no_contact.size(), y.no_contact.size());
    for (std::size_t k = 0; k < x.no_contact.size(); ++k) EXPECT_EQ(x.no_contact[k]->id, y.no_contact[k]->id);
    EXPECT_TRUE((x.relativePose().inverse() * y.relativePose()).isIdentity(kRounding));
    ASSERT_EQ(x.joint.has_value(), y.joint.has_value());
    if (x.joint) expectSameJoint(*x.joint, *y.joint);
    ASSERT_EQ(x.shape != nullptr, y.shape != nullptr);
    if (x.shape) expectSameShape(*x.shape, *y.shape);
    ASSERT_EQ(x.inertia.has_value(), y.inertia.has_value());
    if (x.inertia) {
      EXPECT_EQ(x.inertia->mass, y.inertia->mass);
      EXPECT_EQ(x.inertia->com, y.inertia->com);
      EXPECT_EQ(x.inertia->matrix, y.inertia->matrix);
    }
    EXPECT_EQ(freeAttributes(x), freeAttributes(y)) << writeEntries(freeAttributes(x)) << "\n"
                                                    << writeEntries(freeAttributes(y));
  }
  for (int i = 0; i < a.getFrameDimension(); ++i) {
    for (int j = 0; j < i; ++j) {
      EXPECT_EQ(a.getFrame(i).data().shape && a.getFrame(i).data().shape == a.getFrame(j).data().shape,
                b.getFrame(i).data().shape && b.getFrame(i).data().shape == b.getFrame(j).data().shape)
          << "shapes of frames " << i << " and " << j;
    }
  }
}

}  // namespace

TEST(WriteScene, ReadsBackAsTheSameScene) {
  Rng rng(0);
  for (int sample = 0; sample < 500; ++sample) {
    const Config config = randomScene(rng);
    const std::string text = writeScene(config);
    SCOPED_TRACE(text);
    Config back;
    ASSERT_NO_THROW(back = scene(text));
    expectSameScene(config, back);
    if (HasFailure()) break;
  }
}

TEST(WriteYaml, ReadsBackAsTheSameScene) {
  Rng rng(1);
  for (int sample = 0; sample < 500; ++sample) {
    const Config config = randomScene(rng);
    const std::string text = writeYaml(config, sample % 2 == 0);
    SCOPED_TRACE(text);
    Config back;
    ASSERT_NO_THROW(back = scene(text));
    expectSameScene(config, back);
    if (HasFailure()) break;
  }
}

TEST(WriteScene, KeepsNamesThatTheLanguageCanHoldAndWarnsOfOthers) {
  Config config;
  config.addFrame("a:1");
  config.addFrame("b", "a:1");
  config.getFrame("b").setName("two words");
  config.addFrame("c", "two words");
  std::vector<std::string> warnings;
  EXPECT_EQ(scene(writeScene(config, &warnings)).getFrameNames(), (std::vector<std::string>{"a:1", "two_words", "c"}));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(
      warnings[0],
      "names that are duplicate or not expressible in the text are changed: 'two words' (frame 1) as 'two_words'");
}

TEST(WriteScene, TransformsBeforeAJointAreWrittenOnce) {
  for (const char* key : {"pre", "A", "origin"}) {
    Config config, again;
    config.addText(cat("a: {}  b (a): { ", key, ": [0 0 1], joint: hingeX, post: [1 0 0] }"));
    again.addText(writeScene(config));
    EXPECT_EQ(again.getFrameNames(), config.getFrameNames()) << key;
  }
}

TEST(WriteScene, IsOneReadableLinePerFrame) {
  const Config config = scene(
      "a: { shape: ssBox, size: [1 1 1 .1], contact: -1, note: \"x y\", flag } b(a): { pre: [0 0 1], joint: hingeX, "
      "limits: [-1 1], q: .3 }");
  EXPECT_EQ(writeScene(config),
            "a: { shape: ssBox, size: [1 1 1 0.1], contact: -1, note: \"x y\", flag }\n"
            "b (b_origin): { joint: hingeX, limits: [-1 1], q: [0.3] }\n"
            "b_origin (a): { pose: [0 0 1] }\n");
}

TEST(WriteYaml, HasPointsInNumbersAndOneLinePerFrame) {
  const Config config = scene("a: { mass: 2, shape: box, size: [1 2 1e-7], flag, no!, s: yes, t: [a b] } b(a): {}");
  EXPECT_EQ(writeYaml(config).substr(0, 43), "a: {shape: box, size: [1.0, 2.0, 1.0e-07], ");
  EXPECT_NE(writeYaml(config).find("flag: true, no: false, s: \"yes\", t: [\"a\", \"b\"]}\nb(a): {}\n"),
            std::string::npos)
      << writeYaml(config);
}

TEST(WriteScene, AMeshFromAFileStaysAFileUntilItsPointsChange) {
  const TemporaryFolder folder;
  const std::string file = folder.write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  Config config = scene("a: { mesh: <" + file + ">, meshscale: 2 }");
  EXPECT_NE(writeScene(config).find("mesh: <" + file + ">, meshscale: [2 2 2]"), std::string::npos)
      << writeScene(config);
  config.getFrame("a").setMesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}});
  EXPECT_NE(writeScene(config).find("vertices: [0 0 0 1 0 0 0 1 0], triangles: [0 1 2]"), std::string::npos)
      << writeScene(config);
}

TEST(SaveScene, SelectsTheFormatByTheExtension) {
  const TemporaryFolder folder;
  const Config config = scene("a: { pose: [1 0 0] } j(a): { joint: hingeZ }");
  for (const auto& [name, start] :
       {std::pair("s.g", "a: { pose"), std::pair("s.yaml", "a: {pose: [1.0,"), std::pair("s.urdf", "<?xml")}) {
    EXPECT_TRUE(saveScene(config, (folder / name).string()).starts_with(start)) << name;
    Config back;
    back.addFile((folder / name).string());
    EXPECT_LT((back.getFrame("j").getPose().p - Vector3d(1, 0, 0)).norm(), 1e-15) << name;
  }
  EXPECT_THROW(saveScene(config, (folder / "missing/s.g").string()), FileError);
}
