# A simple gripper to hang on an arm: a palm with two balls as fingers. Its root is `gripper`; z points away from what is
# held, `gripperCenter` is between the fingers.

gripper: {
  X: "t(.05 .5 1) d(-90 0 0 1) d(-45 1 0 0)", shape: ssBox, size: [.14 .04 .03 .01], color: [.9 .9 .9], contact: -3
}
finger1 (gripper): { Q: [.07 0 -.05], shape: sphere, size: [.03], color: [.9 .9 .9], contact: -3 }
finger2 (gripper): { Q: [-.07 0 -.05], shape: sphere, size: [.03], color: [.9 .9 .9], contact: -3 }
gripperCenter (gripper): { Q: [0 0 -.05], shape: marker, size: [.03], color: [.9 .9 .9] }
