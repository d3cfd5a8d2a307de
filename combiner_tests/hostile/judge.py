"""Runs one command in a folder of its own and judges what it did: the rules that every hostile file is held to."""
import collections
import dataclasses
import json
import os
import pathlib
import select
import shutil
import signal
import stat
import subprocess
import tempfile
import time

SECONDS = 10.0  # a run may take
MIB = 2048.0  # its processes may hold together
SAMPLE_MS = 25  # between two looks at the memory
MESSAGE_LINES = 8  # on stderr, where a file is refused
FAULT_LINES = 310  # where a program or a profile is: at most 100 faults, each with its line and a mark below it
LINE_LENGTH = 4096
OWN_WORDS = "ninebit: "  # an error begins with them, a note with the name of a file

PIPE = object()  # in place of a file's bytes: a FIFO that nobody writes to


@dataclasses.dataclass
class Case:
    """A command without the program's name, and the files it reads, by name: bytes or a function that gives them, PIPE,
    or a path to link to."""
    command: list
    files: dict
    expected: dict = dataclasses.field(default_factory=dict)  # of a kept case: "exit", "says", "not"


@dataclasses.dataclass
class Outcome:
    """What a run did. `faults` is empty if the run was as it should be."""
    code: int
    seconds: float
    mib: float
    message: str
    faults: list

    def kind(self):
        """The fault without its figures, so that a reduced case can be compared with the original one."""
        return self.faults[0].split(":")[0] if self.faults else ""


def descendants(pid):
    """The process and all that it started, as far as they still run."""
    found, queue = [], collections.deque([pid])
    while queue:
        process = queue.popleft()
        found.append(process)
        try:
            for task in os.listdir(f"/proc/{process}/task"):
                with open(f"/proc/{process}/task/{task}/children", encoding="ascii") as children:
                    queue.extend(int(child) for child in children.read().split())
        except OSError:
            pass  # it has ended meanwhile
    return found


def resident_mib(pid):
    """The resident memory of the process and its descendants; shared pages count for each of them."""
    pages = 0
    for process in descendants(pid):
        try:
            with open(f"/proc/{process}/statm", encoding="ascii") as statm:
                pages += int(statm.read().split()[1])
        except (OSError, IndexError):
            pass
    return pages * os.sysconf("SC_PAGE_SIZE") / 2**20


def group_lives(pid):
    try:
        os.killpg(pid, 0)
    except (ProcessLookupError, PermissionError):
        return False
    return True


def end_group(pid):
    try:
        os.killpg(pid, signal.SIGKILL)
    except ProcessLookupError:
        pass


def watch(process, limit):
    """Waits for the process, kills it past a limit. Returns wait status, largest MiB, seconds, why it was killed."""
    begin, largest, why = time.monotonic(), 0.0, ""
    poll = select.poll()
    handle = os.pidfd_open(process.pid)
    poll.register(handle, select.POLLIN)
    while not poll.poll(SAMPLE_MS):
        largest = max(largest, resident_mib(process.pid))
        if largest > MIB:
            why = f"memory: more than {MIB:.0f} MiB"
        elif time.monotonic() - begin > limit:
            why = f"hang: more than {limit:.0f} s"
        if why:
            for child in descendants(process.pid):  # also those that have left the group
                try:
                    os.kill(child, signal.SIGKILL)
                except ProcessLookupError:
                    pass
            break
    _, status, usage = os.wait4(process.pid, 0)
    os.close(handle)
    process.returncode = os.waitstatus_to_exitcode(status)
    largest = max(largest, usage.ru_maxrss / 1024)
    if not why and largest > MIB:
        why = f"memory: {largest:.0f} MiB"
    return largest, time.monotonic() - begin, why


def write_files(case, folder):
    for name, content in case.files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if callable(content):
            content = case.files[name] = content()
        if content is PIPE:
            os.mkfifo(path)
        elif isinstance(content, pathlib.Path):
            path.symlink_to(content)
        else:
            path.write_bytes(content)


def run(case, program, scratch=None, limit=SECONDS):
    """Runs the case with the program in a scratch folder and returns its Outcome."""
    top = pathlib.Path(tempfile.mkdtemp(prefix="hostile-", dir=scratch))
    try:
        folder = top / "case"
        folder.mkdir()
        write_files(case, folder)
        with open(top / "stdout", "wb") as out, open(top / "stderr", "wb") as err:
            process = subprocess.Popen([str(program), *case.command], cwd=folder, stdin=subprocess.DEVNULL, stdout=out,
                                       stderr=err, start_new_session=True)
            mib, seconds, why = watch(process, limit)
        faults = [why] if why else []
        if not why:
            faults += left_process(process.pid)
            end_group(process.pid)
        code = process.returncode
        error = (top / "stderr").read_bytes()[:1 << 20]
        if not why:
            faults += judge_code(code) + judge_order(case, code) + judge_message(case, code, error)
            faults += judge_files(case, code, folder)
            if (top / "stdout").stat().st_size < 1 << 24:
                faults += judge_answer(case, code, (top / "stdout").read_bytes())
            faults += judge_expected(case, code, error.decode("utf-8", "replace"))
        message = error.decode("utf-8", "replace").strip().split("\n")[0]
        return Outcome(code, seconds, mib, printable(message), faults)
    finally:
        shutil.rmtree(top, ignore_errors=True)


def left_process(pid):
    """A helper may end a moment later than the program; it may not stay."""
    for _ in range(40):
        if not group_lives(pid):
            return []
        time.sleep(0.025)
    return ["process: one was left running"]


def printable(text):
    return "".join(c if c.isprintable() else f"\\x{ord(c):02x}" for c in text)


def judge_code(code):
    if code < 0:
        return [f"signal {-code}"]
    if code > 5:
        return [f"exit {code}: expected 0 to 5"]
    if code == 5:
        return ["exit 5: out of memory, far below the memory there is"]
    return []


def judge_order(case, code):
    """No scene gets an order of indices with false neighbours."""
    return ["exit 1: --check-order found false neighbours"] if code == 1 and "--check-order" in case.command else []


def reads_texts(command):
    """Whether the command reads a program or a profile, of which many faults are told at once."""
    return command[0] not in ("render", "study") or "--profile" in command or "--program" in command


def judge_message(case, code, error):
    """A few lines, without anything that a terminal would obey."""
    faults = []
    try:
        text = error.decode("utf-8")
    except UnicodeDecodeError:
        return ["stderr is not UTF-8"]
    control = sorted({ord(c) for c in text if (ord(c) < 32 and c != "\n") or 127 <= ord(c) < 160})
    if control:
        faults.append("control characters on stderr: " + ", ".join(f"0x{c:02x}" for c in control))
    lines = text.count("\n")
    if code > 1:
        if not text.strip():
            faults.append("stderr is empty: expected why the exit code is not 0")
        elif not text.startswith((OWN_WORDS, *case.files)):
            faults.append("stderr begins with the words of something else")
        many = FAULT_LINES if reads_texts(case.command) else MESSAGE_LINES
        if lines > many:
            faults.append(f"lines on stderr: {lines}, expected at most {many}")
    if max(map(len, text.split("\n"))) > LINE_LENGTH:
        faults.append(f"a line on stderr has more than {LINE_LENGTH} characters")
    return faults


def judge_answer(case, code, answer):
    if code != 0 or "--json" not in case.command:
        return []
    try:
        json.loads(answer, parse_constant=lambda name: (_ for _ in ()).throw(ValueError(name)))
    except ValueError as error:
        return [f"stdout is not JSON: {error}"]
    return []


def complete(path):
    """Whether an output file is whole, as far as its end shows."""
    data = path.read_bytes()
    kind = path.suffix
    if kind == ".png":
        return data.startswith(b"\x89PNG") and data.endswith(b"IEND\xaeB`\x82")
    if kind == ".exr":
        return data.startswith(b"\x76\x2f\x31\x01")
    if kind == ".json":
        try:
            json.loads(data)
        except ValueError:
            return False
        return True
    if kind in (".csv", ".jsonl", ".html", ".txt"):
        return data.endswith(b"\n")
    return bool(data)


def judge_files(case, code, folder):
    """Inputs stay as they are; outputs are there only if they are complete and the run was done."""
    faults = []
    parts_may_stay = case.command[0] == "study"
    for root, _, names in os.walk(folder):
        for name in names:
            path = pathlib.Path(root) / name
            place = str(path.relative_to(folder))
            if place in case.files:
                content = case.files[place]
                if isinstance(content, bytes) and (path.is_symlink() or path.read_bytes() != content):
                    faults.append(f"input changed: {printable(place)}")
            elif name.startswith("."):
                faults.append(f"file left behind: {printable(place)}")
            elif not stat.S_ISREG(path.lstat().st_mode):
                faults.append(f"not a regular file: {printable(place)}")
            elif code > 1 and not (parts_may_stay and name.endswith(".jsonl")):
                faults.append(f"output in spite of exit {code}: {printable(place)}")
            elif not complete(path):
                faults.append(f"output is not complete: {printable(place)}")
    return faults


def judge_expected(case, code, text):
    """What a kept case says of itself besides."""
    faults = []
    if "exit" in case.expected and code not in case.expected["exit"]:
        wanted = " or ".join(map(str, case.expected["exit"]))
        faults.append(f"exit {code}: expected {wanted}")
    for words in case.expected.get("says", []):
        if words not in text:
            faults.append(f"stderr does not say '{words}'")
    for words in case.expected.get("not", []):
        if words in text:
            faults.append(f"stderr says '{words}'")
    return faults
