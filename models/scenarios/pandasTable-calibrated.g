# Two Pandas at the table of pandasTable.g as one real table has them, and the origin of its motion capture system.

Include: <pandasTable.g>

Edit r_panda_base: { Q: [.402336 -.298259 0 .70899675 0 0 .70521175] }

optitrack_base (world): { Q: [.00233399 -.207618 .605897 .70581681 -.000992576 .00334569 .708385808] }
