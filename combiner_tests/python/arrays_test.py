"""Program.evaluate with the types and shapes that NumPy has."""
import unittest

import ninebit
import numpy as np

# red: tex0 · primary; green and blue: tex0; alpha: tex0's.
TEXT = """!!RC1.0
{ rgb { spare0 = tex0 * col0; } alpha { spare0 = tex0; } }
out.rgb = spare0; out.a = spare0;
"""
program = ninebit.Program(TEXT)
random = np.random.default_rng(5)


def by_planes(tex0, primary=255):
    """The same of separate planes, fragment by fragment."""
    tex0 = np.asarray(tex0).astype(int)
    return np.stack([tex0[..., c] * primary // 255 for c in range(3)] + [tex0[..., 3]], axis=-1)


class Shapes(unittest.TestCase):
    def test_a_picture_gives_a_picture(self):
        for dtype in (np.uint8, np.int8, np.int16, np.uint16, np.int32, np.uint64, ">i2", ">u4"):
            picture = random.integers(0, 128, (5, 7, 4)).astype(dtype)
            out = program.evaluate(tex0=picture, primary=200)
            self.assertEqual((out.shape, out.dtype), ((5, 7, 4), np.int16), dtype)
            np.testing.assert_array_equal(out, by_planes(picture, 200), str(dtype))

    def test_planes_give_planes(self):
        picture = random.integers(0, 256, (5, 7, 4), dtype=np.uint8)
        planes = np.moveaxis(picture, -1, 0)
        expected = np.moveaxis(by_planes(picture), -1, 0)
        np.testing.assert_array_equal(program.evaluate({"tex0": planes, "primary": 255}), expected)
        separate = {f"tex0.{c}": plane for c, plane in zip("rgba", planes)}
        out = program.evaluate(separate, primary=255)
        self.assertEqual(out.shape, (4, 5, 7))
        np.testing.assert_array_equal(out, expected)

    def test_strides_of_any_kind(self):
        picture = random.integers(0, 256, (12, 16, 4), dtype=np.uint8)
        for view in (picture[::2], picture[:, ::-3], picture[::-1, ::-1], picture.transpose(1, 0, 2),
                     np.asfortranarray(picture), picture[3:4], np.broadcast_to(picture[0], (5, 16, 4))):
            np.testing.assert_array_equal(program.evaluate(tex0=view, primary=99), by_planes(view, 99))
        misaligned = np.frombuffer(bytes(1) + picture.astype("<i2").tobytes(), "<i2", offset=1).reshape(picture.shape)
        np.testing.assert_array_equal(program.evaluate(tex0=misaligned, primary=99), by_planes(picture, 99))

    def test_lists_scalars_and_broadcasting(self):
        self.assertEqual(program.evaluate({"tex0.r": 100, "primary.r": 255}).tolist(), [100, 0, 0, 255])
        self.assertEqual(program.evaluate(tex0=[1, 2, 3, 4], primary=255).tolist(), [1, 2, 3, 4])
        self.assertEqual(program.evaluate(tex0=(1, 2, 3), primary=255).tolist(), [1, 2, 3, 255])
        self.assertEqual(program.evaluate({"tex0.r": [1, 2], "primary.r": [[255], [0]]})[0].tolist(), [[1, 2], [0, 0]])
        photo = random.integers(0, 256, (3, 9, 3), dtype=np.uint8)
        with self.assertRaisesRegex(ninebit.Error, r"\(3, 9, 3\).*expected axis=0 or axis=-1"):
            program.evaluate(tex0=photo)
        out = program.evaluate(tex0=photo, primary=255, axis=-1)
        np.testing.assert_array_equal(out[..., :3], photo)
        np.testing.assert_array_equal(out[..., 3], 255)
        self.assertEqual(program.evaluate(tex0=np.zeros((0, 5, 4), int)).shape, (0, 5, 4))
        self.assertEqual(program.evaluate({"tex0.r": []}).shape, (4, 0))
        self.assertEqual(program.evaluate({"tex0.r": np.int8(-1)}).shape, (4,))
        # One plane beside a picture.
        mask = np.zeros((5, 7), np.uint8)
        picture = random.integers(0, 256, (5, 7, 4), dtype=np.uint8)
        self.assertEqual(program.evaluate({"tex0": picture, "primary.r": mask})[..., 0].max(), 0)

    def test_registers_have_the_same_layout(self):
        picture = random.integers(0, 256, (5, 7, 4), dtype=np.uint8)
        left = program.evaluate(tex0=picture, primary=255, registers=True)
        np.testing.assert_array_equal(left["tex0"], picture)
        np.testing.assert_array_equal(left["out"], by_planes(picture))
        self.assertEqual({array.shape for array in left.values()}, {(5, 7, 4)})

    def test_what_is_not_given_is_the_profiles(self):
        for source, geforce2, nv2a in (("col1.a", 255, 0), ("fog.a", 255, 255), ("tex1.a", 255, 255), ("spare0.a", 255, 255)):
            text = f"!!RC1.0\nout.rgb = {source};\nout.a = zero;\n"
            for profile, code in (("geforce2", geforce2), ("nv2a", nv2a)):
                one = ninebit.Program(text, profile=profile)
                self.assertEqual(one.evaluate({"primary.r": 1}).tolist(), [code, code, code, 0], (source, profile))
                self.assertEqual(one.trace({"primary.r": 1})["out"]["codes"], [code, code, code, 0], (source, profile))

    def test_spare0s_alpha_is_texture_0s_unless_it_is_given(self):
        shown = ninebit.Program("!!RC1.0\nout.rgb = spare0.a;\nout.a = zero;\n")
        for given, code in (({"tex0.a": 31}, 31), ({"tex0.a": 31, "spare0.a": 77}, 77), ({"spare0.a": 5}, 5)):
            self.assertEqual(shown.evaluate(given).tolist(), [code, code, code, 0], given)
            self.assertEqual(shown.trace(given)["out"]["codes"], [code, code, code, 0], given)

    def test_registers_have_constants_and_what_stages_wrote(self):
        text = "!!RC1.0\nconst1 = (1, 0, 0, 0.2);\n{ rgb { spare0 = tex0 * const1; } }\nout.rgb = spare0;\nout.a = zero;\n"
        for profile in ("geforce2", "ideal"):
            one = ninebit.Program(text, profile=profile)
            left = one.evaluate({"tex0.r": 40}, registers=True)
            self.assertEqual((left["const1"].tolist(), left["spare0"].tolist()[:3]), ([255, 0, 0, 51], [40, 0, 0]), profile)
            varied = one.evaluate({"tex0.r": 40, "const1.r": [255, 0]}, registers=True)
            self.assertEqual(varied["spare0"][0].tolist(), [40, 0], profile)

    def test_registers_have_their_names_in_the_languages(self):
        expected = program.evaluate(tex0=[9, 8, 7, 6], primary=[4, 3, 2, 1]).tolist()
        self.assertEqual(program.evaluate(t0=[9, 8, 7, 6], v0=[4, 3, 2, 1]).tolist(), expected)
        self.assertEqual(program.evaluate({"tex0": [9, 8, 7, 6], "col0": [4, 3, 2, 1]}).tolist(), expected)
        self.assertEqual(program.trace({"t0.r": 9, "v0.r": 255})["out"], program.trace({"tex0.r": 9, "col0.r": 255})["out"])
        with self.assertRaisesRegex(ninebit.Error, "tex0.r is given twice"):
            program.evaluate({"tex0.r": 1, "t0.r": 2})

    def test_out(self):
        picture = random.integers(0, 256, (5, 7, 4), dtype=np.uint8)
        for out in (np.empty((5, 7, 4), np.uint8), np.empty((5, 7, 4), np.int64), np.empty((10, 7, 4), np.int16)[::2], picture):
            expected = by_planes(picture)
            self.assertIs(program.evaluate(tex0=picture, primary=255, out=out), out)
            np.testing.assert_array_equal(out, expected)
        read_only = np.empty((5, 7, 4), np.uint8)
        read_only.flags.writeable = False
        for out, error, message in ((np.empty((5, 7, 4), np.int8), TypeError, "array of int8.*hold codes from 0 to 255"),
                                    (np.empty((5, 7, 4)), TypeError, "float64"), ([], TypeError, "out is list"),
                                    (np.empty((4, 5, 7), int), ninebit.Error, r"\(4, 5, 7\); expected \(5, 7, 4\)"),
                                    (read_only, ninebit.Error, "read-only")):
            with self.assertRaisesRegex(error, message):
                program.evaluate(tex0=picture, out=out)
        # A code that is out of range leaves `out` as it was.
        codes = np.zeros(2000, np.int16)
        codes[-1] = 300
        for out in (np.full((4, 2000), 7), np.full((4, 2000), 7, np.int16)):
            with self.assertRaisesRegex(ninebit.Error, "the code 300"):
                program.evaluate({"tex0.r": codes}, out=out)
            self.assertTrue((out == 7).all())

    def test_out_may_share_the_memory_of_inputs(self):
        for share in (lambda a: a[::-1], lambda a: a[:, ::-1], lambda a: a):
            picture = random.integers(0, 256, (40, 50, 4), dtype=np.uint8)
            expected = by_planes(share(picture))
            program.evaluate(tex0=share(picture), primary=255, out=picture)
            np.testing.assert_array_equal(picture, expected)

    def test_many_fragments_are_evaluated_in_parts(self):
        picture = random.integers(0, 256, (700, 1001, 4), dtype=np.uint8)
        expected = by_planes(picture)
        np.testing.assert_array_equal(program.evaluate(tex0=picture, primary=255), expected)
        planes = program.evaluate(tex0=np.moveaxis(picture, -1, 0).astype(np.int16), primary=255, axis=0)
        np.testing.assert_array_equal(np.moveaxis(planes, 0, -1), expected)


class Refusals(unittest.TestCase):
    def test_types(self):
        for wrong, message in ((np.zeros(3), r"tex0.r is an array of float64; expected codes.*rint\(255 \* x\)"), (0.5, "is float"),
                               (True, "is bool"), (np.zeros(3, bool), "array of bool"), (None, "is NoneType; expected whole"),
                               ("1", "is str"), ([1, None], "is list"), (np.zeros(2, complex), "complex128"), ([0.5], "list of float64"),
                               (np.ma.masked_array([1, 2], [0, 1]), "masked array"), (np.array(["a"]), "<U1"), (object(), "is object")):
            with self.assertRaisesRegex(TypeError, message):
                program.evaluate({"tex0.r": wrong})
        with self.assertRaisesRegex(ninebit.Error, "tex0.r is not an array"):
            program.evaluate({"tex0.r": [[1], [2, 3]]})

    def test_codes(self):
        for wrong in (256, -256, [0, 256], np.uint64(2**63), np.array([-300])):
            with self.assertRaisesRegex(ninebit.Error, "tex0.r has the code .*; expected -255 to 255"):
                program.evaluate({"tex0.r": wrong})
        half = ninebit.Program(TEXT, profile="geforce256-8bit")
        with self.assertRaisesRegex(ninebit.Error, f"expected {half.lowest} to {half.one}"):
            half.evaluate(tex0=np.full((2, 2, 4), 255, np.uint8))

    def test_names(self):
        for call, error, message in (
                (lambda: program.evaluate({"tex.r": 1}), ninebit.Error, "'tex.r' is not a register; expected one of const0"),
                (lambda: program.evaluate({"primry": 1}), ninebit.Error, "did you mean 'primary'"),
                (lambda: program.evaluate(tex9=1), TypeError, "'tex9' is not a register or an option.*did you mean 'tex0'"),
                (lambda: program.evaluate(tex0=1, registrs=True), TypeError, "did you mean 'registers'"),
                (lambda: program.evaluate({7: 1}), TypeError, "must be str.* not int"),
                (lambda: program.evaluate([1]), TypeError, "dictionary of registers.* not list"),
                (lambda: program.evaluate(), ninebit.Error, "no inputs"),
                (lambda: program.evaluate({"tex0": 1}, tex0=2), TypeError, "given twice"),
                (lambda: program.evaluate({"tex0": 1, "tex0.r": 2}), ninebit.Error, "tex0.r is given twice")):
            with self.assertRaisesRegex(error, message):
                call()

    def test_shapes(self):
        for inputs, message in (({"tex0": [1, 2]}, r"\(2,\); expected one colour of 3 or 4 components"),
                                ({"tex0": np.zeros((2, 5), int)}, "expected 3 or 4 components along the first or the last axis"),
                                ({"tex0.r": [1, 2], "primary.r": [1, 2, 3]}, r"do not broadcast together: tex0.r \(2,\), primary.r \(3,\)"),
                                ({"tex0": np.zeros((4, 9), int), "tex1": np.zeros((9, 4), int)}, r"tex1 has the shape \(9, 4\); expected 3 or 4 components along axis 0, as axis or another register says")):
            with self.assertRaisesRegex(ninebit.Error, message):
                program.evaluate(inputs)
        with self.assertRaisesRegex(ninebit.Error, "axis is 1; expected 0 or -1"):
            program.evaluate(tex0=1, axis=1)
        with self.assertRaisesRegex(ninebit.Error, "along axis 0"):
            program.evaluate(tex0=np.zeros((9, 4), int), axis=0)


if __name__ == "__main__":
    unittest.main()
