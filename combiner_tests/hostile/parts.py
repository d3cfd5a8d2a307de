"""Parts of every study, with hashes that fit again after a change, so that the change is looked at."""
import hashlib
import json
import pathlib
import tempfile
import threading

import json_tree
import seeds
from judge import Case
from json_tree import Number, Object
from mutate import damage, few, integer

PROGRAM = "docs/programs/index_compare.gl"
STUDIES = {
    "index-steps": ["--steps", "1-3", "--formats", "channel,l"],
    "index-steps one": ["--steps", "1", "--formats", "l", "--profile", "nv2a"],
    "depth-packing": ["--packings", "rgba8-mod,rgba8-fract", "--depths", "16"],
    "datapath": ["--profile", "geforce2"],
    "datapath program": ["--program", str(seeds.ROOT / PROGRAM), "--over", "tex0.r"],
    "shadows": [str(seeds.ROOT / "scenes/cornell_box.gltf"), "--size", "8x8", "--map-sizes", "16,32", "--steps", "1,2"],
    "shadows offsets": [str(seeds.ROOT / "scenes/cornell_box.gltf"), "--size", "8x8", "--technique", "shadow-map",
                        "--map-sizes", "16",
                        "--polygon-offsets", "0,0;1,16"],
}

WHOLE = {"datapath program"}  # of a single unit, which cannot be divided


def sha(text):
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()


class Starts:
    """Both parts of each study, made once by the program that will read the mutants: a part names its build."""

    def __init__(self, program):
        self.program, self.made, self.lock = program, {}, threading.Lock()

    def of(self, name):
        """The texts of a study's parts."""
        return self.written(1 if name in WHOLE else 2, name.split()[0], *STUDIES[name])

    def written(self, count, *words):
        """The texts of so many parts of `ninebit study WORDS`, which together are accepted as they are."""
        with self.lock:
            if (count, words) not in self.made:
                self.made[count, words] = self.make(count, words)
            return self.made[count, words]

    def make(self, count, words):
        with tempfile.TemporaryDirectory(prefix="hostile-") as folder:
            for shard in range(1, count + 1):
                seeds.answer(self.program, "study", *words, "--shard", f"{shard}/{count}", "-o", folder, "--quiet")
            files = sorted(pathlib.Path(folder).glob("*.jsonl"))
            if len(files) != count:
                raise RuntimeError(f"study {' '.join(words)}: expected {count} parts, found {len(files)}")
            # Otherwise a mutant would be refused for another reason than its change.
            seeds.answer(self.program, "study", "merge", *map(str, files), "--allow-outside", "-o", f"{folder}/merged",
                         "--quiet")
            return [path.read_text(encoding="utf-8") for path in files]

    def build(self):
        """What this build of the program calls itself in a part."""
        return json.loads(self.of("index-steps one")[0].split("\n")[0])["build"]


def without_hash(line):
    """A line's JSON before its hash was put in; None if it has none."""
    start = line.rfind(',"sha256":"')
    return line[:start] + "}" if start >= 0 and line.endswith('"}') else None


def with_hash(text):
    return f'{text[:-1]},"sha256":"{sha(text)}"}}' if text.endswith("}") else text


def end_line(count, before):
    return f'{{"end":{count},"sha256":"{sha(before)}"}}\n'


def rehash(lines):
    """The file of these lines, which have no hashes, with an end that fits."""
    body = "".join(with_hash(line) + "\n" for line in lines)
    return body + end_line(len(lines) - 1, body)


def for_build(text, build):
    """A kept part as if this build had written it; lines whose hash did not fit stay as they are."""
    out, fitted = "", True
    for line in text.split("\n"):
        plain = without_hash(line)
        if plain is None or not line:
            out += line + ("\n" if line else "")
            continue
        try:
            node = json_tree.parse(line)
        except ValueError:
            out += line + "\n"
            continue
        if isinstance(node, Object) and node.get("end") is not None and len(node.pairs) == 2:
            out += f'{{"end":{json_tree.write(node.get("end"))},"sha256":"{sha(out)}"}}\n' if fitted else line + "\n"
            continue
        fits = with_hash(plain) == line
        if fits and isinstance(node, Object) and node.get("build") is not None:
            old = json.dumps(node.get("build"))
            plain = plain.replace(f'"build":{old}', f'"build":{json.dumps(build)}', 1)
        out += (with_hash(plain) if fits else line) + "\n"
    return out


def changed(text, changes):
    """A part with hashes that fit again after the changes: (line, keys and indices, JSON of the new value)."""
    lines = [json_tree.parse(without_hash(line)) for line in text.strip().split("\n")[:-1]]
    for line, path, value in changes:
        node = lines[line - 1]
        *way, last = [int(step) if step.isdecimal() else step for step in path.split(".")]
        for step in way:
            node = node.get(step) if isinstance(node, Object) else node[step]
        old = node.get(last) if isinstance(node, Object) else node[last]
        if old is None or json_tree.write(old) == value:
            raise RuntimeError(f"line {line} of the part has no {path} that {value[:40]} would change")
        if isinstance(node, Object):
            node.set(last, json_tree.Raw(value))
        else:
            node[last] = json_tree.Raw(value)
    return rehash([json_tree.write(line) for line in lines])


def change_units(random, units):
    """Changes of whole lines: missing, repeated, exchanged or renumbered units."""
    kind = random.randrange(5)
    k = random.randrange(len(units)) if units else 0
    if not units:
        return
    if kind == 0:
        del units[k]
    elif kind == 1:
        units.insert(random.randrange(len(units) + 1), units[k])
    elif kind == 2:
        random.shuffle(units)
    elif kind == 3 and isinstance(units[k], Object):
        old = units[k].get("unit")
        near = int(old.text) if isinstance(old, Number) and old.text.isdigit() else 0
        units[k].set("unit", Number(str(integer(random, near))))
    else:
        del units[k:]


def change(random, text):
    """One part with changes that its hashes cover."""
    lines = [json_tree.parse(without_hash(line)) for line in text.strip().split("\n")[:-1]]
    head, units = lines[:1], lines[1:]
    for _ in range(few(random)):
        choice = random.random()
        if choice < 0.3:
            json_tree.mutate(random, head[0])
        elif choice < 0.8 and units:
            k = random.randrange(len(units))
            if isinstance(units[k], Object):
                json_tree.mutate(random, units[k])
        elif choice < 0.85 and units:  # one value in all units
            source = random.choice(units)
            units = [source] * len(units)
        else:
            change_units(random, units)
    return rehash([json_tree.write(node) for node in head + units])


def part(random, context):
    starts = context.parts
    name = random.choice(sorted(STUDIES))
    texts = list(starts.of(name))
    which = random.randrange(len(texts))
    choice = random.random()
    if choice < 0.06:
        pass  # right parts, so that some are always accepted
    elif choice < 0.85:
        texts[which] = change(random, texts[which])
        if random.random() < 0.2:
            texts[-1 - which] = change(random, starts.of(name)[-1 - which])
    elif choice < 0.92:
        texts[which] = random.choice(starts.of(random.choice(sorted(STUDIES))))
    else:
        texts[which] = damage(random, texts[which].encode()).decode("utf-8", "surrogateescape")
    files = {f"p{k}.jsonl": text.encode("utf-8", "surrogateescape") for k, text in enumerate(texts)}
    names = sorted(files) if random.random() < 0.95 else [random.choice(sorted(files))] * random.choice([1, 2])
    command = ["study", "merge", *names, "-o", "out", *(["--json"] if random.random() < 0.3 else [])]
    return Case(command, files)
