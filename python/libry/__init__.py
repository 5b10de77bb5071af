"""Runs scripts of 2019 and 2020, whose module is called libry: the same as robotic."""

import sys

import robotic

sys.modules[__name__] = robotic
