"""Types of what all functions of the program's verbs share."""
from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from . import Program, State

Path = str | PathLike[str]
AnyProgram = State | Program | Path | bytes  # a path or a text
Picture = NDArray[np.uint8]
AnyPicture = Path | Picture | Sequence[Path] | Sequence[Picture]
Pair = str | Sequence[int] | NDArray[np.integer[Any]]
Point = Sequence[float] | NDArray[Any]
Color = Sequence[float] | NDArray[Any]
Values = Mapping[str, Any] | Sequence[str] | str  # NAME=VALUE
Progress = Callable[[float, str], object]
Technique = Literal["index-cube", "depth-cube", "shadow-map", "shadow-volume", "reflective", "light-cookie"]
LightType = Literal["point", "spot", "directional"]
Faces = Literal["none", "back", "front"]

def options(verb: str) -> dict[str, str]: ...
