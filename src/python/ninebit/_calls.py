"""Calls of the program's verbs: keyword arguments become flags, answers become values."""
import functools
import json
import keyword
import numbers
import os
import re
import tempfile
import warnings
from contextlib import ExitStack

import numpy as np

from . import _verbs
from ._combiner import Error, Program, State, nearest_name  # the bases of ninebit.Program and ninebit.State
from ._sources import source_of

_verbs.set_file(_verbs.__file__)

_ONLY_IN_THE_PROGRAM = {"help", "json", "quiet"}
STUDIES = ["index-steps", "datapath", "depth-packing", "shadows", "merge"]
QUESTIONS = ["equivalent", "stable", "discriminate", "kit"]
_PICTURES = {"tex0", "tex1", "tex2", "tex3", "cookie"}  # options that take pictures as arrays
_CANNOT_WRITE, _OUT_OF_MEMORY, _INTERRUPTED = 4, 5, 128


@functools.lru_cache(maxsize=None)
def _flags_of(verb):
    """The flags of a verb by the names of their keywords: (flag, takes a value, may be repeated, help)."""
    return {name.replace("-", "_") + ("_" if keyword.iskeyword(name) else ""): (f"--{name}", *about)
            for name, *about in _verbs.flags(list(verb)) if name not in _ONLY_IN_THE_PROGRAM}


def options(verb):
    """The keyword arguments of a function, such as "render" or "study shadows", with what each means."""
    if not isinstance(verb, str):
        raise TypeError(f"verb is {type(verb).__name__}; expected a name such as 'render' or 'study shadows'")
    words = tuple(verb.split())
    known = ["render", "draw", "compare", "trace", "explain", "convert", "vectors", *(f"study {s}" for s in STUDIES),
             *(f"prove {q}" for q in QUESTIONS)]
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
        text, path = source_of(name, program)
        if path is not None:
            return self.path(name, path)
        return self.file_of(text if isinstance(text, bytes) else text.encode(), ".txt", name)

    def picture(self, name, value):
        """A picture as the name of a file."""
        if isinstance(value, np.ndarray):
            fits = value.ndim == 2 or (value.ndim == 3 and value.shape[2] in (1, 3, 4))
            if value.dtype != np.uint8 or not fits or value.size == 0:
                real = "; numpy.rint(255 * x).astype(numpy.uint8) makes one of real numbers" if value.dtype.kind == "f" else ""
                raise TypeError(f"{name} is an array of {value.dtype} with the shape {value.shape}; expected a picture: uint8 with "
                                f"the shape (height, width), (height, width, 3) or (height, width, 4){real}")
            return self.file_of(_verbs.png(np.ascontiguousarray(value)), ".png", name)
        if isinstance(value, (list, tuple)) and value and all(isinstance(one, (str, os.PathLike, np.ndarray)) for one in value):
            return ",".join(self.picture(name, one) for one in value)
        if isinstance(value, (str, os.PathLike)):
            return self.plain(name, value)
        raise TypeError(f"{name} is {type(value).__name__}; expected a file, a picture as an array of uint8, or a list of six")

    def path(self, name, value, expected="a path"):
        if not isinstance(value, (str, os.PathLike)) or not isinstance(os.fspath(value), str):
            raise TypeError(f"{name} is {type(value).__name__}; expected {expected}")
        path = os.fspath(value)
        if not path or "\0" in path:
            raise Error(f"{name} is {path!r}; expected the name of a file")
        return path if not path.startswith("-") else f"./{path}"

    def text(self, name, value):
        """A value as a flag's text."""
        if name in _PICTURES:
            return self.picture(name, value)
        if name == "program":
            return self.program(name, value)
        if isinstance(value, np.ndarray) and value.ndim > 2:
            raise TypeError(f"{name} is an array of {value.dtype} with the shape {value.shape}; expected a text, a number, or a list of them")
        if isinstance(value, (np.ndarray, np.generic)):
            value = value.tolist()
        return self.plain(name, value)

    def plain(self, name, value):
        if isinstance(value, (str, os.PathLike)) and isinstance(os.fspath(value), str):
            text = os.fspath(value)
        elif isinstance(value, numbers.Real) and not isinstance(value, bool):
            text = repr(value)
        elif isinstance(value, (State, Program)):
            text = self.program(name, value)
        elif isinstance(value, (list, tuple, range)) and value:
            nested = any(isinstance(one, (list, tuple, range, np.ndarray)) for one in value)
            text = ("x" if name == "size" else ";" if nested else ",").join(self.text(name, one) for one in value)
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
        text = re.sub(r"--([a-z][a-z0-9-]*)", lambda flag: flag[1].replace("-", "_") + ("_" if keyword.iskeyword(flag[1]) else ""), text)
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


def page_of(verb, state, **options):
    """The page that a verb makes of a state."""
    return run_verb(verb, [("program", state, True)], options, None)[1].get("page")


def run_verb(verb, positional, options, progress):
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
