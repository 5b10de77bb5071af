"""The words of named problems."""

import kinegraph


class arg:
    """The words of named problems, as earlier years wrote them."""

    left = kinegraph.ArgWord._left
    right = kinegraph.ArgWord._right
    sequence = kinegraph.ArgWord._sequence
    path = kinegraph.ArgWord._path
