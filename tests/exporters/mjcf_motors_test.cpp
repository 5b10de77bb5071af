#include "kinegraph/exporters/mjcf_motors.h"

#include "kinegraph/exporters/writers.h"
#include "kinegraph/kinematics/kinematic_model.h"
#include "tests/exporters/mujoco_model.h"
#include "tests/support/temporary_folder.h"

using namespace kinegraph;

namespace {

constexpr const char* kHand = R"(
world: {}
table (world): { Q: [0 0 .1], shape: box, size: [1 1 .1], contact: 1 }
arm (world): { Q: [0 0 .5], joint: hingeZ, limits: [-2 2], ctrl_limits: [2 50 -1], mass: 1, q: .3 }
loose (arm): { Q: [.3 0 0], joint: hingeY, noMotor: true, mass: .2 }
finger1 (arm): { joint: transY, limits: [0 .04], ctrl_limits: [.1 30], q: .02, joint_active: False, mass: .1 }
finger2 (arm): { joint: transY, joint_scale: -1, mimic: finger1, mass: .1 }
cup (table): { Q: [.3 .3 .1], joint: rigid, shape: box, size: [.1 .1 .1], mass: .1, contact: 1, friction: .7 }
)";

TEST(MjcfMotors, AreActuatorsOfJointsAndHandsAndObjectsAreFree) {
  Config C;
  C.addText(kHand);
  const TemporaryFolder folder;
  const std::string path = (folder / "hand.xml").string();
  saveMjcf(C, path, nullptr, true);
  const MujocoModel made(path);
  const mjModel& m = made.model();
  ASSERT_EQ(m.nu, 2);
  EXPECT_EQ(made.name(mjOBJ_ACTUATOR, 0), "arm");
  EXPECT_EQ(made.name(mjOBJ_ACTUATOR, 1), "finger1");
  const double mass = C.equationOfMotion(VectorXd::Zero(2)).M(0, 0) + .1;
  EXPECT_NEAR(m.actuator_gainprm[0], 1e4 * mass, 1e-6 * mass);
  EXPECT_NEAR(m.actuator_biasprm[2], -200. * mass, 1e-6 * mass);
  EXPECT_EQ(m.actuator_forcerange[1], 50.);
  EXPECT_EQ(m.actuator_forcerange[3], 60.);  // of two fingers
  EXPECT_EQ(m.ntendon, 1);
  EXPECT_EQ(m.neq, 1);
  EXPECT_EQ(m.nkey, 1);
  EXPECT_NEAR(m.key_ctrl[0], .3, 1e-12);
  EXPECT_NEAR(m.key_ctrl[1], .02, 1e-12);
  int free = 0;
  for (int j = 0; j < m.njnt; ++j) free += m.jnt_type[j] == mjJNT_FREE;
  EXPECT_EQ(free, 1);
}

TEST(MjcfMotors, GainsOfTheSceneReplaceThoseOfTheSimulation) {
  Config C;
  C.addText("base: {}\narm (base): { joint: hingeX, mass: 1, motorKp: 30, motorKd: 4, motorLimit: 5 }");
  const TemporaryFolder folder;
  const std::string path = (folder / "arm.xml").string();
  saveMjcf(C, path, nullptr, true);
  const MujocoModel made(path);
  ASSERT_EQ(made.model().nu, 1);
  EXPECT_EQ(made.model().actuator_gainprm[0], 30.);
  EXPECT_EQ(made.model().actuator_biasprm[2], -4.);
  EXPECT_EQ(made.model().actuator_forcerange[1], 5.);
}

TEST(MjcfMotors, HandsMoveInUrdfAndOtherInactiveJointsAreFixed) {
  Config C;
  C.addText(std::string(kHand) + "knob (world): { joint: hingeX, joint_active: False, q: .5 }\n");
  std::vector<std::string> warnings;
  const std::string text = writeUrdf(C, {}, &warnings);
  EXPECT_NE(text.find("<joint name=\"finger1\" type=\"prismatic\">"), std::string::npos) << text;
  EXPECT_NE(text.find("<mimic joint=\"finger1\" multiplier=\"1\" offset=\"0\"/>"), std::string::npos) << text;
  EXPECT_EQ(text.find("<joint name=\"knob\" type=\"continuous\">"), std::string::npos) << text;
}

}  // namespace
