"""GeForce 2 register combiners to the bit, and the shadow techniques built on them."""
from ._ninebit import Error, Program, State, __version__, profiles, render, simd_target, techniques

__all__ = ["Error", "Program", "State", "__version__", "profiles", "render", "simd_target", "techniques"]
