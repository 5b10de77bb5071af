# The Allegro right hand with 16 dofs, from the URDF of the Python package example-robot-data, which must be installed:
# pip install example-robot-data. Frames tip1 .. tip4 are the balls of the fingers; the last is the thumb's.

base_link: { X: [0 0 .2], allegro: "none" }
Include: <package://example-robot-data/robots/allegro_hand_description/urdf/allegro_right_hand.urdf>
Edit palm_link (base_link): {}

Edit joint_1.0: { q: .7 }
Edit joint_2.0: { q: .7 }
Edit joint_3.0: { q: .7 }
Edit joint_5.0: { q: .7 }
Edit joint_6.0: { q: .7 }
Edit joint_7.0: { q: .7 }
Edit joint_9.0: { q: .7 }
Edit joint_10.0: { q: .7 }
Edit joint_11.0: { q: .7 }
Edit joint_12.0: { q: .5 }
Edit joint_13.0: { q: .9 }
Edit joint_14.0: { q: .7 }
Edit joint_15.0: { q: .7 }

tip1 (link_3.0_tip): { shape: sphere, size: [.0122], color: [0 1 1] }
tip2 (link_7.0_tip): { shape: sphere, size: [.0122], color: [0 1 1] }
tip3 (link_11.0_tip): { shape: sphere, size: [.0122], color: [0 1 1] }
tip4 (link_15.0_tip): { shape: sphere, size: [.0122], color: [0 1 1] }
