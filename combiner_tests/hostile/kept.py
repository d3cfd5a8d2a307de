"""The kept cases: folders of cases/ with a command and its files, and some that are made here as they are large.

CMD has the command in its first line. Further lines say what is expected besides the rules of judge.py:
    exit 3        or several codes; without it, any of 0 to 5 that the rules let pass
    says TEXT     what stderr must hold
    not TEXT      what it must not hold
    pipe NAME     a FIFO of that name stands in the folder
    make NAME     a function of large.py writes the files
    parts N WORDS `ninebit study WORDS` of the program itself writes N parts, p0.jsonl and so on, and accepts them
    change FILE LINE PATH VALUE   in such a part: the value at the keys and indices of PATH, such as rows.0.1.count
"""
import functools
import pathlib
import shlex

import large
import parts
import seeds
from judge import PIPE, Case

CASES = pathlib.Path(__file__).resolve().parent / "cases"


def read(folder, context):
    """The case of a folder. Parts of studies get hashes and a build that fit the program."""
    lines = (folder / "CMD").read_text(encoding="utf-8").splitlines()
    words = shlex.split(lines[0])
    if words[:1] != ["ninebit"]:
        raise RuntimeError(f"{folder}/CMD: expected a command that begins with ninebit")
    case = Case(words[1:], {}, {})
    study, changes = None, {}
    for line in lines[1:]:
        key, _, value = line.partition(" ")
        if key == "exit":
            case.expected["exit"] = [int(code) for code in value.split()]
        elif key in ("says", "not"):
            case.expected.setdefault(key, []).append(value)
        elif key == "pipe":
            case.files[value] = PIPE
        elif key == "make":
            case.files.update(getattr(large, value)())
        elif key == "parts":
            study = (int(value.split()[0]), *value.split()[1:])
        elif key == "change":
            name, number, path, text = value.split(" ", 3)
            changes.setdefault(name, []).append((int(number), path, text))
        elif line.strip():
            raise RuntimeError(f"{folder}/CMD: '{line}' is not a line of CMD")
    for k in range(study[0] if study else 0):
        name = f"p{k}.jsonl"
        case.files[name] = functools.partial(part, context, study, k, changes.pop(name, []))
    if changes:
        raise RuntimeError(f"{folder}/CMD: there is no part {', '.join(changes)}")
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if name == "CMD" or path.is_dir():
            continue
        data = path.read_bytes()
        if path.suffix == ".jsonl":
            data = parts.for_build(data.decode("utf-8"), context.parts.build()).encode()
        case.files[name] = data
    case.files["scenes"] = seeds.ROOT / "scenes"
    return case


def part(context, study, k, changes):
    """The bytes of a part that this build of the program writes, with the changes."""
    return parts.changed(context.parts.written(*study)[k], changes).encode()


def names():
    return sorted(path.parent.name for path in CASES.glob("*/CMD"))


def cases(context, chosen=()):
    """The kept cases by name: all, or those with one of the texts in their names."""
    found = [n for n in names() if not chosen or any(text in n for text in chosen)]
    if not found:
        raise RuntimeError("no kept case has such a name")
    return [(name, read(CASES / name, context)) for name in found]
