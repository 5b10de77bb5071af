# The hall of k-hall.g with one pendulum that swings.

Include: <k-hall.g>
