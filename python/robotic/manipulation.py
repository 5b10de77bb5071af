"""Problems of manipulation in a few calls."""

from .not_yet import KOMO_ManipulationHelper as KOMO_ManipulationHelper
from .pending import pending

ManipulationModelling = pending(
    "manipulation.ManipulationModelling", "KOMO with addModeSwitch states the same problems"
)
