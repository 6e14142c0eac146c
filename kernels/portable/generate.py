#!/usr/bin/env python3
"""Turns one kernel part into what the library builds in: SPIR-V, flat OpenCL C, and C++ in float and double.

A signature begins with a comment that the build reads:

    /* BUILD
       math: border                         files of kernels/math that the kernel uses
       module f32x4: CHANNELS=4 SRC=f32x4   one line per combination of options that is built
       modules READ TEXELS: f32x4 f32x4_f16x4   one module per kind of src and per formats of src and dst
    */
"""
import argparse
import pathlib
import re
import shutil
import struct
import subprocess
import sys

from spirv import forbid_contraction

ROOT = pathlib.Path(__file__).resolve().parents[2]
KERNELS = ROOT / "kernels"

TOKEN = re.compile(r"""
    (?P<comment>//[^\n]*|/\*.*?\*/)
  | (?P<hex>0[xX][0-9a-fA-F]+[uUlL]*)
  | (?P<real>(?:\d+\.\d*|\.\d+|\d+)(?:[eE][+-]?\d+)?[fF](?![\w.]))
  | (?P<number>(?:\d+\.\d*|\.\d+|\d+)(?:[eE][+-]?\d+)?\w*)
  | (?P<name>[A-Za-z_]\w*)
""", re.VERBOSE | re.DOTALL)


def to_double(text):
    """The same source in double: float, vecN, matN and the f suffixes rewritten; comments, hex numbers and longer names spared."""
    def swap(match):
        word = match.group()
        if match.lastgroup == "real":
            return word[:-1] if re.search(r"[.eE]", word) else word[:-1] + ".0"
        if match.lastgroup == "name":
            if word == "float":
                return "double"
            if re.fullmatch(r"(vec|mat)[234](x[234])?", word):
                return "d" + word
        return word
    return TOKEN.sub(swap, text)


# Words that some of the three languages reserves and the dialect does not use.
RESERVED = frozenset("""
    alignas alignof and and_eq asm auto bitand bitor catch char class compl concept consteval constexpr constinit const_cast
    co_await co_return co_yield decltype delete double dynamic_cast enum explicit export extern friend goto inline long mutable
    namespace new noexcept not not_eq nullptr operator or or_eq private protected public register reinterpret_cast requires
    short signed sizeof static static_assert static_cast template this thread_local throw try typedef typeid typename union
    unsigned using virtual volatile wchar_t xor xor_eq
    kernel global local constant half quad complex imaginary uchar ushort ulong size_t ptrdiff_t event_t sampler_t pipe
    image1d_t image2d_t image3d_t read_only write_only read_write vec_step as_float as_int as_uint
    attribute uniform varying buffer shared coherent restrict readonly writeonly atomic_uint layout centroid flat smooth
    noperspective patch sample invariant precise precision highp mediump lowp subroutine in out inout discard common partition
    active noinline external interface fixed superp input output filter cast resource sampler2DRect texture2D texture3D
    sampler2D sampler3D image2D image3D double2 double4 float2 float3 float4 float8 float16 int2 int3 int4 uint2 uint3 uint4
    dvec2 dvec3 dvec4 mat2x2 mat3x3 mat4x4 main barrier
""".split())
# Functions whose result the languages define differently, or not at all.
UNPORTABLE = re.compile(r"\b(round|rint|mix|dot|length|normalize|cross|fmod|fma|mad|mod|rsqrt|inversesqrt|native_\w+|half_\w+|fast_\w+|fmin|fmax|isnormal)\s*\(")


def lint(text):
    """Lines of complaint about kernel text: reserved words, functions that are not the same everywhere, stray includes."""
    complaints = []
    bare = re.sub(r"//[^\n]*|/\*.*?\*/", lambda match: "\n" * match.group().count("\n"), text, flags=re.DOTALL)
    for number, line in enumerate(bare.splitlines(), 1):
        for word in re.findall(r"[A-Za-z_]\w*", line):
            if word in RESERVED or word.startswith("gl_") or "__" in word:
                complaints.append(f"{number}: `{word}` is reserved in one of the three languages")
        complaints += [f"{number}: `{word}` is not the same in the three languages" for word in UNPORTABLE.findall(line)]
        if "#include" in line:
            complaints.append(f"{number}: kernel and math files include nothing; list math files in the signature")
    return complaints


def flatten(text):
    """Resolves the includes that the portable headers make of math files."""
    def include(match):
        return (KERNELS / match.group(1)).read_text()
    return re.sub(r'^#include "([^"]+)"\n', include, text, flags=re.MULTILINE)


PREFIX = {"READ": "", "TEXELS": "texels_", "IMAGE2D": "image_", "IMAGE_READ2D": "storage_"}


def pixel_modules(kinds, formats):
    """The modules that read src of each kind and format; `f16x4_f32x4` writes another format, `f32x4` the same."""
    for kind in kinds or [None]:
        for name in formats:
            src, _, dst = name.partition("_")
            options = {} if src.endswith("x4") else {"CHANNELS": src[-1]}
            if kind:
                options["SRC_KIND"] = kind
            yield PREFIX.get(kind, "") + name, {**options, "SRC": src, "DST": dst or src}


def read_mutants(path):
    """[(name, file under kernels/, text, its replacement)] of a list of deliberate faults, and the regular expression of the
    tests that are to notice them. Entries are blocks of four lines: name, file, "- text", "+ text"; text stands once in its file."""
    tests, *blocks = path.read_text().strip().split("\n\n")
    entries = [block.split("\n") for block in blocks]
    for entry in entries:
        if len(entry) != 4 or entry[2][:2] != "- " or entry[3][:2] != "+ ":
            sys.exit(f"{path}: four lines are expected: name, file, - text, + text; not {entry}")
        if (KERNELS / entry[1]).read_text().count(entry[2][2:]) != 1:
            sys.exit(f"{path}: {entry[0]}: its text does not stand once in {entry[1]}")
    return [(name, file, before[2:], after[2:]) for name, file, before, after in entries], tests.removeprefix("tests: ")


def with_mutant(spec, out):
    """A copy of the kernels, in `out`, with one deliberate fault. `spec`: a list, a colon, the number of a fault in it."""
    path, _, number = spec.rpartition(":")
    _, file, before, after = read_mutants(pathlib.Path(path))[0][int(number)]
    shutil.copytree(KERNELS, out, dirs_exist_ok=True)
    (out / file).write_text((KERNELS / file).read_text().replace(before, after))
    return out


def parse_build(signature):
    """(math files, [(module name, {option: value})]) of a signature's BUILD comment."""
    comment = re.match(r"/\* BUILD\n(.*?)\*/", signature, re.DOTALL)
    if not comment:
        sys.exit("a signature begins with /* BUILD ... */")
    math, modules = [], []
    for line in comment.group(1).splitlines():
        word, _, rest = line.strip().partition(":")
        if not word:
            continue
        if word == "math":
            math = rest.split()
        elif word.startswith("module "):
            modules.append((word.split()[1], dict(pair.split("=", 1) for pair in rest.split())))
        elif word.split()[0] == "modules" and set(word.split()[1:]) <= PREFIX.keys():
            modules += pixel_modules(word.split()[1:], rest.split())
        else:
            sys.exit(f"unknown line in BUILD: {line.strip()}")
    return math, modules


LISTS = ("PARAMETERS", "CONSTANTS", "SHAPE", "SHARED_MEMORY", "BINDINGS")


def defaults(signature):
    """Lists that a signature leaves out are empty."""
    return "".join(f"#define {name}(_)\n" for name in LISTS if not re.search(rf"#define {name}\(", signature)) + (
        "" if "#define PHASE_COUNT" in signature else "#define PHASE_COUNT 1\n")


def defines(options):
    options = {"CHANNELS": "4", **options}
    return "".join(f"#define {name} {value}\n" for name, value in options.items())


def glsl_text(source, options):
    return ("#version 450\n#extension GL_EXT_samplerless_texture_functions : require\n"
            "#extension GL_EXT_control_flow_attributes : require\n" + defines(options)
            + flatten((KERNELS / "portable/glsl.h").read_text()) + source["math"] + source["signature"]
            + "layout(push_constant) uniform Parameters { PARAMETERS(GLSL_PARAMETER) } params;\n"
            "CONSTANTS(GLSL_CONSTANT) SHAPE(GLSL_CONSTANT)\nSHARED_MEMORY(GLSL_SHARED)\nBINDINGS(GLSL_BINDING)\n"
            + source["kernel"])


def opencl_text(source, options):
    return (defines(options) + flatten((KERNELS / "portable/opencl.h").read_text()) + source["math"] + source["signature"]
            + "typedef struct { PARAMETERS(OCL_MEMBER) } Parameters;\n" + source["kernel"])


def compile_spirv(text, path, glslang):
    path.write_text(text)
    spv = path.with_suffix(".spv")
    done = subprocess.run([glslang, "-V", "--target-env", "vulkan1.1", "-S", "comp", str(path), "-o", str(spv)],
                          capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{path}: glslang refused the kernel\n{done.stdout}{done.stderr}")
    raw = spv.read_bytes()
    words = forbid_contraction(list(struct.unpack(f"<{len(raw) // 4}I", raw)))
    spv.write_bytes(struct.pack(f"<{len(words)}I", *words))
    return words


def literal(text):
    """A C++ string literal; long ones in pieces, which every compiler joins."""
    pieces = [text[i:i + 8000] for i in range(0, len(text), 8000)]
    return "\n".join(f'R"luxel({piece})luxel"' for piece in pieces)


def fnv1a(data):
    value = 0xcbf29ce484222325
    for byte in data:
        value = ((value ^ byte) * 0x100000001b3) & 0xffffffffffffffff
    return value


STRUCT = """namespace in_{precision} {{
#include "{portable}"
#include "{signature}"
struct Kernel : Invocation {{
CONSTANTS(CPP_CONSTANT) SHAPE(CPP_SHAPE)
struct {{ PARAMETERS(CPP_PARAMETER) }} params;
SHARED_MEMORY(CPP_SHARED)
BINDINGS(CPP_BINDING)
static constexpr int phases_ = PHASE_COUNT;
explicit Kernel([[maybe_unused]] const Dispatch& d_) {{
  [[maybe_unused]] int i_ = 0;
  PARAMETERS(CPP_PARAMETER_SET)
  i_ = 0;
  CONSTANTS(CPP_CONSTANT_SET)
  i_ = 0;
  BINDINGS(CPP_BINDING_SET)
  SHARED_MEMORY(CPP_SHARED_SET)
}}
{sources}}};
{tables}}}
{undefine}"""

TABLES = """const BindingInfo bindings[] = {BINDINGS(TABLE_BINDING) {}};
const ParameterInfo parameters[] = {PARAMETERS(TABLE_PARAMETER) {}};
const ConstantInfo constants[] = {CONSTANTS(TABLE_CONSTANT) SHAPE(TABLE_SHAPE) {}};
const SharedInfo shared[] = {SHARED_MEMORY(TABLE_SHARED) {}};
"""

MODULE = """const Module module{{"{kernel}", "{part}", "{name}", all(in_float::bindings), all(in_float::parameters),
    all(in_float::constants), all(in_float::shared), spirv, opencl, glsl, {hash}ull,
    run_workgroups<in_float::Kernel>, run_workgroups<in_double::Kernel>}};
}}
"""


def write(path, text):
    """Leaves an unchanged file alone, so that nothing is compiled again for it."""
    if not path.exists() or path.read_text() != text:
        path.write_text(text)


def cpp_in(precision, stem, math, out, part, signature):
    """The C++ execution of one module in float (the original files, as a debugger should show them) or double."""
    files = [KERNELS / "portable/cpp.h", out / f"{stem}.signature.float.h",
             *(KERNELS / f"math/{name}.h" for name in math), part.with_name(stem + ".kernel.h")]
    write(files[1], signature)
    text = "".join(path.read_text() for path in files)
    if precision == "double":
        doubles = [out / f"{stem}.{path.name.replace('.float', '').removesuffix('.h')}.double.h" for path in files]
        for path, double in zip(files, doubles):
            write(double, to_double(path.read_text()))
        files = doubles
    macros = dict.fromkeys(re.findall(r"^ *# *define (\w+)", text, re.MULTILINE))
    return STRUCT.format(precision=precision, portable=files[0], signature=files[1],
                         sources="".join(f'#include "{path}"\n' for path in files[2:]),
                         tables=TABLES if precision == "float" else "",
                         undefine="".join(f"#undef {macro}\n" for macro in macros))


def main():
    cli = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    cli.add_argument("--part", required=True, type=pathlib.Path, help="path of the part without its endings")
    cli.add_argument("--out", required=True, type=pathlib.Path)
    cli.add_argument("--glslang", default="glslangValidator")
    cli.add_argument("--mutant", help="LIST:NUMBER, a deliberate fault that is built in")
    args = cli.parse_args()
    part, out = args.part, args.out
    if args.mutant:
        global KERNELS
        copy = with_mutant(args.mutant, out / "mutants" / part.name)
        part = copy / part.resolve().relative_to(KERNELS)
        KERNELS = copy
    stem = part.name
    signature = part.with_name(stem + ".signature.h").read_text()
    math, modules = parse_build(signature)
    source = {"signature": defaults(signature) + signature, "kernel": part.with_name(stem + ".kernel.h").read_text(),
              "math": "".join((KERNELS / f"math/{name}.h").read_text() for name in math)}
    out.mkdir(parents=True, exist_ok=True)
    files = [part.with_name(stem + ".signature.h"), part.with_name(stem + ".kernel.h"),
             *(KERNELS / f"math/{name}.h" for name in math)]
    complaints = [f"{path}:{line}" for path in files for line in lint(path.read_text())]
    if complaints:
        sys.exit("\n".join(complaints))

    cpp = ['#include "host/module_table.h"\n#include "host/reference/words.h"\n\nnamespace luxel::reference {\nnamespace {\n'
           "// All but the entry that keeps an array from being empty.\n"
           "template <class T, std::size_t N> constexpr std::span<const T> all(const T (&array)[N]) { return {array, N - 1}; }\n"]
    for name, options in modules:
        glsl, opencl = glsl_text(source, options), opencl_text(source, options)
        spirv = compile_spirv(glsl, out / f"{stem}.{name}.comp", args.glslang)
        write(out / f"{stem}.{name}.cl", opencl)
        cpp += [f"namespace module_{name} {{\n", defines(options)]
        cpp += [cpp_in(precision, stem, math, out, part, source["signature"]) for precision in ("float", "double")]
        cpp += [f"#undef {option}\n" for option in {"CHANNELS": 4, **options}]
        cpp += ["const std::uint32_t spirv[] = {", ",".join(map(str, spirv)), "};\n"]
        cpp += [f"const char opencl[] = {literal(opencl)};\nconst char glsl[] = {literal(glsl)};\n"]
        cpp += [MODULE.format(kernel=part.parent.name, part=stem, name=name, hash=fnv1a((glsl + opencl).encode()))]
    pointers = ", ".join(f"&reference::module_{name}::module" for name, _ in modules)
    cpp += [f"}}\n}}\n\nnamespace luxel::built_in {{\nextern const std::span<const Module* const> {stem};\n"
            f"const Module* const {stem}_modules[] = {{{pointers}}};\n"
            f"const std::span<const Module* const> {stem}({stem}_modules);\n}}\n"]
    write(out / f"{stem}.cpp", "".join(cpp))


if __name__ == "__main__":
    main()
