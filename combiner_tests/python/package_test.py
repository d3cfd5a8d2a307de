"""The package itself: what it loads, its stub, its documentation."""
import ast
import contextlib
import inspect
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import typing
import unittest

import ninebit
import numpy as np

top = pathlib.Path(__file__).resolve().parents[2]
PAGES = [top / f"docs/{name}.md" for name in ("library", "python", "draw", "evaluate")]
package = pathlib.Path(ninebit.__file__).parent
VERBS = {"render": ["render"], "draw": ["draw"], "compare": ["compare"], "trace": ["trace"], "explain": ["explain"],
         "convert": ["convert"], "vectors": ["vectors"],
         "study": [f"study {s}" for s in ("index-steps", "datapath", "depth-packing", "shadows", "merge")],
         "prove": [f"prove {q}" for q in ("equivalent", "stable", "discriminate", "discriminate", "kit")]}


def blocks_of(page):
    """The Python blocks of a page."""
    return re.findall(r"^```python\n(.*?)^```", page.read_text(), re.DOTALL | re.MULTILINE)


class Loading(unittest.TestCase):
    def test_programs_load_the_combiners_alone(self):
        script = ("import ninebit, sys; ninebit.Program('!!RC1.0\\nout.rgb = tex0;').evaluate(tex0=1)\n"
                  "print([name for name in sys.modules if name.startswith('ninebit.')])\n"
                  "print([line.split('/')[-1].strip() for line in open('/proc/self/maps') if 'assimp' in line or 'embree' in line])")
        said = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout.splitlines()
        self.assertEqual(sorted(ast.literal_eval(said[0])), ["ninebit._arrays", "ninebit._combiner", "ninebit._programs", "ninebit._sources"])
        self.assertEqual(said[1], "[]")

    def test_everything_has_a_description(self):
        for name in set(ninebit.__all__) - {"__version__"}:
            thing = getattr(ninebit, name)
            self.assertTrue(thing.__doc__, name)
            if inspect.isclass(thing):
                for method in {one for one in vars(thing) if not one.startswith("_")}:
                    self.assertTrue(getattr(thing, method).__doc__, f"{name}.{method}")
        self.assertEqual(dir(ninebit), sorted(ninebit.__all__))


class Stubs(unittest.TestCase):
    def test_they_have_every_name(self):
        stub = ast.parse((package / "__init__.pyi").read_text())
        told = {node.name: node for node in stub.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
        told.update({alias.asname: node for node in stub.body if isinstance(node, ast.ImportFrom) for alias in node.names if alias.asname})
        self.assertEqual(set(ninebit.__all__) - {"__version__"} - set(told), set())
        for cls in (ninebit.State, ninebit.Program):
            methods = {node.name for node in told[cls.__name__].body if isinstance(node, ast.FunctionDef)}
            public = {name for name in dir(cls) if not name.startswith("_")}
            self.assertEqual(public, {name for name in methods if not name.startswith("_")}, cls)

    def test_their_options_are_those_of_the_program(self):
        stub = [node for file in ("_pictures.pyi", "_questions.pyi") for node in ast.parse((package / file).read_text()).body]
        for name, verbs in VERBS.items():
            functions = [node for node in stub if isinstance(node, ast.FunctionDef) and node.name == name]
            if name == "convert":
                verbs = verbs * 3
            self.assertEqual(len(functions), len(verbs), name)
            for function, verb in zip(functions, verbs):
                told = {argument.arg for argument in function.args.kwonlyargs} - {"progress"}
                known = set(ninebit.options(verb)) - ({"to"} if name == "convert" else set())
                if name == "convert" and "output" not in told:
                    known -= {"output"}
                self.assertEqual(told, known, verb)

    @unittest.skipUnless(shutil.which("mypy"), "mypy is not installed")
    def test_mypy_finds_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            files = []
            for page in PAGES:
                for number, block in enumerate(blocks_of(page)):
                    files.append(pathlib.Path(folder) / f"{page.stem}_{number}.py")
                    files[-1].write_text(block)
            self.assertGreater(len(files), 3)
            files.append(pathlib.Path(folder) / "all_that_runs.py")
            files[-1].write_text(ALL_THAT_RUNS)
            environment = {**os.environ, "MYPYPATH": str(package.parent), "PYTHONPATH": str(package.parent)}
            stubs = [package / "__init__.pyi", *[package / f"{name}.pyi" for name in ("_calls", "_pictures", "_questions")]]
            for together in (stubs, files):
                checked = subprocess.run(["mypy", "--strict", "--cache-dir", f"{folder}/cache", *map(str, together)],
                                         capture_output=True, text=True, env=environment, cwd=folder)
                self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)
            wrong = pathlib.Path(folder) / "wrong.py"
            wrong.write_text("import ninebit\nninebit.render('x.obj', index_stepp=2)\nninebit.State.parse(7)\n")
            refused = subprocess.run(["mypy", "--strict", "--cache-dir", f"{folder}/cache", str(wrong)], capture_output=True, text=True,
                                     env=environment, cwd=folder)
            self.assertEqual(refused.stdout.count("error:"), 2, refused.stdout)

    @unittest.skipUnless(shutil.which("stubtest"), "stubtest is not installed")
    def test_stubtest_finds_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            allowed = pathlib.Path(folder) / "allowed"
            allowed.write_text("\n".join(ALLOWED_BY_STUBTEST))
            settings = pathlib.Path(folder) / "mypy.ini"
            settings.write_text("[mypy]\nignore_missing_imports = True\n")  # the extension modules have no stubs
            environment = {**os.environ, "MYPYPATH": str(package.parent), "PYTHONPATH": str(package.parent)}
            checked = subprocess.run(["stubtest", "ninebit", "--ignore-missing-stub", "--mypy-config-file", str(settings), "--allowlist", str(allowed), "--ignore-unused-allowlist"],
                                     capture_output=True, text=True, env=environment, cwd=folder)
            self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)


# Calls that run; Stubs asks mypy whether the stubs take them, AllThatRuns runs them.
ALL_THAT_RUNS = """
import pathlib

import ninebit
import numpy as np

invert = "!!RC1.0\\nout.rgb = unsigned_invert(tex0);\\nout.a = tex0.a;"
program = ninebit.Program(invert)
ninebit.Program(program)
ninebit.Program(invert.encode())
picture = np.zeros((4, 8, 3), np.uint8)
ninebit.draw(invert, tex0=picture, const0=np.ones(4), camera=np.array([0, 0, 3]), size=[8, 4])
ninebit.draw(program, tex0=[picture[:, :4]] * 6, coord0="normal", size=np.array([8, 4]), alpha_test=["greater", 127])
ninebit.draw(invert.encode(), tex0=picture, fov=50, size="8x4")
ninebit.trace(invert, set="tex0=1,2,3,4")
ninebit.trace(invert, set={"tex0": np.array([1, 2, 3, 4])})
ninebit.trace(invert, set=["tex0=1,2,3,4"])
ninebit.convert(invert, "gl", profile="geforce2")
ninebit.prove("equivalent", invert, program.state)
ninebit.study("index-steps", profile=["geforce2", "nv2a"], steps=range(1, 3), formats="channel")
ninebit.study("index-steps", profile="geforce2", steps=1, formats=["channel"])
ninebit.study("datapath", profile="geforce2", program=invert, over=["tex0.r"], set={"tex0.a": 1})
"""

# Types that only the stub has; pybind11's metaclass; overloads whose positional argument mypy 1.0 takes for a keyword.
ALLOWED_BY_STUBTEST = [r"ninebit\.(ReadForm|Form|Chip|Codes|Coordinates|Inputs|IntArray|Diagnostic|_Picture)",
                       r"ninebit\._(calls|pictures|questions)\.(Path|AnyProgram|Picture|AnyPicture|Pair|Point|Color|Values|List|Progress"
                       r"|Technique|LightType|Faces)",
                       r"ninebit(\._programs)?\.(Program|State)", r"ninebit\.Program\.evaluate(_real)?"]


class AllThatRuns(unittest.TestCase):
    def test_it_runs(self):
        with contextlib.chdir(top) if hasattr(contextlib, "chdir") else contextlib.nullcontext():
            exec(ALL_THAT_RUNS, {})  # pylint: disable=exec-used


class Documentation(unittest.TestCase):
    def test_its_examples_run(self):
        """Each block of the Python page runs; a comment behind a line is what its value is."""
        count = 0
        with tempfile.TemporaryDirectory() as folder:
            for name in ("scenes", "docs"):
                os.symlink(top / name, f"{folder}/{name}")
            for page in PAGES:
                for block in blocks_of(page):
                    with contextlib.chdir(folder):
                        names = {}
                        exec(compile(block, str(page), "exec"), names)
                    for line in block.splitlines():
                        told = re.match(r"(\w+) = .*#=> (.+)$", line)
                        if told:
                            self.assertEqual(repr(names[told[1]]), told[2], line)
                            count += 1
        self.assertGreater(count, 5)


if __name__ == "__main__":
    unittest.main()
