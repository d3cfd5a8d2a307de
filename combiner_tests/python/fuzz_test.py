"""Arguments of wrong types, shapes and names: each call returns or raises an exception of Python; none crashes."""
import os
import pathlib
import random
import tempfile
import unittest
import warnings

import ninebit
import numpy as np

top = pathlib.Path(__file__).resolve().parents[2]
SEED, ROUNDS = 20260101, int(os.environ.get("NINEBIT_FUZZ_ROUNDS", 1200))
ALLOWED = (TypeError, ValueError, OSError, OverflowError, MemoryError, RuntimeError, RecursionError, AttributeError)
source = random.Random(SEED)
gl = (top / "docs/programs/index_compare.gl").read_text()
state = ninebit.State.parse(gl)
program = ninebit.Program(state)
raw = [cls.__new__(cls) for cls in (ninebit.State, ninebit.Program)]


class Odd:
    """Conversions fail in ways of their own."""

    def __fspath__(self):
        return 7

    def __array__(self, *_):
        raise ZeroDivisionError

    def __str__(self):
        raise KeyError

    __repr__ = object.__repr__


def value(depth=0):
    made = source.choice([
        lambda: source.randint(-400, 400), lambda: 2 ** source.randint(8, 200), lambda: source.uniform(-2, 300),
        lambda: float("nan"), lambda: None, lambda: source.choice([True, False]), lambda: "", lambda: "\0x", lambda: "é" * 9,
        lambda: "\ud800", lambda: gl[:source.randint(0, len(gl))], lambda: b"bytes", lambda: state, lambda: program,
        lambda: source.choice(raw), lambda: Odd(), lambda: object, lambda: {}, lambda: set(), lambda: range(source.randint(0, 5)),
        lambda: {name(): value(depth + 1)}, lambda: [value(depth + 1) for _ in range(source.randint(0, 4))] if depth < 3 else 1,
        lambda: tuple(source.randint(-3, 300) for _ in range(source.randint(0, 5))), array, array, array,
        lambda: pathlib.Path("none.obj"), lambda: np.int64(source.randint(-300, 300)), lambda: np.float32(0.5), lambda: "64x48",
        lambda: (16, 12), lambda: "index-cube", lambda: "nv2a", lambda: 2])
    return made()


def array():
    shape = source.choice([(), (0,), (1,), (3,), (4,), (4, 4), (2, 3, 4), (4, 7), (7, 3), (5, 0, 4), (1, 1, 1, 4), (600,)])
    kind = source.choice(["u1", "i1", "i2", "<u2", ">i2", "i4", "u8", "f4", "f8", "?", "c8", "O", "U2", "M8[s]", "V3", [("a", "i2")]])
    made = np.zeros(shape, kind)
    if made.dtype.kind in "iu":
        made[...] = source.choice([0, 1, 100, 127])
    return source.choice([lambda: made, lambda: made[::-1] if made.ndim else made, lambda: made.T, lambda: np.ma.array(made)])()


def name():
    return source.choice(["tex0", "tex0.r", "tex3.a", "primary", "fog", "const0", "const1.b", "spare0", "zero", "discard", "tex0.x",
                          "tex0.", ".r", "", "\0", "out", 7, None, "size", "map_size", "technique", "vary", "camera", "profile",
                          "threads", "index_step", "turntable", "only", "tex0.rr", "é"])


def keywords(*known):
    names = [source.choice([*known, str(name())]) for _ in range(source.randint(0, 3))]
    return {one: value() for one in names}


def calls():
    """One random call each."""
    scene = source.choice([top / "scenes/index_room.gltf", value()])
    return source.choice([
        lambda: program.evaluate(source.choice([{name(): value() for _ in range(source.randint(0, 3))}, value()]),
                                 **keywords("out", "axis", "registers", "tex0", "primary")),
        lambda: program.evaluate({"tex0": array()}, **keywords("out", "axis", "registers")),
        lambda: program.trace(source.choice([{name(): value()}, value()]), **keywords("tex0")),
        lambda: program._evaluate({name(): value()}, source.choice([0, 3, 600, -1, 2**63]), array(), array()),
        lambda: program._evaluate({"tex0.r": array()}, 4, np.zeros((4, 4), np.int16), source.choice([None, array()])),
        lambda: program._trace({name(): value()}, {name(): value()}),
        lambda: program._run_stages({name(): value()}, source.choice([0, 3, 600, -1, 2**63])),
        lambda: ninebit.State.parse(value(), **keywords("form", "profile", "chip", "function", "define", "setup")),
        lambda: ninebit.State(value()), lambda: ninebit.Program(value(), value(), value()),
        lambda: state.print(value(), value()), lambda: state == value(), lambda: repr(source.choice(raw)),
        lambda: program.glsl(value(), value()),
        lambda: ninebit.render(scene, **{"size": (16, 12), "map_size": 16, **keywords("size", "camera", "technique", "index_step")}),
        lambda: ninebit.draw(source.choice([state, value()]), **{"size": (16, 16), **keywords("tex0", "size", "mesh", "const0", "primary")}),
        lambda: ninebit.compare(scene, **{"size": (16, 12), **keywords("vary", "technique")}),
        lambda: ninebit.trace(source.choice([state, value()]), **keywords("set", "pixel", "scene", "effect")),
        lambda: ninebit.explain(value(), **keywords("from_", "define")), lambda: ninebit.convert(value(), value()),
        lambda: ninebit.convert(state, value(), **keywords("chip")),
        lambda: ninebit.prove(value(), value(), value()),
        lambda: ninebit.study(source.choice(["index-steps", value()]), **{"formats": "channel", "profile": "geforce2", **keywords("steps", "variants")}),
        lambda: ninebit.vectors(**{"programs": source.choice([150, value()]), "fragments": 1, **keywords("seed", "profile")}),
        lambda: ninebit.options(value())])


class Fuzz(unittest.TestCase):
    def test_no_argument_crashes(self):
        returned = raised = 0
        os.chdir(self.enterContext(tempfile.TemporaryDirectory()))
        self.addCleanup(os.chdir, top)
        for number in range(ROUNDS):
            call = calls()
            warnings.simplefilter("ignore")  # of textures that are not given
            try:
                call()
                returned += 1
            except ALLOWED:
                raised += 1
            except ZeroDivisionError:  # of Odd
                raised += 1
            except KeyError as wrong:
                self.assertEqual(wrong.args, (), f"round {number}")  # of Odd
        self.assertGreater(returned, ROUNDS // 20, "calls that are right")
        self.assertGreater(raised, ROUNDS // 4, "calls that are wrong")


if __name__ == "__main__":
    unittest.main()
