"""Code shared by these tests: a display of their own, the program with and without the layer, and lines of results."""
import contextlib
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]


class Missing(Exception):
    """Something that a test needs is not installed."""


def require(packages, programs=(), files=()):
    """Raises Missing where a program or a file is not there; the packages are what to install then."""
    missing = [p for p in programs if not shutil.which(p)] + [f for f in files if not os.path.exists(f)]
    if missing:
        raise Missing(f"{', '.join(missing)} not found; install the packages {packages}")


@contextlib.contextmanager
def display(size="1280x1024", memory=None):
    """An X server without a screen. Gives the environment for its programs, which draw by llvmpipe.

    memory: a folder in which the file Xvfb_screen0 shows what is on the screen.
    """
    read, write = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", f"{size}x24", "-nolisten", "tcp",
                               *(["-fbdir", str(memory)] if memory else [])],
                              pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(write)
    with os.fdopen(read) as answer:
        number = answer.readline().strip()
    if not number:
        server.wait()
        raise RuntimeError("Xvfb does not start")
    try:
        yield {**os.environ, "DISPLAY": f":{number}", "LIBGL_ALWAYS_SOFTWARE": "1", "GALLIUM_DRIVER": "llvmpipe"}
    finally:
        server.terminate()
        server.wait()


class Kit:
    """The program under test, the folder for files, and the judgement so far."""

    def __init__(self, build, output):
        self.ninebit_path = pathlib.Path(build).resolve() / "bin/ninebit"
        self.output = pathlib.Path(output).resolve()
        self.failed = 0

    def folder(self, name):
        folder = self.output / name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        return folder

    def check(self, good, text):
        """Prints one line: the expectation, with the figures that were found."""
        print(f"{'ok    ' if good else 'FAILED'}  {text}", flush=True)
        self.failed += not good
        return good

    def ninebit(self, *arguments, text=None):
        """Runs ninebit and returns what it prints."""
        done = subprocess.run([self.ninebit_path, *map(str, arguments)], input=text, capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"ninebit {' '.join(map(str, arguments))}: {done.stderr.strip()}")
        return done.stdout

    def command(self, command, layer, profile=None, options=()):
        """The arguments that run a program, with the layer if asked for."""
        flags = [*(["--profile", profile] if profile else []), *options]
        return [str(word) for word in ([self.ninebit_path, "gl-run", *flags, "--"] if layer else []) + list(command)]

    def run(self, command, environment, layer=False, profile=None, options=(), timeout=60, cwd=None):
        """Runs a program to its end. Its output and messages are one text, `stdout`."""
        with tempfile.TemporaryFile() as output:  # not a pipe: Wine's services hold it open after the program's end
            done = subprocess.run(self.command(command, layer, profile, options), env=environment, cwd=cwd,
                                  stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT, timeout=timeout)
            output.seek(0)
            done.stdout = output.read().decode(errors="replace").replace("\r\n", "\n")
        return done

    def evaluate(self, program, columns, rows, profile="geforce2", more=()):
        """`ninebit eval` of a program for rows of register codes: lists of (red, green, blue, alpha)."""
        table = ",".join(columns) + "\n" + "".join(",".join(map(str, row)) + "\n" for row in rows)
        lines = self.ninebit("eval", program, "--profile", profile, *more, "--inputs", "-", text=table).splitlines()
        names = lines[0].split(",")
        order = [names.index(f"out.{c}") for c in "rgba"]
        return [[int(line.split(",")[i]) for i in order] for line in lines[1:]]


def build(source, program, *options, compiler="gcc"):
    """Compiles a source of this folder: options of the compiler and libraries. A complaint is a failure of the test."""
    flags = ["-std=gnu99", "-O2", "-Wall", "-Wextra", "-Wno-cast-function-type", "-Werror"] if source.endswith(".c") else ["-O1"]
    done = subprocess.run([compiler, *flags, str(HERE / source), "-o", str(program), *map(str, options)], capture_output=True, text=True)
    if done.returncode != 0:
        sys.stderr.write(done.stderr)
        raise RuntimeError(f"{compiler} failed")
    return program
