"""GeForce 2 register combiners to the bit, and the shadow techniques built on them."""
from ._ninebit import (Error, Program, State, __version__, datapath_study, depth_packing_study, draw, index_steps_study,
                       profiles, render, shadows_study, simd_target, techniques)

__all__ = ["Error", "Program", "State", "__version__", "datapath_study", "depth_packing_study", "draw",
           "index_steps_study", "profiles", "render", "shadows_study", "simd_target", "techniques"]
