#include "kinegraph/viewer/messages/commands.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "kinegraph/common/random.h"

using namespace kinegraph;

namespace {

template <class T>
void append(std::string& data, T value) {
  data.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string setJoint(int structure, int joint, double value) {
  std::string data;
  for (const int number : {SetJointCommand::kKind, structure, joint}) append(data, number);
  append(data, value);
  return data;
}

std::string moveFrame(int count, int numbers) {
  std::string data;
  for (const int number : {MoveFrameCommand::kKind, 1, 2, count}) append(data, number);
  for (int i = 0; i < numbers; ++i) append(data, .5 * i);
  return data;
}

}  // namespace

TEST(Command, IsReadFieldByField) {
  const auto command = readCommand(setJoint(3, 5, -.25));
  ASSERT_TRUE(command && std::holds_alternative<SetJointCommand>(*command));
  const auto& set = std::get<SetJointCommand>(*command);
  EXPECT_EQ(set.structure, 3);
  EXPECT_EQ(set.joint, 5);
  EXPECT_EQ(set.value, -.25);
  const auto move = readCommand(moveFrame(7, 7));
  ASSERT_TRUE(move && std::holds_alternative<MoveFrameCommand>(*move));
  EXPECT_EQ(std::get<MoveFrameCommand>(*move).pose, (std::vector<double>{0., .5, 1., 1.5, 2., 2.5, 3.}));
}

TEST(Command, OfAnotherLengthIsNone) {
  const std::string whole = setJoint(3, 5, 1.);
  for (std::size_t size = 0; size < whole.size(); ++size) EXPECT_FALSE(readCommand(whole.substr(0, size))) << size;
  EXPECT_FALSE(readCommand(whole + "x"));
  EXPECT_FALSE(readCommand(moveFrame(8, 7)));
  EXPECT_FALSE(readCommand(moveFrame(6, 7)));
  EXPECT_FALSE(readCommand(moveFrame(-1, 0)));
  EXPECT_FALSE(readCommand(moveFrame(std::numeric_limits<int>::max(), 7)));
}

TEST(Command, WithANumberThatIsNotFiniteIsNone) {
  EXPECT_FALSE(readCommand(setJoint(1, 1, std::numeric_limits<double>::infinity())));
  EXPECT_FALSE(readCommand(setJoint(1, 1, std::numeric_limits<double>::quiet_NaN())));
}

TEST(Command, IsNeverMoreThanTheBytesSay) {
  Rng rng(0);
  for (int i = 0; i < 20000; ++i) {
    std::string data(std::size_t(rng.uniform(0., 60.)), '\0');
    for (char& c : data) c = static_cast<char>(rng.uniform() < .6 ? rng.uniform(0., 4.) : rng.uniform(0., 256.));
    if (data.size() >= 4) data[1] = data[2] = data[3] = 0;
    const auto command = readCommand(data);
    if (const auto* move = command ? std::get_if<MoveFrameCommand>(&*command) : nullptr)
      EXPECT_EQ(data.size(), 16 + 8 * move->pose.size());
    if (command && std::holds_alternative<KeyCommand>(*command)) EXPECT_EQ(data.size(), 12u);
  }
}
