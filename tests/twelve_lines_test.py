#!/usr/bin/env python3
"""The small layer's example gives what `luxel gaussian_blur` gives, on each execution: twelve_lines_test.py EXAMPLE PROGRAM DIR"""
import pathlib
import subprocess
import sys

import numpy

example, program, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
y, x = numpy.mgrid[0:40, 0:64]
image = numpy.stack([(x // 8 + y // 8) % 2, x / 64, y / 40], 2).astype(numpy.float32)
numpy.save(folder / "twelve_in.npy", image)
subprocess.run([program, "gaussian_blur", "--in", folder / "twelve_in.npy", "--sigma", "4", "--device", "cpu", "-o",
                folder / "twelve_own.npy"], check=True)
for device in ("opencl", "vulkan", "cpu"):
    subprocess.run([example, folder / "twelve_in.npy", folder / "twelve_out.npy", device], check=True)
    if not numpy.array_equal(numpy.load(folder / "twelve_out.npy"), numpy.load(folder / "twelve_own.npy")):
        sys.exit(f"{device}: another result than luxel's own")
subprocess.run([example, folder / "twelve_in.npy", folder / "twelve.png", "cpu"], check=True)
bad = subprocess.run([example, folder / "nothing.npy", "x.png"], capture_output=True, text=True)
if bad.returncode != 1 or bad.stderr.count("\n") != 1:
    sys.exit(f"a missing file gives status {bad.returncode}: {bad.stderr}")
