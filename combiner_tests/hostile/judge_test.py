#!/usr/bin/env python3
"""Tests what judges hostile files: each fault that it must see is made by a small program in the place of ninebit."""
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True

import campaign  # noqa: E402
import json_tree  # noqa: E402
import judge  # noqa: E402
import kept  # noqa: E402
import parts  # noqa: E402
import reduce  # noqa: E402

PICTURE = "os.mkdir('out')\npathlib.Path('out/color.png').write_bytes(%r)\n"
MESSAGE = "sys.stderr.write('ninebit: error: a.obj: is wrong\\n')\n"
PNG = b"\x89PNG\r\n\x1a\n" + b"\0\0\0\0IEND\xaeB`\x82"


class Programs(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="judge-")
        self.addCleanup(self.folder.cleanup)

    def program(self, text):
        path = pathlib.Path(self.folder.name) / "program"
        path.write_text(f"#!{sys.executable}\nimport os, pathlib, signal, subprocess, sys, time\n{text}",
                        encoding="utf-8")
        path.chmod(0o755)
        return path

    def outcome(self, text, command=("render", "a.obj", "-o", "out"), limit=judge.SECONDS, **expected):
        case = judge.Case(list(command), {"a.obj": b"v 0 0 0\n"}, expected)
        return judge.run(case, self.program(text), self.folder.name, limit)

    def refuses(self, text, fault, **options):
        faults = self.outcome(text, **options).faults
        self.assertTrue(any(f.startswith(fault) for f in faults), f"{faults} has nothing that begins with '{fault}'")

    def test_a_good_run_has_no_fault(self):
        outcome = self.outcome(PICTURE % PNG + "print('wrote', file=sys.stderr)\n")
        self.assertEqual((outcome.code, outcome.faults), (0, []))

    def test_a_refusal_has_no_fault(self):
        outcome = self.outcome(MESSAGE + "sys.exit(3)\n", exit=[3], says=["is wrong"])
        self.assertEqual((outcome.code, outcome.faults, outcome.message), (3, [], "ninebit: error: a.obj: is wrong"))

    def test_signals_and_codes(self):
        self.refuses("os.kill(os.getpid(), signal.SIGSEGV)\n", "signal 11")
        self.refuses("os.abort()\n", "signal 6")
        self.refuses(MESSAGE + "sys.exit(139)\n", "exit 139")
        self.refuses(MESSAGE + "sys.exit(5)\n", "exit 5")

    def test_orders(self):
        command = ("render", "a.obj", "-o", "out", "--check-order")
        self.refuses(MESSAGE + "sys.exit(1)\n", "exit 1", command=command)
        self.assertEqual(self.outcome(MESSAGE + "sys.exit(1)\n").faults, [])

    def test_time_and_memory(self):
        self.refuses("time.sleep(60)\n", "hang", limit=0.5)
        self.refuses("signal.signal(signal.SIGTERM, signal.SIG_IGN)\nwhile True: pass\n", "hang", limit=0.5)
        self.refuses("a = []\nwhile True: a.append(b'1' * (1 << 26))\n", "memory", limit=120)

    def test_memory_of_a_child(self):
        child = "import time; size = 2200 << 20; a = b'1' * size; time.sleep(1)"
        self.refuses(f"subprocess.run([sys.executable, '-c', {child!r}])\n", "memory", limit=120)

    def test_processes_that_stay(self):
        self.refuses("subprocess.Popen(['sleep', '60'])\n", "process")

    def test_messages(self):
        self.refuses("sys.exit(3)\n", "stderr is empty")
        self.refuses(MESSAGE + "sys.stderr.write('\\x1b[31m\\n')\nsys.exit(3)\n", "control characters on stderr: 0x1b")
        self.refuses(MESSAGE + "sys.stderr.write('\\x85\\n')\nsys.exit(3)\n", "control characters on stderr: 0x85")
        self.refuses(MESSAGE + "sys.stderr.buffer.write(b'\\xff\\n')\nsys.exit(3)\n", "stderr is not UTF-8")
        self.refuses(MESSAGE * 9 + "sys.exit(3)\n", "lines on stderr: 9")
        self.refuses(MESSAGE + "sys.stderr.write('a' * 5000)\nsys.exit(3)\n", "a line on stderr")
        self.refuses("sys.stderr.write('libpng error\\n')\nsys.exit(3)\n", "stderr begins with")
        self.refuses("print('{')\n", "stdout is not JSON", command=("render", "a.obj", "--json"))
        self.refuses("print('{\"a\": NaN}')\n", "stdout is not JSON", command=("render", "a.obj", "--json"))

    def test_files(self):
        self.refuses("pathlib.Path('a.obj').write_text('')\n", "input changed")
        self.refuses("os.mkdir('out')\npathlib.Path('out/.color.ninebit-1-1.png').write_text('')\n", "file left behind")
        self.refuses("os.mkdir('out')\npathlib.Path('out/color.png').write_bytes(b'\\x89PNG')\n",
                     "output is not complete")
        self.refuses("os.mkdir('out')\npathlib.Path('out/rows.json').write_text('{')\n", "output is not complete")
        self.refuses(PICTURE % PNG + MESSAGE + "sys.exit(3)\n", "output in spite")
        self.refuses("os.mkfifo('pipe')\n", "not a regular file")

    def test_expectations(self):
        self.refuses("sys.exit(0)\n", "exit 0: expected 3", exit=[3])
        self.refuses(MESSAGE + "sys.exit(3)\n", "stderr does not say 'root'", says=["root"])
        self.refuses(MESSAGE + "sys.exit(3)\n", "stderr says 'wrong'", **{"not": ["wrong"]})

    def test_the_reducer_keeps_the_fault(self):
        program = self.program("if b'bad' in pathlib.Path('a.obj').read_bytes(): os.abort()\n")
        lines = [b"v %d 0 0" % k for k in range(50)]
        case = judge.Case(["render", "a.obj", "--size", "8x8"],
                          {"a.obj": b"\n".join(lines + [b"some bad line"] + lines)})
        small = reduce.reduce(case, judge.run(case, program, self.folder.name), program, self.folder.name)
        self.assertEqual((small.command, small.files), (["render", "a.obj"], {"a.obj": b"bad"}))


class Generators(unittest.TestCase):
    def test_a_number_gives_the_same_mutant(self):
        context = campaign.Context("no program")
        for kind in ("obj", "off", "ply", "gltf", "glb", "3ds", "archive", "picture", "profile", "table"):
            for number in range(20):
                once, again = (campaign.make(kind, 3, number, context) for _ in range(2))
                self.assertEqual((once.command, once.files), (again.command, again.files), f"{kind}:3:{number}")

    def test_json_comes_back(self):
        text = '{"a":[1,2.50,-0,1e400,true,null,"\\u00e4"],"a":{},"b":[]}'
        self.assertEqual(json_tree.write(json_tree.parse(text)), text)

    def test_hashes_fit_again(self):
        lines = ['{"file":"a","build":"old"}', '{"unit":0}']
        part = parts.rehash(lines)
        self.assertEqual(parts.for_build(part, "old"), part)
        newer = parts.for_build(part, "new")
        self.assertEqual(newer, parts.rehash([lines[0].replace("old", "new"), lines[1]]))
        changed = parts.changed(part, [(2, "unit", '{"x":1}')])
        self.assertEqual(changed, parts.rehash([lines[0], '{"unit":{"x":1}}']))
        for change in ((2, "unit", "0"), (2, "none", "1")):  # what changes nothing tests nothing
            with self.assertRaises(RuntimeError):
                parts.changed(part, [change])
        broken = part.replace('"unit":0', '"unit":1')
        self.assertIn('"unit":1,"sha256":"' + parts.sha('{"unit":0}'), parts.for_build(broken, "new"))

    def test_a_run_without_variety_is_no_run(self):
        class Options:
            formats = ["obj", "off"]

        seen = campaign.Campaign(Options, None, print)
        self.assertEqual(seen.vacuous(), ["obj: no mutant ran", "off: no mutant ran"])
        for code, count in ((3, campaign.LEAST), (0, 1)):
            for _ in range(count):
                seen.counts["obj"].add("", judge.Outcome(code, 0, 0, "", []))
        for _ in range(campaign.LEAST):
            seen.counts["off"].add("", judge.Outcome(3, 0, 0, "", []))
        self.assertEqual(seen.vacuous(), [f"off: all {campaign.LEAST} mutants were refused"])

    def test_every_kept_case_can_be_read(self):
        class Context:
            class parts:
                @staticmethod
                def build():
                    return "0.1.0 a"

        names = [name for name, _ in kept.cases(Context)]
        self.assertGreater(len(names), 60)


if __name__ == "__main__":
    unittest.main()
