"""The verbs of the program as functions: the same answers as the program, with arrays."""
import json
import os
import pathlib
import pickle
import subprocess
import tempfile
import unittest
import warnings
import zlib

import ninebit
import numpy as np

top = pathlib.Path(__file__).resolve().parents[2]
room = top / "scenes/index_room.gltf"
compare_gl = top / "docs/programs/index_compare.gl"
effects = top / "scenes/effects"
program_file = os.environ.get("NINEBIT_PROGRAM")  # the program, to compare with
small = {"size": (64, 48), "map_size": 64}


def by_program(*words):
    """The answer of the program to the same flags."""
    return json.loads(subprocess.run([program_file, *map(str, words), "--json", "--quiet"], capture_output=True, check=True).stdout)


def pixels_of_png(file):
    """The samples of a PNG that ninebit wrote: 8 bits, all filters."""
    data = pathlib.Path(file).read_bytes()
    width, height, _, kind = (int.from_bytes(data[16:20], "big"), int.from_bytes(data[20:24], "big"), data[24], data[25])
    channels = {0: 1, 2: 3, 6: 4}[kind]
    packed, at = b"", 8
    while at < len(data):
        size = int.from_bytes(data[at:at + 4], "big")
        if data[at + 4:at + 8] == b"IDAT":
            packed += data[at + 8:at + 8 + size]
        at += 12 + size
    lines = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + width * channels).astype(int)
    out = np.zeros((height, width * channels), int)
    for y in range(height):
        if lines[y, 0] == 0:
            out[y] = lines[y, 1:]
            continue
        for x in range(width * channels):
            left = out[y, x - channels] if x >= channels else 0
            above = out[y - 1, x] if y else 0
            corner = out[y - 1, x - channels] if y and x >= channels else 0
            guess = left + above - corner
            paeth = min((left, above, corner), key=lambda one: abs(guess - one))
            out[y, x] = (lines[y, 1 + x] + (0, left, above, (left + above) // 2, paeth)[lines[y, 0]]) % 256
    return out.reshape((height, width, channels) if channels > 1 else (height, width)).astype(np.uint8)


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))


class Render(Folder):
    def test_arrays_are_the_files(self):
        drawn = ninebit.render(room, **small, ground_truth=True, output=self.folder)
        self.assertEqual((drawn.color.shape, drawn.color.dtype), ((48, 64, 4), np.uint8))
        self.assertEqual((drawn.depth.shape, drawn.depth.dtype), ((48, 64), np.uint32))
        np.testing.assert_array_equal(drawn.color[..., :3], pixels_of_png(self.folder / "color.png"))
        np.testing.assert_array_equal(drawn.stencil != 0, pixels_of_png(self.folder / "shadow.png") != 0)
        np.testing.assert_array_equal(drawn.pictures["error"], pixels_of_png(self.folder / "error.png"))
        self.assertEqual(drawn.layers["index_map"].shape, (6, 64, 64))
        self.assertEqual(drawn["pixels"]["shadowed"], np.count_nonzero(drawn.stencil))
        self.assertEqual(sum(drawn["pixels"].values()), 64 * 48)
        self.assertIn("by_cause", drawn["errors"])
        self.assertRegex(repr(drawn), r"^<ninebit.Rendering: 64 x 48 pixels, geforce2, index-cube: \d+ lit, \d+ shadowed, \d+ backg")
        self.assertTrue(drawn._repr_png_().startswith(b"\x89PNG"))
        again = pickle.loads(pickle.dumps(drawn))
        np.testing.assert_array_equal(again.color, drawn.color)

    @unittest.skipUnless(program_file, "NINEBIT_PROGRAM is not set")
    def test_the_program_says_the_same(self):
        for options in ({"technique": "shadow-map", "polygon_offset": (1.5, 8), "depth_encoding": "rgba8-modf"},
                        {"technique": "shadow-volume", "light_facing": True, "cull": "back"},
                        {"technique": "depth-cube", "depth_bits": 16, "bias": 0.25, "camera": (-1.0, 1.5, 3.0), "fov": 40},
                        {"index_step": 1, "index_scope": "object", "index_format": "la", "profile": "nv2a", "supersample": 2}):
            flags = []
            for name, value in {**options, "size": "64x48"}.items():
                text = ",".join(map(str, value)) if isinstance(value, tuple) else str(value)
                flags.append("--" + name.replace("_", "-") + ("" if value is True else f"={text}"))
            expected = by_program("render", room, *flags, "-o", self.folder)
            found = ninebit.render(room, **{**options, "size": (64, 48)})
            for key in ("hash", "pixels", "index", "technique", "profile", "size", "facts"):
                self.assertEqual(found[key], expected[key], (options, key))
            np.testing.assert_array_equal(found.color[..., :3], pixels_of_png(self.folder / "color.png"))

    def test_nothing_is_written_without_output(self):
        with tempfile.TemporaryDirectory() as folder:
            before = os.getcwd()
            os.chdir(folder)
            try:
                self.assertEqual(ninebit.render(room, **small)["files"], [])
                self.assertEqual(os.listdir(folder), [])
            finally:
                os.chdir(before)

    def test_layers_and_turntables(self):
        drawn = ninebit.render(room, **small, layers=True)
        self.assertEqual(drawn.layers["spare0"].shape[:2], (48, 64))
        self.assertEqual(drawn.layers["spare0"].dtype, np.int16)
        turned = ninebit.render(room, **small, turntable=3)
        self.assertEqual(turned.frames.shape, (3, 48, 64, 3))
        np.testing.assert_array_equal(turned.frames[0], drawn.color[..., :3])
        self.assertGreater(np.count_nonzero(turned.frames[1] != turned.frames[0]), 100)

    def test_pictures_of_this_process(self):
        faces = [np.full((32, 32, 3), 40 * i, np.uint8) for i in range(6)]
        lit, dark = (ninebit.render(room, **small, technique="light-cookie", cookie=cookie) for cookie in (faces, [0 * face for face in faces]))
        self.assertGreater(lit.color[..., :3].sum(), dark.color[..., :3].sum())

    def test_what_is_wrong_is_told(self):
        for options, error, message in (
                ({"index_order": "patch"}, ninebit.Error, "^index_order: patch not in {file,neighbour}"),
                ({"technique": "shadow-mop"}, ninebit.Error, "did you mean 'shadow-map'"),
                ({"index_stepp": 2}, TypeError, r"render\(\) has no option 'index_stepp'; did you mean 'index_step'\?; ninebit.options"),
                ({"size": 64}, ninebit.Error, "size"), ({"size": (0, 48)}, ninebit.Error, "size"),
                ({"layers": 1}, TypeError, "layers is 1; expected True or False"),
                ({"map_size": True}, TypeError, "map_size is True; expected a value"),
                ({"map_size": object()}, TypeError, "map_size is <object"),
                ({"camera": {}}, TypeError, "camera is {}"),
                ({"depth_bits": 16}, ninebit.Error, "depth_bits: technique index-cube does not read it; expected map_size"),
                ({"only": "color"}, ninebit.Error, "only names files; expected it with output"),
                ({"progress": 3}, TypeError, "progress is int"), ({"profile": "voodoo"}, ninebit.Error, "geforce2"),
                ({"output": "/proc/none/x"}, OSError, "/proc/none")):
            with self.assertRaisesRegex(error, message):
                ninebit.render(room, **options)
        with self.assertRaisesRegex(ninebit.Error, "missing.obj"):
            ninebit.render("missing.obj")
        with self.assertRaisesRegex(TypeError, "scene is int; expected a path"):
            ninebit.render(7)
        with self.assertRaisesRegex(AttributeError, "no attribute 'rendr'; did you mean 'render'"):
            ninebit.rendr

    def test_warnings_are_pythons(self):
        with self.assertWarnsRegex(UserWarning, "^tex0: 4 x 3 is resampled to powers of two") as caught:
            ninebit.draw(compare_gl, tex0=np.zeros((3, 4), np.uint8), size=(8, 8), filter0="trilinear")
        self.assertEqual(caught.filename, __file__)

    def test_options_are_listed(self):
        options = ninebit.options("render")
        self.assertIn("index_step", options)
        self.assertNotIn("json", options)
        with self.assertRaisesRegex(ninebit.Error, "did you mean 'render'"):
            ninebit.options("rendr")


class Draw(Folder):
    def test_a_program_on_an_array(self):
        picture = np.random.default_rng(3).integers(0, 256, (32, 64, 4), dtype=np.uint8)
        invert = "!!RC1.0\nout.rgb = unsigned_invert(tex0);\nout.a = tex0.a;"
        state = ninebit.State.parse(invert)
        drawn = ninebit.draw(state, tex0=picture, filter0="nearest", size=(64, 32))
        np.testing.assert_array_equal(drawn.color[..., :3], 255 - picture[..., :3])
        np.testing.assert_array_equal(drawn.color, ninebit.Program(state).evaluate(tex0=picture))
        self.assertEqual(drawn["program"], "State")
        self.assertRegex(repr(drawn), "64 x 32 pixels, geforce2, 1 pass>")

    def test_an_array_of_any_shape_keeps_its_size(self):
        picture = np.random.default_rng(4).integers(0, 256, (7, 11, 4), dtype=np.uint8)
        program = ninebit.State.parse("!!RC1.0\nout.rgb = unsigned_invert(tex0);\nout.a = tex0.a;")
        drawn = ninebit.draw(program, tex0=picture)
        np.testing.assert_array_equal(drawn.color, ninebit.Program(program).evaluate(tex0=picture))

    def test_arrays_that_are_no_pictures(self):
        program = effects / "programs" / "texture0.rc1"
        for wrong, message in (
                (np.zeros((128, 128)), r"tex0 is an array of float64 with the shape \(128, 128\); expected a picture: uint8 .*numpy.rint"),
                (np.zeros((8, 8), np.uint16), r"tex0 is an array of uint16 with the shape \(8, 8\); expected a picture"),
                (np.zeros((8, 8), bool), "tex0 is an array of bool"), (np.zeros(8, np.uint8), r"shape \(8,\)"),
                (np.zeros((8, 8, 5), np.uint8), r"shape \(8, 8, 5\)"), (np.zeros((0, 8), np.uint8), r"shape \(0, 8\)"),
                ([[0, 1], [2, 3]], "tex0 is list; expected a file"), (7, "tex0 is int; expected a file")):
            with self.assertRaisesRegex(TypeError, message) as caught:
                ninebit.draw(program, tex0=wrong)
            self.assertLess(len(str(caught.exception)), 300)
        with self.assertRaisesRegex(TypeError, r"camera is an array of float64 with the shape \(2, 2, 3\); expected a text"):
            ninebit.draw(program, camera=np.zeros((2, 2, 3)))

    def test_polygons_and_samplers(self):
        program = effects / "programs" / "texture0.rc1"
        black = np.zeros((8, 8, 4), np.uint8)
        drawn = ninebit.draw(program, tex0=black + 255, filter0="nearest", size=(8, 8), polygon_stipple=["1000", "0110"])
        self.assertEqual(drawn.color[..., 0].astype(bool).astype(int).tolist(), 4 * [[1, 0, 0, 0] * 2, [0, 1, 1, 0] * 2])
        drawn = ninebit.draw(program, tex0=black, filter0="nearest", wrap0="clamp-to-border", border_color0=(1, 0.5, 0, 1),
                             coord0="position", size=(8, 8))
        self.assertEqual(drawn.color[-1, 0].tolist(), [255, 128, 0, 255])
        with self.assertRaisesRegex(ninebit.Error, "a line width has no effect here"):
            ninebit.draw(program, tex0=black, line_width=2, line_smooth=False)

    def test_formats_of_surfaces(self):
        program = effects / "programs" / "texture0.rc1"
        picture = np.random.default_rng(5).integers(0, 256, (64, 64, 4), dtype=np.uint8)
        drawn = ninebit.draw(program, tex0=picture, filter0="nearest", size=(64, 64), color_format="r5g6b5").color
        for component, bits in enumerate((5, 6, 5)):
            kept = picture[..., component] >> (8 - bits)
            np.testing.assert_array_equal(drawn[..., component], kept << (8 - bits) | kept >> (2 * bits - 8))
        # Twelve bits of mantissa do not tell the sides of a cube apart in all pixels of its edges.
        exact, short = (ninebit.draw(program, tex0=picture, mesh="cube", camera=(0, 2, 3), size=(64, 64), depth_stencil=name).color
                        for name in ("d24s8", "f16"))
        self.assertTrue(0 < (exact != short).any(axis=2).sum() < 20)
        with self.assertRaisesRegex(ninebit.Error, "depth_stencil: d32 not in .*d24s8"):
            ninebit.draw(program, tex0=picture, depth_stencil="d32")

    def test_an_effect(self):
        drawn = ninebit.draw(effects / "toon.json", size=(64, 48), output=self.folder / "toon.png")
        np.testing.assert_array_equal(drawn.color, pixels_of_png(self.folder / "toon.png"))
        self.assertEqual(len({tuple(pixel) for pixel in drawn.color.reshape(-1, 4).tolist()}), 3)
        self.assertGreater(len(np.unique(drawn.depth)), 100)
        sepia = ninebit.draw(effects / "sepia.json", difference="nv2a", layers=True)
        self.assertEqual(sepia.pictures["difference"].shape, sepia.color.shape[:2])
        self.assertEqual(np.count_nonzero(sepia.pictures["difference"]), sepia["difference"]["pixels"])

    def test_what_is_wrong_is_told(self):
        for call, message in ((lambda: ninebit.draw(compare_gl, tex0=top / "none.png"), "none.png"),
                              (lambda: ninebit.draw(effects / "none.json"), "none.json"),
                              (lambda: ninebit.draw(effects / "toon.json", profile="voodoo"), "voodoo"),
                              (lambda: ninebit.draw(compare_gl, output="x.jpg"), "output x.jpg: expected a file whose name ends in .png")):
            with self.assertRaisesRegex(ninebit.Error, message):
                call()
        with self.assertRaisesRegex(TypeError, "program is float; expected a State, a Program, the path of a file, or the text"):
            ninebit.draw(1.5)

    def test_files_outside_are_read_only_if_allowed(self):
        (self.folder / "sub").mkdir()
        (self.folder / "p.rc1").write_text("!!RC1.0\nout.rgb = col0;\n")
        effect = self.folder / "sub" / "e.json"
        effect.write_text(json.dumps({"ninebit": "effect", "version": 1, "size": 4, "passes": [{"program": "../p.rc1"}]}))
        for call in (lambda **more: ninebit.draw(effect, **more),
                     lambda **more: ninebit.trace(effect=effect, pixel=(1, 1), **more)):
            with self.assertRaisesRegex(ninebit.Error, "'../p.rc1' leaves the folder .* allow_outside"):
                call()
            call(allow_outside=True)


class Compare(Folder):
    def test_settings_side_by_side(self):
        found = ninebit.compare(room, size=(64, 48), vary={"index_step": [1, 2], "map_size": [32, 64]}, output=self.folder)
        self.assertEqual(found.rows["name"].tolist()[:2], ["index-step 1, map-size 32", "index-step 1, map-size 64"])
        self.assertEqual(len(found.pictures), 4)
        self.assertTrue(all(picture.shape == (48, 64, 3) for picture in found.pictures.values()))
        for row in found.rows:
            self.assertEqual(np.count_nonzero(found.wrong[row["name"]]), row["errors.wrong"])
        self.assertEqual((self.folder / "index.html").exists(), True)
        self.assertIsNone(found.sheet)
        sheet = ninebit.compare(room, size=(64, 48), vary={"index_step": [1, 2]}, sheet=self.folder / "s.png").sheet
        self.assertEqual(sheet.shape[1:], (3 * 16 + 2 * 6 * 64, 3))
        self.assertTrue((self.folder / "s.png").exists())
        self.assertIn("srcdoc", found._repr_html_())
        self.assertRegex(repr(found), "^<ninebit.Comparison: 4 renderings of .*index_room.gltf, geforce2>$")
        offsets = ninebit.compare(room, size=(32, 24), technique="shadow-map", vary={"polygon_offset": [(0, 0), (1, 16)]})
        self.assertEqual(len(offsets.rows), 2)

    def test_techniques(self):
        found = ninebit.compare(room, **small)
        self.assertIn("shadow-volume", found.rows["technique"].tolist())
        with self.assertRaisesRegex(ninebit.Error, "'index-stp' cannot be varied.*did you mean 'index-step'"):
            ninebit.compare(room, vary={"index_stp": [1]})


class Study(Folder):
    def test_index_steps_counts_what_programs_compute(self):
        report = ninebit.study("index-steps", profile="geforce2", formats=["channel"], variants=["both-x4"], steps=range(1, 4))
        rows = report.rows
        self.assertEqual(rows.dtype.names, ("profile", "format", "variant", "step", "codes", "pairs", "false_matches"))
        self.assertEqual((rows["step"].tolist(), rows["step"].dtype), ([1, 2, 3], np.int64))
        self.assertEqual(rows["codes"].tolist(), [256, 128, 86])
        # The same by the program itself, pair by pair.
        a, b = np.meshgrid(np.arange(256), np.arange(256))
        alpha = ninebit.Program(compare_gl.read_text()).evaluate({"primary.r": a, "tex0.r": b}, registers=True)["spare1"][2]
        self.assertEqual(int(np.count_nonzero((alpha == 0) & (a != b))), int(rows["false_matches"][0]))
        self.assertRegex(repr(report), "^<ninebit.Report: ninebit study index-steps .*: rows 3>$")
        self.assertIn("srcdoc", report._repr_html_())

    def test_datapath(self):
        report = ninebit.study("datapath", profile="geforce2")
        rows = report.rows
        product = rows[(rows["operation"] == "product") & (rows["form"] == rows["form"][rows["operation"] == "product"][0])]
        self.assertGreater(len(product), 0)
        self.assertLess(rows["mean_error_codes"].max(), 1.0)

    def test_depth_packing(self):
        report = ninebit.study("depth-packing", packings="rgba8-fract", storages="round", depths="16")
        self.assertEqual(report.rows["count"].tolist(), [65536])
        self.assertEqual(len(report.tables["second_digit"]), 256)
        self.assertEqual(report.rows.dtype["max_error"], np.float64)

    def test_shadows_are_judged(self):
        rows = ninebit.study("shadows", room, size=(160, 120), map_sizes=[64, 256], steps=[1, 2]).rows
        self.assertEqual(rows["map_size"].tolist(), [64, 64, 256, 256])
        self.assertEqual(rows["index_step"].tolist(), [1, 2, 1, 2])
        wrong = dict(zip(zip(rows["map_size"].tolist(), rows["index_step"].tolist()), rows["wrong"].tolist()))
        self.assertLess(wrong[256, 2], wrong[64, 2])
        self.assertTrue(np.array_equal(rows["false_lit"] + rows["false_shadowed"], rows["wrong"]))

    def test_folders_and_parts(self):
        options = {"profile": "geforce2", "formats": "channel", "steps": "1-2"}
        for part in ("1/2", "2/2"):
            ninebit.study("index-steps", **options, output=self.folder / "parts", shard=part)
        parts = sorted((self.folder / "parts").glob("part-*.jsonl"))
        merged = ninebit.study("merge", *parts, output=self.folder / "out")
        self.assertEqual(merged.rows.tolist(), ninebit.study("index-steps", **options).rows.tolist())

    def test_what_is_wrong_is_told(self):
        for call, error, message in (
                (lambda: ninebit.study("index-step"), ninebit.Error, "unknown study 'index-step'.*did you mean 'index-steps'"),
                (lambda: ninebit.study("index-steps", formats=["rgba"]), ninebit.Error, "rgba"),
                (lambda: ninebit.study("index-steps", steps=(0, 3)), ninebit.Error, "steps"),
                (lambda: ninebit.study("shadows"), TypeError, "was given 0 arguments; expected a scene"),
                (lambda: ninebit.study("datapath", room), TypeError, "expected no argument"),
                (lambda: ninebit.study(3), TypeError, "study is int")):
            with self.assertRaisesRegex(error, message):
                call()


class Programs(Folder):
    def test_proofs(self):
        a, b = compare_gl, ninebit.State.parse(compare_gl.read_text())
        proof = ninebit.prove("equivalent", a, b, outputs=["out.a"])
        self.assertTrue(proof)
        self.assertEqual(proof["programs"], [str(a), "State"])
        differs = ninebit.prove("equivalent", b, ninebit.State.parse("!!RC1.0\nout.rgb = tex0;\nout.a = tex0.a;"))
        self.assertFalse(differs)
        self.assertIn("inputs", differs["counterexample"])
        self.assertRegex(repr(differs), "^<ninebit.Proof: equivalent refuted after .* cases>$")
        self.assertIn("fields", ninebit.prove("stable", b))
        self.assertFalse(ninebit.prove("discriminate", "geforce2", "nv2a"))
        other = ninebit.prove("equivalent", b, ninebit.State.parse(compare_gl.read_text(), profile="nv2a"), outputs="out.a")
        self.assertEqual((other["profile"], other["other_profile"]), ("geforce2", "nv2a"))
        with self.assertRaisesRegex(TypeError, "was given 1 arguments; expected 2"):
            ninebit.prove("equivalent", a)
        with self.assertRaisesRegex(ninebit.Error, "did you mean 'equivalent'"):
            ninebit.prove("equivalant", a, b)

    def test_traces_have_diagrams(self):
        state = ninebit.State.parse(compare_gl.read_text())
        trace = ninebit.trace(state, set={"primary.r": 102, "tex0": (101, 0, 0, 255)})
        same = ninebit.Program(state).trace({"primary.r": 102, "tex0": (101, 0, 0, 255)})
        self.assertEqual(trace["out"], same["out"])
        self.assertEqual(trace["stages"], same["stages"])
        for one in (trace, same, state, ninebit.Program(state)):
            self.assertIn("srcdoc", one._repr_html_())
        pixel = ninebit.trace(scene=room, pixel=(20, 20), **small)
        self.assertIn("stages", pixel)
        self.assertEqual(pixel["scene"]["pass"], "comparison")
        with self.assertRaisesRegex(ninebit.Error, "scene requires pixel"):
            ninebit.trace(scene=room)

    def test_texts(self):
        state = ninebit.State.parse(compare_gl.read_text())
        self.assertIn("spare0", str(ninebit.explain(compare_gl)))
        self.assertIn("srcdoc", ninebit.explain(state)._repr_html_())
        for form in ("gl", "rc10", "words", "json", "glsl", "c"):
            self.assertEqual(ninebit.convert(compare_gl, form), state.print(form), form)
            self.assertEqual(ninebit.convert(state, form), state.print(form), form)
        self.assertEqual(str(ninebit.explain(compare_gl.read_text())), str(ninebit.explain(compare_gl)))
        with self.assertRaisesRegex(TypeError, "a State is parsed already"):
            ninebit.convert(state, "gl", from_="gl")
        ninebit.convert(compare_gl, "gl", output=self.folder / "x.gl")
        self.assertEqual((self.folder / "x.gl").read_text(), state.print("gl"))

    def test_vectors(self):
        pack = ninebit.vectors(programs=200, fragments=2, seed=7, output=self.folder)
        self.assertEqual((self.folder / "vectors.txt").read_text(), pack.text)
        self.assertEqual((len(pack.programs), pack["programs"]), (200, 200))
        state = ninebit.State.parse(pack.programs[0])
        self.assertEqual(state.validate(), [])
        self.assertEqual(pack.rows["programs"].sum(), 200)
        self.assertEqual(ninebit.vectors(programs=200, fragments=2, seed=7).text, pack.text)


if __name__ == "__main__":
    warnings.simplefilter("error")
    unittest.main()
