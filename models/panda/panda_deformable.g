# The Panda of panda_clean.g, under the name of a study of arms that bend; its links are stiff.
Include: <panda_clean.g>
