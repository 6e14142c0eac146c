#!/usr/bin/env python3
"""Writes the linker's version script of the shared library: what public headers declare is seen outside, nothing else.

    exports.py OUT.map HEADER...
"""
import pathlib
import re
import sys

patterns, exact = set(), set()
for header in sys.argv[2:]:
    text = re.sub(r"//[^\n]*|/\*.*?\*/", "", pathlib.Path(header).read_text(), flags=re.DOTALL)
    space = re.search(r"^namespace ([\w:]+)", text, re.MULTILINE)
    if not space:
        continue
    for line in text.splitlines():
        kind = re.match(r"(?:class|struct)\s+(?:\[\[\w+\]\]\s+)?(\w+)", line)
        function = re.match(r"(?!constexpr|inline|template|namespace|using|struct|class|enum|return|#)[A-Za-z][^=(]*?\b(\w+)\(", line)
        if kind:
            name = f"{space[1]}::{kind[1]}"
            patterns.add(f"{name}::*")
            exact |= {f"{what} for {name}" for what in ("vtable", "typeinfo", "typeinfo name")}
        elif function:
            patterns.add(f"{space[1]}::{function[1]}[!_a-zA-Z0-9]*")
lines = [f"    {p};" for p in sorted(patterns)] + [f'    "{e}";' for e in sorted(exact)]
pathlib.Path(sys.argv[1]).write_text('{\n  global: extern "C++" {\n' + "\n".join(lines) + "\n  };\n  local: *;\n};\n")
