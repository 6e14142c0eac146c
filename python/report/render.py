#!/usr/bin/env python3
"""Turns a report's DIR/report.json and pictures into DIR/plots and one self-contained DIR/index.html.

usage: render.py DIR
"""

import json
import os
import pathlib
import sys

sys.dont_write_bytecode = True  # the source folder may not be ours


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    folder = pathlib.Path(sys.argv[1])
    try:
        import plots
    except ImportError as error:
        print(f"{error.name} is missing (Debian: apt-get install python3-{error.name.split('.')[0]})", file=sys.stderr)
        return 3
    import page

    try:
        report = json.loads((folder / "report.json").read_text())
        pictures = folder / "pictures.json"
        pictures = json.loads(pictures.read_text()) if pictures.exists() else []
    except (OSError, ValueError) as error:
        print(f"{folder}: {error}; run `luxel report -o {folder}` again", file=sys.stderr)
        return 2
    figures = plots.draw(report, folder / "plots")
    methods = plots.draw_methods(report, folder / "plots")
    part = folder / "index.html.part"
    part.write_text(page.page(report, pictures, figures, folder, methods))
    os.replace(part, folder / "index.html")  # whole or not at all
    return 0


if __name__ == "__main__":
    sys.exit(main())
