#!/usr/bin/env python3
"""The build step that turns kernels into three languages: the rewrite to double, the lint, NoContraction."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "kernels/portable"))
import generate


class ToDouble(unittest.TestCase):
    def check(self, text, expected):
        self.assertEqual(generate.to_double(text), expected)

    def test_types(self):
        self.check("float a; vec2 b; vec3 c; vec4 d; mat3 e; mat2x4 f;", "double a; dvec2 b; dvec3 c; dvec4 d; dmat3 e; dmat2x4 f;")
        self.check("float(x) + vec4(1)", "double(x) + dvec4(1)")

    def test_integer_types_stay(self):
        self.check("ivec2 a; uvec4 b; uint c; int d; bool e;", "ivec2 a; uvec4 b; uint c; int d; bool e;")

    def test_suffixes(self):
        self.check("1.0f 1.f .5f 1e-3f 2.5E+7F 1f", "1.0 1. .5 1e-3 2.5E+7 1.0")
        self.check("1.0 3u 7 2.5e3", "1.0 3u 7 2.5e3")

    def test_hex_numbers_stay(self):
        self.check("0x1f 0xFF 0x7f800000u 0x0f", "0x1f 0xFF 0x7f800000u 0x0f")

    def test_longer_names_stay(self):
        text = "floatBitsToUint(x) my_float float_ afloat vec4_at uintBitsToFloat avec4 vec5 f1f x1f e1f _1f"
        self.check(text, text)

    def test_names_of_formats_and_pasted_macros_stay(self):
        self.check("_(READ, 0, f32x4, src) CPP_TYPE_float LOAD_vec4", "_(READ, 0, f32x4, src) CPP_TYPE_float LOAD_vec4")
        self.check("_(READ, 0, float, numbers)", "_(READ, 0, double, numbers)")

    def test_comments_stay(self):
        self.check("// a float of 1.0f\n/* vec4\n 2.0f */ float x;", "// a float of 1.0f\n/* vec4\n 2.0f */ double x;")

    def test_adjacent_operators(self):
        self.check("a-1.0f*b/2.f+c.x", "a-1.0*b/2.+c.x")
        self.check("v.xyzw*1.0f", "v.xyzw*1.0")
        self.check("x<1.0f?vec2(0.0f):y", "x<1.0?dvec2(0.0):y")


class Lint(unittest.TestCase):
    def test_reserved(self):
        for word in ("half", "sample", "input", "filter", "kernel", "class", "and", "buffer", "this", "global", "main"):
            self.assertTrue(generate.lint(f"float {word} = 1.0f;"), word)

    def test_unportable(self):
        for call in ("round(x)", "mix(a, b, t)", "dot(u, v)", "fma(a, b, c)", "native_exp(x)", "mod(a, b)", "inversesqrt(x)"):
            self.assertTrue(generate.lint(f"float y = {call};"), call)

    def test_includes(self):
        self.assertTrue(generate.lint('#include "math/border.h"'))

    def test_line_numbers(self):
        self.assertEqual(generate.lint("/* a\n b */\nfloat half;")[0].split(":")[0], "3")

    def test_clean(self):
        self.assertEqual(generate.lint("// the kernel samples a half buffer\nFN float f(float x) { return x * 2.0f; }"), [])

    def test_every_kernel_is_clean(self):
        files = [*generate.KERNELS.glob("*/*.kernel.h"), *generate.KERNELS.glob("*/*.signature.h"), *generate.KERNELS.glob("math/*.h")]
        self.assertGreater(len(files), 3)
        for path in files:
            self.assertEqual(generate.lint(path.read_text()), [], path)


class NoContraction(unittest.TestCase):
    def test_every_float_result_is_decorated(self):
        text = ("#version 450\nlayout(std430, binding = 0) buffer B { float v[]; };\nlayout(local_size_x = 1) in;\n"
                "void main() { v[0] = v[1] * v[2] + v[3] / v[4] - (-v[5]); int i = 3; v[6] = float(i * 4); }\n")
        with tempfile.TemporaryDirectory() as folder:
            words = generate.compile_spirv(text, pathlib.Path(folder) / "a.comp", "glslangValidator")
            check = subprocess.run(["spirv-val", str(pathlib.Path(folder) / "a.spv")], capture_output=True, text=True)
        self.assertEqual(check.returncode, 0, check.stdout + check.stderr)
        results, decorated, at = set(), set(), 5
        while at < len(words):
            opcode, count = words[at] & 0xffff, words[at] >> 16
            if opcode in (127, 129, 131, 133, 136):  # OpFNegate, OpFAdd, OpFSub, OpFMul, OpFDiv
                results.add(words[at + 2])
            if opcode == 71 and words[at + 2] == 42:
                decorated.add(words[at + 1])
            at += count
        self.assertEqual(len(results), 5)
        self.assertEqual(results, decorated)


class Build(unittest.TestCase):
    def test_comment(self):
        math, modules = generate.parse_build("/* BUILD\n   math: border packing\n   module a: X=1 Y=f32x4\n   module b:\n*/\n")
        self.assertEqual(math, ["border", "packing"])
        self.assertEqual(modules, [("a", {"X": "1", "Y": "f32x4"}), ("b", {})])

    def test_pixels(self):
        _, modules = generate.parse_build("/* BUILD\n   modules READ TEXELS: f32x1 f16x4_f32x4\n   modules: unorm8x4\n*/\n")
        self.assertEqual(modules, [("f32x1", {"CHANNELS": "1", "SRC_KIND": "READ", "SRC": "f32x1", "DST": "f32x1"}),
                                   ("f16x4_f32x4", {"SRC_KIND": "READ", "SRC": "f16x4", "DST": "f32x4"}),
                                   ("texels_f32x1", {"CHANNELS": "1", "SRC_KIND": "TEXELS", "SRC": "f32x1", "DST": "f32x1"}),
                                   ("texels_f16x4_f32x4", {"SRC_KIND": "TEXELS", "SRC": "f16x4", "DST": "f32x4"}),
                                   ("unorm8x4", {"SRC": "unorm8x4", "DST": "unorm8x4"})])

    def test_unknown_kind(self):
        with self.assertRaises(SystemExit):
            generate.parse_build("/* BUILD\n   modules READS: f32x1\n*/\n")

    def test_missing_comment(self):
        with self.assertRaises(SystemExit):
            generate.parse_build("#define PARAMETERS(_)\n")


class Mutants(unittest.TestCase):
    def test_every_list_fits_the_kernels(self):
        lists = sorted((generate.ROOT / "tests/mutants").glob("*.txt"))
        self.assertGreaterEqual(len(lists), 8)
        for path in lists:
            mutants, tests = generate.read_mutants(path)
            self.assertTrue(mutants and tests, path)
            for name, _, before, after in mutants:
                self.assertNotEqual(before, after, f"{path}: {name}")

    def test_one_fault_is_built_in(self):
        with tempfile.TemporaryDirectory() as folder:
            path = generate.ROOT / "tests/mutants/mip_build.txt"
            _, file, before, after = generate.read_mutants(path)[0][0]
            copy = generate.with_mutant(f"{path}:0", pathlib.Path(folder) / "kernels")
            self.assertEqual((copy / file).read_text(), (generate.KERNELS / file).read_text().replace(before, after))
            changed = [p for p in copy.rglob("*") if p.is_file() and p.read_bytes() != (generate.KERNELS / p.relative_to(copy)).read_bytes()]
            self.assertEqual(changed, [copy / file])

    def test_a_text_that_is_not_there_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.txt"
            path.write_text("tests: ^a_\n\nnothing\nmath/bound.h\n- no such text\n+ other\n")
            with self.assertRaisesRegex(SystemExit, "does not stand once"):
                generate.read_mutants(path)


if __name__ == "__main__":
    unittest.main()
