"""Earlier names for the abstraction of LGP_Tool and its argument."""

from .._core import default_LGP_TAMP_Abstraction

default_TAMP_Provider = default_LGP_TAMP_Abstraction


class default_Logic2KOMO_Translator:
    """A placeholder: default_LGP_TAMP_Abstraction defines the constraints of actions."""
