# The Panda of panda_clean.g without its fingers' and hand's pictures.

Include: <panda_clean.g>
Delete: panda_hand_0
Delete: panda_rightfinger_0
