# Include, Prefix, Edit, Delete and what they do to names, parents and mimics.
Prefix: left_
Include: <sub/arm.g>
Prefix: right_
Include: <sub/arm.g>
world: { X: [0 0 1] }
Edit left_base (world): { Q: "t(0 .3 0)" }
Edit right_base (world): { Q: "t(0 -.3 0) d(180 0 0 1)" }
Edit (right_elbow): { q: -.4, limits: [-.5 .5] }
Delete: left_spare
DeleteBranch right_spare
Prefix: extra_
first: { X: [1 0 0] }
second (extra_first): { Q: [0 1 0] }
Prefix!
third (extra_second): { Q: [0 0 1] }
q: [.1 .2 .3 .4]
