"""import ninebit: states, and programs on NumPy arrays."""
import copy
import os
import pathlib
import pickle
import tempfile
import threading
import unittest
import warnings

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
    return ninebit.Program(text, form, profile)


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
        self.assertIn("#version 330", state.print("glsl"))
        self.assertIn("int32_t", state.print("c"))

    def test_what_is_wrong_is_told(self):
        with self.assertRaisesRegex(ninebit.Error, "2:11: .*spare2"):
            ninebit.State.parse("!!RC1.0\nout.rgb = spare2;", "rc10")
        with self.assertRaisesRegex(ninebit.Error, "voodoo.*geforce2"):
            ninebit.State("voodoo")
        with self.assertRaisesRegex(ninebit.Error, "'geforce'.*did you mean 'geforce2'"):
            ninebit.State("geforce")
        with self.assertRaisesRegex(ninebit.Error, "none.json.*cannot be read"):
            ninebit.State("none.json")
        with tempfile.TemporaryDirectory() as folder:  # a FIFO would never end
            pipe = os.path.join(folder, "pipe.json")
            os.mkfifo(pipe)
            with self.assertRaisesRegex(ninebit.Error, "pipe.json: cannot be read"):
                ninebit.State(pipe)
        with self.assertRaisesRegex(ninebit.Error, "unknown form 'basic'.*gl, rc10"):
            ninebit.State.parse("", "basic")
        with self.assertRaisesRegex(ninebit.Error, "text is '.*', which is not a file; expected the path of a file, or the text"):
            ninebit.State.parse(top)
        with self.assertRaisesRegex(ninebit.Error, "text is 'none.gl', which is not a file"):
            ninebit.Program("none.gl")
        for wrong in (3, None, ["!!RC1.0"], np.zeros(3)):
            for take in (ninebit.State.parse, ninebit.Program, ninebit.explain, ninebit.draw):
                with self.assertRaisesRegex(TypeError, "is (int|NoneType|list|ndarray); expected a State, a Program, the path of a file, or the text"):
                    take(wrong)
        with self.assertRaisesRegex(ninebit.Error, "unknown form 'rc1'.*did you mean 'rc10'"):
            ninebit.State().print("rc1")

    def test_a_program_is_a_text_a_path_or_a_state_everywhere(self):
        path = top / "docs/programs/index_compare.gl"
        text = path.read_text()
        state = ninebit.State.parse(text)
        one_line = "!!RC1.0 out.rgb = tex0; out.a = tex0.a;"
        with tempfile.TemporaryDirectory() as folder:
            odd = pathlib.Path(folder) / "step=2;.gl"  # its name looks like a program
            odd.write_text(text)
            wrong = pathlib.Path(folder) / "wrong.rc1"
            wrong.write_text("!!RC1.0\nout.rgb = spare2;")
            for given in (text, text.encode(), path, str(path), odd, str(odd), state, ninebit.Program(state)):
                self.assertEqual(ninebit.Program(given).state, state)
                self.assertEqual(ninebit.convert(given, "json"), state.print("json"))
                self.assertEqual(str(ninebit.explain(given)), ninebit.Program(state).explain())
                self.assertTrue(ninebit.prove("equivalent", given, state))
                self.assertEqual(ninebit.State.parse(given), state)
            for more in ({"form": "gl"}, {"profile": "geforce2"}, {"chip": "nv10"}, {"setup": 1}):
                with self.assertRaisesRegex(TypeError, "belong to the text of a program; a State has them already"):
                    ninebit.State.parse(state, **more)
            self.assertEqual(ninebit.State.parse(one_line).print("json"), ninebit.convert(one_line, "json"))
            with self.assertRaisesRegex(ninebit.Error, "wrong.rc1: .*2:11: .*spare2"):
                ninebit.State.parse(wrong)
        with self.assertRaisesRegex(ninebit.Error, "^program:2: .*spare2"):
            ninebit.draw("!!RC1.0\nout.rgb = spare2;")

    def test_a_shader_is_given_what_its_conditions_need(self):
        shader = "ps.1.1\n#if MODE == 0\nmov r0, v0\n#else\nmov r0, v1\n#endif"
        with self.assertRaisesRegex(ninebit.Error, "'MODE' is not defined, and #if MODE == 0 depends on it"):
            ninebit.State.parse(shader)
        for mode, plain in ((0, "ps.1.1\nmov r0, v0"), (1, "ps.1.1\nmov r0, v1")):
            self.assertEqual(ninebit.State.parse(shader, define={"MODE": mode}), ninebit.State.parse(plain))

    def test_stages_go_with_their_program(self):
        text = "!!TS1.0\ntexture_2d();\ndependent_ar(tex0);\n!!RC1.0\nout.rgb = tex1;"
        state = ninebit.State.parse(text, profile="nv2a")
        self.assertIn('{"operation": "dependent_ar"}', state.print("json"))
        self.assertEqual(ninebit.State.parse(state.print("gl"), profile="nv2a").print("json"), state.print("json"))
        self.assertIn("tex1 = texture 1 at (tex0.a, tex0.red)", ninebit.Program(state).explain())
        with self.assertRaisesRegex(ninebit.Error, "GL_INVALID_ENUM: profile geforce2 has no texture shaders"):
            ninebit.State.parse(text)

    def test_the_form_is_found(self):
        shader = "ps.1.1\ntex t0\nmul r0.rgb, t0, v0"
        with self.assertWarnsRegex(UserWarning, "r0.a is not written"):
            state = ninebit.State.parse(shader)
        self.enterContext(warnings.catch_warnings())
        warnings.simplefilter("ignore")
        self.assertEqual(state, ninebit.State.parse(shader, "ps"))
        source = "void f() { glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1); }"
        self.assertEqual(ninebit.State.parse(source), ninebit.State.parse(source, "source"))
        for form, read in [("gl", "gl"), ("rc10", "rc10"), ("ps11", "ps"), ("words", "words"), ("xbox", "xbox"),
                           ("json", "json"), ("words-json", "words-json")]:
            text = ninebit.State.parse(shader, profile="nv2a").print(form)
            again = ninebit.State.parse(text, profile="nv2a")
            self.assertEqual(again, ninebit.State.parse(text, read, "nv2a"), form)
        self.assertTrue(issubclass(ninebit.Error, ValueError))

    def test_a_profile_of_ones_own(self):
        path = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / "mine.json"
        path.write_text('{"base": "geforce2", "name": "mine", "half": 127}')
        own = ninebit.Program(ninebit.State.parse("!!RC1.0\n{ rgb { spare0 = half_bias(tex0); } }\nout.rgb = spare0;",
                                                  profile=path))
        self.assertEqual(own.profile, "mine")
        self.assertEqual(own.evaluate({"tex0.r": 200})[0], 200 - 127)

    def test_objects_describe_themselves(self):
        state = ninebit.State.parse(compare)
        self.assertEqual(repr(state), "<ninebit.State of 2 general combiners, geforce2>")
        self.assertEqual(repr(ninebit.Program(state)), "<ninebit.Program of 2 general combiners, geforce2>")
        self.assertRegex(repr(ninebit.Program(state).trace(primary=5)), r"^<ninebit.Trace of 2 stages, geforce2: out [0-9, ]+>$")

    def test_objects_are_copied_and_pickled(self):
        state = ninebit.State.parse(compare, profile="nv2a")
        p = ninebit.Program(state)
        for again in (copy.deepcopy, lambda one: pickle.loads(pickle.dumps(one))):
            self.assertEqual(again(state), state)
            self.assertEqual(hash(again(state)), hash(state))
            self.assertEqual(again(p).state, state)
            self.assertEqual(again(p.trace(primary=5)), p.trace(primary=5))


class Programs(unittest.TestCase):
    def test_every_pair_of_bytes(self):
        a, b = np.meshgrid(np.arange(256), np.arange(256))
        color = program(double).evaluate({"primary.r": a, "tex0.r": b})
        self.assertEqual((color.dtype, color.shape), (np.int16, (4, 256, 256)))
        # A GeForce 2 scales before it cuts toward zero.
        np.testing.assert_array_equal(color[0], np.minimum(255, 2 * a * b // 255))
        np.testing.assert_array_equal(color[3], 255)

    def test_whole_registers_and_what_is_left_in_them(self):
        codes = np.arange(-255, 256, dtype=np.int16)
        register = np.stack([codes, -codes, codes, codes])
        left = program("!!RC1.0\n{ rgb { spare1 = -spare0; } }\nout.rgb = spare1;\nout.a = spare0.a;\n").evaluate(
            {"spare0": register}, registers=True)
        np.testing.assert_array_equal(left["spare1"][:3], -register[:3])
        np.testing.assert_array_equal(left["spare0"], register)
        np.testing.assert_array_equal(left["out"][0], np.maximum(0, -codes))
        self.assertEqual(list(left), ["out", "const0", "const1", "fog", "primary", "secondary", "spare0", "spare1",
                                      "tex0", "tex1", "tex2", "tex3"])

    def test_constants_vary(self):
        text = "!!RC1.0\nconst0 = (0.0, 1.0, 0.0, 1.0);\n{ rgb { spare0 = const0 * tex0; } }\nout.rgb = spare0;\n"
        for profile in ("geforce2", "ideal"):
            p = program(text, profile=profile)
            own = p.evaluate({"tex0": (p.one, p.one, p.one)})
            self.assertEqual(own[:3].tolist(), [0, p.one, 0])
            codes = np.arange(p.one + 1)
            given = p.evaluate({"tex0": (p.one, p.one, p.one), "const0.b": codes}, registers=True)
            np.testing.assert_array_equal(given["out"][2], codes, profile)
            np.testing.assert_array_equal(given["out"][1], np.full(len(codes), p.one))
            np.testing.assert_array_equal(given["const0"][2], codes)
            self.assertEqual(p.trace({"tex0": (p.one, p.one, p.one), "const0.b": 7})["out"]["codes"][2], 7)

    def test_real_numbers(self):
        picture = np.random.default_rng(1).integers(0, 256, (20, 30, 4), np.uint8)
        texels = picture / 255
        for profile in ("geforce2", "ideal"):
            found = program(double, profile=profile).evaluate_real(tex0=picture, primary=99)
            self.assertEqual((found.shape, found.dtype), ((20, 30, 4), np.float64))
            np.testing.assert_allclose(found[..., :3], np.minimum(1, 2 * texels[..., :3] * 99 / 255), rtol=1e-15)
        ideal = program(double, profile="ideal")
        codes = ideal.evaluate(tex0=picture, primary=99)
        np.testing.assert_array_equal(codes, np.floor(ideal.evaluate_real(tex0=picture, primary=99) * 255 + 0.5))
        # Constants vary, components stand along the first axis, and registers are doubles, too.
        p = program("!!RC1.0\n{ rgb { spare0 = const0 * tex0; } }\nout.rgb = spare0;\nout.a = unsigned_invert(zero);\n")
        found = p.evaluate_real({"const0.r": np.arange(256), "tex0": 100}, registers=True)
        np.testing.assert_allclose(found["out"][0], np.arange(256) * 100 / 255**2, rtol=1e-15)
        np.testing.assert_array_equal(found["spare0"][:3], found["out"][:3])
        self.assertEqual(found["out"].shape, (4, 256))
        with self.assertRaisesRegex(ninebit.Error, "expected -?[0-9]+ to 255"):
            p.evaluate_real(tex0=300)

    def test_objects_that_were_never_made(self):
        raw_program, raw_state = (cls.__new__(cls) for cls in (ninebit.Program, ninebit.State))
        uses = [lambda: raw_program.evaluate({"tex0.r": 0}), lambda: raw_program.trace({}), raw_program.explain,
                raw_program.glsl, lambda: raw_program.one, lambda: raw_program.lowest, lambda: raw_program.profile,
                lambda: raw_state.print("json"), raw_state.validate, lambda: raw_state.profile, lambda: repr(raw_state),
                lambda: repr(raw_program), lambda: raw_state == ninebit.State(), lambda: ninebit.State() == raw_state,
                lambda: ninebit.Program(raw_state)]
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
        color = p.evaluate({"primary.r": 101, "tex0": (100, 0, 0, 255)})
        self.assertEqual(trace["out"]["codes"], color.tolist())
        self.assertEqual(trace["one"], p.one)
        self.assertEqual(len(trace["stages"]), 2)
        self.assertEqual(p.trace(tex0=np.array([1, 2, 3]))["one"], 255)
        self.assertIn("spare0", p.explain())
        self.assertTrue(p.glsl("mine").startswith("#version 330"))
        self.assertTrue(p.glsl(es=True).startswith("#version 300 es"))
        for wrong, message in (({"tex0.r": [1, 2]}, r"tex0.r has the shape \(2,\); expected one whole number"),
                               ({"tex0": [[1] * 4] * 2}, "a trace is of one fragment"),
                               ({"tex0.r": 256}, "tex0.r has the code 256"),
                               ({"tex0.r": 1, "tex0": (1, 2, 3, 4)}, "tex0.r is given twice")):
            with self.assertRaisesRegex(ninebit.Error, message):
                p.trace(wrong)
        with self.assertRaisesRegex(TypeError, "tex0.r is float"):
            p.trace({"tex0.r": 0.5})

    def test_stages_run_on_coordinates_and_texels(self):
        text = ("!!TS1.0\ntexture_2d();\ndot_product_2d_1of2(tex0);\ndot_product_2d_2of2(tex0);\n"
                "cull_fragment(GEQUAL_TO_ZERO, GEQUAL_TO_ZERO, GEQUAL_TO_ZERO, GEQUAL_TO_ZERO);\n!!RC1.0\nout.rgb = tex2;\nout.a = tex0.a;")
        p = program(text, profile="nv2a")
        across = np.linspace(-1, 1, 5)
        found = p.evaluate({"texel0": (255, 51, 0, 9), "at1.s": 0.5, "at2.t": 2, "at3.s": across, "texel2": (1, 2, 3, 4)},
                           registers=True)
        self.assertEqual(found["out"][:, 0].tolist(), [1, 2, 3, 9])
        self.assertEqual(found["tex2"].shape, (4, 5))
        self.assertEqual(found["culled"].tolist(), [True, True, False, False, False])
        self.assertTrue(np.isnan(found["depth"]).all())
        # Pictures of texels, and coordinates along an axis.
        texels = np.zeros((5, 2, 4), np.uint8)
        texels[..., 3] = 7
        self.assertEqual(p.evaluate(texel0=texels)[2, 1].tolist(), [0, 0, 0, 7])
        self.assertEqual(p.evaluate(at1=np.zeros((5, 2, 4)), texel0=texels).shape, (5, 2, 4))
        np.testing.assert_array_equal(p.evaluate_real({"texel2": (255, 0, 51, 0), "at3.s": [0.5, 1]})[:, 1], [1, 0, 0.2, 0])
        trace = p.trace({"texel0": (255, 51, 0, 9), "at1": (0.5, 0), "at2": (0, 2), "texel2": (1, 2, 3, 4)})
        stages = trace["texture_shader"]["stages"]
        np.testing.assert_allclose(stages[2]["at"], [0.5, 0.4, 0])
        self.assertEqual(trace["out"]["codes"], [1, 2, 3, 9])
        self.assertIn("texture_shader", p.trace())
        self.assertNotIn("texture_shader", p.trace(tex2=9))
        self.assertIn("texture stage 2: ", trace._repr_html_())
        depth = program("!!TS1.0\ntexture_2d();\ndot_product_depth_replace_1of2(tex0);\ndot_product_depth_replace_2of2(tex0);\n",
                        profile="nv2a")
        self.assertEqual(depth.evaluate({"texel0.r": 255, "at1.s": [1, 3], "at2.s": 4}, registers=True)["depth"].tolist(), [0.25, 0.75])
        for inputs, message in (({"at1.s": 0, "tex0.r": 1}, "tex0.r is what the texture-shader stages give"),
                                ({"texel0.r": 256}, "texel0.r has the (code|byte) 256"), ({"texel0.r": -1}, "texel0.r has the"),
                                ({"at1": 3}, "expected two to four coordinates"), ({"at1": (1, 2), "at1.s": 3}, "at1.s is given twice")):
            with self.subTest(inputs=inputs), self.assertRaisesRegex(ninebit.Error, message):
                p.evaluate(inputs)
        for value in (True, "x", None):
            with self.subTest(value=value), self.assertRaisesRegex(TypeError, "expected numbers"):
                p.evaluate({"at1.s": value})
        for call in (program(double).evaluate, program(double).trace):
            with self.assertRaisesRegex(ninebit.Error, "at1.s is for texture-shader stages, and the program has none"):
                call({"at1.s": 0})

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


if __name__ == "__main__":
    unittest.main()
