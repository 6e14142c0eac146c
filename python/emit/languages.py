"""A module's tree as text: GLSL 450, OpenCL C 1.2, C++17 with GLM."""
import re
from dataclasses import dataclass

from dialect import BINARY
from fold import calls, names, statements

PIXELS = {"f32x1": "float", "f32x2": "vec2", "f32x4": "vec4", "f16x2": "vec2", "f16x4": "vec4", "unorm8x4": "vec4"}
CHANNELS = {"f32x1": 1, "f32x2": 2, "f32x4": 4, "f16x2": 2, "f16x4": 4, "unorm8x4": 4}
IMAGES = {"IMAGE2D", "IMAGE3D", "IMAGE_READ2D", "IMAGE_WRITE2D", "SAMPLED2D", "SAMPLED3D"}
WIDTH = 112


def wrap(text, indent):
    """A long line in pieces, each further in; cut after commas and before operators, as far out as it goes."""
    lines, lead = [], " " * indent
    while len(lead) + len(text) > WIDTH:
        best, depth, quality = None, 0, None
        for i, c in enumerate(text):
            if i + len(lead) > WIDTH:
                break
            depth += c in "([{"
            depth -= c in ")]}"
            cut = c == " " and i > 24 and (text[i - 1] in ",?:" or re.match(r" (\|\||&&|[-+*?:]) ", text[i:i + 4]))
            if cut and (quality is None or depth <= quality):
                best, quality = i, depth
        if best is None:
            break
        lines.append(lead + text[:best])
        text = text[best + 1:]
        lead = " " * (indent + 8)
    return lines + [lead + text]


@dataclass
class Shader:
    """What is printed: a module with its constants frozen."""
    name: str
    functions: list
    bindings: list     # (kind, slot, type, name) that are used
    parameters: list   # (type, name, remark) that are used
    shared: list
    constants: list    # (id, type, name, value, remark, open)
    numbers: list      # (name, text, comment) of macros that are used
    workgroup: list
    channels: int
    about: list
    title: str


class Printer:
    """What the three languages share."""
    UNROLL = ""

    def __init__(self, shader):
        self.s = shader
        self.kinds = {name: (kind, kind_of) for kind, _, kind_of, name in shader.bindings}
        self.shared = {name for _, _, name in shader.shared}
        self.helpers = {}   # name -> text, in the order of first use
        self.pixel = "float" if shader.channels == 1 else f"vec{shader.channels}"
        self.by_name = {f.name: f for f in shader.functions}
        self.uses = self.find_uses()

    def find_uses(self):
        """What each function touches, itself and by what it calls: bindings, workgroup memory, `params`."""
        memory = {name for _, _, _, name in self.s.bindings} | self.shared | {"params"}
        direct = {f.name: names(f.body) & memory for f in self.s.functions}
        for _ in range(len(direct)):
            for f in self.s.functions:
                for call in calls(f.body):
                    direct[f.name] |= direct.get(call[1], set())
        return direct

    # Expressions.
    def e(self, e):
        kind = e[0]
        if kind == "num":
            return self.num(e[1])
        if kind == "name":
            return e[1]
        if kind == "paren":
            return f"({self.e(e[1])})"
        if kind == "un":
            inner = self.e(e[2])
            return f"{e[1]}{f'({inner})' if e[2][0] in ('bin', 'tern', 'assign') or e[2][0] == 'un' and e[2][1] == e[1] else inner}"
        if kind == "post":
            return self.e(e[2]) + e[1]
        if kind == "index":
            return f"{self.e(e[1])}[{self.e(e[2])}]"
        if kind == "member":
            return f"{self.primary(e[1])}.{e[2]}"
        if kind == "bin":
            level = BINARY[e[1]]
            return f"{self.side(e[2], level)} {e[1]} {self.side(e[3], level + 1)}"
        if kind == "tern":
            condition = self.side(e[1], 1)
            return f"{condition} ? {self.e(e[2])} : {self.e(e[3])}"
        if kind == "assign":
            return f"{self.e(e[2])} {e[1]} {self.e(e[3])}"
        if kind == "list":
            return ", ".join(self.e(x) for x in e[1])
        return self.call(e[1], e[2])

    def side(self, e, level):
        text = self.e(e)
        low = e[0] in ("tern", "assign") or e[0] == "bin" and BINARY[e[1]] < level
        return f"({text})" if low else text

    def primary(self, e):
        text = self.e(e)
        return f"({text})" if e[0] in ("bin", "tern", "un") else text

    def num(self, text):
        return text

    def arguments(self, listed):
        return ", ".join(self.e(a) for a in listed if a != ("name", "ctx"))

    def call(self, name, a):
        method = getattr(self, "word_" + name, None)
        if method:
            return method(*a)
        if name in self.by_name:
            return f"{name}({', '.join(x for x in (self.context(name, False), self.arguments(a)) if x)})"
        return self.builtin(name, a)

    def builtin(self, name, a):
        return f"{name}({self.arguments(a)})"

    def context(self, name, declared):
        """What a function takes before its own parameters."""
        return ""

    def at(self, b, i):
        return f"{self.e(b)}[{self.e(i)}]"

    def word_load(self, b, i):
        return self.at(b, i)

    def word_store(self, b, i, v):
        return f"{self.at(b, i)} = {self.e(v)}"

    def word_get_pixel(self, w, k):
        return self.primary(w)

    def word_set_pixel(self, w, k, p):
        return f"{self.e(w)} = {self.e(p)}"

    def word_wide_splat(self, v):
        return self.e(v) if self.s.channels == 1 else self.call(self.pixel, [v])

    def word_with_alpha_of(self, w, alpha):
        return self.primary(w) if self.s.channels != 4 else \
            self.call("vec4", [("member", w, "xyz"), ("member", alpha, "w")])

    def word_load_wide(self, *a):
        return self.word_load_pixel(*a)

    def word_store_wide(self, *a):
        return self.word_store_pixel(*a)

    # Statements.
    def body(self, body, indent):
        lines = []
        for s in body:
            lines += self.statement(s, indent)
        return lines

    def comments(self, listed, indent):
        return [(" " * indent + line.strip()).rstrip() for c in listed for line in c.split("\n") if c or c is not listed[-1]]

    def statement(self, s, indent):
        lead = " " * indent
        lines = self.comments(s.above, indent)
        if s.kind == "comment":
            return lines
        text = self.simple(s)
        if text is not None:
            new = wrap(text + ";", indent)
            if s.beside:
                if len(new[-1]) + len(s.beside) + 2 <= WIDTH + 8:
                    new[-1] += "  " + s.beside
                else:
                    new.insert(0, lead + s.beside)
            return lines + new
        if s.kind == "block":
            return lines + [lead + "{"] + self.body(s.parts, indent + 4) + [lead + "}"]
        if s.kind == "phases":
            return lines + self.phases(s.parts, indent)
        if s.kind == "if":
            return lines + self.branch(f"if ({self.e(s.e)})", s, indent)
        if s.kind == "do":
            return lines + [lead + "do {"] + self.body(s.parts[0], indent + 4) + wrap(f"}} while ({self.e(s.e)});", indent)
        if s.kind == "while":
            head = f"while ({self.e(s.e)})"
        else:
            init, step = s.more
            head = f"for ({self.simple(init)}; {self.e(s.e) if s.e else ''}; {self.e(step)})"
            if s.unroll and self.UNROLL:
                lines.append(lead + self.UNROLL)
        new = wrap(head + " {", indent)
        return lines + new + self.body(s.parts[0], indent + 4) + [lead + "}"]

    def branch(self, head, s, indent):
        lead, (yes, no) = " " * indent, s.parts
        if no is None and len(yes) == 1 and not yes[0].above and not s.beside:
            text = self.simple(yes[0])
            if text is not None and len(head) + len(text) + indent < WIDTH and yes[0].kind not in ("declare", "array"):
                return [f"{lead}{head} {text};" + (f"  {yes[0].beside}" if yes[0].beside else "")]
        new = wrap(head + " {", indent)
        if s.beside:
            new[-1] += "  " + s.beside
        new += self.body(yes, indent + 4)
        if no is None:
            return new + [lead + "}"]
        if len(no) == 1 and no[0].kind == "if" and not no[0].above:
            return new + self.else_if(no[0], indent)
        return new + [lead + "} else {"] + self.body(no, indent + 4) + [lead + "}"]

    def else_if(self, s, indent):
        """`} else if (...) { ... }`, always with braces."""
        lead, (yes, no) = " " * indent, s.parts
        new = wrap(f"}} else if ({self.e(s.e)}) {{", indent) + self.body(yes, indent + 4)
        if no is None:
            return new + [lead + "}"]
        if len(no) == 1 and no[0].kind == "if" and not no[0].above:
            return new + self.else_if(no[0], indent)
        return new + [lead + "} else {"] + self.body(no, indent + 4) + [lead + "}"]

    def simple(self, s):
        """The text of a statement without statements in it, else None."""
        if s.kind == "return":
            return f"return {self.e(s.e)}" if s.e else "return"
        if s.kind in ("break", "continue"):
            return s.kind
        if s.kind == "expression":
            return self.e(s.e)
        if s.kind == "declare":
            kind, const, listed = s.more
            parts = [n + (f" = {self.e(v)}" if v is not None else "") for n, v in listed]
            return f"{'const ' if const else ''}{self.type(kind)} {', '.join(parts)}"
        if s.kind == "array":
            return f"{self.type(s.more[0])} {s.more[1]}[{self.e(s.more[2])}]"
        return None

    def phases(self, parts, indent):
        lead, lines = " " * indent, []
        for i, part in enumerate(parts):
            lines += [lead + self.BARRIER] if i else []
            lines += [lead + "{"] + self.body(part, indent + 4) + [lead + "}"]
        return lines

    def type(self, kind):
        return kind

    def function(self, f, indent=0):
        lead = " " * indent
        own = ", ".join(f"{'const ' if c else ''}{self.type(t.split('[')[0])} {n}{t[t.index('['):] if '[' in t else ''}"
                        for t, n, c in f.parameters)
        given = ", ".join(x for x in (self.context(f.name, True), own) if x)
        lines = self.comments(f.above, indent)
        head = self.head(f, given)
        if not f.entry and len(f.body) == 1 and not f.body[0].above:
            text = self.simple(f.body[0])
            if text is not None and len(head) + len(text) + indent + 6 <= WIDTH:
                return lines + [f"{lead}{head} {{ {text}; }}"]
        return lines + wrap(head + " {", indent) + self.body(f.body, indent + 4) + [lead + "}"]

    def all_functions(self, indent=0):
        out = []
        for f in self.s.functions:
            text = self.function(f, indent)
            short = len(text) == 1 and out and len(out[-1]) == 1
            out.append(text)
            if not short and len(out) > 1:
                out[-1] = [""] + text
        return [line for text in out for line in text]

    def constant_lines(self, frozen, opened):
        lines = []
        for identity, kind, name, value, remark, is_open in self.s.constants:
            text = (opened if is_open else frozen).format(id=identity, type=self.type(kind), name=name, value=value)
            lines.append(text + (f"  // {remark}" if remark else ""))
        for name, text, comment in self.s.numbers:
            kind = "float" if re.search(r"[fF.]", text) and not text.lower().startswith("0x") else \
                "uint" if text[-1] in "uU" else "int"
            lines.append(frozen.format(type=self.type(kind), name=name, value=text) + (f"  {comment}" if comment else ""))
        return lines


class Glsl(Printer):
    UNROLL = "[[unroll]]"
    BARRIER = "memoryBarrierShared(); barrier();"
    STORED = {"f32x1": "float", "f32x2": "vec2", "f32x4": "vec4", "f16x2": "uint", "f16x4": "uvec2", "unorm8x4": "uint",
              "float": "float", "vec4": "vec4", "uint": "uint", "int": "int"}
    IMAGE_FORMAT = {"f32x1": "r32f", "f32x2": "rg32f", "f32x4": "rgba32f", "f16x4": "rgba16f", "unorm8x4": "rgba8"}
    SWIZZLE = {1: ".x", 2: ".xy", 4: ""}

    def word_invocation_x(self): return "int(gl_GlobalInvocationID.x)"
    def word_invocation_y(self): return "int(gl_GlobalInvocationID.y)"
    def word_invocation_z(self): return "int(gl_GlobalInvocationID.z)"
    def word_local_x(self): return "int(gl_LocalInvocationID.x)"
    def word_local_y(self): return "int(gl_LocalInvocationID.y)"
    def word_local_z(self): return "int(gl_LocalInvocationID.z)"
    def word_group_x(self): return "int(gl_WorkGroupID.x)"
    def word_group_y(self): return "int(gl_WorkGroupID.y)"
    def word_group_z(self): return "int(gl_WorkGroupID.z)"
    def word_atomic_add(self, b, i, v): return f"atomicAdd({self.at(b, i)}, {self.e(v)})"
    def word_atomic_min(self, b, i, v): return f"atomicMin({self.at(b, i)}, {self.e(v)})"
    def word_atomic_max(self, b, i, v): return f"atomicMax({self.at(b, i)}, {self.e(v)})"
    def word_atomic_compare_swap(self, b, i, x, v): return f"atomicCompSwap({self.at(b, i)}, {self.e(x)}, {self.e(v)})"

    def word_table(self, b, i):
        self.helpers["table_" + b[1]] = f"float table_{b[1]}(int i) {{ return {b[1]}[i >> 2][i & 3]; }}"
        return f"table_{b[1]}({self.e(i)})"

    def word_choose(self, *a):
        p = self.pixel
        one = f"{p} choose({p} which, {p} yes, {p} no) {{ return which != 0.0f ? yes : no; }}"
        many = f"{p} choose({p} which, {p} yes, {p} no) {{ return mix(no, yes, notEqual(which, {p}(0.0f))); }}"
        self.helpers["choose"] = one if self.s.channels == 1 else many
        return f"choose({self.arguments(a)})"

    def word_sample2d(self, b, uv):
        return f"textureLod({b[1]}, {self.e(uv)}, 0.0f){self.SWIZZLE[self.s.channels]}"

    def word_sample3d(self, b, uvw, level):
        return f"textureLod({b[1]}, {self.e(uvw)}, {self.e(level)}){self.SWIZZLE[self.s.channels]}"

    DECODE = {"f32x1": "{}", "f32x2": "{}", "f32x4": "{}", "f16x2": "unpackHalf2x16({})",
              "f16x4": "vec4(unpackHalf2x16({0}.x), unpackHalf2x16({0}.y))", "unorm8x4": "unorm8x4_value({})"}
    ENCODE = {"f32x1": "v", "f32x2": "v", "f32x4": "v", "f16x2": "f16_bits(v.x) | (f16_bits(v.y) << 16)",
              "f16x4": "uvec2(f16_bits(v.x) | (f16_bits(v.y) << 16), f16_bits(v.z) | (f16_bits(v.w) << 16))",
              "unorm8x4": "unorm8_bits(v.x) | (unorm8_bits(v.y) << 8) | (unorm8_bits(v.z) << 16) | (unorm8_bits(v.w) << 24)"}
    UNORM = ("vec4 unorm8x4_value(uint u) {\n    return vec4(float(u & 255u), float((u >> 8) & 255u), float((u >> 16) & 255u), "
             "float(u >> 24)) / 255.0f;\n}")

    def access(self, b, verb, what, parameters, index):
        """A helper that loads or stores one pixel or voxel of a binding."""
        kind, stored = self.kinds[b]
        name = f"{verb}_{what}_{b}"
        if name in self.helpers:
            return name
        swizzle = self.SWIZZLE[self.s.channels]
        place = "ivec2(x, y)" if what == "pixel" else "p"
        if kind in ("IMAGE2D", "IMAGE3D", "IMAGE_READ2D"):
            fetch = f"imageLoad({b}, {place})" if kind == "IMAGE_READ2D" else f"texelFetch({b}, {place}, 0)"
            if stored == "unorm8x4":  # drivers decode it in ways of their own: the integer is found again
                fetch = f"(floor({fetch} * 255.0f + 0.5f) / 255.0f)"
            body, kept = f"return {fetch}{swizzle};", self.pixel
        elif kind == "TEXELS":
            fetch = f"texelFetch({b}, {index})"
            body = f"return {'(vec4(' + fetch + ') / 255.0f)' if stored == 'unorm8x4' else fetch + swizzle};"
            kept = self.pixel
        elif kind == "IMAGE_WRITE2D":
            fill = {1: "vec4(v, 0.0f, 0.0f, 0.0f)", 2: "vec4(v, 0.0f, 0.0f)", 4: "v"}[self.s.channels]
            body, kept = f"imageStore({b}, {place}, {fill});", self.pixel
        elif verb == "load":
            if stored == "unorm8x4":
                self.helpers.setdefault("unorm8x4_value", self.UNORM)
            if stored == "f16x4":
                body = f"uvec2 u = {b}[{index}]; return vec4(unpackHalf2x16(u.x), unpackHalf2x16(u.y));"
            else:
                body = f"return {self.DECODE[stored].format(f'{b}[{index}]')};"
            kept = PIXELS[stored]
        else:
            body, kept = f"{b}[{index}] = {self.ENCODE[stored]};", PIXELS[stored]
        head = f"{kept if verb == 'load' else 'void'} {name}({parameters}{'' if verb == 'load' else f', {kept} v'})"
        self.helpers[name] = f"{head} {{ {body} }}" if len(head + body) < WIDTH - 6 else f"{head} {{\n    {body}\n}}"
        return name

    PIXEL, VOXEL = "y * stride + x", "(p.z * extent.y + p.y) * extent.x + p.x"

    def is_image(self, b):
        return self.kinds[b[1]][0] in IMAGES

    def word_load_pixel(self, b, stride, x, y):
        given = "int x, int y" if self.is_image(b) else "int stride, int x, int y"
        name = self.access(b[1], "load", "pixel", given, self.PIXEL)
        return f"{name}({self.arguments([x, y] if self.is_image(b) else [stride, x, y])})"

    def word_store_pixel(self, b, stride, x, y, v):
        given = "int x, int y" if self.is_image(b) else "int stride, int x, int y"
        name = self.access(b[1], "store", "pixel", given, self.PIXEL)
        return f"{name}({self.arguments([x, y, v] if self.is_image(b) else [stride, x, y, v])})"

    def word_load_voxel(self, b, extent, p):
        name = self.access(b[1], "load", "voxel", "ivec3 p" if self.is_image(b) else "ivec3 extent, ivec3 p", self.VOXEL)
        return f"{name}({self.arguments([p] if self.is_image(b) else [extent, p])})"

    def word_store_voxel(self, b, extent, p, v):
        name = self.access(b[1], "store", "voxel", "ivec3 extent, ivec3 p", self.VOXEL)
        return f"{name}({self.arguments([extent, p, v])})"

    def head(self, f, given):
        return "void main()" if f.entry else f"{f.type} {f.name}({given})"

    def binding(self, kind, slot, stored, name):
        at = f"set = 0, binding = {slot}"
        if kind == "UNIFORM":
            return f"layout(std140, {at}) uniform {name}_block {{ vec4 {name}[{(int(eval(stored)) + 3) // 4}]; }};"
        if kind == "TEXELS":
            return f"layout({at}) uniform {'u' if stored == 'unorm8x4' else ''}textureBuffer {name};"
        if kind in ("IMAGE2D", "IMAGE3D"):
            return f"layout({at}) uniform texture{kind[-2:]} {name};"
        if kind in ("SAMPLED2D", "SAMPLED3D"):
            return f"layout({at}) uniform sampler{kind[-2:]} {name};"
        if kind in ("IMAGE_READ2D", "IMAGE_WRITE2D"):
            access = "readonly" if kind == "IMAGE_READ2D" else "writeonly"
            return f"layout({at}, {self.IMAGE_FORMAT[stored]}) restrict {access} uniform image2D {name};"
        access = {"READ": "restrict readonly ", "WRITE": "restrict writeonly ", "UPDATE": ""}[kind]
        return f"layout(std430, {at}) {access}buffer {name}_block {{ {self.STORED[stored]} {name}[]; }};"

    def text(self, banner):
        functions = self.all_functions()
        x, y, z = self.s.workgroup
        lines = [*banner, "#version 450"]
        if any(k in ("IMAGE2D", "IMAGE3D", "TEXELS") for k, _, _, _ in self.s.bindings):
            lines.append("#extension GL_EXT_samplerless_texture_functions : require")
        if any(s.unroll for f in self.s.functions for s in statements(f.body)):
            lines.append("#extension GL_EXT_control_flow_attributes : require")
        lines += [f"layout(local_size_x = {x}, local_size_y = {y}, local_size_z = {z}) in;", ""]
        if self.s.parameters:
            lines.append("layout(push_constant) uniform Parameters {")
            lines += [f"    {t} {n};" + (f"  // {r}" if r else "") for t, n, r in self.s.parameters]
            lines += ["} params;", ""]
        constants = self.constant_lines("const {type} {name} = {value};",
                                        "layout(constant_id = {id}) const {type} {name} = {value};")
        lines += constants + [""] * bool(constants)
        lines += [self.binding(*b) for b in self.s.bindings]
        lines += [f"shared {t} {n}[{c}];" for t, c, n in self.s.shared] + [""]
        # What helpers call comes before them.
        early = [f for f in self.s.functions if f.name in ("f16_bits", "unorm8_bits")]
        for f in early:
            lines += self.function(f) + [""]
        helpers = [h for text in self.helpers.values() for h in text.split("\n")]
        self.s.functions = [f for f in self.s.functions if f not in early]
        return "\n".join(lines + helpers + [""] * bool(helpers) + self.all_functions()) + "\n"


class OpenCl(Printer):
    UNROLL = "#pragma unroll"
    BARRIER = "barrier(CLK_LOCAL_MEM_FENCE);"
    VECTORS = re.compile(r"^(|i|u)vec([234])$")
    STORED = {"f32x1": "float", "f32x2": "float2", "f32x4": "float4", "f16x2": "ushort2", "f16x4": "ushort4",
              "unorm8x4": "uchar4", "float": "float", "vec4": "float4", "uint": "uint", "int": "int"}
    BITS = {"floatBitsToUint": "as_uint", "floatBitsToInt": "as_int", "uintBitsToFloat": "as_float", "intBitsToFloat": "as_float"}

    def type(self, kind):
        match = self.VECTORS.match(kind)
        return {"": "float", "i": "int", "u": "uint"}[match[1]] + match[2] if match else kind

    def builtin(self, name, a):
        if self.VECTORS.match(name):
            return f"({self.type(name)})({self.arguments(a)})"
        if name in ("float", "int", "uint"):
            return f"({name})({self.arguments(a)})"
        if name == "abs":
            self.helpers["abs"] = "\n".join(f"static inline __attribute__((overloadable)) {t} abs({t} v) {{ return fabs(v); }}"
                                            for t in ("float", "float2", "float3", "float4"))
        return f"{self.BITS.get(name, name)}({self.arguments(a)})"

    def primary(self, e):
        text = super().primary(e)
        return f"({text})" if e[0] == "call" and (self.VECTORS.match(e[1]) or e[1] == "wide_splat") else text

    def word_invocation_x(self): return "(int)get_global_id(0)"
    def word_invocation_y(self): return "(int)get_global_id(1)"
    def word_invocation_z(self): return "(int)get_global_id(2)"
    def word_local_x(self): return "(int)get_local_id(0)"
    def word_local_y(self): return "(int)get_local_id(1)"
    def word_local_z(self): return "(int)get_local_id(2)"
    def word_group_x(self): return "(int)get_group_id(0)"
    def word_group_y(self): return "(int)get_group_id(1)"
    def word_group_z(self): return "(int)get_group_id(2)"
    def word_table(self, b, i): return self.at(b, i)
    def place(self, b, i): return f"{self.e(b)} + {self.side(i, 10)}"
    def word_atomic_add(self, b, i, v): return f"atomic_add({self.place(b, i)}, {self.e(v)})"
    def word_atomic_min(self, b, i, v): return f"atomic_min({self.place(b, i)}, {self.e(v)})"
    def word_atomic_max(self, b, i, v): return f"atomic_max({self.place(b, i)}, {self.e(v)})"
    def word_atomic_compare_swap(self, b, i, x, v): return f"atomic_cmpxchg({self.place(b, i)}, {self.e(x)}, {self.e(v)})"

    def word_choose(self, which, yes, no):
        if self.s.channels == 1:
            return f"({self.side(which, 7)} != 0.0f ? {self.e(yes)} : {self.e(no)})"
        return f"select({self.e(no)}, {self.e(yes)}, {self.side(which, 7)} != 0.0f)"

    SWIZZLE = {1: ".x", 2: ".xy", 4: ""}

    def word_sample2d(self, b, uv):
        return f"read_imagef({b[1]}, {b[1]}_sampler, {self.e(uv)}){self.SWIZZLE[self.s.channels]}"

    def word_sample3d(self, b, uvw, level):
        return f"read_imagef({b[1]}, {b[1]}_sampler, (float4)({self.e(uvw)}, 0.0f)){self.SWIZZLE[self.s.channels]}"

    PIXEL, VOXEL = "y * stride + x", "(p.z * extent.y + p.y) * extent.x + p.x"

    def pointer(self, kind, stored, name, alone=""):
        if kind == "UNIFORM":
            return f"__constant float* {alone}{name}"
        if kind in ("SAMPLED2D", "SAMPLED3D"):
            return f"__read_only image{kind[-2:].lower()}_t {name}, sampler_t {name}_sampler"
        if kind in IMAGES:
            return f"{'__write_only' if kind == 'IMAGE_WRITE2D' else '__read_only'} image{kind[-2:].lower()}_t {name}"
        if kind == "UPDATE":
            return f"volatile __global {self.STORED[stored]}* {name}"
        return f"__global {'' if kind == 'WRITE' else 'const '}{self.STORED[stored]}* {alone}{name}"

    def access(self, b, verb, what):
        kind, stored = self.kinds[b]
        name = f"{verb}_{what}_{b}"
        index = self.PIXEL if what == "pixel" else self.VOXEL
        if kind in IMAGES:
            if verb == "load":
                self.helpers.setdefault("nearest", "__constant sampler_t nearest = CLK_NORMALIZED_COORDS_FALSE | "
                                                   "CLK_ADDRESS_NONE | CLK_FILTER_NEAREST;")
            place = "(int2)(x, y)" if what == "pixel" else "(int4)(p, 0)"
            fill = {1: "(float4)(v, 0.0f, 0.0f, 0.0f)", 2: "(float4)(v, 0.0f, 0.0f)", 4: "v"}[self.s.channels]
            given = "int x, int y" if what == "pixel" else "int3 p"
            value = self.type(self.pixel)
            body = f"return read_imagef({b}, nearest, {place}){self.SWIZZLE[self.s.channels]};" if verb == "load" \
                else f"write_imagef({b}, {place}, {fill});"
        else:
            given = "int stride, int x, int y" if what == "pixel" else "int3 extent, int3 p"
            value, n = self.type(PIXELS[stored]), CHANNELS[stored]
            if verb == "load":
                body = {"f32": f"return {b}[{index}];",
                        "f16": f"return vload_half{n}({index}, (__global const half*){b});",
                        "uno": f"return convert_float4({b}[{index}]) / 255.0f;"}[stored[:3]]
            else:
                coded = ", ".join(f"{'f16' if stored[:3] == 'f16' else 'unorm8'}_bits(v.{c})" for c in "xyzw"[:n])
                body = f"{b}[{index}] = " + ("v;" if stored[:3] == "f32" else f"({self.STORED[stored]})({coded});")
        head = f"static inline {value if verb == 'load' else 'void'} {name}({self.pointer(kind, stored, b)}, {given}" + \
            (")" if verb == "load" else f", {value} v)")
        self.helpers[name] = f"{head} {{\n    {body}\n}}"
        return name

    def is_image(self, b):
        return self.kinds[b[1]][0] in IMAGES

    def word_load_pixel(self, b, stride, x, y):
        return f"{self.access(b[1], 'load', 'pixel')}({self.arguments([b, x, y] if self.is_image(b) else [b, stride, x, y])})"

    def word_store_pixel(self, b, stride, x, y, v):
        given = [b, x, y, v] if self.is_image(b) else [b, stride, x, y, v]
        return f"{self.access(b[1], 'store', 'pixel')}({self.arguments(given)})"

    def word_load_voxel(self, b, extent, p):
        return f"{self.access(b[1], 'load', 'voxel')}({self.arguments([b, p] if self.is_image(b) else [b, extent, p])})"

    def word_store_voxel(self, b, extent, p, v):
        return f"{self.access(b[1], 'store', 'voxel')}({self.arguments([b, extent, p, v])})"

    def context(self, name, declared):
        used, f = self.uses[name], self.by_name[name]
        everything = f.entry
        out = []
        if self.s.parameters and (everything or "params" in used):
            out.append("const Parameters params" if declared else "params")
        for kind, _, stored, b in self.s.bindings:
            if everything or b in used:
                plain = b + (f", {b}_sampler" if kind.startswith("SAMPLED") else "")
                out.append(self.pointer(kind, stored, b, "restrict " if everything and kind != "UPDATE" else "") if declared else plain)
        for kind, _, b in self.s.shared:
            if everything or b in used:
                out.append(f"__local {self.type(kind)}* {b}" if declared else b)
        return ", ".join(out)

    def head(self, f, given):
        if f.entry:
            return f"void {self.s.name}({given})"
        return f"static inline {self.type(f.type)} {f.name}({given})"

    def text(self, banner):
        x, y, z = self.s.workgroup
        self.all_functions()  # finds the helpers
        lines = [*banner, "#pragma OPENCL FP_CONTRACT OFF", ""]
        if self.s.parameters:
            lines += ["typedef struct {"] + [f"    {t} {n};" + (f"  // {r}" if r else "") for t, n, r in self.s.parameters]
            lines += ["} Parameters;", ""]
        constants = self.constant_lines("#define {name} {value}", "#ifndef {name}\n#define {name} {value}\n#endif")
        lines += constants + [""] * bool(constants)
        early = [f for f in self.s.functions if f.name in ("f16_bits", "unorm8_bits")]
        for f in early:
            lines += self.function(f) + [""]
        helpers = [h for text in self.helpers.values() for h in text.split("\n")]
        self.s.functions = [f for f in self.s.functions if f not in early]
        body = self.all_functions()
        at = next(i for i, line in enumerate(body) if line.startswith(f"void {self.s.name}("))
        body.insert(at, f"__kernel __attribute__((reqd_work_group_size({x}, {y}, {z})))")
        return "\n".join(lines + helpers + [""] * bool(helpers) + body) + "\n"


GLM_TYPES = {"vec2", "vec3", "vec4", "ivec2", "ivec3", "ivec4", "uvec2", "uvec3", "uvec4"}
GLM_WORDS = {"abs", "ceil", "clamp", "floor", "max", "min", "sign", "isnan", "isinf"}
STD_WORDS = {"exp", "exp2", "log2", "pow", "sqrt", "sin", "cos", "atan", "acos"}


class Cpp(Printer):
    STORED = {"f32x1": "float", "f32x2": "vec2", "f32x4": "vec4", "f16x2": "std::uint16_t", "f16x4": "std::uint16_t",
              "unorm8x4": "std::uint8_t", "float": "float", "vec4": "vec4", "uint": "uint", "int": "int"}

    def simple(self, s):
        text = super().simple(s)
        return text + " = {}" if s.kind == "array" else text

    def word_invocation_x(self): return "invocation_.x"
    def word_invocation_y(self): return "invocation_.y"
    def word_invocation_z(self): return "invocation_.z"
    def word_local_x(self): return "local_.x"
    def word_local_y(self): return "local_.y"
    def word_local_z(self): return "local_.z"
    def word_group_x(self): return "group_.x"
    def word_group_y(self): return "group_.y"
    def word_group_z(self): return "group_.z"
    def word_table(self, b, i): return self.at(b, i)

    def change(self, name, body, b, i, *v):
        self.helpers[name] = (f"template <class T> static T {name}(T& cell, {body}")
        return f"{name}({self.at(b, i)}, {self.arguments(v)})"

    def word_atomic_add(self, b, i, v):
        return self.change("fetch_add", "T v) { const T old = cell; cell = old + v; return old; }", b, i, v)

    def word_atomic_min(self, b, i, v):
        return self.change("fetch_min", "T v) { const T old = cell; cell = old < v ? old : v; return old; }", b, i, v)

    def word_atomic_max(self, b, i, v):
        return self.change("fetch_max", "T v) { const T old = cell; cell = old > v ? old : v; return old; }", b, i, v)

    def word_atomic_compare_swap(self, b, i, x, v):
        return self.change("compare_swap", "T e, T v) { const T old = cell; if (old == e) cell = v; return old; }", b, i, x, v)

    def word_choose(self, *a):
        if self.s.channels == 1:
            self.helpers["choose"] = "static float choose(float which, float yes, float no) { return which != 0.0f ? yes : no; }"
        else:
            self.helpers["choose"] = (f"static {self.pixel} choose({self.pixel} which, {self.pixel} yes, {self.pixel} no) {{\n"
                                      f"    for (int c = 0; c < {self.s.channels}; ++c) yes[c] = which[c] != 0.0f ? yes[c] : no[c];\n"
                                      "    return yes;\n}")
        return f"choose({self.arguments(a)})"

    def word_with_alpha_of(self, w, alpha):
        if self.s.channels != 4:
            return self.primary(w)
        return f"vec4(vec3({self.e(w)}), {self.primary(alpha)}.w)"

    SWIZZLE = {1: ".x", 2: "", 4: ""}

    def sampled(self, text):
        return f"vec2({text})" if self.s.channels == 2 else text + self.SWIZZLE[self.s.channels]

    def word_sample2d(self, b, uv): return self.sampled(f"{b[1]}.linear(vec3({self.e(uv)}, 0.0f))")
    def word_sample3d(self, b, uvw, level): return self.sampled(f"{b[1]}.linear({self.e(uvw)})")

    PIXEL = "static_cast<std::ptrdiff_t>(y) * stride + x"
    VOXEL = "(static_cast<std::ptrdiff_t>(p.z) * extent.y + p.y) * extent.x + p.x"

    def access(self, b, verb, what):
        kind, stored = self.kinds[b]
        name, index = f"{verb}_{what}_{b}", self.PIXEL if what == "pixel" else self.VOXEL
        if kind in IMAGES:
            place = "x, y, 0" if what == "pixel" else "p.x, p.y, p.z"
            given, value = "int x, int y" if what == "pixel" else "ivec3 p", self.pixel
            fill = {1: "vec4(v, 0.0f, 0.0f, 0.0f)", 2: "vec4(v, 0.0f, 0.0f)", 4: "v"}[self.s.channels]
            body = f"return {self.sampled(f'{b}.texel({place})')};" if verb == "load" else f"{b}.texel({place}) = {fill};"
        else:
            given = "int stride, int x, int y" if what == "pixel" else "ivec3 extent, ivec3 p"
            value, n = PIXELS[stored], CHANNELS[stored]
            code = "f16" if stored[:3] == "f16" else "unorm8"
            if stored[:3] == "f32":
                body = f"return {b}[{index}];" if verb == "load" else f"{b}[{index}] = v;"
            elif verb == "load":
                parts = ", ".join(f"{code}_value(at[{c}])" for c in range(n))
                body = f"const {self.STORED[stored]}* at = {b} + {n} * ({index});\n    return {value}({parts});"
            else:
                parts = " ".join(f"at[{c}] = static_cast<{self.STORED[stored]}>({code}_bits(v.{'xyzw'[c]}));" for c in range(n))
                body = f"{self.STORED[stored]}* at = {b} + {n} * ({index});\n    {parts}"
        head = f"{value if verb == 'load' else 'void'} {name}({given}" + (")" if verb == "load" else f", {value} v)")
        self.helpers[name] = f"{head} {{\n    {body}\n}}"
        return name

    is_image = OpenCl.is_image

    def word_load_pixel(self, b, stride, x, y):
        return f"{self.access(b[1], 'load', 'pixel')}({self.arguments([x, y] if self.is_image(b) else [stride, x, y])})"

    def word_store_pixel(self, b, stride, x, y, v):
        return f"{self.access(b[1], 'store', 'pixel')}({self.arguments([x, y, v] if self.is_image(b) else [stride, x, y, v])})"

    def word_load_voxel(self, b, extent, p):
        return f"{self.access(b[1], 'load', 'voxel')}({self.arguments([p] if self.is_image(b) else [extent, p])})"

    def word_store_voxel(self, b, extent, p, v):
        return f"{self.access(b[1], 'store', 'voxel')}({self.arguments([extent, p, v])})"

    def phases(self, parts, indent):
        lead, lines = " " * indent, []
        for i, part in enumerate(parts):  # run() goes over the workgroup once a phase
            lines += [f"{lead}if (phase == {i}) {{"] + self.body(part, indent + 4) + [lead + "}"]
        return lines

    def head(self, f, given):
        if f.entry:
            return f"void invoke({'int phase' if self.phase_count() > 1 else ''})"
        return f"{f.type} {f.name}({given})"

    def phase_count(self):
        return max([1] + [len(s.parts) for f in self.s.functions for s in statements(f.body) if s.kind == "phases"])

    def pointer(self, kind, stored, name):
        if kind in IMAGES:
            return f"Image {name}"
        if kind == "UNIFORM":
            return f"const float* {name} = nullptr"
        return f"{'' if kind in ('WRITE', 'UPDATE') else 'const '}{self.STORED[stored]}* {name} = nullptr"

    IMAGE = """// Texels as four floats each, missing channels 0, row after row, slice after slice.
struct Image {
    vec4* texels = nullptr;
    int width = 1, height = 1, depth = 1;
    bool wrap = false;  // coordinates outside, where it is sampled: repeated, else clamped
    vec4& texel(int x, int y, int z) const { return texels[(static_cast<std::ptrdiff_t>(z) * height + y) * width + x]; }
    int inside(int i, int n) const { return wrap ? (i % n + n) % n : i < 0 ? 0 : i >= n ? n - 1 : i; }
    vec4 linear(vec3 uvw) const {
        const int size[] = {width, height, depth};
        int low[3], high[3];
        float f[3];
        for (int a = 0; a < 3; ++a) {
            const float p = uvw[a] * float(size[a]) - 0.5f, base = std::floor(p);
            f[a] = p - base;
            low[a] = inside(static_cast<int>(base), size[a]);
            high[a] = inside(static_cast<int>(base) + 1, size[a]);
        }
        auto row = [&](int y, int z) { return glm::mix(texel(low[0], y, z), texel(high[0], y, z), f[0]); };
        auto slice = [&](int z) { return glm::mix(row(low[1], z), row(high[1], z), f[1]); };
        return depth == 1 ? slice(0) : glm::mix(slice(low[2]), slice(high[2]), f[2]);
    }
};
"""

    def text(self, banner):
        functions = self.all_functions(4)
        constants = self.constant_lines("constexpr {type} {name} = {value};", "constexpr {type} {name} = {value};")
        images = any(k in IMAGES for k, _, _, _ in self.s.bindings)
        helpers = [("    " + h) if h else "" for text in self.helpers.values() for h in text.split("\n")]
        everything = "\n".join(functions + helpers + constants + [self.STORED.get(t, "") for _, _, t, _ in self.s.bindings])
        words = set(re.findall(r"\w+", everything))
        using = [f"using glm::{w};" for w in sorted(words & (GLM_TYPES | GLM_WORDS) | {"ivec3"} | ({"vec3", "vec4"} if images else set()))]
        using += [f"using std::{w};" for w in sorted(words & STD_WORDS)]
        lines = [*banner, "#pragma once", "#ifndef GLM_FORCE_XYZW_ONLY", "#define GLM_FORCE_XYZW_ONLY", "#endif",
                 "#include <glm/glm.hpp>", "", "#include <cmath>", "#include <cstddef>", "#include <cstdint>", "#include <cstring>", "",
                 f"namespace {self.s.name} {{", "", "using uint = unsigned int;"]
        for i in range(0, len(using), 5):
            lines.append(" ".join(using[i:i + 5]))
        lines.append("")
        for a, b, name in (("uint", "float", "floatBitsToUint"), ("float", "uint", "uintBitsToFloat"),
                           ("int", "float", "floatBitsToInt"), ("float", "int", "intBitsToFloat")):
            if name in words:
                lines.append(f"inline {a} {name}({b} v) {{ {a} u; std::memcpy(&u, &v, sizeof u); return u; }}")
        lines += [""] * (lines[-1] != "") + constants + [""] * bool(constants)
        if images:
            lines += self.IMAGE.split("\n")
        if self.s.parameters:
            lines += ["struct Parameters {"]
            lines += [f"    {t} {n} = 0;" + (f"  // {r}" if r else "") for t, n, r in self.s.parameters] + ["};", ""]
        lines += ["struct Kernel {"] + (["    Parameters params;"] if self.s.parameters else [])
        lines += [f"    {self.pointer(k, t, n)};" for k, _, t, n in self.s.bindings] + [""]
        lines += [f"    {t} {n}[{c}] = {{}};" for t, c, n in self.s.shared]
        x, y, z = self.s.workgroup
        count = self.phase_count()
        phase = "            for (int phase = 0; phase < %d; ++phase) {  // a barrier between\n" % count if count > 1 else ""
        call = "invoke(phase)" if count > 1 else "invoke()"
        lines += f"""    // All invocations of workgroups [first, last), counted x first. Of a kernel that only reads and writes its own
    // results, other threads may run other workgroups with a Kernel of their own.
    void run(ivec3 groups, long first, long last) {{
        for (long g = first; g < last; ++g) {{
            group_ = ivec3(static_cast<int>(g % groups.x), static_cast<int>(g / groups.x % groups.y),
                          static_cast<int>(g / groups.x / groups.y));
{phase}            for (int z = 0; z < {z}; ++z)
                for (int y = 0; y < {y}; ++y)
                    for (int x = 0; x < {x}; ++x) {{
                        local_ = ivec3(x, y, z);
                        invocation_ = group_ * ivec3({x}, {y}, {z}) + local_;
                        {call};
                    }}
{'            }' + chr(10) if count > 1 else ''}        }}
    }}
    void run(ivec3 groups) {{ run(groups, 0, static_cast<long>(groups.x) * groups.y * groups.z); }}

    ivec3 invocation_{{0}}, local_{{0}}, group_{{0}};
""".split("\n")
        return "\n".join(lines + helpers + [""] * bool(helpers) + functions) + f"\n}};\n\n}}  // namespace {self.s.name}\n"
