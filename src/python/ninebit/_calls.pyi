"""Types of what all functions of the program's verbs share."""
from collections.abc import Callable, Sequence
from os import PathLike
from typing import Literal

from . import Program, State

Path = str | PathLike[str]
AnyProgram = State | Program | Path
Point = tuple[float, float, float] | Sequence[float]
Progress = Callable[[float, str], object]
Technique = Literal["index-cube", "depth-cube", "shadow-map", "shadow-volume", "reflective", "light-cookie"]
LightType = Literal["point", "spot", "directional"]
Faces = Literal["none", "back", "front"]

def options(verb: str) -> dict[str, str]: ...
