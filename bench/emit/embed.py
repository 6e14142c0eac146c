#!/usr/bin/env python3
"""Writes a C++ file that holds text files, for `luxel emit` to work without the source tree.

    embed.py OUT.cpp NAME=FILE...     FILE: its text; READMEs are cut down to what they say of errors
"""
import json
import pathlib
import re
import sys


def error_lines(path):
    """The paragraphs of a kernel's README that state errors, without markup of the page."""
    found = []
    for paragraph in re.split(r"\n\s*\n", path.read_text()):
        if paragraph.lstrip().startswith(("|", "#", "!", "    ")):
            continue
        if re.match(r"\**(Error|Truncation|Arithmetic|Rounding)\b", paragraph):
            found.append(" ".join(paragraph.split()))
    return found


def literal(text):
    pieces = [text[i:i + 8000] for i in range(0, len(text), 8000)]
    return "\n".join(f'R"luxel({piece})luxel"' for piece in pieces)


out, entries = pathlib.Path(sys.argv[1]), []
errors = {}
summary = {}
for argument in sys.argv[2:]:
    name, _, file = argument.partition("=")
    path = pathlib.Path(file)
    if name == "readme":
        errors[path.parent.name] = error_lines(path)
    elif name == "summary":  # the table of the first page: | [`kernel`](...) | what | variants | error | time |
        for kernel, error in re.findall(r"^\| \[`(\w+)`\][^|]*\|[^|]*\|[^|]*\|\s*([^|]*?)\s*\|", path.read_text(), re.MULTILINE):
            summary[kernel] = error
    else:
        entries.append((name, path.read_text()))
entries.append(("errors.json", json.dumps({"stated": errors, "summary": summary})))
text = '#include "bench/emit/embedded.h"\n\nnamespace luxel::emit {\n\nconst std::vector<Embedded>& embedded() {\n' \
       "  static const std::vector<Embedded> files{\n"
for name, content in entries:
    text += f'    {{"{name}", {literal(content)}}},\n'
text += "  };\n  return files;\n}\n\n}  // namespace luxel::emit\n"
if not out.exists() or out.read_text() != text:
    out.write_text(text)
