from typing import Any, Callable, Literal, Mapping, Sequence, TypedDict

import numpy as np
from numpy.typing import NDArray

ReadForm = Literal["gl", "source", "rc10", "ps", "words", "words-json", "json", "xbox", "log"]
Form = Literal["gl", "rc10", "ps11", "words", "words-json", "json", "xbox"]
Point = tuple[float, float, float]

__version__: str

class Error(ValueError): ...

class Diagnostic(TypedDict):
    gl_error: str
    stage: int | None
    portion: Literal["rgb", "alpha"] | None
    variable: str | None
    message: str

class IndexOrder(TypedDict):
    order: Literal["file", "neighbour"]
    reason: str
    patches: int
    borders: int
    broken_borders: int
    broken_share: float
    false_neighbours: int

class Drawing(TypedDict):
    red: NDArray[np.uint8]
    green: NDArray[np.uint8]
    blue: NDArray[np.uint8]
    alpha: NDArray[np.uint8]
    stencil: NDArray[np.uint8]
    depth: NDArray[np.uint32]
    warnings: list[str]

class Rendering(TypedDict):
    red: NDArray[np.uint8]
    green: NDArray[np.uint8]
    blue: NDArray[np.uint8]
    alpha: NDArray[np.uint8]
    depth: NDArray[np.uint32]
    stencil: NDArray[np.uint8]
    background: int
    lit: int
    shadowed: int
    facts: dict[str, int | float | str]
    index_order: IndexOrder

class State:
    def __init__(self, profile: str = "geforce2") -> None: ...
    @staticmethod
    def parse(text: str, form: ReadForm | None = None, profile: str = "geforce2") -> State: ...
    def print(self, form: Form) -> str: ...
    def validate(self) -> list[Diagnostic]: ...
    @property
    def profile(self) -> str: ...
    def __eq__(self, other: object) -> bool: ...

class Program:
    def __init__(self, state: State) -> None: ...
    @property
    def profile(self) -> str: ...
    @property
    def one(self) -> int: ...
    @property
    def lowest(self) -> int: ...
    def evaluate(self, inputs: Mapping[str, NDArray[np.int16]]) -> NDArray[np.int16]: ...
    def evaluate_registers(self, inputs: Mapping[str, NDArray[np.int16]]) -> dict[str, NDArray[np.int16]]: ...
    def trace(self, registers: Mapping[str, int | Sequence[int]]) -> dict[str, Any]: ...
    def explain(self) -> str: ...
    def glsl(self, function: str = "ninebit_combine", es: bool = False) -> str: ...

def profiles() -> list[str]: ...
def techniques() -> list[str]: ...
def simd_target() -> str: ...
def render(
    scene: str,
    *,
    technique: str = "index-cube",
    size: tuple[int, int] = (1024, 768),
    map_size: int = 512,
    profile: str = "geforce2",
    index_step: int = 2,
    index_order: Literal["file", "neighbour"] = "file",
    patch_angle: float = 20.0,
    index_scales: Literal["both-x4", "first-x4", "second-x4", "no-scale"] = "both-x4",
    camera: Point | None = None,
    look_at: Point | None = None,
    fov: float | None = None,
    light: Point | None = None,
    allow_outside: bool = False,
) -> Rendering: ...
def draw(
    effect: str,
    *,
    profile: str | None = None,
    size: tuple[int, int] | None = None,
    read_picture: Callable[[str], NDArray[np.uint8]] | None = None,
) -> Drawing: ...
def index_steps_study(
    *,
    profiles: Sequence[str] | None = None,
    formats: Sequence[Literal["channel", "rgb", "la", "l", "a"]] | None = None,
    variants: Sequence[str] | None = None,
    steps: tuple[int, int] = (1, 16),
) -> dict[str, NDArray[np.void]]: ...
def datapath_study(*, profiles: Sequence[str] | None = None) -> dict[str, NDArray[np.void]]: ...
def shadows_study(
    scene: str,
    *,
    technique: str = "index-cube",
    size: tuple[int, int] = (1024, 768),
    profile: str = "geforce2",
    map_sizes: Sequence[int] = (),
    formats: Sequence[Literal["rgb", "la", "l", "a"]] | None = None,
    scopes: Sequence[Literal["polygon", "object", "section"]] | None = None,
    steps: Sequence[int] = (),
    orders: Sequence[Literal["file", "neighbour"]] | None = None,
    scales: Sequence[Literal["both-x4", "first-x4", "second-x4", "no-scale"]] | None = None,
    depth_bits: Sequence[Literal["8", "16", "float"]] | None = None,
    biases: Sequence[float] = (),
    encodings: Sequence[str] | None = None,
    polygon_offsets: Sequence[tuple[float, float]] = (),
    camera: tuple[float, float, float] | None = None,
    look_at: tuple[float, float, float] | None = None,
    fov: float | None = None,
    light: tuple[float, float, float] | None = None,
    allow_outside: bool = False,
) -> dict[str, NDArray[np.void]]: ...
def depth_packing_study(
    *,
    packings: Sequence[str] | None = None,
    storages: Sequence[Literal["round", "truncate"]] | None = None,
    sets: Sequence[Literal["16", "24", "floats"]] | None = None,
    float_step: int = 64,
) -> dict[str, NDArray[np.void]]: ...
