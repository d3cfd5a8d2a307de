"""Types of the functions about programs and studies. Their options are those of `ninebit help VERB`."""
from collections.abc import Mapping, Sequence
from typing import Any, Literal, overload

from . import Explanation, Form, Proof, ReadForm, Report, Vectors
from ._calls import Path, AnyProgram, Point, Progress, Technique, DepthEncoding, IndexScales, LightType, Faces

List = str | Sequence[str] | Sequence[int] | Sequence[float] | Sequence[Sequence[float]]

def explain(
    program: AnyProgram,
    *,
    profile: Path | None = None,
    from_: ReadForm | None = None,
    function: str | Sequence[str] | None = None,
    define: Mapping[str, Any] | Sequence[str] | None = None,
    chip: Literal["nv10", "nv20"] | None = None,
    output: Path | None = None,
) -> Explanation: ...
@overload
def convert(
    program: AnyProgram,
    to: Form,
    *,
    profile: Path | None = None,
    from_: ReadForm | None = None,
    function: str | Sequence[str] | None = None,
    define: Mapping[str, Any] | Sequence[str] | None = None,
    chip: Literal["nv10", "nv20"] | None = None,
    frame: int | None = None,
) -> str: ...
@overload
def convert(
    program: AnyProgram,
    to: Form,
    *,
    output: Path,
    profile: Path | None = None,
    from_: ReadForm | None = None,
    function: str | Sequence[str] | None = None,
    define: Mapping[str, Any] | Sequence[str] | None = None,
    chip: Literal["nv10", "nv20"] | None = None,
    frame: int | None = None,
) -> dict[str, Any]: ...
@overload
def convert(
    program: AnyProgram,
    to: None = None,
    *,
    output: Path | None = None,
    profile: Path | None = None,
    from_: ReadForm | None = None,
    function: str | Sequence[str] | None = None,
    define: Mapping[str, Any] | Sequence[str] | None = None,
    chip: Literal["nv10", "nv20"] | None = None,
    frame: int | None = None,
) -> dict[str, Any]: ...
def vectors(
    *,
    progress: Progress | None = None,
    profile: Path | None = None,
    threads: int | None = None,
    output: Path | None = None,
    programs: int | None = None,
    fragments: int | None = None,
    seed: int | None = None,
) -> Vectors: ...
@overload
def study(
    name: Literal["index-steps"],
    /,
    *,
    progress: Progress | None = None,
    profile: Path | None = None,
    threads: int | None = None,
    output: Path | None = None,
    shard: str | None = None,
    budget: float | None = None,
    steps: List | None = None,
    formats: List | None = None,
    variants: List | None = None,
    program: Path | None = None,
    define: Mapping[str, Any] | Sequence[str] | None = None,
) -> Report: ...
@overload
def study(
    name: Literal["datapath"],
    /,
    *,
    progress: Progress | None = None,
    profile: Path | None = None,
    threads: int | None = None,
    output: Path | None = None,
    shard: str | None = None,
    budget: float | None = None,
    program: Path | None = None,
    define: Mapping[str, Any] | Sequence[str] | None = None,
    inputs: Path | None = None,
    over: List | None = None,
    exhaustive_sum: bool = False,
    forms: List | None = None,
) -> Report: ...
@overload
def study(
    name: Literal["depth-packing"],
    /,
    *,
    progress: Progress | None = None,
    threads: int | None = None,
    output: Path | None = None,
    shard: str | None = None,
    budget: float | None = None,
    packings: List | None = None,
    storages: List | None = None,
    depths: List | None = None,
    float_step: int | None = None,
) -> Report: ...
@overload
def study(
    name: Literal["shadows"],
    scene: Path,
    /,
    *,
    progress: Progress | None = None,
    profile: Path | None = None,
    threads: int | None = None,
    output: Path | None = None,
    shard: str | None = None,
    budget: float | None = None,
    map_sizes: List | None = None,
    formats: List | None = None,
    scopes: List | None = None,
    steps: List | None = None,
    orders: List | None = None,
    scales: List | None = None,
    depth_bits: Literal[8, 16, "8", "16", "float"] | None = None,
    biases: List | None = None,
    encodings: List | None = None,
    polygon_offsets: List | None = None,
    find_offset: bool = False,
    allow_outside: bool = False,
    up: Literal["y", "z"] | None = None,
    camera: Point | str | None = None,
    look_at: Point | str | None = None,
    fov: float | None = None,
    light: Point | str | None = None,
    floor: float | Literal["auto", "none"] | None = None,
    light_type: LightType | None = None,
    light_target: Point | str | None = None,
    spot_angle: float | None = None,
    technique: Technique | None = None,
    size: tuple[int, int] | str | None = None,
    light_facing: bool = False,
    cull: Faces | None = None,
    depth_stencil: Literal["d24s8", "d16", "d15s1"] | None = None,
    style: Literal["plain", "cartoon"] | None = None,
    map_size: int | None = None,
    index_format: Literal["rgb", "la", "l", "a"] | None = None,
    index_scope: Literal["polygon", "object", "section"] | None = None,
    index_step: int | None = None,
    section_size: int | None = None,
    index_order: Literal["file", "neighbour"] | None = None,
    patch_angle: float | None = None,
    index_scales: IndexScales | None = None,
    bias: float | None = None,
    polygon_offset: tuple[float, float] | str | None = None,
    depth_encoding: DepthEncoding | None = None,
    depth_storage: Literal["round", "truncate"] | None = None,
    volume_method: Literal["depth-fail", "depth-pass"] | None = None,
    stencil_sides: Literal["two", "one"] | None = None,
    samples: int | None = None,
    kernel: float | None = None,
    pattern: Literal["poisson", "polar"] | None = None,
    gather_scale: int | None = None,
    cookie: Path | Sequence[Path] | None = None,
    light_rotate: Point | str | None = None,
    cookie_shadows: Literal["index", "none"] | None = None,
) -> Report: ...
@overload
def study(
    name: Literal["merge"],
    /,
    *parts: Path,
    progress: Progress | None = None,
    threads: int | None = None,
    output: Path | None = None,
    allow_outside: bool = False,
) -> Report: ...
@overload
def prove(
    question: Literal["equivalent"],
    a: AnyProgram,
    b: AnyProgram,
    /,
    *,
    progress: Progress | None = None,
    profile: Path | None = None,
    threads: int | None = None,
    timeout: float | None = None,
    set: Mapping[str, Any] | str | Sequence[str] | None = None,
    free: str | Sequence[str] | None = None,
    define: Mapping[str, Any] | Sequence[str] | None = None,
    other_profile: Path | None = None,
    outputs: str | Sequence[str] | None = None,
) -> Proof: ...
@overload
def prove(
    question: Literal["stable"],
    program: AnyProgram,
    /,
    *,
    progress: Progress | None = None,
    profile: Path | None = None,
    threads: int | None = None,
    timeout: float | None = None,
    set: Mapping[str, Any] | str | Sequence[str] | None = None,
    free: str | Sequence[str] | None = None,
    from_: ReadForm | None = None,
    function: str | Sequence[str] | None = None,
    define: Mapping[str, Any] | Sequence[str] | None = None,
    chip: Literal["nv10", "nv20"] | None = None,
) -> Proof: ...
@overload
def prove(
    question: Literal["discriminate"],
    profile1: Path,
    profile2: Path,
    /,
    *,
    progress: Progress | None = None,
    profile: Path | None = None,
    threads: int | None = None,
    field: str | None = None,
) -> Proof: ...
@overload
def prove(
    question: Literal["discriminate"],
    /,
    *,
    progress: Progress | None = None,
    profile: Path | None = None,
    threads: int | None = None,
    field: str | None = None,
) -> Proof: ...
@overload
def prove(
    question: Literal["kit"],
    /,
    *,
    progress: Progress | None = None,
    family: Literal["geforce2", "nv2a"] | None = None,
    output: Path | None = None,
) -> Proof: ...
