# An arm of seven joints, turning and bending by turns, made of rounded bars 0.2 m apart; it stands 0.2 m above its base.

base: { X: [0, 0, .1], shape: ssBox, size: [.1, .1, .25, .03], mass: .5, contact: -1 }

joint1 (base): { pre: [0, 0, .1], joint: hingeZ, limits: [-2, 2] }
(joint1): { Q: [0, 0, .1], shape: ssBox, size: [.1, .1, .25, .03], mass: .5, contact: -1 }

joint2 (joint1): { pre: [0, 0, .2], joint: hingeX, limits: [-2, 2], q: -.3 }
(joint2): { Q: [0, 0, .1], shape: ssBox, size: [.1, .1, .25, .03], mass: 1, contact: -1 }

joint3 (joint2): { pre: [0, 0, .2], joint: hingeZ, limits: [-2, 2] }
(joint3): { Q: [0, 0, .1], shape: ssBox, size: [.1, .1, .25, .03], mass: 1, contact: -1 }

joint4 (joint3): { pre: [0, 0, .2], joint: hingeX, limits: [-2, 2], q: -1.3 }
(joint4): { Q: [0, 0, .1], shape: ssBox, size: [.1, .1, .25, .03], mass: 1, contact: -1 }

joint5 (joint4): { pre: [0, 0, .2], joint: hingeZ, limits: [-2, 2] }
(joint5): { Q: [0, 0, .1], shape: ssBox, size: [.1, .1, .25, .03], mass: 1, contact: -1 }

joint6 (joint5): { pre: [0, 0, .2], joint: hingeX, limits: [-2, 2], q: -1.3 }
(joint6): { Q: [0, 0, .1], shape: ssBox, size: [.1, .1, .25, .03], mass: 1, contact: -1 }

joint7 (joint6): { pre: [0, 0, .2], joint: hingeZ, limits: [-2, 2] }
(joint7): { Q: [0, 0, .1], shape: ssBox, size: [.1, .1, .25, .03], mass: 1, contact: -1 }

endeff (joint7): { Q: [0, 0, .25, 0, 1, 0, 0], shape: ssBox, size: [.03, .03, .05, .01], color: [1, 1, 0], contact: -1 }
