# A ball that three slides carry anywhere in a cube of 2 m around (0, 0, .5).

base: { X: [0, 0, .5], multibody, multibody_gravity: false }
jointX (base): { joint: transX, limits: [-1, 1], mass: .01, inertia: [.01, .01, .01], sampleUniform: 1, motorLambda: .01, motorMass: .01 }
jointY (jointX): { joint: transY, limits: [-1, 1], mass: .01, inertia: [.01, .01, .01], sampleUniform: 1, motorLambda: .01, motorMass: .01 }
jointZ (jointY): { joint: transZ, limits: [-1, 1], sampleUniform: 1, motorLambda: .01, motorMass: .01 }
finger (jointZ): { shape: sphere, size: [.02], color: [.5, 1, 1], mass: .1, contact: 1 }
