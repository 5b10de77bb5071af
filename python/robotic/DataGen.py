"""Scenes and grasps at random."""

from .pending import pending

_SAMPLES = "NLP_Sampler(komo.nlp()) draws configurations that hold constraints"
RndStableConfigs = pending("DataGen.RndStableConfigs", _SAMPLES)
ShapenetGrasps = pending("DataGen.ShapenetGrasps", _SAMPLES)
sampleGraspCandidate = pending("DataGen.sampleGraspCandidate", _SAMPLES)
