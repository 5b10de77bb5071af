# The Ranger Mini as a base that moves in the plane: two slides and a turn. Wheels and legs stand still.

ranger_base: { multibody: true, multibody_gravity: false }
ranger_transX (ranger_base): { joint: transX, limits: [-5 5], ctrl_H: 2, motorLambda: .02, motorMass: 40 }
ranger_transY (ranger_transX): { joint: transY, limits: [-5 5], ctrl_H: 2, motorLambda: .02, motorMass: 40 }
ranger_rot (ranger_transY): { joint: hingeZ, limits: [-5 5] }

Prefix: ranger_
Include: <ranger_mini_conv.g>
Prefix!

# the deck is 31.5 cm above the floor
Edit ranger_base_link (ranger_rot): { Q: [0 0 .315] }
Edit ranger_fr_joint: { joint: none }
Edit ranger_fl_joint: { joint: none }
Edit ranger_br_joint: { joint: none }
Edit ranger_bl_joint: { joint: none }

# what it collides with
ranger_coll (ranger_base_link): {
  Q: [0 0 -.14], shape: ssBox, size: [.75 .5 .3 .05], color: [1 1 1 .5], contact: 1
}
