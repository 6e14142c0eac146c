#!/usr/bin/env python3
"""What `luxel emit` writes, run without luxel: each format's result against luxel's own, bit for bit.

    emit_test.py PROGRAM EMITTED_SPIRV EXAMPLES quick|full [NAME...]     NAME: only these tests
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import numpy

PROGRAM, EMITTED_SPIRV, EXAMPLES, LABEL = sys.argv[1:5]
ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "kernels/portable"))
import spirv  # noqa: E402

failures = []


def run(*command, status=0, env=None):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, env=env)
    if done.returncode != status:
        raise AssertionError(f"{' '.join(str(w) for w in command)}: status {done.returncode}\n{done.stdout}{done.stderr}"[:3000])
    return done.stdout + done.stderr


def emit(kernel, *arguments, out):
    run(PROGRAM, "emit", kernel, *arguments, "-o", out)
    manifest = json.loads((out / f"{kernel}.json").read_text())
    check_manifest(manifest, out)
    return manifest


def check_manifest(manifest, out):
    """The schema's own words, as far as a reader depends on them (docs/emit.schema.json)."""
    schema = json.loads((ROOT / "docs/emit.schema.json").read_text())
    check(manifest, schema, schema, "manifest")
    shaders = {s["name"]: s for s in manifest["shaders"]}
    for shader in shaders.values():
        for file in shader["files"].values():
            assert (out / file).stat().st_size > 0, file
        offsets = [m["offset"] for m in shader["parameters"]["members"]]
        assert offsets == list(range(0, shader["parameters"]["bytes"], 4)), offsets
    known = {x["name"] for part in ("resources", "scratch", "tables") for x in manifest[part]}
    for item in manifest["passes"]:
        shader = shaders[item["shader"]]
        assert set(item["bind"]) == {b["name"] for b in shader["bindings"]}, item["label"]
        assert set(item["bind"].values()) <= known, item["label"]
        assert set(item["parameters"]) == {m["name"] for m in shader["parameters"]["members"]}, item["label"]


TYPES = {"object": dict, "array": list, "string": str, "integer": int, "number": (int, float), "boolean": bool,
         "null": type(None)}


def check(value, rule, schema, where):
    """As much of JSON Schema as the published schema uses."""
    if "$ref" in rule:
        rule = schema["$defs"][rule["$ref"].rsplit("/", 1)[1]]
    kinds = rule.get("type", list(TYPES))
    kinds = kinds if isinstance(kinds, list) else [kinds]
    assert any(isinstance(value, TYPES[k]) and not (k in ("integer", "number") and isinstance(value, bool)) for k in kinds), \
        f"{where} is {value!r}; expected {kinds}"
    if "enum" in rule:
        assert value in rule["enum"], f"{where} is {value!r}; expected one of {rule['enum']}"
    if isinstance(value, dict):
        for name in rule.get("required", []):
            assert name in value, f"{where} has no {name}"
        for name, inner in value.items():
            if name in rule.get("properties", {}):
                check(inner, rule["properties"][name], schema, f"{where}.{name}")
            elif isinstance(rule.get("additionalProperties"), dict):
                check(inner, rule["additionalProperties"], schema, f"{where}.{name}")
            else:
                assert rule.get("additionalProperties", True), f"{where} has {name}, which the schema does not know"
    if isinstance(value, list) and "items" in rule:
        for i, inner in enumerate(value):
            check(inner, rule["items"], schema, f"{where}[{i}]")


def cpp_main(manifest):
    """A program that runs the emitted C++ by the manifest: RESOURCE=FILE as the examples take them."""
    lines = [f'#include "{s["files"]["cpp"]}"' for s in manifest["shaders"]]
    lines += ["#include <cstdio>", "#include <map>", "#include <string>", "#include <vector>", "int main(int argc, char** argv) {",
              "  std::map<std::string, std::vector<char>> memory;"]
    for part in ("resources", "scratch", "tables"):
        lines += [f'  memory["{x["name"]}"].resize({x["bytes"]});' for x in manifest[part]]
    for t in manifest["tables"]:
        lines.append("  { const float values[] = {%s}; std::memcpy(memory[\"%s\"].data(), values, sizeof values); }" %
                     (", ".join(repr(float(v)) + "f" for v in t["values"]), t["name"]))
    written = {r["name"] for r in manifest["resources"] if r["written"]}
    lines += ["  std::map<std::string, std::string> files;",
              "  for (int i = 1; i < argc; ++i) { const std::string w = argv[i]; const auto at = w.find('=');",
              "    files[w.substr(0, at)] = w.substr(at + 1); }"]
    for name in (r["name"] for r in manifest["resources"]):
        if name not in written:
            lines.append(f'  if (files.count("{name}")) {{ std::FILE* f = std::fopen(files["{name}"].c_str(), "rb"); '
                         f'auto& m = memory["{name}"]; if (!f || std::fread(m.data(), 1, m.size(), f) != m.size()) return 1; '
                         "std::fclose(f); }")
    for item in manifest["passes"]:
        shader = next(s for s in manifest["shaders"] if s["name"] == item["shader"])
        lines.append(f"  {{ {shader['entry']['cpp']} kernel;")
        for name, value in item["parameters"].items():
            kind = next(m["type"] for m in shader["parameters"]["members"] if m["name"] == name)
            text = repr(float(value["value"])) + "f" if kind == "f32" else str(int(value["value"]))
            lines.append(f"    kernel.params.{name} = {text};")
        for name, what in item["bind"].items():
            lines.append(f'    kernel.{name} = reinterpret_cast<decltype(kernel.{name})>(memory["{what}"].data());')
        lines.append(f"    kernel.run(glm::ivec3({', '.join(map(str, item['groups']))})); }}")
    for name in written:
        lines.append(f'  if (files.count("{name}")) {{ std::FILE* f = std::fopen(files["{name}"].c_str(), "wb"); '
                     f'std::fwrite(memory["{name}"].data(), 1, memory["{name}"].size(), f); std::fclose(f); }}')
    return "\n".join(lines) + "\n  return 0;\n}\n"


def run_all(manifest, out, given, results):
    """The bytes of `results` by every format, after `given` (resource -> array)."""
    words = []
    for name, values in given.items():
        values.tofile(out / f"{name}.raw")
        words.append(f"{name}={out / name}.raw")
    answers = {}
    layers = {**os.environ, "VK_INSTANCE_LAYERS": "VK_LAYER_KHRONOS_validation",
              "VK_LAYER_ENABLES": "VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT"}

    def collect(which, *command):
        files = {name: out / f"{which}_{name}.raw" for name in results}
        said = run(*command, *words, *(f"{n}={f}" for n, f in files.items()), env=layers)
        assert "VUID" not in said and "SYNC-HAZARD" not in said, said  # what Vulkan forbids
        answers[which] = {n: f.read_bytes() for n, f in files.items()}
    path = out / f"{manifest['kernel']}.json"
    collect("spirv", EMITTED_SPIRV, path)
    collect("opencl", sys.executable, pathlib.Path(EXAMPLES) / "emitted_opencl.py", path)
    # GLSL: compiled here, as an engine does with its own build, and kept from contraction as kernels/portable/spirv.py does.
    glsl = out / "by_glsl"
    glsl.mkdir()
    shutil.copy(path, glsl)
    for shader in manifest["shaders"]:
        binary = glsl / shader["files"]["spirv"]
        run("glslangValidator", "-V", "--target-env", "vulkan1.1", out / shader["files"]["glsl"], "-o", binary)
        numpy.array(spirv.forbid_contraction(numpy.fromfile(binary, numpy.uint32).tolist()), numpy.uint32).tofile(binary)
        run("spirv-val", "--target-env", "vulkan1.1", out / shader["files"]["spirv"])
    collect("glsl", EMITTED_SPIRV, glsl / path.name)
    (out / "main.cpp").write_text(cpp_main(manifest))
    run("g++", "-std=c++17", "-O1", "-Wall", "-Wextra", "-Werror", "-ffp-contract=off", out / "main.cpp", "-o", out / "by_cpp")
    collect("cpp", out / "by_cpp")
    return answers


def same(answers, expected):
    for which, results in answers.items():
        for name, data in results.items():
            wanted = expected[name].tobytes()
            assert len(data) == len(wanted), f"{which}: {name} has {len(data)} bytes; luxel gives {len(wanted)}"
            if data != wanted:
                a, b = numpy.frombuffer(data, numpy.float32), numpy.frombuffer(wanted, numpy.float32)
                raise AssertionError(f"{which}: {name} differs in {(a != b).sum()} of {a.size} floats, by {abs(a - b).max()} at most")


def noise(*shape):
    return numpy.random.default_rng(7).random(shape, numpy.float32)


def test_gaussian_blur(at):
    image = noise(45, 67, 4)
    numpy.save(at / "in.npy", image)
    for border, difference in (("mirror", 0), ("zero", 1)):
        out = at / border
        manifest = emit("gaussian_blur", "--size", "67x45", "--options", f"sigma=2,border={border},difference={difference}", out=out)
        run(PROGRAM, "gaussian_blur", "--in", at / "in.npy", "--sigma", 2, "--border", border, *["--difference"] * difference,
            "--device", "cpu", "-o", out / "own.npy")
        same(run_all(manifest, out, {"src": image}, ["dst"]), {"dst": numpy.load(out / "own.npy")})
        if border == "mirror" and LABEL == "quick":
            break


def test_mip_build(at):
    """Workgroup memory and barriers: three levels a dispatch."""
    volume = noise(16, 16, 16, 4)
    volume[..., :3] *= volume[..., 3:]
    numpy.save(at / "in.npy", volume)
    manifest = emit("mip_build", "--size", "16x16x16", out=at / "out")
    assert any(s["workgroup_memory_bytes"] for s in manifest["shaders"]), "no shader has workgroup memory"
    run(PROGRAM, "mip_build", "--in", at / "in.npy", "--device", "cpu", "-o", at / "own")
    levels = [r["name"] for r in manifest["resources"] if r["written"]]
    assert len(levels) == 4, levels
    same(run_all(manifest, at / "out", {"level_0": volume}, levels), {n: numpy.load(at / "own" / f"{n}.npy") for n in levels})


def test_left_out(at):
    """What constants and options switch off is gone from text and bindings."""
    bare = emit("cone_trace", "--size", "8x8", "--options", "extent=8x8x8,occlusion=0", "--format", "glsl", out=at / "bare")
    full = emit("cone_trace", "--size", "8x8", "--options", "extent=8x8x8,sky_size=16,count=1,gamma=1", "--format", "glsl",
                out=at / "full")
    names = [{b["name"] for b in m["shaders"][0]["bindings"]} for m in (bare, full)]
    assert "sky" not in names[0] and "counters" not in names[0] and {"sky", "counters"} <= names[1], names
    text = re.sub(r"//.*", "", (at / "bare" / bare["shaders"][0]["files"]["glsl"]).read_text())
    assert not re.search(r"params\.gamma|\bsky\[|counters|ANISOTROPIC|occlusion|#if|#define", text.split("#version")[1]), "switched off, and still there"
    plain = emit("gaussian_blur", "--size", "8x8", "--options", "sigma=1", "--format", "glsl", out=at / "plain")
    text = (at / "plain" / plain["shaders"][0]["files"]["glsl"]).read_text()
    assert "wrap_index" not in text and "BORDER" not in text and "AXIS" not in text, text
    free = emit("gaussian_blur", "--size", "8x8", "--options", "sigma=1", "--constants", "RADIUS=open", out=at / "free")
    assert [c["name"] for c in free["shaders"][0]["constants"]] == ["RADIUS"], free["shaders"][0]["constants"]
    assert "layout(constant_id = 0) const int RADIUS = 3;" in (at / "free" / free["shaders"][0]["files"]["glsl"]).read_text()
    assert "#ifndef RADIUS" in (at / "free" / free["shaders"][0]["files"]["opencl"]).read_text()


def test_rules(at):
    """Rules of one size give the numbers of another."""
    small = emit("gaussian_blur", "--size", "640x360", "--format", "glsl", out=at / "small")
    large = emit("gaussian_blur", "--size", "1917x1083", "--format", "glsl", out=at / "large")
    width, height = 1917, 1083

    def value(rule):
        match = re.fullmatch(r"ceil\((\w+) / (\d+)\)", rule)
        return -(-{"width": width, "height": height}[match[1]] // int(match[2])) if match else \
            eval(rule, {"__builtins__": {}}, {"width": width, "height": height})
    for a, b in zip(small["passes"], large["passes"]):
        assert [value(r) for r in a["groups_rule"]] == b["groups"], (a, b)
        for name, parameter in a["parameters"].items():
            assert value(parameter["rule"]) == b["parameters"][name]["value"], name
    for part in ("resources", "scratch"):
        for a, b in zip(small[part], large[part]):
            assert value(a["bytes_rule"]) == b["bytes"], a["name"]


def test_refusals(at):
    for arguments, text in ((["nothing"], "no kernel nothing"),
                            (["gaussian_blur", "--options", "sigmma=3"], "has no option sigmma"),
                            (["gaussian_blur", "--options", "border=round"], "expected one of clamp, mirror, wrap, zero"),
                            (["gaussian_blur", "--options", "sigma=-1"], "GaussianBlurParams.sigma is -1"),
                            (["gaussian_blur", "--constants", "RADIUM=3"], "no constant RADIUM"),
                            (["gaussian_blur", "--constants", "AXIS=7"], "constant AXIS is 7; expected one of 0, 1 (0: along rows"),
                            (["gaussian_blur", "--constants", "RADIUS=-1"], "constant RADIUS is -1; expected a whole number 0.."),
                            (["gaussian_blur", "--constants", "RADIUS=1.5"], "constant RADIUS is 1.5; expected a whole number"),
                            (["gaussian_blur", "--constants", "RADIUS=nan"], "constant RADIUS is nan; expected a whole number"),
                            (["gaussian_blur", "--constants", "RADIUS=4294967296"], "constant RADIUS is 4294967296; expected"),
                            (["gaussian_blur", "--size", "0x3"], "--size is 0x3"),
                            (["probe_minimum", "--variant", "x"], "has no variants")):
        said = run(PROGRAM, "emit", *arguments, "-o", at / "x", status=2)
        assert text in said and said.count("\n") == 1, said


def test_variant_is_named(at):
    for arguments, variant in ((["gaussian_blur"], "separable"), (["gaussian_blur", "--variant", "box"], "box"),
                               (["gaussian_blur", "--options", "variant=recursive"], "recursive"), (["probe_minimum"], "default")):
        manifest = emit(*arguments, "--format", "glsl", out=at / "x")
        assert manifest["variant"] == variant, (arguments, manifest["variant"])


def test_folders_of_any_name(at):
    odd = at / "it's $HOME; `a`"
    odd.mkdir()
    before = os.environ.get("TMPDIR")
    os.environ["TMPDIR"] = str(odd)
    try:
        manifest = emit("gaussian_blur", "--size", "8x8", out=odd / "out")
    finally:
        os.environ.pop("TMPDIR")
        if before is not None:
            os.environ["TMPDIR"] = before
    assert manifest["shaders"] and (odd / "out/gaussian_blur.json").exists()
    assert [f.name for f in odd.iterdir()] == ["out"], "what was there for a while is gone"


def full_kernels(at):
    """Every kernel's variants: SPIR-V is valid, GLSL goes through glslang, OpenCL C builds, C++ compiles without a warning."""
    import pyopencl
    said = run(PROGRAM, "emit", "?", "-o", at / "x", status=2)
    kernels = re.search(r"expected (.*)", said)[1].split(", ")
    assert len(kernels) >= 24, kernels
    context = pyopencl.Context([pyopencl.get_platforms()[0].get_devices()[0]])
    headers = [{}]  # each file is a namespace: of equal names one a program
    # Each kernel as it is by default, and in each of its variants.
    calls = []
    for kernel in kernels:
        calls.append((kernel, []))
        said = run(PROGRAM, "emit", kernel, "--variant", "?", "-o", at / "x", status=2)
        if "expected one of " in said:
            standard = emit(kernel, "--format", "glsl", out=at / "standard")["variant"]
            calls += [(kernel, ["--variant", v]) for v in re.search(r"expected one of (.*)", said)[1].split(", ") if v != standard]
    assert len(calls) >= 45, calls
    seen = set()
    for kernel, arguments in calls:
        out = at / "_".join([kernel, *arguments[1:]])
        manifest = emit(kernel, *arguments, out=out)
        for shader in manifest["shaders"]:
            files = {which: out / file for which, file in shader["files"].items()}
            text = re.sub(r"//.*", "", files["opencl"].read_text())
            if text in seen:  # but for the comment, which has the command
                continue
            seen.add(text)
            run("spirv-val", "--target-env", "vulkan1.1", files["spirv"])
            if not arguments:
                run("glslangValidator", "-V", files["glsl"], "-o", at / "again.spv")
            pyopencl.Program(context, files["opencl"].read_text()).build(cache_dir=False)
            if all(shader["name"] in program for program in headers):
                headers.append({})
            next(program for program in headers if shader["name"] not in program)[shader["name"]] = files["cpp"]
    for program in headers:
        (at / "all.cpp").write_text("".join(f'#include "{h}"\n' for h in program.values()) + "int main() {}\n")
        run("g++", "-std=c++17", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", at / "all.cpp")


tests = {name: f for name, f in list(globals().items()) if name.startswith("test_" if LABEL == "quick" else "full_")}
if LABEL == "full":
    tests["test_gaussian_blur"] = test_gaussian_blur
for name, test in tests.items():
    if len(sys.argv) > 5 and name not in sys.argv[5:]:
        continue
    with tempfile.TemporaryDirectory() as folder:
        try:
            test(pathlib.Path(folder))
            print(f"{name}: passed")
        except AssertionError as error:
            failures.append(name)
            print(f"{name}: FAILED: {error}")
sys.exit(f"failed: {', '.join(failures)}" if failures else 0)
