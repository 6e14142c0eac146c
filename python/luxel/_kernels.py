"""The kernels on images, volumes and meshes as NumPy has them. Every other call: `run` with the parameters of its header."""
import numpy as np

from . import _luxel
from ._run import as_array, run

_FORMATS = {1: {"float32": "f32x1"}, 2: {"float32": "f32x2", "float16": "f16x2"},
            4: {"float32": "f32x4", "float16": "f16x4", "uint8": "unorm8x4"}}


def _image(image, name="image", formats=_FORMATS):
    """(values [y][x][c] as a format holds them, the format, a function that gives results the image's own shape)."""
    array = as_array(image, name)
    if array.ndim not in (2, 3) or (array.ndim == 3 and not 1 <= array.shape[2] <= 4) or 0 in array.shape:
        raise ValueError(f"{name} has the shape {array.shape}; expected H x W or H x W x C with 1 to 4 channels")
    own = array.shape[2] if array.ndim == 3 else 1
    kind = array.dtype.name if array.dtype.name in ("float16", "uint8") else "float32"
    channels = own if own in formats and kind in formats[own] else 4
    values = array.reshape(*array.shape[:2], own)
    if channels > own:
        pad = np.ones if own == 3 else np.zeros
        values = np.concatenate([values, pad((*array.shape[:2], channels - own), array.dtype) * (255 if own == 3 and kind == "uint8" else 1)],
                                axis=2).astype(array.dtype)

    def back(result):
        return result.reshape(*array.shape[:2], channels)[:, :, :own].reshape(array.shape)
    return values, formats[channels][kind], back


def gaussian_blur(image, sigma, *, device=None, **fields):
    """A Gaussian blur. image: H x W or H x W x C (float32, float16, uint8; other numbers as float32); sigma: pixels, 0..10000;
    fields: of GaussianBlurParams (variant, border, radius ...). Returns an image of the same shape. Source: kernels/gaussian_blur."""
    values, form, back = _image(image)
    params = _luxel.GaussianBlurParams(width=values.shape[1], height=values.shape[0], sigma=sigma, format=form, **fields)
    return back(run(params, src=values, device=device)["dst"])


def bilateral(image, *, device=None, guides=None, **fields):
    """A bilateral filter. image as in gaussian_blur; guides: arrays by the name of their resource (depth, normals, guide ...);
    fields: of BilateralParams (variant, radius, sigma_space, sigma_range ...). Returns an image of the same shape."""
    values, form, back = _image(image, formats={1: {"float32": "f32x1"}, 4: _FORMATS[4]})
    params = _luxel.BilateralParams(width=values.shape[1], height=values.shape[0], format=form, **fields)
    return back(run(params, {"src": values, **(guides or {})}, device=device)["dst"])


def mip_build(image, *, device=None, **fields):
    """The coarser levels of an image (H x W x C) or a volume (D x H x W x 4), finest first; directional volumes have an axis of
    six before the rest. fields: of MipBuildParams (variant, sizes, ratio, levels ...)."""
    array = as_array(image, "image")
    volume = array.ndim == 4
    if volume and array.shape[3] != 4:
        raise ValueError(f"image has the shape {array.shape}; expected D x H x W x 4 for a volume")
    if volume:
        kind = array.dtype.name if array.dtype.name in ("float16", "uint8") else "float32"
        values, form = array, _FORMATS[4][kind]
        depth, height, width = array.shape[:3]
    else:
        values, form, _ = _image(array)
        depth, (height, width) = 1, values.shape[:2]
    params = _luxel.MipBuildParams(width=width, height=height, depth=depth, format=form, **fields)
    made = run(params, level_0=values, device=device)
    levels = []
    for level in range(1, _luxel.mip_levels(params) + 1):
        w, h, d = _luxel.mip_extent(params, level)
        shape = (d, h, w, -1) if volume else (h, w, -1)
        name = _luxel.mip_level_name(level, -1)
        if name in made:
            levels.append(made[name].reshape(shape))
        else:
            levels.append(np.stack([made[_luxel.mip_level_name(level, k)].reshape(shape) for k in range(6)]))
    return levels


def voxelize(vertices, triangles, resolution, *, colours=None, materials=None, origin=None, voxel=None, device=None, **fields):
    """A mesh in voxels. vertices: N x 3; triangles: M x 3 indices; resolution: voxels along each side, 1..1024; colours: K x 4 linear
    base colours and opacities, and materials: one of them a triangle (default: grey); origin, voxel: the outer corner of voxel
    (0, 0, 0) and a voxel's side (default: the bounding cube, padded by 1 % at each end). Returns (volume [z][y][x][4] of straight
    colour and coverage, origin, voxel)."""
    points = np.ascontiguousarray(as_array(vertices, "vertices"), np.float64)
    faces = np.ascontiguousarray(as_array(triangles, "triangles"), np.uint32)
    for name, array in (("vertices", points), ("triangles", faces)):
        if array.ndim != 2 or array.shape[1] != 3:
            raise ValueError(f"{name} has the shape {array.shape}; expected N x 3")
    if origin is None or voxel is None:
        used = points[faces[faces.max(axis=1) < len(points)].reshape(-1)]
        used = used[np.isfinite(used).all(axis=1)]
        low, high = (used.min(axis=0), used.max(axis=0)) if len(used) else (np.zeros(3), np.ones(3))
        side = max(float((high - low).max()) * 1.02, 1e-30)
        origin, voxel = (low + high) / 2 - side / 2, side / resolution
    grid = _luxel.VoxelGrid(width=resolution, height=resolution, depth=resolution, origin=[float(v) for v in origin], voxel=float(voxel))
    made = _luxel.voxel_triangles(points, faces, None if materials is None else [int(k) for k in materials], grid)
    params = _luxel.voxelize_params(grid, made)
    palette = np.zeros((1 if colours is None else len(colours), 2, 4), np.float32)
    palette[:, 0] = (0.5, 0.5, 0.5, 1) if colours is None else as_array(colours, "colours")
    params.materials = len(palette)
    for name, value in fields.items():
        setattr(params, name, value)
    result = run(params, triangles=np.array(made.records or [0] * 12, np.int32), materials=palette, device=device)
    return result["colour"].reshape(resolution, resolution, resolution, 4), np.array(origin), float(voxel)


def cone_trace(volume, positions, normals, *, origin=(0, 0, 0), voxel=1.0, cones=6, device=None, **fields):
    """Irradiance and visibility at points, by cones through voxels. volume: [z][y][x][4], premultiplied radiance and opacity;
    positions, normals: N x 3, scene units; origin, voxel: as voxelize gives them; cones: 1, 4, 5, 6, 8, 9, 16 or 25; fields: of
    ConeTraceParams (environment, step_scale ...). Returns N x 4: irradiance r, g, b and the visible part 0..1."""
    array = as_array(volume, "volume")
    if array.ndim != 4 or array.shape[3] != 4:
        raise ValueError(f"volume has the shape {array.shape}; expected D x H x W x 4")
    places, facing = as_array(positions, "positions"), as_array(normals, "normals")
    if places.ndim != 2 or places.shape[1] != 3 or facing.shape != places.shape:
        raise ValueError(f"positions and normals have the shapes {places.shape} and {facing.shape}; expected N x 3 both")
    count = len(places)
    width = min(count, 4096)
    height = -(-count // width)
    depth, rows, columns = array.shape[:3]
    form = "f16x4" if array.dtype == np.float16 else "unorm8x4" if array.dtype == np.uint8 else "f32x4"
    params = _luxel.ConeTraceParams(width=width, height=height, extent=[columns, rows, depth], format=form, voxel=float(voxel),
                                    origin=[float(v) for v in origin], cones=_luxel.cone_set(cones, 0), **fields)
    levels = mip_build(array, device=device, variant=params.variant.name)
    coarse = np.zeros((_luxel.cone_trace_coarse_texels(params), 4), array.dtype)
    for k, level in enumerate(levels, 1):
        for direction, one in enumerate(level if level.ndim == 5 else [level]):
            at = _luxel.cone_trace_level_offset(params, k, direction)
            texels = one.reshape(-1, 4)
            coarse[at:at + len(texels)] = texels
    receivers = np.zeros((width * height, 2, 4), np.float32)
    receivers[:count, 0, :3], receivers[:count, 1, :3] = places, facing
    return run(params, fine=array, coarse=coarse, receivers=receivers, device=device)["irradiance"][:count]
