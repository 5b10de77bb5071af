# The Unitree G1 humanoid with 29 dofs, from the URDF of the Python package example-robot-data, which must be installed:
# pip install example-robot-data. It stands with bent knees; `g1_base` is free to be moved.

g1_base: { X: [0 0 .79], multibody: true, multibody_fixedBase: false, multibody_gravity: true }
Include: <package://example-robot-data/robots/g1_description/urdf/g1_29dof_rev_1_0.urdf>
Edit pelvis (g1_base): {}

Edit left_hip_pitch_joint: { q: -.25 }
Edit right_hip_pitch_joint: { q: -.25 }
Edit left_knee_joint: { q: .5 }
Edit right_knee_joint: { q: .5 }
Edit left_ankle_pitch_joint: { q: -.25, motorLambda: .02, motorMass: 100 }
Edit right_ankle_pitch_joint: { q: -.25, motorLambda: .02, motorMass: 100 }
