"""Runs mutants by number, keeps those that fail with their commands, counts, and judges the run itself."""
import collections
import concurrent.futures
import dataclasses
import itertools
import pathlib
import random
import shlex
import threading
import time

import archives
import gltf
import judge
import parts
import pictures_more
import programs
import scenes

FORMATS = {"obj": scenes.obj, "off": scenes.off, "ply": scenes.ply, "gltf": gltf.gltf, "glb": gltf.glb,
           "3ds": scenes.three_ds, "archive": archives.archive,
           "part": parts.part, "picture": pictures_more.picture, **programs.FORMATS}
SLOWER = {"picture": 3}  # times fewer than of the others: loading the picture library takes longest
LEAST = 40  # mutants of a format from which on all refused, or all accepted, means that the run shows nothing
LARGEST = 1 << 20  # bytes of a mutant's file


class Context:
    """What generators take from the program under test, made when it is first needed."""

    def __init__(self, program):
        self.program, self.parts, self.lock = program, parts.Starts(program), threading.Lock()
        self.forms = {}


@dataclasses.dataclass
class Count:
    """What the runs of one format were."""
    runs: int = 0
    codes: collections.Counter = dataclasses.field(default_factory=collections.Counter)
    failed: int = 0
    slowest: tuple = (0.0, "")
    largest: tuple = (0.0, "")

    def add(self, name, outcome):
        self.runs += 1
        self.codes[outcome.code] += 1
        self.failed += bool(outcome.faults)
        self.slowest = max(self.slowest, (outcome.seconds, name))
        self.largest = max(self.largest, (outcome.mib, name))


def make(kind, seed, number, context):
    """Mutant `number` of a format: the same for the same seed, start files and program."""
    case = FORMATS[kind](random.Random(f"{kind}:{seed}:{number}"), context)
    for name, content in case.files.items():
        if isinstance(content, bytes):
            case.files[name] = content[:LARGEST]
    return case


def run(case, program, scratch=None):
    """As judge.run; what looks like a hang is run again with more time, as the machine may be busy."""
    outcome = judge.run(case, program, scratch)
    if any(f.startswith("hang") for f in outcome.faults):
        again = judge.run(case, program, scratch, limit=3 * judge.SECONDS)
        if not any(f.startswith("hang") for f in again.faults) and again.seconds < judge.SECONDS:
            return again
    return outcome


def keep(folder, case, outcome, replay):
    """Writes a failing case where it can be looked at: its files, its command, what was wrong."""
    folder.mkdir(parents=True, exist_ok=True)
    lines = [shlex.join(["ninebit", *case.command])]
    for name, content in case.files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if content is judge.PIPE:
            lines.append(f"pipe {name}")
        elif isinstance(content, bytes):
            path.write_bytes(content)
        elif not path.is_symlink():
            path.symlink_to(content)
    (folder / "CMD").write_text("\n".join(lines) + "\n", encoding="utf-8", errors="surrogateescape")
    (folder / "WHY").write_text("\n".join([*outcome.faults, outcome.message, f"replay: {replay}"]) + "\n",
                                encoding="utf-8")


def numbered(kinds, count, seed, first=0):
    """(kind, number) in turn, until each format has had its count, or for ever if count is None."""
    for number in itertools.count(first):
        if count is not None and number >= first + count:
            return
        for kind in kinds:
            if number % SLOWER.get(kind, 1) == 0:
                yield kind, number


class Campaign:
    """One run over several formats."""

    def __init__(self, options, context, say):
        self.options, self.context, self.say = options, context, say
        self.counts = {kind: Count() for kind in options.formats}
        self.failures = []
        self.lock = threading.Lock()

    def one(self, kind, number):
        name = f"{kind}:{self.options.seed}:{number}"
        case = make(kind, self.options.seed, number, self.context)
        outcome = run(case, self.options.program, self.options.scratch)
        with self.lock:
            self.counts[kind].add(name, outcome)
            if outcome.faults:
                self.failures.append((name, outcome))
                place = pathlib.Path(self.options.keep) / name.replace(":", "-")
                keep(place, case, outcome, f"--replay {name}")
                self.say(f"{name}: {'; '.join(outcome.faults)}: {outcome.message[:120]}; kept in {place}")

    def work(self):
        """Runs all mutants, so many at a time, until they are done, the time is up or the user interrupts."""
        begin = time.monotonic()
        end = begin + 60 * self.options.minutes if self.options.minutes else None
        mutants = numbered(self.options.formats, self.options.count, self.options.seed, self.options.first)
        with concurrent.futures.ThreadPoolExecutor(self.options.jobs) as pool:
            pending = set()
            try:
                for kind, number in mutants:
                    if end and time.monotonic() > end:
                        break
                    pending.add(pool.submit(self.one, kind, number))
                    if len(pending) >= 2 * self.options.jobs:
                        done, pending = concurrent.futures.wait(pending, return_when=concurrent.futures.FIRST_COMPLETED)
                        for future in done:
                            future.result()
            except KeyboardInterrupt:
                self.say("interrupted")
            for future in pending:
                future.result()
        return time.monotonic() - begin

    def vacuous(self):
        """Formats of which the run shows nothing: none ran, or all had the same fate."""
        faults = []
        for kind, count in self.counts.items():
            accepted = sum(n for code, n in count.codes.items() if code in (0, 1))
            if count.runs == 0:
                faults.append(f"{kind}: no mutant ran")
            elif count.runs >= LEAST and accepted == 0:
                faults.append(f"{kind}: all {count.runs} mutants were refused")
            elif count.runs >= LEAST and accepted == count.runs:
                faults.append(f"{kind}: all {count.runs} mutants were accepted")
        return faults

    def table(self):
        lines = [f"{'format':<10} {'runs':>7} {'failed':>6}  {'exit codes':<34} {'slowest':>9}  {'most MiB':>8}"]
        for kind, c in self.counts.items():
            codes = "  ".join(f"{code}: {n}" for code, n in sorted(c.codes.items()))
            lines.append(f"{kind:<10} {c.runs:>7} {c.failed:>6}  {codes:<34} {c.slowest[0]:>7.2f} s  "
                         f"{c.largest[0]:>8.0f}")
        total = sum(c.runs for c in self.counts.values())
        slowest = max((c.slowest for c in self.counts.values()), default=(0, ""))
        largest = max((c.largest for c in self.counts.values()), default=(0, ""))
        lines.append(f"{total} mutants, {len(self.failures)} failed; slowest {slowest[1]} {slowest[0]:.2f} s, "
                     f"largest {largest[1]} {largest[0]:.0f} MiB")
        return "\n".join(lines)
