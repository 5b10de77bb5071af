"""Keywords of named problems."""

import kinegraph


class arg:
    """Keywords of named problems, by their former names."""

    left = kinegraph.ArgWord._left
    right = kinegraph.ArgWord._right
    sequence = kinegraph.ArgWord._sequence
    path = kinegraph.ArgWord._path
