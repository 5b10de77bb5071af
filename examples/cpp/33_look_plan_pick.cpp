// A simulated depth camera looks, the robot plans and picks, and looks again while somebody moves the cubes.
#include <kinegraph/kinegraph.h>

#include <iostream>

using namespace kinegraph;

/// The believed scene: a Panda at a table with a tray, two cubes, and a camera beyond the table.
Config belief() {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  C.addFrame("tray", "table").setShape(ST::ssBox, {.2, .2, .02, .005}).setRelativePosition({.35, .35, .06});
  C.getFrame("tray").setContact(1);
  for (const auto& [name, x, y] : {std::tuple("red", -.3, .25), std::tuple("blue", -.1, .4)}) {
    Frame cube = C.addFrame(name, "table", "friction: 1").setRelativePosition({x, y, .075}).setJoint(JT::rigid);
    cube.setShape(ST::ssBox, {.05, .05, .05, .004}).setContact(1).setMass(.1);
  }
  const Vector3d eye(-.5, .95, 1.2), z = (Vector3d(0, .3, .65) - eye).normalized();
  const Vector3d x = z.cross(Vector3d::UnitZ()).normalized();
  Matrix3d axes;
  axes << x, z.cross(x), z;
  C.addFrame("camera", "", "focalLength: 1.25, width: 640, height: 480")
      .setPosition(eye)
      .setQuaternion(Quaterniond(axes));
  return C;
}

int main() try {
  Config C = belief(), world = belief();
  for (const char* name : {"red", "blue"}) {  // in the world, both cubes are 4 cm beside their believed places
    Frame cube = world.getFrame(name);
    cube.setRelativePosition(cube.getRelativePosition() + Vector3d(.03, -.03, 0));
  }
  BotOp bot(world);
  Rng rng(0);

  // A depth image of this moment, as from a good stereo camera.
  const auto take = [&] {
    CameraView view(bot.getWorld());
    view.setCamera("camera");
    CameraImage image = view.computeImageAndDepth();
    for (float& depth : image.depth) depth += float(.0027 * depth * depth * rng.normal());
    return std::vector<DepthView>{{image.depth, image.width, image.height, view.getFxycxy(), "camera"}};
  };
  // Finds the poses of the cubes that stand, and moves the cubes of a scene there.
  SceneObserver observer(take, {"red", "blue"}, {"table", .1});
  const auto look = [&](Config& believed) { return observer.observe(believed); };

  for (const auto& [name, pose] : look(C)) {
    if (!pose) continue;
    const double off = (pose->p - world.getFrame(name).getPosition()).norm();
    std::cout << name << " was seen within " << 1e3 * off << " mm\n";
  }

  const TaskPlan plan = planTask(C, "(on tray red) (on tray blue)");
  Config seen = worldOf(bot, plan, true);
  TaskRun run(plan, bot, seen, {.observe = look});
  bool moved = false;
  while (const auto event = run.next()) {
    std::cout << event->str() << "\n";
    if (moved || event->kind != TaskEventKind::grip) continue;
    // While the hand is busy, somebody moves the other cube.
    const std::string other = event->str().find("red") == std::string::npos ? "red" : "blue";
    Pose pose = bot.getWorld().getFrame(other).getPose();
    pose.p += Vector3d(.04, .03, 0);
    bot.setFramePose(other, pose);
    moved = true;
  }
  std::cout << run.result().str() << "\n";
  bot.getWorld().view(false, "both cubes on the tray");
  return run.result().feasible ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
