#!/usr/bin/env python3
"""A kernel without luxel: the OpenCL C that `luxel emit` wrote, bound and launched by its manifest with PyOpenCL.

    luxel emit gaussian_blur --size 320x200 --options sigma=6 --format opencl -o blur
    emitted_opencl.py blur/gaussian_blur.json src=in.raw dst=out.raw [--picture out.ppm WIDTH]
"""
import json
import pathlib
import struct
import sys

import numpy
import pyopencl as cl


def picture(path, pixels, width):
    """Linear f32x4 pixels as a screen shows them: the sRGB curve."""
    light = numpy.clip(pixels.reshape(-1, width, 4)[:, :, :3], 0, 1)
    shown = numpy.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
    with open(path, "wb") as out:
        out.write(b"P6 %d %d 255\n" % (width, len(light)))
        out.write((255 * shown + 0.5).astype(numpy.uint8).tobytes())


def main():
    path, words = pathlib.Path(sys.argv[1]), sys.argv[2:]
    shown = None
    if "--picture" in words:
        at = words.index("--picture")
        shown, words = words[at + 1:at + 3], words[:at] + words[at + 3:]
    files = dict(word.split("=", 1) for word in words)
    manifest = json.loads(path.read_text())
    context = cl.Context([cl.get_platforms()[0].get_devices()[0]])
    queue = cl.CommandQueue(context)

    # Everything that passes name: the caller's resources, scratch, tables. Zero, until something is written.
    sizes = {r["name"]: r["bytes"] for r in manifest["resources"] if r["kind"] == "buffer"}
    sizes.update({s["name"]: s["bytes"] for s in manifest["scratch"] + manifest["tables"]})
    buffers = {}
    for name, size in sizes.items():
        first = numpy.zeros(max(size, 4), numpy.uint8)
        values = next((t["values"] for t in manifest["tables"] if t["name"] == name), None)
        if values is not None:
            first.view(numpy.float32)[:len(values)] = values
        elif name in files and not next(r["written"] for r in manifest["resources"] if r["name"] == name):
            first = numpy.fromfile(files[name], numpy.uint8)
            assert first.size == size, f"{files[name]} does not have the bytes of {name}"
        buffers[name] = cl.Buffer(context, cl.mem_flags.READ_WRITE | cl.mem_flags.COPY_HOST_PTR, hostbuf=first)

    kernels = {}
    for shader in manifest["shaders"]:
        source = (path.parent / shader["files"]["opencl"]).read_text()
        # Constants that were left open (`constants`) would be given here, as -D NAME=value.
        kernels[shader["name"]] = cl.Kernel(cl.Program(context, source).build(), shader["entry"]["opencl"])

    for run in manifest["passes"]:
        shader = next(s for s in manifest["shaders"] if s["name"] == run["shader"])
        kernel = kernels[shader["name"]]
        if shader["parameters"]["members"]:
            code = {"f32": "f", "i32": "i", "u32": "I"}
            kernel.set_arg(0, b"".join(
                struct.pack("<" + code[m["type"]], run["parameters"][m["name"]]["value"] if m["type"] == "f32"
                            else int(run["parameters"][m["name"]]["value"])) for m in shader["parameters"]["members"]))
        for binding in shader["bindings"]:
            kernel.set_arg(binding["opencl_argument"], buffers[run["bind"][binding["name"]]])
        for local in shader.get("opencl_local_arguments", []):
            kernel.set_arg(local["opencl_argument"], cl.LocalMemory(local["bytes"]))
        group = shader["workgroup"]
        cl.enqueue_nd_range_kernel(queue, kernel, [g * w for g, w in zip(run["groups"], group)], group)

    for resource in manifest["resources"]:
        if resource["written"] and resource["kind"] == "buffer" and (resource["name"] in files or shown):
            result = numpy.empty(resource["bytes"], numpy.uint8)
            cl.enqueue_copy(queue, result, buffers[resource["name"]])
            if resource["name"] in files:
                result.tofile(files[resource["name"]])
            if shown and resource["format"] == "f32x4":
                picture(shown[0], result.view(numpy.float32), int(shown[1]))
                shown = None


if __name__ == "__main__":
    main()
