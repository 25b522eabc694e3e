"""The version of this release, named in sidecars and by ``--version``."""

__all__ = ["__version__"]

__version__ = "0.1.0"
