# A chain of hinges with every contact flag, beside boxes on the ground: which pairs collide?
ground: { shape: ssBox, size: [4 4 .1 .02], contact: 1 }
plate (ground): { Q: [0 0 .2], shape: box, size: [.1 .1 .1], contact: 1 }
ghost (ground): { Q: [0 0 .3], shape: box, size: [.1 .1 .1] }
free_box: { X: [1 0 1], shape: box, size: [.1 .1 .1], contact: 1 }
free_other: { X: [1 1 1], shape: sphere, size: [.1], contact: -1 }
l1 (ground): { joint: hingeX, pre: [0 0 .2], shape: capsule, size: [.2 .05], contact: -1 }
l1_hand (l1): { Q: [0 .1 0], shape: sphere, size: [.05], contact: 1 }
l2 (l1): { joint: hingeY, pre: [0 0 .2], shape: capsule, size: [.2 .05], contact: -2 }
l3 (l2): { joint: hingeX, pre: [0 0 .2], shape: capsule, size: [.2 .05], contact: -3 }
bridge (l3): { joint: rigid, Q: [0 0 .1], shape: sphere, size: [.05], contact: -1 }
l4 (bridge): { joint: hingeZ, pre: [0 0 .2], shape: capsule, size: [.2 .05], contact: 1 }
l5 (l4): { joint: transX, pre: [0 0 .2], shape: cylinder, size: [.2 .05], contact: -2 }
