# The Panda of panda.g with tight collision shapes: convex hulls of the links in place of capsules around them. To be
# taken where obstacles are near, as in planning; frames and joints are those of panda.g.

Include: <panda_arm.g>
Include: <panda_hand.g>
Include: <panda_hand_masses.g>
Include: <panda_tight_collision.g>
