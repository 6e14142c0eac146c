#!/usr/bin/env python3
"""Writes one kernel as flat files with a manifest. The program `luxel emit` pipes the plan and the modules' texts here.

    emit.py request.json     prints the names of the files that were written
"""
import json
import pathlib
import re
import struct
import subprocess
import sys

import fold
import languages
from dialect import parse_module
from fit import rule_of
from spirv import forbid_contraction

ELEMENT = {"f32x1": 4, "f32x2": 8, "f32x4": 16, "f16x2": 4, "f16x4": 8, "unorm8x4": 4, "float": 4, "vec4": 16, "uint": 4,
           "int": 4}
ENDINGS = {"glsl": ".comp", "spirv": ".spv", "opencl": ".cl", "cpp": ".hpp"}
KINDS = {"READ": "storage_buffer", "WRITE": "storage_buffer", "UPDATE": "storage_buffer", "TEXELS": "texel_buffer",
         "UNIFORM": "uniform_buffer", "IMAGE2D": "sampled_image_2d", "IMAGE3D": "sampled_image_3d",
         "SAMPLED2D": "combined_image_sampler_2d", "SAMPLED3D": "combined_image_sampler_3d",
         "IMAGE_READ2D": "storage_image_2d", "IMAGE_WRITE2D": "storage_image_2d"}
ACCESS = {"READ": "read", "WRITE": "write", "UPDATE": "read_write", "IMAGE_WRITE2D": "write"}


def fail(message, status=1):
    print(f"emit: {message}", file=sys.stderr)
    sys.exit(status)


def refused(kind, default, remark, value):
    """What a constant takes where it does not take `value`, else nothing. Its line of the signature names its values, as
    `0: along rows, 1: along columns`, `2 or 3` (of a switch the one that is not named is allowed too); where it does not, the
    type decides. None is negative but where its default is."""
    if kind == "float":
        return "" if abs(value) <= 3.4028234663852886e38 else "a finite number"
    whole = value == value and abs(value) < 2 ** 33 and value == int(value)
    named = {int(n) for n in re.findall(r"(?:^|[,;] | or )(\d+)(?=:? )", remark + " ")} if re.match(r"\d+(:| )", remark) else set()
    if named:
        named |= {0, 1} if named <= {0, 1} else {0} if re.match("[01]:? ", remark) else set()
        return "" if whole and value in named else f"one of {', '.join(str(n) for n in sorted(named))} ({remark})"
    least = -2147483648 if kind == "int" and float(str(default).rstrip("fu")) < 0 else 0
    most = 4294967295 if kind == "uint" else 2147483647
    return "" if whole and least <= value <= most else f"a whole number {least}..{most}"


def spelled(kind, value):
    """A constant's value as the languages spell it."""
    if kind == "float":
        return repr(float(value)) + "f"
    return f"{int(value)}{'u' if kind == 'uint' else ''}"


def slug(label):
    return re.sub(r"_(level_)?\d+$", "", re.sub(r"\W+", "_", label.strip()).strip("_"))


class Emitter:
    def __init__(self, request):
        self.request = request
        self.sources = {}
        self.files = {}    # key -> entry of the manifest
        self.out = pathlib.Path(request["out"])
        self.formats = list(ENDINGS) if request["format"] == "all" else [request["format"]]
        self.written = []

    def source(self, name):
        if name not in self.sources:
            self.sources[name] = parse_module(self.request["modules"][name]["glsl"])
        return self.sources[name]

    def banner(self, shader, comment="//"):
        r = self.request
        words = [f"{shader.title}", f"Made by luxel {r['version']}: {r['command']}", "", *r["license"].strip().split("\n")]
        lines = [f"{comment} {line}".rstrip() for line in words] + [""]
        return lines + [line for c in shader.about for line in c.split("\n")]

    def frozen(self, run, module, source):
        """(name -> value, names that stay open) of a pass's constants."""
        given, opened, values = self.request["constants"], set(), {}
        declared = {n: (t, v, r) for _, t, n, v, r, _ in source.constants}
        for info, value in zip(module["constants"], run["constants"]):
            name = info["name"]
            if given.get(name) == "open":
                if info["shape"]:
                    fail(f"constant {name} decides how many groups there are and cannot stay open", 2)
                opened.add(name)
            elif name in given:
                value = float(given[name])
                if info["shape"]:
                    fail(f"constant {name} follows from --profile; the plan counts groups by it", 2)
                if expected := refused(*declared[name], value):
                    fail(f"constant {name} is {given[name]}; expected {expected}", 2)
            values[name] = value
        return values, opened

    def emit_pass(self, run):
        module = self.request["modules"][run["module"]]
        source = self.source(run["module"])
        values, opened = self.frozen(run, module, source)
        if source.options.get("LANES") or values.get("LANES", 0) > int(source.options.get("CHANNELS", "4")):
            fail(f"profile {self.request['profile']} gives an invocation {int(values['LANES'])} lanes, which only luxel's own "
                 "OpenCL text has; expected gpu, opencl_gpu or lavapipe")
        values.pop("LANES", None)
        key = (run["module"], tuple(sorted(values.items())), tuple(run["workgroup"]))
        if key in self.files:
            return self.files[key]
        base = slug(run["label"])
        name, taken = base, {f["name"] for f in self.files.values()}
        for i in range(2, 1000):
            if name not in taken:
                break
            name = f"{base}_{i}"
        kinds = {n: t for _, t, n, _, _, _ in source.constants}
        frozen = {n: (v if kinds.get(n) == "float" else int(v)) for n, v in values.items() if n not in opened}
        # Helpers of storage formats call these, which the kernel itself may not.
        roots = {"f16_bits", "f16_value"} if any(b[2].startswith("f16") for b in source.bindings) else set()
        roots |= {"unorm8_bits", "unorm8_value"} if any(b[2] == "unorm8x4" for b in source.bindings) else set()
        functions = fold.specialise(source, frozen, roots)
        entry = {"name": name, "module": run["module"], "files": {}}
        manifest = None
        for which in ("glsl", "opencl", "cpp"):
            shader = self.shader(name, source, functions, values, opened, run)
            printer = {"glsl": languages.Glsl, "opencl": languages.OpenCl, "cpp": languages.Cpp}[which](shader)
            texels = any(k == "TEXELS" for k, _, _, _ in shader.bindings)
            if texels and which != "glsl":
                if which in self.formats and self.request["format"] != "all":
                    fail("profile lavapipe reads through texel buffers, which only Vulkan has; expected gpu or opencl_gpu")
                continue
            printer.all_functions()
            helpers = set(re.findall(r"\w+", "\n".join(printer.helpers.values())))
            shader.functions = fold.live(functions, helpers & roots)
            printer = type(printer)(shader)
            manifest = manifest or (shader, printer)
            text = printer.text(self.banner(shader))
            if which in self.formats or which == "glsl" and "spirv" in self.formats:
                self.write(entry, which, name, text)
        self.describe(entry, *manifest)
        self.files[key] = entry
        return entry

    def shader(self, name, source, functions, values, opened, run):
        used = set().union(*(fold.names(f.body) for f in functions)) if functions else set()
        members = {e[2] for f in functions for e in fold.expressions(f.body) if e[0] == "member" and e[1] == ("name", "params")}
        bindings = [b for b in source.bindings if b[3] in used]
        parameters = [p for p in source.parameters if p[1] in members]
        shared = [s for s in source.shared if s[2] in used]
        used |= {w for _, c, _ in shared for w in re.findall(r"[A-Za-z_]\w*", c)}
        constants = [(i, t, n, spelled(t, values[n]), r, n in opened) for i, t, n, v, r, shape in source.constants
                     if n in used and n in values]
        numbers, listed = [], {c[2] for c in constants}
        for macro in source.macros.table:
            tokens = source.macros.value(macro)
            if tokens and macro in used and macro not in listed and not (macro == "PIXELS"):
                numbers.append((macro, "".join(t.text for t in tokens), source.macros.table[macro][2]))
        about = [c for c in source.about]
        return languages.Shader(name, list(functions), bindings, parameters, shared, constants, numbers, run["workgroup"],
                                int(source.options.get("CHANNELS", "4")), about,
                                f"{name}: {self.request['kernel']}, {run['label']}; module {run['module']}.")

    def write(self, entry, which, name, text):
        path = self.out / (name + ENDINGS[which])
        if which == "glsl" and "glsl" not in self.formats:
            self.spirv(entry, name, text)
            return
        path.write_text(text)
        entry["files"][which] = path.name
        self.written.append(path.name)
        if which == "glsl" and "spirv" in self.formats:
            self.spirv(entry, name, text)

    def spirv(self, entry, name, text):
        path = self.out / (name + ".spv")
        source = self.out / (name + ".comp.tmp")
        source.write_text(text)
        try:
            done = subprocess.run([self.request["glslang"], "-V", "--target-env", "vulkan1.1", "-S", "comp", str(source), "-o",
                                   str(path)], capture_output=True, text=True)
        except OSError:
            fail(f"{self.request['glslang']} makes SPIR-V and is not there; install glslang-tools, or leave out spirv")
        finally:
            source.unlink()
        if done.returncode:
            fail(f"glslangValidator refuses {name}: {done.stdout.strip()}")
        raw = path.read_bytes()
        words = forbid_contraction(list(struct.unpack(f"<{len(raw) // 4}I", raw)))
        path.write_bytes(struct.pack(f"<{len(words)}I", *words))
        entry["files"]["spirv"] = path.name
        self.written.append(path.name)

    def describe(self, entry, shader, printer):
        """What of a file a host must know."""
        entry["entry"] = {"spirv": "main", "glsl": "main", "opencl": shader.name, "cpp": f"{shader.name}::Kernel"}
        entry["entry"] = {k: v for k, v in entry["entry"].items() if k in entry["files"]}
        entry["workgroup"] = shader.workgroup
        argument = 1 if shader.parameters else 0
        entry["bindings"] = []
        for kind, slot, stored, name in shader.bindings:
            b = {"name": name, "kind": KINDS[kind], "set": 0, "binding": slot, "opencl_argument": argument,
                 "access": ACCESS.get(kind, "read")}
            argument += 2 if kind.startswith("SAMPLED") else 1
            if kind == "UNIFORM":
                b.update(type="float", element_bytes=4, most_elements=int(eval(stored)))
            else:
                b.update(type=stored, element_bytes=ELEMENT[stored])
            entry["bindings"].append(b)
        entry["parameters"] = {
            "bytes": 4 * len(shader.parameters), "vulkan": "push constants, stage compute, offset 0",
            "opencl_argument": 0 if shader.parameters else None,
            "members": [{"name": n, "type": {"float": "f32", "int": "i32", "uint": "u32"}[t], "offset": 4 * i,
                         **({"meaning": r} if r else {})} for i, (t, n, r) in enumerate(shader.parameters)]}
        entry["constants"] = [{"name": n, "type": {"float": "f32", "int": "i32", "uint": "u32"}[t], "id": i,
                               "default": float(v.rstrip("fu")) if t == "float" else int(v.rstrip("u")),
                               **({"meaning": r} if r else {})} for i, t, n, v, r, is_open in shader.constants if is_open]
        entry["frozen"] = {n: (float(v.rstrip("fu")) if t == "float" else int(v.rstrip("u")))
                           for _, t, n, v, _, is_open in shader.constants if not is_open}
        entry["workgroup_memory_bytes"] = self.shared_bytes(shader)
        if entry["workgroup_memory_bytes"]:
            entry["opencl_local_arguments"] = [
                {"name": n, "opencl_argument": argument + i, "bytes": size}
                for i, (n, size) in enumerate(self.shared_sizes(shader))]
        entry["_used"] = [n for n in (b["name"] for b in entry["bindings"])]
        entry["_members"] = [m["name"] for m in entry["parameters"]["members"]]

    def shared_sizes(self, shader):
        module = self.request["modules"][next(f for f in [shader.title.split("module ")[1].rstrip(".")])]
        sizes = {s["name"]: s["bytes"] for s in module["shared"]}
        return [(n, sizes[n]) for _, _, n in shader.shared]

    def shared_bytes(self, shader):
        return sum(size for _, size in self.shared_sizes(shader))

    def run(self):
        request, plans = self.request, self.request["plans"]
        plan, sizes = plans[0], request["sizes"]
        self.out.mkdir(parents=True, exist_ok=True)
        passes = [self.emit_pass(run) for run in plan["passes"]]
        # Other sizes of the same plan say how numbers follow from the size.
        others = [(s, p) for s, p in zip(sizes, plans) if self.shape_of(p) == self.shape_of(plan)]
        rule = lambda read: rule_of([s for s, _ in others], [read(p) for _, p in others])
        used_slots = {}
        listed = []
        for i, (run, entry) in enumerate(zip(plan["passes"], passes)):
            module = request["modules"][run["module"]]
            bound = {}
            for info, slot in zip(module["bindings"], run["slots"]):
                if info["name"] in entry["_used"]:
                    bound[info["name"]] = f"{slot['source']}:{slot['index']}" if slot["source"] != "resource" else \
                        plan["resources"][slot["index"]]["name"]
                    used_slots.setdefault(slot["source"], set()).add(slot["index"])
            parameters = {}
            for j, info in enumerate(module["parameters"]):
                if info["name"] in entry["_members"]:
                    parameters[info["name"]] = {"value": run["parameters"][j],
                                                "rule": rule(lambda p: p["passes"][i]["parameters"][j])}
            item = {"label": run["label"], "shader": entry["name"], "bind": bound, "parameters": parameters,
                    "groups": run["groups"], "groups_rule": [rule(lambda p: p["passes"][i]["groups"][a]) for a in range(3)]}
            if run.get("counts"):
                slot = run["counts"]["slot"]
                item["groups_from"] = {"what": f"{slot['source']}:{slot['index']}" if slot["source"] != "resource" else
                                       plan["resources"][slot["index"]]["name"], "first_u32": run["counts"]["first"],
                                       "meaning": "three u32 that an earlier pass wrote; dispatch indirectly by them, or `groups`"}
            listed.append(item)
        resources = []
        for i, r in enumerate(plan["resources"]):
            item = {"name": r["name"], "kind": r["kind"], "format": r["format"], "written": r["written"],
                    "may_alias": r["may_alias"], "used": i in used_slots.get("resource", set())}
            if r["kind"] == "buffer":
                item.update(bytes=r["bytes"], bytes_rule=rule(lambda p: p["resources"][i]["bytes"]))
            else:
                item.update(extent=r["extent"], address=r["address"],
                            extent_rule=[rule(lambda p: p["resources"][i]["extent"][a]) for a in range(3)])
            resources.append(item)
        scratch = [{"name": f"scratch:{i}", "format": s["format"], "bytes": s["bytes"],
                    "bytes_rule": rule(lambda p: p["scratch"][i]["bytes"]),
                    "first_pass": min((j for j, p in enumerate(listed) if f"scratch:{i}" in p["bind"].values()), default=None),
                    "last_pass": max((j for j, p in enumerate(listed) if f"scratch:{i}" in p["bind"].values()), default=None)}
                   for i, s in enumerate(plan["scratch"])]
        tables = [{"name": f"table:{i}", "bytes": self.table_bytes(f"table:{i}", listed), "values": t, "depends_on_size": any(p["tables"][i] != t for _, p in others)}
                  for i, t in enumerate(plan["tables"]) if i in used_slots.get("table", set())]
        shaders = []
        for entry in self.files.values():
            shaders.append({k: v for k, v in entry.items() if not k.startswith("_") and k != "module"})
        manifest = {
            "schema": "emit.schema.json", "schema_version": 1, "luxel": request["version"],
            "kernel": request["kernel"], "variant": request["variant"], "options": request["options"],
            "profile": request["profile"], "size": sizes[0], "command": request["command"], "license": "MIT",
            "shaders": shaders, "resources": resources, "scratch": scratch, "tables": tables, "passes": listed,
            "limits": self.limits(plan, shaders), "errors": request["errors"],
            "notes": ["Passes run in order; each sees what the one before wrote: a barrier between any two.",
                      "Rules give a number for other sizes: constants, products of sizes, ceil(size / n); null: for this size only.",
                      "Bits are equal on drivers that round as IEEE 754 asks: SPIR-V forbids contraction, OpenCL C turns it off, "
                      "C++ needs -ffp-contract=off; GLSL that is compiled elsewhere may be contracted."]}
        path = self.out / f"{request['kernel']}.json"
        path.write_text(json.dumps(manifest, indent=2, ensure_ascii=False) + "\n")
        self.written.append(path.name)
        print("\n".join(self.written))

    def table_bytes(self, name, passes):
        """What a buffer for a table holds at least: as much as the shaders that read it declare."""
        shaders = {f["name"]: f for f in self.files.values()}
        return max(-(-4 * b["most_elements"] // 16) * 16 for p in passes for b in shaders[p["shader"]]["bindings"]
                   if p["bind"].get(b["name"]) == name)

    @staticmethod
    def shape_of(plan):
        return ([(p["module"], p["constants"], p["workgroup"]) for p in plan["passes"]], [r["name"] for r in plan["resources"]],
                len(plan["scratch"]), len(plan["tables"]))

    @staticmethod
    def limits(plan, shaders):
        buffers = [r["bytes"] for r in plan["resources"] if r["kind"] == "buffer"] + [s["bytes"] for s in plan["scratch"]]
        return {"max_storage_buffer_range": max(buffers, default=0),
                "max_push_constants_bytes": max((s["parameters"]["bytes"] for s in shaders), default=0),
                "max_storage_buffers": max((sum(b["kind"] == "storage_buffer" for b in s["bindings"]) for s in shaders), default=0),
                "max_workgroup_invocations": max((s["workgroup"][0] * s["workgroup"][1] * s["workgroup"][2] for s in shaders), default=0),
                "max_groups": [max((p["groups"][a] for p in plan["passes"]), default=0) for a in range(3)],
                "max_workgroup_memory_bytes": max((s["workgroup_memory_bytes"] for s in shaders), default=0)}


if __name__ == "__main__":
    Emitter(json.loads(pathlib.Path(sys.argv[1]).read_text())).run()
