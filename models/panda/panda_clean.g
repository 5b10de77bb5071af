# The Panda with the hand joined to its last link, as rigid-body dynamics wants it: masses and inertias of links as
# shells, the full range of every joint, and fingers that are part of q. Nothing collides.

Include: <panda_links.g>

# the hand, an eighth of a turn about the flange's axis
panda_hand_0 (panda_joint7): {
  Q: [0 0 .107 .923879754 0 0 -.3826829], shape: ssCvx, size: [.012], color: [.93 .94 .95],
  core: [
    -.018  -.09  .002, -.018   .09  .002,  .018  -.09  .002,  .018   .09  .002, -.019 -.091   .02
    -.019  .091   .02,  .019 -.091   .02,  .019  .091   .02, -.008 -.087  .054, -.008  .087  .054
     .008 -.087  .054,  .008  .087  .054,  .024   .01  -.01,   .01  .024  -.01,  -.01  .024  -.01
    -.024   .01  -.01, -.024  -.01  -.01,  -.01 -.024  -.01,   .01 -.024  -.01,  .024  -.01  -.01
  ],
  visual_mesh: <package://example-robot-data/robots/panda_description/meshes/visual/hand.dae>
}
Include: <panda_hand.g>
Edit panda_finger_joint1_origin (panda_joint7): { Q: [0 0 .1654 .923879754 0 0 -.3826829] }
Edit panda_finger_joint2_origin (panda_joint7): { Q: [0 0 .1654 .923879754 0 0 -.3826829] }
Delete: panda_hand_joint
Delete: panda_hand_joint_origin
Delete: panda_joint8
Delete: panda_joint8_origin

Edit panda_joint1: { mass: .54041, inertia: [.0045632 0 0 .0041073 .0009866 .0018874] }
Edit panda_joint2: { q: 0, mass: .5439, inertia: [.0046463 1e-7 1e-7 .001901 -.0010021 .0041874] }
Edit panda_joint3: { mass: .546829, inertia: [.0024931 -.0005526 -.0008198 .0029029 -.0005407 .0025233] }
Edit panda_joint4: { q: 0, mass: .552034, inertia: [.0025711 .0008477 -.0005601 .0025553 .0005593 .0029871] }
Edit panda_joint5: { mass: .660947, inertia: [.0085205 2.3e-6 -4e-7 .0076539 -.0017765 .0020936] }
Edit panda_joint6: {
  q: 0, limits: [-.0175 3.7525], mass: .499248, inertia: [.0011873 -3.51e-5 .0001619 .0016479 7e-6 .0020942]
}
Edit panda_joint7: {
  q: 0, mass: .508784, com: [.0047918 .0029389 .110289], inertia: [.0014038 -.0005856 3.48e-5 .0013959 5.49e-5 .0015899]
}
Edit panda_finger_joint1: {
  q: 0, joint_active: true, mass: .0339598, inertia: [1.29e-5 0 0 1.25e-5 2.6e-6 3.2e-6]
}
Edit panda_finger_joint2: {
  q: 0, mass: .0339598, com: [-7e-7 .0122672 .0270327], inertia: [1.29e-5 0 0 1.25e-5 -2.6e-6 3.2e-6]
}
