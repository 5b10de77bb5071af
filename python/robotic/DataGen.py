"""Random scenes and grasps."""

from .pending import pending

_SAMPLES = "NLP_Sampler(komo.nlp()) samples configurations that satisfy constraints"
RndStableConfigs = pending("DataGen.RndStableConfigs", _SAMPLES)
ShapenetGrasps = pending("DataGen.ShapenetGrasps", _SAMPLES)
sampleGraspCandidate = pending("DataGen.sampleGraspCandidate", _SAMPLES)
