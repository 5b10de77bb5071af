// Scenes of tests/data/scenes against the numbers that robotic 0.4.2 gave for them (beside each, in its .json).
#include <gtest/gtest.h>

#include <cmath>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "kinegraph/geometry/shapes/shape_types.h"
#include "kinegraph/gfile/parser.h"
#include "kinegraph/scene/config.h"

using namespace kinegraph;

namespace {

constexpr double kExact = 1e-6;        // the recording has 9 digits
constexpr double kTessellation = .02;  // the recorded inertias of round shapes are those of coarse meshes

const std::string kFolder = KINEGRAPH_SOURCE_DIR "/tests/data/scenes/";

/// JSON without escapes is a part of the language of scenes.
Graph recording(const std::string& name) {
  std::ifstream file(kFolder + name + ".json");
  std::stringstream text;
  text << file.rdbuf();
  return parse(text.str(), name + ".json");
}

VectorXd vectorOf(const Graph& graph, const char* key) {
  const Node* node = graph.find(key);
  const NumberArray* array = node ? node->value.as<NumberArray>() : nullptr;
  if (!array) return {};
  return Eigen::Map<const VectorXd>(array->numbers.data(), Eigen::Index(array->numbers.size()));
}

double numberOf(const Graph& graph, const char* key) { return *graph.find(key)->value.as<double>(); }

std::string wordOf(const Graph& graph, const char* key) {
  const Node* node = graph.find(key);
  return node ? *node->value.as<std::string>() : "none";
}

/// Largest difference of two poses, up to the sign of the quaternion.
double poseDifference(const Vector7d& a, const Vector7d& b) {
  const double sign = a.tail<4>().dot(b.tail<4>()) < 0. ? -1. : 1.;
  return std::max((a.head<3>() - b.head<3>()).cwiseAbs().maxCoeff(),
                  (a.tail<4>() - sign * b.tail<4>()).cwiseAbs().maxCoeff());
}

void expectShape(const Frame& frame, const Graph& expected) {
  EXPECT_EQ(shapeTypeName(frame.getShapeType()), wordOf(expected, "shape"));
  if (frame.getShapeType() == ShapeType::none) return;
  const VectorXd size = vectorOf(expected, "size");
  EXPECT_EQ(frame.getSize(), std::vector<double>(size.begin(), size.end()));
  EXPECT_EQ(frame.data().shape->contact, numberOf(expected, "contact"));
  const VectorXd color = vectorOf(expected, "color");
  if (color.size() == 3 || color.size() == 4) EXPECT_EQ(frame.data().shape->color->head(color.size()), color);
}

void expectInertia(const Frame& frame, const Graph& expected) {
  if (!expected.find("mass")) return;
  const double mass = numberOf(expected, "mass");
  const bool round = frame.getShapeType() != ShapeType::box && frame.getShapeType() != ShapeType::none;
  const double tolerance = round ? kTessellation : kExact;
  EXPECT_NEAR(frame.getMass(), mass, kExact * mass);
  const VectorXd matrix = vectorOf(expected, "inertia");
  const Matrix3d difference = frame.getInertia()->matrix - Eigen::Map<const Matrix3d>(matrix.data());
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), tolerance * matrix.cwiseAbs().maxCoeff());
  EXPECT_LT((frame.getInertia()->com - Vector3d(vectorOf(expected, "com"))).norm(), tolerance);
}

}  // namespace

class RecordedScene : public ::testing::TestWithParam<const char*> {
 protected:
  RecordedScene() : expected(recording(std::filesystem::path(GetParam()).stem())) {
    scene.addFile(kFolder + GetParam());
  }

  const ValueList& frames() const { return *expected.find("frames")->value.as<ValueList>(); }

  Config scene;
  Graph expected;
};

TEST_P(RecordedScene, HasTheFramesInTheirOrderWithTheirParentsAndPoses) {
  ASSERT_EQ(std::size_t(scene.getFrameDimension()), frames().size());
  for (int i = 0; i < scene.getFrameDimension(); ++i) {
    const Frame frame = scene.getFrame(i);
    const Graph& recorded = *frames()[i].as<Graph>();
    SCOPED_TRACE(frame.getName());
    EXPECT_EQ(frame.getName(), wordOf(recorded, "name"));
    EXPECT_EQ(frame.getParent() ? frame.getParent()->id() : -1, numberOf(recorded, "parent_id"));
    EXPECT_EQ(jointTypeName(frame.getJointType()), wordOf(recorded, "joint"));
    EXPECT_LT(poseDifference(frame.getPose().numbers(), vectorOf(recorded, "pose")), kExact);
    if (recorded.find("rel"))
      EXPECT_LT(poseDifference(frame.getRelativePose().numbers(), vectorOf(recorded, "rel")), kExact);
    expectShape(frame, recorded);
    expectInertia(frame, recorded);
  }
}

TEST_P(RecordedScene, HasTheJointStateAndItsLimits) {
  const VectorXd q = vectorOf(expected, "q");
  ASSERT_EQ(scene.getJointDimension(), q.size());
  if (q.size() == 0) return;
  EXPECT_LT((scene.getJointState() - q).cwiseAbs().maxCoeff(), kExact);
  const VectorXd lower = vectorOf(expected, "lower"), upper = vectorOf(expected, "upper");
  const MatrixXd limits = scene.getJointLimits();
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const bool is_endless = lower[i] > upper[i];  // recorded as 0, -1
    EXPECT_EQ(std::isinf(limits(0, i)) && std::isinf(limits(1, i)), is_endless) << i;
    if (is_endless) continue;
    EXPECT_NEAR(limits(0, i), lower[i], kExact) << i;
    EXPECT_NEAR(limits(1, i), upper[i], kExact) << i;
  }
}

TEST_P(RecordedScene, MovesToTheRecordedPoses) {
  const VectorXd q = vectorOf(expected, "random_q");
  if (q.size() > 0) scene.setJointState(q);
  const ValueList& poses = *expected.find("random_poses")->value.as<ValueList>();
  for (int i = 0; i < scene.getFrameDimension(); ++i) {
    const NumberArray& pose = *poses[i].as<NumberArray>();
    EXPECT_LT(poseDifference(scene.getFrame(i).getPose().numbers(), Vector7d(pose.numbers.data())), kExact)
        << scene.getFrame(i).getName();
  }
}

TEST_P(RecordedScene, HasTheCollidablePairs) {
  std::vector<std::vector<std::string>> pairs, recorded;
  for (const auto& [a, b] : scene.getCollidablePairs()) {
    pairs.push_back({scene.getFrame(a).getName(), scene.getFrame(b).getName()});
    std::sort(pairs.back().begin(), pairs.back().end());
  }
  std::sort(pairs.begin(), pairs.end());
  if (const ValueList* list = expected.find("pairs")->value.as<ValueList>()) {
    for (const Value& pair : *list) recorded.push_back(*pair.as<StringArray>());
  }
  EXPECT_EQ(pairs, recorded);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RecordedScene,
                         ::testing::Values("joints.g", "contacts.g", "shapes.g", "specials.g", "blocks.yml"),
                         [](const auto& info) { return std::filesystem::path(info.param).stem().string(); });
