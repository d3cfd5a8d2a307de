"""Writes the stubs of a built package: python write_stubs.py PACKAGE TEMPLATE...

A template is a stub whose comments `# scene`, `# settings` and `# axes` stand for parameters: those of every verb that
renders, the settings of techniques, and their lists for sweeps. `# forms` stands for the names of the forms of programs.
"""
import importlib
import pathlib
import re
import sys

SCENE = """\
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
size: Pair | None = None,
light_facing: bool = False,"""


def type_of(kind, numbers, words):
    if kind == "word":
        whole = [word for word in words if word.isdigit()]
        return f"Literal[{', '.join([*whole, *(repr(word) for word in words)])}]".replace("'", '"')
    if kind == "files":
        return "AnyPicture"
    one = {"whole": "int", "real": "float"}[kind]
    return one if numbers == 1 else f"tuple[{', '.join([one] * numbers)}] | str"


def parameters(settings, axes):
    """The lines of `# settings` and `# axes`. A list replaces the single value of its name."""
    lists = {axis for *_, axis in settings if axes and axis}
    single = [f"{name}: {type_of(kind, numbers, words)} | None = None," for name, kind, numbers, words, _ in settings
              if name not in lists]
    return single, [f"{axis}: List | None = None," for *_, axis in settings if axis]


def literal(name, words):
    return f"{name} = Literal[{', '.join(repr(word) for word in words)}]".replace("'", '"')


def stub_of(template, settings, forms):
    single, axes = parameters(settings, "# axes" in template)
    blocks = {"scene": SCENE.splitlines(), "settings": single, "axes": axes,
              "forms": [literal("ReadForm", forms["read"]), literal("Form", forms["written"])]}
    lines = []
    for line in template.splitlines():
        found = re.fullmatch(r"( *)# (scene|settings|axes|forms)", line)
        lines += [found[1] + one for one in blocks[found[2]]] if found else [line]
    return "\n".join(lines) + "\n"


def main(package, *templates):
    sys.path.insert(0, str(pathlib.Path(package).parent))
    verbs = importlib.import_module(f"{pathlib.Path(package).name}._verbs")
    for template in map(pathlib.Path, templates):
        (pathlib.Path(package) / template.stem).write_text(stub_of(template.read_text(), verbs.settings(), verbs.forms()))


if __name__ == "__main__":
    main(*sys.argv[1:])
