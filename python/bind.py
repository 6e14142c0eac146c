#!/usr/bin/env python3
"""Writes the Python bindings of luxel's public headers: enums, parameters, and the functions of parameters.

Nothing is listed by hand: what a kernel's header declares is what Python has. Structs and functions whose types Python has no
word for (pointers, functions) are left out; `core.cpp` has those that are of use.
"""
import pathlib
import re
import sys

NOT_KERNELS = {"status", "plan", "device", "opencl", "vulkan", "reference", "version", "export"}
VALUES = {"int", "double", "bool", "float", "unsigned", "std::size_t", "std::string", "std::uint32_t", "std::int32_t", "Format", "Input"}


def known(kind, types):
    """Whether nanobind converts a C++ type by value."""
    kind = kind.replace("const ", "").replace("&", "").strip()
    inner = re.fullmatch(r"(?:std::vector|std::array|std::optional)<(.+?)(?:, \d+)?>", kind)
    return known(inner.group(1), types) if inner else kind in VALUES or kind in types


def comment_of(line):
    return line.split("//", 1)[1].lstrip("/< ").strip() if "//" in line else ""


def enums_of(text):
    """(C++ name, Python name, values); an enum inside a struct has the struct's name before its own in Python."""
    for match in re.finditer(r"^(?:struct (\w+) \{|( *)enum class (\w+)(?: : [\w:]+)? \{(.*?)\})", text, re.DOTALL | re.MULTILINE):
        if match.group(1):
            outer = match.group(1)
            continue
        bare = re.sub(r"//[^\n]*", "", match.group(4))
        values = [name.split("=")[0].strip() for name in bare.split(",") if name.strip()]
        name = match.group(3)
        yield (f"{outer}::{name}", outer + name, values) if match.group(2) else (name, name, values)


def structs_of(text):
    """(name, [(type, field, comment)]); a struct with a field that cannot be read gives None for its fields."""
    for match in re.finditer(r"^struct (?:LUXEL_\w+ )?(\w+) \{\n(.*?)^\};", text, re.DOTALL | re.MULTILINE):
        fields, depth = [], 0
        for line in match.group(2).splitlines():
            code = line.split("//")[0].strip()
            declared = re.fullmatch(r"((?:const )?[\w:]+(?:<.+>)?\*?) (\w+(?:(?: = [^,;]+|\{[^}]*\})?, \w+)*)(?: = .+|\{.*\})?;", code)
            if depth == 0 and declared:
                for name in re.sub(r"( = [^,;]+|\{[^}]*\})", "", declared.group(2)).split(", "):
                    fields.append((declared.group(1), name, comment_of(line)))
            depth += code.count("{") - code.count("}") if code.endswith(("{", "}", "};")) else 0
        yield match.group(1), fields


def functions_of(text):
    """(result, name, [(type, name, default)], comment) of what is declared at namespace level."""
    pattern = r"((?:^///[^\n]*\n)*)^(?:LUXEL_\w+ )?((?:std::|Result<|Status|MipBuildParams|\w)[\w:<>, ]*?) (\w+)\(([^;{}]*)\);"
    for match in re.finditer(pattern, text, re.MULTILINE):
        arguments = []
        for part in re.split(r", (?![^<]*>)", " ".join(match.group(4).split())):
            got = re.fullmatch(r"(.+?) ?(\w+)(?: = (.+))?", part)
            if part and got:
                arguments.append((got.group(1).strip(), got.group(2), got.group(3)))
        comment = " ".join(line.lstrip("/ ") for line in match.group(1).splitlines())
        yield match.group(2), match.group(3), arguments, comment


def quoted(text):
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def main(include, out):
    headers = [path for path in sorted((include / "luxel").glob("*.h")) if path.stem not in NOT_KERNELS]
    texts = [re.sub(r"\n +///< ", " ", path.read_text()) for path in headers]  # comments that go on below their line
    enums = [enum for text in texts for enum in enums_of(text)]
    structs = [struct for text in texts for struct in structs_of(text)]
    types = {name.split("::")[-1] for name, _, _ in enums} | {name for name, _ in structs}
    changed = True
    while changed:  # a struct goes where one of its fields cannot be shown
        lost = {name for name, fields in structs if name in types and not (fields and all(known(kind, types) for kind, _, _ in fields))}
        types -= lost
        changed = bool(lost)
    lines = ["// Made by bind.py from the public headers.", '#include "core.h"', ""]
    lines += [f"#include <luxel/{path.name}>" for path in headers]
    lines += ["", "namespace luxel::python {", "", "void bind_kernels(nb::module_& m) {"]
    for name, shown, values in enums:
        lines.append(f'  nb::enum_<{name}>(m, "{shown}")')
        lines += [f'      .value("{value}", {name}::{value})' for value in values]
        lines.append("      ;")
    ordered, left = [], [(name, fields) for name, fields in structs if name in types]
    while left:  # what is a field of another comes first
        ready = [(n, f) for n, f in left if not any(o in kind for kind, _, _ in f for o, _ in left if o != n)]
        ordered += ready
        left = [pair for pair in left if pair not in ready]
    for name, fields in ordered:
        lines.append(f"  fields(nb::class_<{name}>(m, \"{name}\"))")
        lines += [f'      .def_rw("{field}", &{name}::{field}, {quoted(comment)})' for _, field, comment in fields]
        lines.append("      ;")
    for text in texts:
        for result, name, arguments, comment in functions_of(text):
            plain = re.sub(r"^Result<(.+)>$", r"\1", result)
            if name == "plan":
                params = arguments[0][0].replace("const ", "").replace("&", "")
                if params in types:
                    lines.append(f'  m.def("plan", [](const {params}& p, const std::string& profile_name) {{ return value_of(plan(p, '
                                 f'profile(profile_name))); }}, nb::arg("params"), nb::arg("profile") = "reference");')
                continue
            if not all(known(kind, types) for kind, _, _ in arguments) or not (plain == "Status" or known(plain, types)):
                continue
            if any("&" in kind and "const" not in kind for kind, _, _ in arguments):
                continue
            given = ", ".join(f"{kind} {argument}" for kind, argument, _ in arguments)
            passed = ", ".join(argument for _, argument, _ in arguments)
            body = f"check({name}({passed}))" if plain == "Status" else f"return value_of({name}({passed}))" if plain != result \
                else f"return {name}({passed})"
            words = "".join(f', nb::arg("{argument}")' + (f" = {default}" if default else "") for _, argument, default in arguments)
            lines.append(f'  m.def("{name}", []({given}) {{ {body}; }}{words}, {quoted(comment)});')
    lines += ["}", "", "}  // namespace luxel::python", ""]
    out.write_text("\n".join(lines))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
