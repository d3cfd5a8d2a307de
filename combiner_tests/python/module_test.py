"""import ninebit: programs on NumPy arrays, traces, renderings, and a stub that tells of all of it."""
import ast
import contextlib
import pathlib
import re
import threading
import unittest

import ninebit
import numpy as np

top = pathlib.Path(__file__).resolve().parents[2]
compare = (top / "docs/programs/index_compare.gl").read_text()
double = """!!RC1.0
{ rgb { spare0 = col0 * tex0; scale_by_two(); } }
out.rgb = spare0;
out.a = unsigned_invert(zero);
"""


def program(text, form="rc10", profile="geforce2"):
    return ninebit.Program(ninebit.State.parse(text, form, profile))


class States(unittest.TestCase):
    def test_forms_there_and_back(self):
        state = ninebit.State.parse(compare, "gl")
        for form in ("gl", "rc10", "words", "words-json", "json"):
            again = ninebit.State.parse(state.print(form), form)
            one, two = (ninebit.Program(s).explain() for s in (state, again))
            self.assertEqual(one.split("how to read")[0].splitlines()[:6], two.splitlines()[:6])
        self.assertEqual(ninebit.State.parse(state.print("json"), "json"), state)
        self.assertEqual(state.validate(), [])
        self.assertEqual(ninebit.State("nv2a").profile, "nv2a")

    def test_what_is_wrong_is_told(self):
        with self.assertRaisesRegex(ninebit.Error, "2:11: .*spare2"):
            ninebit.State.parse("!!RC1.0\nout.rgb = spare2;", "rc10")
        with self.assertRaisesRegex(ninebit.Error, "voodoo.*geforce2"):
            ninebit.State("voodoo")
        with self.assertRaisesRegex(ninebit.Error, "unknown form"):
            ninebit.State.parse("", "basic")

    def test_the_form_is_found(self):
        shader = "ps.1.1\ntex t0\nmul r0, t0, v0"
        state = ninebit.State.parse(shader)
        self.assertEqual(state, ninebit.State.parse(shader, "ps"))
        source = "void f() { glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1); }"
        self.assertEqual(ninebit.State.parse(source), ninebit.State.parse(source, "source"))
        for form, read in [("gl", "gl"), ("rc10", "rc10"), ("ps11", "ps"), ("words", "words"), ("xbox", "xbox")]:
            text = ninebit.State.parse(shader, profile="nv2a").print(form)
            again = ninebit.State.parse(text, profile="nv2a")
            self.assertEqual(again, ninebit.State.parse(text, read, "nv2a"), form)
        self.assertTrue(issubclass(ninebit.Error, ValueError))


class Programs(unittest.TestCase):
    def test_every_pair_of_bytes(self):
        a, b = (x.astype(np.int16) for x in np.meshgrid(np.arange(256), np.arange(256)))
        a, b = np.ascontiguousarray(a.ravel()), np.ascontiguousarray(b.ravel())
        color = program(double).evaluate({"primary.r": a, "tex0.r": b})
        self.assertEqual((color.dtype, color.shape), (np.int16, (4, 65536)))
        # A GeForce 2 scales before it cuts toward zero.
        expected = np.minimum(255, 2 * a.astype(np.int64) * b // 255)
        np.testing.assert_array_equal(color[0], expected)
        np.testing.assert_array_equal(color[3], 255)

    def test_whole_registers_and_what_is_left_in_them(self):
        codes = np.arange(-255, 256, dtype=np.int16)
        register = np.ascontiguousarray(np.stack([codes, -codes, codes, codes]))
        left = program("!!RC1.0\n{ rgb { spare1 = -spare0; } }\nout.rgb = spare1;\nout.a = spare0.a;\n").evaluate_registers(
            {"spare0": register})
        np.testing.assert_array_equal(left["spare1"][:3], -register[:3])
        np.testing.assert_array_equal(left["spare0"], register)
        np.testing.assert_array_equal(left["color"][0], np.maximum(0, -codes))

    def test_nothing_is_copied_and_nothing_wrong_is_taken(self):
        p = program(double)
        codes = np.zeros(16, dtype=np.int16)
        for wrong in (codes.astype(np.int32), codes.astype(float), [0] * 16, codes[::2]):
            with self.assertRaises(TypeError):
                p.evaluate({"primary.r": wrong})
        for wrong in ({"primary": codes}, {"primary.r": codes.reshape(4, 4)}, {}, {"primary.r": codes, "tex0.r": codes[:3]}):
            with self.assertRaises(ValueError):
                p.evaluate(wrong)
        with self.assertRaisesRegex(ninebit.Error, "256; expected -255 to 255"):
            p.evaluate({"primary.r": np.full(3, 256, dtype=np.int16)})
        with self.assertRaisesRegex(ninebit.Error, "'primry.r' is not a register"):
            p.evaluate({"primry.r": codes})
        self.assertEqual(p.evaluate({"primary.r": codes[:0]}).shape, (4, 0))

    def test_wrong_types_are_told_with_what_was_expected(self):
        p = program(double)
        codes = np.zeros(4, dtype=np.int16)
        for wrong, expected in (({7: codes}, "name must be str.* not int"), ({b"tex0.r": codes}, "must be str.* not bytes"),
                                ({"tex0.r": [0] * 4}, "tex0.r must be a C-contiguous array of int16.* list"),
                                ({"tex0.r": None}, "tex0.r must be .* NoneType"),
                                ({"tex0.r": np.frombuffer(bytes(9), dtype=np.int16, offset=1)}, "aligned")):
            for evaluate in (p.evaluate, p.evaluate_registers):
                with self.assertRaisesRegex(TypeError, expected):
                    evaluate(wrong)
        for wrong, expected in (({7: 1}, "name must be str.* not int"), ({"tex0.r": "1"}, "tex0.r must be a whole number, not str"),
                                ({"tex0.r": (1, 2, 3, 4)}, "a whole number, not tuple"),
                                ({"tex0": 1}, "tex0 must be a sequence of four whole numbers, not int"),
                                ({"tex0": (1, 2, 3, None)}, "four whole numbers, not tuple")):
            with self.assertRaisesRegex(TypeError, expected):
                p.trace(wrong)
        with self.assertRaises(TypeError):
            p.evaluate([codes])
        self.assertFalse(ninebit.State() == 3)
        self.assertEqual(p.trace({"tex0.r": np.int16(7)})["one"], 255)

    def test_objects_that_were_never_made(self):
        raw_program, raw_state = (cls.__new__(cls) for cls in (ninebit.Program, ninebit.State))
        codes = {"tex0.r": np.zeros(4, dtype=np.int16)}
        uses = [lambda: raw_program.evaluate(codes), lambda: raw_program.evaluate_registers(codes),
                lambda: raw_program.trace({}), raw_program.explain, raw_program.glsl, lambda: raw_program.one,
                lambda: raw_program.lowest, lambda: raw_program.profile, lambda: raw_state.print("json"),
                raw_state.validate, lambda: raw_state.profile, lambda: raw_state == ninebit.State(),
                lambda: ninebit.State() == raw_state, lambda: ninebit.Program(raw_state)]
        for use in uses:
            with self.assertRaisesRegex(TypeError, "__init__.* has not run"):
                use()

    def test_arrays_live_as_long_as_they_are_read(self):
        p = program(compare, "gl")
        count = 2_000_000
        expected = p.evaluate({"tex0.r": np.full(256, 77, dtype=np.int16)})[:, :1]
        for _ in range(4):
            inputs = {"tex0.r": np.full(count, 77, dtype=np.int16)}
            found = []
            worker = threading.Thread(target=lambda: found.append(p.evaluate(inputs)))
            worker.start()
            # The array is read while another thread drops it, and memory of its size is taken and filled.
            while worker.is_alive():
                inputs.clear()
                np.full(count, -9999, dtype=np.int16)
            worker.join()
            if found:  # else the dictionary was empty before it was looked at
                self.assertTrue((found[0] == expected).all())

    def test_codes_are_checked_as_they_are_read(self):
        p = program(double)
        codes = np.zeros(1_000_000, dtype=np.int16)
        for place in (0, 511, 512, 999_999):
            codes[place] = -256
            with self.assertRaisesRegex(ninebit.Error, "tex0.r has the code -256; expected -255 to 255"):
                p.evaluate({"tex0.r": codes})
            codes[place] = 0
        self.assertEqual(p.evaluate({"tex0.r": codes}).shape, (4, 1_000_000))

    def test_trace_is_what_evaluate_gives(self):
        p = program(compare, "gl")
        trace = p.trace({"primary.r": 101, "tex0": (100, 0, 0, 255)})
        one = lambda code: np.array([code], dtype=np.int16)
        color = p.evaluate({"primary.r": one(101), "tex0.r": one(100), "tex0.a": one(255)})
        self.assertEqual(trace["out"]["codes"], color[:, 0].tolist())
        self.assertEqual(trace["one"], p.one)
        self.assertEqual(len(trace["stages"]), 2)
        self.assertIn("spare0", p.explain())
        self.assertTrue(p.glsl("mine").startswith("#version 330"))
        self.assertTrue(p.glsl(es=True).startswith("#version 300 es"))

    def test_threads(self):
        p = program(compare, "gl")
        codes = np.arange(256, dtype=np.int16).repeat(40)
        expected = p.evaluate({"primary.r": codes})
        found = [None] * 4

        def work(i):
            found[i] = p.evaluate({"primary.r": codes})

        threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for color in found:
            np.testing.assert_array_equal(color, expected)


class Renderings(unittest.TestCase):
    def test_planes_are_the_renderings(self):
        scene = str(top / "scenes/index_room.gltf")
        drawn = ninebit.render(scene, size=(64, 48), map_size=64)
        for name in ("red", "green", "blue", "alpha", "stencil", "depth"):
            self.assertEqual(drawn[name].shape, (48, 64), name)
            self.assertFalse(drawn[name].flags.owndata, name)
        self.assertEqual(drawn["lit"] + drawn["shadowed"] + drawn["background"], 64 * 48)
        self.assertEqual(np.count_nonzero(drawn["stencil"]), drawn["shadowed"])
        self.assertGreater(drawn["shadowed"], 0)
        # A plane outlives the dictionary.
        red = drawn["red"]
        copy = red.copy()
        del drawn
        np.testing.assert_array_equal(red, copy)
        # Upright: what the light stands above is darker at the bottom than a white frame would be; and the step matters.
        self.assertNotEqual(ninebit.render(scene, size=(64, 48), map_size=64, index_step=1)["shadowed"],
                            ninebit.render(scene, size=(64, 48), map_size=64)["shadowed"])

    def test_order_of_indices(self):
        scene = str(top / "scenes/index_room.gltf")
        drawn = {order: ninebit.render(scene, size=(160, 120), map_size=64, index_order=order, patch_angle=30.0)
                 for order in ("file", "neighbour")}
        counts = ["patches", "borders", "broken_borders", "broken_share", "false_neighbours"]
        for order, rendering in drawn.items():
            report = rendering["index_order"]
            self.assertEqual(list(report), ["order", "reason", *counts])
            self.assertEqual((report["order"], report["reason"]), (order, ""))
            self.assertEqual(report["false_neighbours"], 0)
        self.assertEqual([drawn["file"]["index_order"][count] for count in counts], [0] * 5)
        self.assertGreater(drawn["neighbour"]["index_order"]["patches"], 0)
        self.assertLess(drawn["neighbour"]["shadowed"], drawn["file"]["shadowed"])
        self.assertLess(ninebit.render(scene, size=(160, 120), map_size=64, index_scales="no-scale")["shadowed"],
                        ninebit.render(scene, size=(160, 120), map_size=64, index_scales="both-x4")["shadowed"])

    def test_what_is_wrong_is_told(self):
        with self.assertRaisesRegex(ninebit.Error, "unknown index order 'patch'; expected one of file neighbour"):
            ninebit.render("x.obj", index_order="patch")
        with self.assertRaisesRegex(ninebit.Error, "unknown index scales 'x4'; expected one of both-x4 first-x4"):
            ninebit.render("x.obj", index_scales="x4")
        for degrees in (-1.0, 90.5, float("nan")):
            with self.assertRaisesRegex(ninebit.Error, "0 to 90"):
                ninebit.render(str(top / "scenes/index_room.gltf"), size=(8, 6), index_order="neighbour",
                               patch_angle=degrees)
        with self.assertRaisesRegex(ninebit.Error, "missing.obj"):
            ninebit.render("missing.obj")
        with self.assertRaisesRegex(ninebit.Error, "index-cube"):
            ninebit.render("x.obj", technique="magic")


class Effects(unittest.TestCase):
    folder = top / "scenes/effects"

    def test_a_generated_mesh_and_texture(self):
        drawn = ninebit.draw(str(self.folder / "toon.json"), size=(64, 48))
        self.assertEqual(drawn["red"].shape, (48, 64))
        self.assertEqual(drawn["warnings"], [])
        colors = set(zip(*(drawn[c].ravel().tolist() for c in ("red", "green", "blue"))))
        self.assertEqual(len(colors), 3, "two tones and the background")
        self.assertGreater(len(np.unique(drawn["depth"])), 100)

    def test_pictures_are_read_by_a_function(self):
        read = []

        def picture(path):
            read.append(pathlib.Path(path).name)
            pixels = np.zeros((256, 256, 3), np.uint8)
            pixels[:128] = 255  # the upper half is white
            return pixels

        sepia = str(self.folder / "sepia.json")
        drawn = ninebit.draw(sepia, read_picture=picture)
        self.assertEqual(read, ["photograph.png"])
        self.assertTrue((drawn["red"][:128] > 250).all() and (drawn["red"][128:] == 0).all())
        with self.assertRaisesRegex(ninebit.Error, "photograph.png.*read_picture"):
            ninebit.draw(sepia)
        with self.assertRaisesRegex(ninebit.Error, "height, width"):
            ninebit.draw(sepia, read_picture=lambda path: np.zeros(4, np.uint8))
        with self.assertRaisesRegex(ninebit.Error, "power"):
            ninebit.draw(sepia, read_picture=lambda path: np.zeros((3, 4), np.uint8))

    def test_what_is_wrong_is_told(self):
        with self.assertRaisesRegex(ninebit.Error, "none.json"):
            ninebit.draw(str(self.folder / "none.json"))
        with self.assertRaisesRegex(ninebit.Error, "voodoo"):
            ninebit.draw(str(self.folder / "toon.json"), profile="voodoo")


class Studies(unittest.TestCase):
    def test_index_steps_counts_what_programs_compute(self):
        rows = ninebit.index_steps_study(profiles=["geforce2", "ideal"], formats=["channel"], variants=["both-x4"],
                                         steps=(1, 3))["rows"]
        self.assertEqual(rows.dtype.names, ("profile", "format", "variant", "step", "codes", "pairs", "false_matches"))
        self.assertEqual(rows["profile"].tolist(), ["geforce2"] * 3 + ["ideal"] * 3)
        self.assertEqual((rows["step"].tolist(), rows["step"].dtype), ([1, 2, 3] * 2, np.int64))
        self.assertEqual(rows["codes"].tolist()[:3], [256, 128, 86])
        # The same by the program itself, pair by pair.
        a, b = (np.ascontiguousarray(x.astype(np.int16).ravel()) for x in np.meshgrid(np.arange(256), np.arange(256)))
        equal = program(compare, "gl").evaluate({"primary.r": a, "tex0.r": b})[3] == 0
        self.assertEqual(rows["false_matches"][0], np.count_nonzero(equal & (a != b)))
        self.assertGreater(rows["false_matches"][0], 0)
        self.assertFalse(rows[rows["step"] >= 2]["false_matches"].any())

    def test_datapath(self):
        tables = ninebit.datapath_study(profiles=["geforce256-8bit", "geforce2-early-truncation", "geforce2"])
        rows, differences = tables["rows"], tables["differences"]
        product = rows[(rows["profile"] == "geforce2") & (rows["operation"] == "product") & (rows["form"] == "x1")]
        self.assertEqual(product["cases"].tolist(), [511 * 511])
        a, b = np.meshgrid(np.arange(-255, 256), np.arange(-255, 256))
        error = np.abs(np.trunc(a * b / 255) - a * b / 255) / 255
        self.assertAlmostEqual(product["max_error"][0], error.max(), places=12)
        self.assertAlmostEqual(product["mean_error"][0], error.mean(), places=12)
        self.assertEqual(set(differences["first"]), {"geforce2-early-truncation"})
        self.assertTrue((differences["differ"] <= differences["cases"]).all())

    def test_depth_packing(self):
        tables = ninebit.depth_packing_study(packings=["rgba8-fract"], storages=["round"], sets=["16"])
        self.assertEqual(tables["rows"]["count"].tolist(), [65536])
        self.assertEqual(len(tables["second_digit"]), 256)
        self.assertEqual(tables["rows"].dtype["max_error"], np.float64)

    def test_shadows_are_judged(self):
        room = str(top / "scenes/index_room.gltf")
        rows = ninebit.shadows_study(room, size=(160, 120), map_sizes=[64, 256], steps=[1, 2])["rows"]
        self.assertEqual(rows["map_size"].tolist(), [64, 64, 256, 256])
        self.assertEqual(rows["index_step"].tolist(), [1, 2, 1, 2])
        wrong = dict(zip(zip(rows["map_size"].tolist(), rows["index_step"].tolist()), rows["wrong"].tolist()))
        self.assertLess(wrong[256, 2], wrong[64, 2])
        self.assertTrue(np.array_equal(rows["false_lit"] + rows["false_shadowed"], rows["wrong"]))
        self.assertNotIn("index_order", rows.dtype.names)
        swept = ninebit.shadows_study(room, size=(160, 120), map_sizes=[64], orders=["file", "neighbour"],
                                      scales=["both-x4", "no-scale"])["rows"]
        self.assertEqual(swept["index_order"].tolist(), ["file", "file", "neighbour", "neighbour"])
        self.assertEqual(swept["index_scales"].tolist(), ["both-x4", "no-scale"] * 2)
        self.assertLess(swept["joint"][2], swept["joint"][0])
        with self.assertRaisesRegex(ninebit.Error, "unknown order 'patch'; expected one of file neighbour"):
            ninebit.shadows_study(room, orders=["patch"])
        depth = ninebit.shadows_study(room, technique="depth-cube", size=(160, 120), depth_bits=["8", "float"])["rows"]
        self.assertEqual(len(depth), 2)
        with self.assertRaisesRegex(ninebit.Error, "unknown number of depth bits '9'"):
            ninebit.shadows_study(room, technique="depth-cube", depth_bits=["9"])
        with self.assertRaisesRegex(ninebit.Error, "shadow-volume"):
            ninebit.shadows_study(room, technique="shadow-volume", steps=[1])

    def test_what_is_wrong_is_told(self):
        with self.assertRaisesRegex(ninebit.Error, "unknown format 'rgba'; expected one of channel rgb la l a"):
            ninebit.index_steps_study(formats=["rgba"])
        with self.assertRaisesRegex(ninebit.Error, "step"):
            ninebit.index_steps_study(profiles=["geforce2"], steps=(0, 3))
        with self.assertRaisesRegex(ninebit.Error, "voodoo"):
            ninebit.datapath_study(profiles=["voodoo"])
        with self.assertRaises(ninebit.Error):
            ninebit.datapath_study(profiles=["ideal"])
        with self.assertRaises(ninebit.Error):
            ninebit.depth_packing_study(float_step=0)


class Readme(unittest.TestCase):
    def test_its_example_runs(self):
        code = re.search(r"```python\n(.*?)```", (top / "docs/library.md").read_text(), re.DOTALL)[1]
        names = {}
        with contextlib.chdir(top):
            exec(code, names)
        self.assertEqual(names["red"].shape, (256,))
        self.assertEqual(names["shadow"].shape, (480, 640))
        self.assertEqual(names["safe"], 2)


class Stubs(unittest.TestCase):
    def test_they_tell_of_everything(self):
        stub = ast.parse((pathlib.Path(ninebit.__file__).parent / "__init__.pyi").read_text())
        told = {node.name: node for node in stub.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
        for name in set(ninebit.__all__) - {"__version__"}:
            self.assertIn(name, told)
            self.assertTrue(getattr(ninebit, name).__doc__, name)
        for cls in (ninebit.State, ninebit.Program):
            methods = {node.name for node in told[cls.__name__].body if isinstance(node, ast.FunctionDef)}
            public = {name for name in vars(cls) if not name.startswith("_")}
            self.assertEqual(public, {name for name in methods if not name.startswith("_")}, cls)
            for name in public:
                self.assertTrue(getattr(cls, name).__doc__, name)


if __name__ == "__main__":
    unittest.main()
