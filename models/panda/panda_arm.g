# The seven-joint Panda arm, from its base to the mechanical flange.

panda_base: { multibody: true, multibody_gravity: false, franka: "none" }

Include: <panda_links.g>
Edit panda_link0 (panda_base): {}

# Masses, centers and inertias as identified on the real arm: Gaz, Cognetti, Oliva, Robuffo Giordano & De Luca,
# Dynamic identification of the Franka Emika Panda robot, RA-L 2019.
Edit panda_link0: { mass: .629769, com: [-.041018 -.00014 .049974], inertia: [.00315 8.2904e-7 .00015 .00388 8.2299e-6 .004285] }
Edit panda_joint1: {
  mass: 4.970684, com: [.003875 .002081 -.04762],
  inertia: [.70337 -.000139 .006772 .70661 .019169 .009117]
}
Edit panda_joint2: {
  mass: .646926, com: [-.003141 -.02872 .003495],
  inertia: [.007962 -.003925 .010254 .02811 .000704 .025995]
}
Edit panda_joint3: {
  mass: 3.228604, com: [.027518 .039252 -.066502],
  inertia: [.037242 -.004761 -.011396 .036155 -.012805 .01083]
}
Edit panda_joint4: {
  mass: 3.587895, com: [-.05317 .104419 .027454],
  inertia: [.025853 .007796 -.001332 .019552 .008641 .028323]
}
Edit panda_joint5: {
  mass: 1.225946, com: [-.011953 .041065 -.038437],
  inertia: [.035549 -.002117 -.004037 .029474 .000229 .008627]
}
Edit panda_joint6: {
  mass: 1.666555, com: [.060149 -.014117 -.010517],
  inertia: [.001964 .000109 -.001158 .004354 .000341 .005433]
}
Edit panda_joint7: {
  mass: .735522, com: [.010517 -.004252 .061597],
  inertia: [.012516 -.000428 -.001196 .010027 -.000741 .004815]
}
