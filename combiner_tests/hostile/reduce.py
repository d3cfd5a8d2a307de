"""Makes a failing case smaller: flags, files, lines and bytes go as long as the fault stays the same."""
import time

import judge

SECONDS = 120  # for one case


class Reducer:
    def __init__(self, outcome, program, scratch):
        self.kind, self.program, self.scratch = outcome.kind(), program, scratch
        self.end = time.monotonic() + SECONDS

    def fails(self, case):
        """Whether the case still has the fault; past the time limit, nothing has."""
        return time.monotonic() < self.end and judge.run(case, self.program, self.scratch).kind() == self.kind

    def pieces(self, case, parts, rebuild):
        """Leaves out ever smaller runs of the parts. Returns the parts that are needed."""
        size = max(1, len(parts) // 2)
        while size and time.monotonic() < self.end:
            at = 0
            while at < len(parts):
                fewer = parts[:at] + parts[at + size:]
                if self.fails(rebuild(case, fewer)):
                    parts = fewer
                else:
                    at += size
            size //= 2
        return parts


def with_file(name, join):
    def rebuild(case, parts):
        return judge.Case(case.command, {**case.files, name: join(parts)}, case.expected)
    return rebuild


def without_flags(reducer, case):
    """Leaves out flags with their values; those that a verb needs stay as the fault goes without them."""
    k = 2
    while k < len(case.command):
        if case.command[k].startswith("-"):
            for length in (2, 1):
                command = case.command[:k] + case.command[k + length:]
                smaller = judge.Case(command, case.files, case.expected)
                if reducer.fails(smaller):
                    case, k = smaller, k - 1
                    break
        k += 1
    return case


def reduce(case, outcome, program, scratch=None):
    """The smaller case."""
    reducer = Reducer(outcome, program, scratch)
    case = without_flags(reducer, case)
    for name, content in list(case.files.items()):
        if not isinstance(content, bytes):
            continue
        smaller = judge.Case(case.command, {k: v for k, v in case.files.items() if k != name}, case.expected)
        if reducer.fails(smaller):
            case = smaller
            continue
        if name.endswith(".jsonl"):
            continue  # its lines have hashes
        for join in (b"\n", b" ", b""):
            rebuild = with_file(name, join.join if join else bytes)
            parts = content.split(join) if join else content
            if reducer.fails(rebuild(case, parts)):
                parts = reducer.pieces(case, parts, rebuild)
                case = rebuild(case, parts)
                content = case.files[name]
    return case
