# The PR2 that reaches with its right arm into a shelf behind it; head, grippers and left arm stand still.

Include: <../pr2/pr2.g>
Include: <../pr2/pr2_modify_fixHead.g>
Include: <../pr2/pr2_modify_fixGrippers.g>
Include: <../pr2/pr2_modify_fixLeft.g>

Include: <../objects/shelf.g>
Edit shelf: { X: "t(-1 1 0) d(-150 0 0 1)" }

endeff (r_wrist_roll_joint): { Q: [.2 0 0], shape: marker, size: [.1], color: [1 0 0] }
