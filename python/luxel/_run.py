"""Devices, and kernels on arrays: what is given is checked against the plan's resources, named where it does not fit."""
import numpy as np

from . import _luxel

_TYPES = {"f32": np.float32, "f16": np.float16, "u32": np.uint32, "unorm8": np.uint8}
_open = {}


def _kind(resource):
    return resource.format.name.split("x")[0]


def as_array(value, name):
    """An array of what is given: NumPy's own, or anything that speaks DLPack or the array interface."""
    if isinstance(value, np.ndarray):
        return value
    if hasattr(value, "__dlpack__"):
        return np.from_dlpack(value)
    array = np.asarray(value)
    if array.dtype == object:
        raise TypeError(f"{name} is {type(value).__name__}; expected an array of numbers")
    return array


def device(which=None):
    """An open device: a name ("opencl", "vulkan", "cpu", "cpu:double", or part of one that `devices()` lists), a device, or None
    for the first of opencl, vulkan and cpu that works. Opened once in a process. Errors: luxel.Error, naming what there is."""
    if isinstance(which, _luxel.Context):
        return which
    if which is not None:
        if which not in _open:
            _open[which] = _luxel.open(which)
        return _open[which]
    for name in ("opencl", "vulkan", "cpu"):
        try:
            return device(name)
        except _luxel.Error as error:
            problem = error
    raise problem


def _values(resource):
    return resource.bytes // _size(resource) if resource.is_buffer else int(np.prod(resource.extent)) * _luxel.channels(resource.format)


def _size(resource):
    return {"f32": 4, "u32": 4, "f16": 2, "unorm8": 1}[_kind(resource)]


def _bytes(resource, given, real64):
    """The bytes of a resource, from an array of at least as many values."""
    array = as_array(given, resource.name)
    kind, need = _kind(resource), _values(resource)
    if array.dtype.kind not in "fiub":
        raise TypeError(f"{resource.name} holds {array.dtype}; expected {np.dtype(_TYPES[kind])} ({resource.format.name})")
    if kind == "u32" and array.dtype.kind == "f":
        raise TypeError(f"{resource.name} holds {array.dtype}; expected uint32 or int32 ({resource.format.name})")
    if array.size < need:
        raise ValueError(f"{resource.name} has {array.size} values; expected at least {need} ({resource.format.name})")
    flat = np.ascontiguousarray(array).reshape(-1)
    if kind == "u32":
        flat = flat.view(np.uint32) if flat.dtype == np.int32 else flat.astype(np.uint32)
    elif kind == "unorm8":
        steps = flat if flat.dtype == np.uint8 else np.clip(np.nan_to_num(flat.astype(np.float64)) * 255 + 0.5, 0, 255.5).astype(np.uint8)
        flat = steps.astype(np.float64) / 255 if real64 else steps
    else:
        if flat.dtype == np.uint8:
            flat = flat / np.float32(255)
        flat = flat.astype(np.float64 if real64 else _TYPES[kind])
    return flat.view(np.uint8)


def _result(resource, raw, real64):
    """Values of a resource: [texel][channel], images [z][y][x][channel]; one channel has no axis of its own."""
    kind, channels = _kind(resource), _luxel.channels(resource.format)
    array = raw.view(np.float64 if real64 and kind != "u32" else _TYPES[kind])
    if resource.is_buffer:
        return array if channels == 1 else array.reshape(-1, channels)
    x, y, z = resource.extent
    return array.reshape([n for n in (z, y, x, channels) if n > 1] or [1])


def run(params, arrays=None, *, device=None, repeat=1, times=False, **more):
    """Runs a kernel once (or `repeat` times back to back) with the parameters and arrays of its header in include/luxel.

    params: e.g. ConeTraceParams(...), or a Plan. arrays, more: a value for each resource that is read, by name; also for one that is
    written where what it holds before counts; f32 and f16 take any numbers, uint8 counts as 0..1. Returns the resources that are
    written, by name. times: also "times": (milliseconds in all, [of each pass]). Errors: ValueError (a value out of its range, an
    array too small, a resource missing), TypeError, luxel.Error."""
    context = _device(device)
    plan = params if isinstance(params, _luxel.Plan) else _luxel.plan(params, context.profile)
    given = {**(arrays or {}), **more}
    names = [resource.name for resource in plan.resources]
    for name in given:
        if name not in names:
            raise ValueError(f"{plan.kernel} takes no {name}; expected {', '.join(names)}")
    ready = {}
    for resource in plan.resources:
        if resource.name in given:
            ready[resource.name] = _bytes(resource, given[resource.name], context.real64)
        elif not resource.written:
            raise ValueError(f"{plan.kernel} needs {resource.name}: {_values(resource)} values ({resource.format.name})")
    made = context.run(plan, ready, repeat, times)
    results = {r.name: _result(r, made[r.name], context.real64) for r in plan.resources if r.written}
    if times:
        results["times"] = made["times"]
    return results


_device = device
