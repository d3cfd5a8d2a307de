"""Long calls: progress, other threads meanwhile, and Ctrl-C."""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import ninebit
import numpy as np

top = pathlib.Path(__file__).resolve().parents[2]
room = top / "scenes/index_room.gltf"
program = ninebit.Program((top / "docs/programs/index_compare.gl").read_text())

# Calls that take minutes if nothing interrupts them: {folder} is a folder to write into.
ENDLESS = {
    "render": "ninebit.render(room, turntable=3600, output={folder!r})",
    "study": "ninebit.study('depth-packing', depths='floats', float_step=1)",
    "prove": "[ninebit.prove('equivalent', one, other) for _ in range(10_000)]",
    "vectors": "ninebit.vectors(programs=80000, fragments=100, output={folder!r})",
    "compare": "ninebit.compare(room, size=(2048, 2048), vary={{'index_step': list(range(1, 9))}}, output={folder!r})",
    "evaluate": "[program.evaluate({{'tex0.r': codes}}) for _ in range(10_000)]",
}
# Says "ready" before the call, and whether it was interrupted.
SCRIPT = r"""
import numpy as np, ninebit
room, program = {room!r}, ninebit.Program(open({gl!r}).read())
codes = np.zeros(30_000_000, np.int16)
# The same sum of two products, in other registers.
one, other = (ninebit.State.parse("!!RC1.0\n{{ rgb {{ %s }} }}\n{{ rgb {{ discard = %s; discard = %s; spare0 = sum(); }} }}\n"
                                  "out.rgb = spare0;\nout.a = zero;" % texts)
              for texts in (("tex0 = col0 * tex0;", "tex0", "col1 * tex1"),
                            ("tex1 = tex1 * col1; spare1 = col0 * tex0;", "spare1", "tex1")))
print("ready", flush=True)
try:
    {call}
    print("finished")
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


class Interrupts(unittest.TestCase):
    def interrupt(self, call, folder):
        """Runs a call in a process of its own, sends SIGINT, and returns what it says then, and after how long."""
        script = SCRIPT.format(room=str(room), gl=str(top / "docs/programs/index_compare.gl"), call=call.format(folder=folder))
        child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
        self.addCleanup(child.stdout.close)
        self.addCleanup(child.kill)
        self.assertEqual(child.stdout.readline(), "ready\n")
        time.sleep(1.0)  # into the call
        self.assertIsNone(child.poll(), call)
        sent = time.monotonic()
        child.send_signal(signal.SIGINT)
        said = child.stdout.readline()
        seconds = time.monotonic() - sent
        self.assertEqual(child.communicate(timeout=60)[0], "", call)
        return said, seconds

    def test_each_call_is_interrupted(self):
        for name, call in ENDLESS.items():
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                said, seconds = self.interrupt(call, folder)
                self.assertEqual(said, "interrupted\n", name)
                self.assertLess(seconds, 30, f"{name}: the work itself takes minutes")
                self.assertEqual(os.listdir(folder), [], name)
                print(f"{name}: interrupted after {1000 * seconds:.0f} ms")


class Progress(unittest.TestCase):
    def test_it_rises_to_one(self):
        steps, threads = [], set()

        def step(done, what):
            steps.append((done, what))
            threads.add(threading.current_thread())

        ninebit.study("index-steps", profile="geforce2", progress=step)
        shares = [done for done, _ in steps]
        self.assertEqual(shares, sorted(shares))
        self.assertEqual(steps[-1], (1.0, "done"))
        self.assertGreater(len(steps), 2)
        self.assertEqual(threads, {threading.main_thread()})

    def test_its_exception_ends_the_work(self):
        def stop(done, what):
            raise ZeroDivisionError(what)

        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaises(ZeroDivisionError):
                ninebit.render(room, turntable=3600, size=(64, 48), output=folder, progress=stop)
            self.assertEqual(os.listdir(folder), [])
        self.assertEqual(ninebit.render(room, size=(8, 6), map_size=16).color.shape, (6, 8, 4))

    def test_it_must_not_call_back(self):
        with self.assertRaisesRegex(RuntimeError, "progress function must not call"):
            ninebit.render(room, size=(64, 48), progress=lambda done, what: ninebit.options and ninebit.render(room))


class Threads(unittest.TestCase):
    def counted_during(self, call):
        """How often another thread of Python ran during a call."""
        count, end = [0], threading.Event()

        def work():
            while not end.is_set():
                count[0] += 1
                time.sleep(0.001)

        worker = threading.Thread(target=work)
        worker.start()
        before = count[0]
        try:
            call()
        finally:
            counted = count[0] - before
            end.set()
            worker.join()
        return counted

    def test_other_threads_run_meanwhile(self):
        codes = np.zeros(20_000_000, np.uint8)
        for call in (lambda: ninebit.render(room, size=(640, 480), turntable=8),
                     lambda: ninebit.study("index-steps", profile="geforce2", formats="rgb"),
                     lambda: program.evaluate({"tex0.r": codes})):
            self.assertGreater(self.counted_during(call), 5)

    def test_calls_of_several_threads_take_turns(self):
        drawn = {}
        threads = [threading.Thread(target=lambda n=n: drawn.update({n: ninebit.render(room, size=(64, 48), index_step=n)}))
                   for n in (1, 2, 3, 4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for step in drawn:
            np.testing.assert_array_equal(drawn[step].color, ninebit.render(room, size=(64, 48), index_step=step).color)
        self.assertEqual(sorted(drawn), [1, 2, 3, 4])


if __name__ == "__main__":
    unittest.main()
