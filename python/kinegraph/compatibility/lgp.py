"""What scripts of earlier years call the abstraction of LGP_Tool, and what they hand it."""

from .._core import default_LGP_TAMP_Abstraction

default_TAMP_Provider = default_LGP_TAMP_Abstraction


class default_Logic2KOMO_Translator:
    """What an action asks is said by default_LGP_TAMP_Abstraction."""
