"""Names of earlier years, and of scripts written for `robotic`, for functions with other names in this package.

All of them are defined here; the rest of the package does not use them: functions (`parameters`, `skeleton_problems`),
methods added to the classes (`methods`, by `scenes`, `views`, `problems` and `bot_op`), and members of enums
(`OPT_METHODS`). They are available under `import kinegraph` and under `import robotic`. Absent names have an error that
suggests a replacement (`absent`).
"""

from .absent import addAbsentNames as addAbsentNames
from .methods import addEarlierMethods as addEarlierMethods

OPT_METHODS = {
    "AugmentedLag": "augmentedLag",
    "GradientDescent": "gradientDescent",
    "LogBarrier": "logBarrier",
    "Newton": "newton",
    "Rprop": "rprop",
    "SquaredPenalty": "squaredPenalty",
    "SingleSquaredPenalty": "singleSquaredPenalty",
    "lbfgs": "LBFGS",
}
