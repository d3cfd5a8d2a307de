"""The verbs of the program as functions: keyword arguments become its flags, its answers become values."""
import functools
import json
import numbers
import os
import re
import tempfile
import warnings
from contextlib import ExitStack

import numpy as np

from . import _verbs
from ._combiner import Error, nearest_name
from ._programs import Program, State, Trace
from ._results import Comparison, Drawing, Explanation, Proof, Rendering, Report, Vectors

_verbs.set_file(_verbs.__file__)

_ONLY_IN_THE_PROGRAM = {"help", "json", "quiet"}
_CANNOT_WRITE, _OUT_OF_MEMORY, _INTERRUPTED = 4, 5, 128


@functools.lru_cache(maxsize=None)
def _flags_of(verb):
    """The flags of a verb by the names of their keywords: (flag, takes a value, may be repeated, help)."""
    return {name.replace("-", "_") + ("_" if name == "from" else ""): (f"--{name}", *about)
            for name, *about in _verbs.flags(list(verb)) if name not in _ONLY_IN_THE_PROGRAM}


def options(verb):
    """The keyword arguments of a function, such as "render" or "study shadows", with what each means."""
    if not isinstance(verb, str):
        raise TypeError(f"verb is {type(verb).__name__}; expected a name such as 'render' or 'study shadows'")
    words = tuple(verb.split())
    known = ["render", "draw", "compare", "trace", "explain", "convert", "vectors", *(f"study {s}" for s in _STUDIES),
             *(f"prove {q}" for q in _QUESTIONS)]
    if " ".join(words) not in known:
        raise Error(f"unknown function '{verb}'; expected one of {', '.join(known)}{nearest_name(verb, known)}")
    return {name: about[-1].replace("--", "") for name, about in _flags_of(words).items()}


class _Call:
    """One run of a verb: its words, and the files that stand for values of this process."""

    def __init__(self, verb):
        self.verb, self.words, self.stack, self.names = verb, list(verb), ExitStack(), {}

    def file_of(self, content, ending, name):
        """A file that holds a value until the call ends; messages show its name."""
        file = self.stack.enter_context(tempfile.NamedTemporaryFile("wb", prefix="ninebit-", suffix=ending))
        file.write(content)
        file.flush()
        self.names[file.name] = name
        return file.name

    def program(self, name, program):
        """A program as the name of a file."""
        if isinstance(program, Program):
            program = program.state
        if isinstance(program, State):
            return self.file_of(program.print("json").encode(), ".json", "State")
        if isinstance(program, str) and "\n" in program:
            raise Error(f"{name} is a text of several lines; expected a path, a Program or a State, such as State.parse(text)")
        return self.path(name, program, "a path, a State or a Program")

    def path(self, name, value, expected="a path"):
        if not isinstance(value, (str, os.PathLike)) or not isinstance(os.fspath(value), str):
            raise TypeError(f"{name} is {type(value).__name__}; expected {expected}")
        path = os.fspath(value)
        if not path or "\0" in path:
            raise Error(f"{name} is {path!r}; expected the name of a file")
        return path if not path.startswith("-") else f"./{path}"

    def text(self, name, value):
        """A value as a flag's text."""
        if isinstance(value, np.ndarray) and value.dtype == np.uint8 and value.ndim in (2, 3):
            return self.file_of(_verbs.png(np.ascontiguousarray(value)), ".png", name)
        if isinstance(value, (np.ndarray, np.generic)):
            value = value.tolist()
        if isinstance(value, (str, os.PathLike)) and isinstance(os.fspath(value), str):
            text = os.fspath(value)
        elif isinstance(value, numbers.Real) and not isinstance(value, bool):
            text = repr(value)
        elif isinstance(value, (State, Program)):
            text = self.program(name, value)
        elif isinstance(value, (list, tuple, range)) and value:
            text = ("x" if name == "size" else ",").join(self.text(name, one) for one in value)
        else:
            raise TypeError(f"{name} is {value!r:.60}; expected a text, a number, or a list of them")
        if "\0" in text:
            raise Error(f"{name} has a null character; expected text without one")
        return text

    def texts(self, name, value):
        """The texts of a flag that may be repeated."""
        if isinstance(value, dict):
            return [self.pair(name, key, one) for key, one in value.items()]
        if isinstance(value, (list, tuple)) and value and not all(isinstance(one, numbers.Real) for one in value):
            return [self.text(name, one) for one in value]
        return [self.text(name, value)]

    def pair(self, name, key, value):
        """One entry of a dictionary: NAME=VALUE, of a constant COMBINER:R,G,B,A."""
        if name in ("const0", "const1"):
            return f"{self.text(name, key)}:{self.text(name, value)}"
        if name != "vary":
            return f"{self.text(name, key)}={self.text(name, value)}"
        values = list(value) if isinstance(value, (list, tuple, range, np.ndarray)) else [value]
        commas = any(isinstance(one, (list, tuple, np.ndarray)) for one in values)
        return f"{self.text(name, key).replace('_', '-')}={(';' if commas else ',').join(self.text(name, one) for one in values)}"

    def add(self, options):
        """The keyword arguments as flags."""
        known = _flags_of(self.verb)
        for name, value in options.items():
            if name not in known:
                raise TypeError(f"{' '.join(self.verb)}() has no option '{name}'{nearest_name(name, list(known))}; "
                                f"ninebit.options({' '.join(self.verb)!r}) lists them")
            flag, takes_value, repeated, _ = known[name]
            if value is None or value is False:
                continue
            if not takes_value:
                if value is not True:
                    raise TypeError(f"{name} is {value!r:.60}; expected True or False")
                self.words.append(flag)
            elif value is True:
                raise TypeError(f"{name} is True; expected a value")
            else:
                texts = self.texts(name, value) if repeated else [self.text(name, value)]
                self.words += [f"{flag}={text}" for text in texts]

    def shown(self, text):
        """A message of the program in the words of Python."""
        text = re.sub(r" \(see: ninebit [^)]*--help\)", "", text)
        text = re.sub(r"--([a-z][a-z0-9-]*)", lambda flag: "from_" if flag[1] == "from" else flag[1].replace("-", "_"), text)
        for file, name in self.names.items():
            text = text.replace(file, name)
        return text

    def run(self, progress):
        """Runs the verb; returns its answer, texts and arrays."""
        if progress is not None and not callable(progress):
            raise TypeError(f"progress is {type(progress).__name__}; expected a function of the share done and a word")
        found = _verbs.run([*self.words, "--json"], progress)
        code, faults = found["exit_code"], found["faults"]
        if code == _OUT_OF_MEMORY:
            raise MemoryError(self.shown("\n".join(message for message, *_ in faults)) or "out of memory")
        if code >= _INTERRUPTED:
            raise KeyboardInterrupt
        if code > 1 or faults:
            lines = [f"{':'.join(str(place) for place in (file, line, column) if place)}: {message}" if file else message
                     for message, file, line, column in faults]
            error = OSError if code == _CANNOT_WRITE else Error
            raise error(self.shown("\n".join(lines)) or f"{' '.join(self.verb)} failed")
        for line in found["said"].splitlines():
            kind = re.match(r"ninebit: (?:warning|note): (.*)", line)
            if kind:
                warnings.warn(self.shown(kind[1]), stacklevel=4)
        answer = found["answer"]
        for file, name in self.names.items():
            answer = answer.replace(json.dumps(file)[1:-1], name)
            found["texts"] = {key: text.replace(file, name) for key, text in found["texts"].items()}
        return json.loads(answer) if answer else {}, found["texts"], found["arrays"]


def _run(verb, positional, options, progress):
    """Runs a verb; `positional` has names, values, and whether they are programs."""
    call = _Call(verb)
    with call.stack:
        state = None
        for name, value, is_program in positional:
            state = state or (value.state if isinstance(value, Program) else value if isinstance(value, State) else None)
            call.words.append(call.program(name, value) if is_program else call.path(name, value))
        if state is not None:
            if options.get("from_") or options.get("function") or options.get("define"):
                raise TypeError("from_, function and define are for files; a State is parsed already")
            if options.get("profile") is None and "profile" in _flags_of(verb):
                options = {**options, "profile": state._profile}
        call.add(options)
        return call.run(progress)


def render(scene, *, progress=None, **options):
    """Renders a scene with shadows, as `ninebit render`; returns a Rendering. options("render") lists the options.

    Without `output`, nothing is written. `progress` is called with the share that is done, 0 to 1, and a word.
    """
    return Rendering._of(*_run(("render",), [("scene", scene, False)], options, progress))


def draw(program, *, progress=None, **options):
    """Draws a program on textures and a mesh, or an effect file, as `ninebit draw`; returns a Drawing.

    Textures are files, built-in names, or pictures as arrays of uint8. options("draw") lists the options.
    """
    return Drawing._of(*_run(("draw",), [("program", program, True)], options, progress))


def compare(scene, *, progress=None, **options):
    """Renders a scene by several techniques, or with several settings, as `ninebit compare`; returns a Comparison.

    `vary` has lists of values by option: vary={"index_step": [1, 2, 3]}. options("compare") lists the options.
    """
    return Comparison._of(*_run(("compare",), [("scene", scene, False)], options, progress))


_STUDIES = ["index-steps", "datapath", "depth-packing", "shadows", "merge"]
_QUESTIONS = ["equivalent", "stable", "discriminate", "kit"]


def _chosen(what, name, names):
    if not isinstance(name, str):
        raise TypeError(f"{what} is {type(name).__name__}; expected one of {', '.join(names)}")
    if name.replace("_", "-") not in names:
        raise Error(f"unknown {what} '{name}'; expected one of {', '.join(names)}{nearest_name(name, names)}")
    return name.replace("_", "-")


def study(name, *arguments, progress=None, **options):
    """Runs a study, as `ninebit study NAME`: "index-steps", "datapath", "depth-packing", "shadows" with a scene, or
    "merge" with parts; returns a Report. options("study index-steps") lists the options."""
    name = _chosen("study", name, _STUDIES)
    expected = {"shadows": 1, "merge": len(arguments)}.get(name, 0)
    if len(arguments) != expected or (name == "merge" and not arguments):
        needed = {"shadows": "a scene", "merge": "at least one part"}.get(name, "no argument besides the options")
        raise TypeError(f"study {name} was given {len(arguments)} arguments; expected {needed}")
    return Report._of(*_run(("study", name), [("scene" if name == "shadows" else "part", value, False) for value in arguments],
                        options, progress))


def prove(question, *arguments, progress=None, **options):
    """Answers a question for all inputs, as `ninebit prove QUESTION`; returns a Proof, which is true if it is proved.

    "equivalent" takes two programs, "stable" one, "discriminate" two profiles or the option field, "kit" none.
    """
    question = _chosen("question", question, _QUESTIONS)
    expected = {"equivalent": [2], "stable": [1], "discriminate": [0, 2], "kit": [0]}[question]
    if len(arguments) not in expected:
        raise TypeError(f"prove {question} was given {len(arguments)} arguments; expected "
                        f"{' or '.join(str(count) for count in expected)}")
    programs = question in ("equivalent", "stable")
    if question == "equivalent" and options.get("other_profile") is None:
        first, other = (one.state if isinstance(one, Program) else one for one in arguments)
        if isinstance(other, State) and isinstance(first, State) and other._profile != first._profile:
            options = {**options, "other_profile": other._profile}
    return Proof._of(*_run(("prove", question), [("program" if programs else "profile", value, programs) for value in arguments],
                       options, progress))


def trace(program=None, *, progress=None, **options):
    """Traces one fragment, as `ninebit trace`: of registers that are given by `set`, or of the `pixel` of a `scene` or of
    an `effect`; returns a Trace. options("trace") lists the options. Program.trace() does the first without files."""
    positional = [] if program is None else [("program", program, True)]
    answer, texts, _ = _run(("trace",), positional, options, progress)
    found = Trace(answer)
    found._page = texts.get("page")
    return found


def explain(program, **options):
    """What a program computes, as `ninebit explain`; returns an Explanation. options("explain") lists the options."""
    return Explanation._of(*_run(("explain",), [("program", program, True)], options, None))


def convert(program, to=None, **options):
    """A program as a text of another form, as `ninebit convert --to`: "gl", "rc10", "ps11", "words", "words-json",
    "json", "xbox", "glsl", "glsl-es" or "c". Without `to`, the list of set-ups of a log, as a dictionary."""
    answer, _, _ = _run(("convert",), [("program", program, True)], {**options, "to": to}, None)
    return answer if to is None else answer["rows"][0].get("text", answer)


def vectors(*, progress=None, **options):
    """A pack of programs, inputs and expected outputs for emulators, as `ninebit vectors`; returns Vectors.

    Without `output`, nothing is written. options("vectors") lists the options."""
    return Vectors._of(*_run(("vectors",), [], options, progress))
