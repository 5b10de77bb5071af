# The seven-joint Panda arm, from its base to the mechanical flange.

panda_base: { multibody: true, multibody_gravity: false, franka: "none" }

Include: <panda_links.g>
Edit panda_link0 (panda_base): {}
