# A Panda (prefix `l_`) on the back of a Ranger Mini, with its control box in front: 10 dofs.

Include: <../ranger/ranger.g>

Prefix: "l_"
Include: <../panda/panda.g>
Prefix: False
Edit l_panda_base (ranger_base_link): { Q: "t(-.25 0 .04) d(180 0 0 1)", joint: none, multibody: false }

controlBox (ranger_base_link): { Q: [.15 0 .1], shape: ssBox, size: [.35 .45 .16 .01], color: [.1] }
