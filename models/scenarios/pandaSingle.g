# One Panda on a table with two cameras. The robot's frames have the prefix `l_`: `l_gripper`, `l_panda_joint1`, ...

world: {}

table (world): {
  Q: [0 0 .6], shape: ssBox, size: [2.5 2.5 .1 .02], color: [.3 .3 .3],
  contact: 1, friction: .1, logical: {}
}

Prefix: "l_"
Include: <../panda/panda.g>
Prefix: False

# on the table top, a little behind the middle, facing along y
Edit l_panda_base (table): { joint: rigid, Q: "t(0 -.2 .05) d(90 0 0 1)" }

# looks down on the table, from the far side
cameraTop (world): {
  Q: "t(-.01 -.2 1.8) d(-150 1 0 0)", shape: marker, size: [.1],
  focalLength: .895, width: 640, height: 360, zRange: [.5 100]
}

# on the wrist, from a calibration of a real robot
cameraWrist (l_panda_joint7): {
  Q: [.0566288 -.0138618 .158583 .371288 -.0124238 .0272688 -.928034], shape: camera, size: [.1],
  focalLength: .895, width: 640, height: 360, zRange: [.1 10]
}

# the housing of that camera
panda_collCameraWrist (cameraWrist): {
  Q: "t(0 0 .02) d(90 0 1 0)", shape: capsule, size: [.05 .03], color: [1 1 1 .2], contact: -3
}
