"""Earlier names for the abstraction of LGP_Tool and its argument."""

from .._core import LGP_TAMP_Abstraction, default_LGP_TAMP_Abstraction

TAMP_Provider = LGP_TAMP_Abstraction
default_TAMP_Provider = default_LGP_TAMP_Abstraction


class Logic2KOMO_Translator:
    """A placeholder: LGP_TAMP_Abstraction defines the constraints of actions."""


class default_Logic2KOMO_Translator(Logic2KOMO_Translator):
    """A placeholder: default_LGP_TAMP_Abstraction defines the constraints of actions."""


Actions2KOMO_Translator = Logic2KOMO_Translator  # in 0.2.9
default_Actions2KOMO_Translator = default_Logic2KOMO_Translator
