"""Names of earlier years, and of scripts written for `robotic`, for what the package calls otherwise.

All of them are here, above the rest, which does not know them: functions (`parameters`, `skeleton_problems`), methods
that are added to the classes (`methods`, by `scenes`, `views`, `problems` and `bot_op`), and members of enums (`OPT_METHODS`).
The names are there under `import kinegraph` as well as under `import robotic`. What is not there says what to call instead (`absent`).
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
