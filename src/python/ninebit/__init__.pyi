from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any, Literal, TypedDict, overload

import numpy as np
from numpy.typing import NDArray

from ._calls import options as options
from ._pictures import compare as compare
from ._pictures import draw as draw
from ._pictures import render as render
from ._pictures import trace as trace
from ._questions import convert as convert
from ._questions import explain as explain
from ._questions import prove as prove
from ._questions import study as study
from ._questions import vectors as vectors

ReadForm = Literal["gl", "rc10", "ps", "tokens", "xbox", "json", "words", "words-json", "source", "log"]
Form = Literal["gl", "rc10", "tokens", "xbox", "json", "words", "words-json", "ps11", "glsl", "glsl-es",
               "glsl-pixel-130", "glsl-pixel", "glsl-pixel-450", "glsl-pixel-es", "hlsl", "c"]
Chip = Literal["nv10", "nv20"]
# Whole numbers: alone, in lists, in arrays.
Codes = int | np.integer[Any] | NDArray[np.integer[Any]] | Sequence["Codes"]
IntArray = NDArray[np.integer[Any]]

__version__: str
__all__: list[str]

class Error(ValueError): ...

class Diagnostic(TypedDict):
    gl_error: str
    stage: int | None
    portion: Literal["rgb", "alpha"] | None
    variable: str | None
    message: str

class State:
    def __init__(self, profile: str | PathLike[str] = "geforce2") -> None: ...
    @classmethod
    def parse(
        cls,
        text: str | bytes | PathLike[str],
        form: ReadForm | None = None,
        profile: str | PathLike[str] = "geforce2",
        *,
        chip: Chip | None = None,
        function: str | Sequence[str] | None = None,
        define: Mapping[str, object] | None = None,
        setup: int = 0,
    ) -> State: ...
    def print(self, form: Form, chip: Chip | None = None) -> str: ...
    def validate(self) -> list[Diagnostic]: ...
    @property
    def profile(self) -> str: ...
    @property
    def stages(self) -> int: ...
    def __eq__(self, other: object) -> bool: ...
    def __hash__(self) -> int: ...

class Program:
    state: State
    def __init__(
        self,
        state: State | Program | str | bytes | PathLike[str],
        form: ReadForm | None = None,
        profile: str | PathLike[str] | None = None,
    ) -> None: ...
    @property
    def profile(self) -> str: ...
    @property
    def one(self) -> int: ...
    @property
    def lowest(self) -> int: ...
    @property
    def stages(self) -> int: ...
    @overload
    def evaluate(
        self,
        inputs: Mapping[str, Codes] | None = None,
        /,
        *,
        out: IntArray | None = None,
        axis: Literal[0, -1] | None = None,
        registers: Literal[False] = False,
        **keywords: Codes,
    ) -> NDArray[np.int16]: ...
    @overload
    def evaluate(
        self,
        inputs: Mapping[str, Codes] | None = None,
        /,
        *,
        out: IntArray | None = None,
        axis: Literal[0, -1] | None = None,
        registers: Literal[True],
        **keywords: Codes,
    ) -> dict[str, NDArray[np.int16]]: ...
    @overload
    def evaluate_real(
        self,
        inputs: Mapping[str, Codes] | None = None,
        /,
        *,
        axis: Literal[0, -1] | None = None,
        registers: Literal[False] = False,
        **keywords: Codes,
    ) -> NDArray[np.float64]: ...
    @overload
    def evaluate_real(
        self,
        inputs: Mapping[str, Codes] | None = None,
        /,
        *,
        axis: Literal[0, -1] | None = None,
        registers: Literal[True],
        **keywords: Codes,
    ) -> dict[str, NDArray[np.float64]]: ...
    def trace(self, registers: Mapping[str, Codes] | None = None, /, **keywords: Codes) -> Trace: ...
    def explain(self) -> str: ...
    def glsl(self, function: str = "ninebit_combine", es: bool = False) -> str: ...

class Trace(dict[str, Any]): ...

class _Picture(dict[str, Any]):
    color: NDArray[np.uint8]
    depth: NDArray[np.uint32]
    stencil: NDArray[np.uint8]
    frames: NDArray[np.uint8] | None
    pictures: dict[str, NDArray[np.uint8]]
    layers: dict[str, NDArray[Any]]

class Rendering(_Picture): ...
class Drawing(_Picture): ...

class Comparison(dict[str, Any]):
    rows: NDArray[np.void]
    pictures: dict[str, NDArray[np.uint8]]
    wrong: dict[str, NDArray[np.uint8]]
    sheet: NDArray[np.uint8] | None

class Report(dict[str, Any]):
    rows: NDArray[np.void]
    tables: dict[str, NDArray[np.void]]

class Proof(dict[str, Any]):
    def __bool__(self) -> bool: ...

class Explanation(dict[str, Any]):
    text: str

class Vectors(dict[str, Any]):
    text: str
    programs: list[str]
    rows: NDArray[np.void]

def profiles() -> list[str]: ...
def simd_target() -> str: ...
