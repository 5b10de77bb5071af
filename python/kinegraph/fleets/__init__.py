"""Applies a function to many items: on threads, on processes, or on a cluster."""

from .mapping import imap, map
from .reading import readResults
from .results import ItemFailure, MapResults

__all__ = ["ItemFailure", "MapResults", "imap", "map", "readResults"]
