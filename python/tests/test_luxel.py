"""The Python package: every kernel's call on arrays, the same results on every device, and errors that name what is wrong."""
import json
import os
import pathlib

import luxel
import numpy as np
import pytest

DEVICES = [name for name in os.environ.get("LUXEL_BACKENDS", "opencl vulkan cpu").split() if name]
RANDOM = np.random.default_rng(7)


def picture(height=24, width=37, channels=3):
    return RANDOM.random((height, width, channels), dtype=np.float32)


def blurred(image, sigma, radius):
    """Separable, borders clamped, in double."""
    weights = np.exp(-np.arange(-radius, radius + 1) ** 2 / (2 * sigma ** 2))
    weights /= weights.sum()
    out = image.astype(np.float64)
    for axis in (0, 1):
        pad = [(0, 0)] * out.ndim
        pad[axis] = (radius, radius)
        wide = np.pad(out, pad, mode="edge")
        out = sum(w * np.take(wide, range(k, k + out.shape[axis]), axis) for k, w in enumerate(weights))
    return out


def test_every_backend_that_is_expected_is_there():
    found = {info.id.split(":")[0] for info in luxel.devices()}
    assert set(DEVICES) <= found


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("shape", [(24, 37), (24, 37, 1), (24, 37, 2), (24, 37, 3), (24, 37, 4)])
def test_blur_is_the_formula_and_keeps_the_shape(device, shape):
    image = RANDOM.random(shape, dtype=np.float32)
    out = luxel.gaussian_blur(image, 1.5, radius=5, device=device)
    assert out.shape == image.shape and out.dtype == np.float32
    assert np.abs(out - blurred(image, 1.5, 5)).max() <= 1e-6


def test_devices_give_the_same_bits():
    image = picture()
    first = luxel.gaussian_blur(image, 3, device="cpu")
    for device in DEVICES:
        assert np.array_equal(luxel.gaussian_blur(image, 3, device=device), first)


@pytest.mark.parametrize("kind,bound", [(np.float16, 1e-3), (np.uint8, 0.5 / 255 + 1e-6)])
def test_narrow_types_stay(kind, bound):
    image = picture(channels=4)
    narrow = (image * 255 + 0.5).astype(np.uint8) if kind == np.uint8 else image.astype(kind)
    out = luxel.gaussian_blur(narrow, 2, radius=6, device="cpu")
    assert out.dtype == kind
    scale = 255 if kind == np.uint8 else 1
    assert np.abs(out / scale - blurred(narrow.astype(np.float64) / scale, 2, 6)).max() <= bound


def test_double_is_double():
    image = RANDOM.random((9, 11, 4))
    out = luxel.gaussian_blur(image, 2, radius=6, device="cpu:double")
    assert out.dtype == np.float64
    assert np.abs(out - blurred(image, 2, 6)).max() <= 1e-14


def test_arrays_need_not_lie_in_order_and_speak_dlpack():
    image = picture(40, 60, 4)

    class Speaks:
        def __dlpack__(self, **words):
            return image.__dlpack__(**words)

        def __dlpack_device__(self):
            return image.__dlpack_device__()
    whole = luxel.gaussian_blur(image[::2, ::3], 1, device="cpu")
    assert np.array_equal(whole, luxel.gaussian_blur(np.ascontiguousarray(image[::2, ::3]), 1, device="cpu"))
    assert np.array_equal(luxel.gaussian_blur(Speaks(), 1, device="cpu"), luxel.gaussian_blur(image, 1, device="cpu"))


@pytest.mark.parametrize("device", DEVICES)
def test_bilateral_keeps_an_edge(device):
    image = np.zeros((20, 30), np.float32)
    image[:, 15:] = 1
    noisy = image + RANDOM.normal(0, 0.02, image.shape).astype(np.float32)
    out = luxel.bilateral(noisy, radius=4, sigma_space=2, sigma_range=0.1, device=device)
    assert np.abs(out - image).mean() < 0.5 * np.abs(noisy - image).mean()
    assert (out[:, 14] < 0.1).all() and (out[:, 15] > 0.9).all()


@pytest.mark.parametrize("device", DEVICES)
def test_levels_are_means(device):
    image = picture(16, 24, 4)
    levels = luxel.mip_build(image, device=device)
    assert [level.shape[:2] for level in levels] == [(8, 12), (4, 6), (2, 3), (1, 1)]
    assert np.abs(levels[0] - image.reshape(8, 2, 12, 2, 4).mean(axis=(1, 3))).max() <= 1e-6
    volume = RANDOM.random((8, 8, 8, 4), dtype=np.float32)
    assert luxel.mip_build(volume, variant="anisotropic", device=device)[0].shape == (6, 4, 4, 4, 4)


@pytest.mark.parametrize("device", DEVICES)
def test_a_box_in_voxels_and_cones(device):
    corners = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], np.float64)
    faces = [[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4], [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5]]
    volume, origin, voxel = luxel.voxelize(corners, faces, 16, device=device)
    filled = volume[..., 3] > 0
    assert filled[8, 8, 0] or filled[8, 8, 1], "a wall"
    assert not filled[8, 8, 8], "its inside is empty"
    # A closed room of radiance 1 whose walls are a voxel thick: what is not seen of it is seen beyond it.
    glowing = np.where(filled[..., None], np.float32(1), np.float32(0)) * np.ones(4, np.float32)
    light = luxel.cone_trace(glowing, [[0.5, 0.5, 0.5]], [[0, 0, 1]], origin=origin, voxel=voxel, device=device)
    assert light.shape == (1, 4)
    assert np.abs(light[0, :3] / np.pi + light[0, 3] - 1).max() < 1e-5 and light[0, 3] < 0.2


@pytest.mark.parametrize("device", DEVICES)
def test_any_kernel_runs_by_its_parameters(device):
    src = picture(16, 16, 4)
    mean = luxel.run(luxel.OutlierClampParams(width=16, height=16, k=1e6), src=src, device=device)["dst"]
    assert np.array_equal(mean.reshape(src.shape), src), "nothing is an outlier at a million deviations"
    grid = luxel.LpvGrid(extent=[4, 4, 4], cell=1.0)
    pixels = luxel.lpv_pixels(grid, 2, 1)
    light = np.zeros((pixels, 4), np.float32)
    light[0] = 1
    params = luxel.LpvPropagateParams(grid=grid, channels=1, iterations=1)
    names = [r.name for r in luxel.plan(params).resources]
    made = luxel.run(params, {name: light for name in names[:1]}, device=device)
    assert any(np.abs(value).sum() > 0 for value in made.values())


def test_times_are_given_where_asked_for():
    times = luxel.run(luxel.GaussianBlurParams(width=8, height=8), src=np.ones((8, 8, 4)), device="cpu", times=True)["times"]
    assert times[0] > 0


def test_what_is_wrong_is_named():
    with pytest.raises(ValueError, match=r"GaussianBlurParams\.sigma is -1; expected 0\.\.10000"):
        luxel.gaussian_blur(np.zeros((4, 4)), -1)
    with pytest.raises(ValueError, match=r"image has the shape \(4,\); expected H x W"):
        luxel.gaussian_blur(np.zeros(4), 1)
    with pytest.raises(AttributeError, match="GaussianBlurParams has no field sigm; did you mean sigma?"):
        luxel.GaussianBlurParams(sigm=1)
    with pytest.raises(ValueError, match="GaussianBlurParams.border is 'mirrored'; expected one of clamp, mirror, wrap, zero"):
        luxel.gaussian_blur(np.zeros((4, 4)), 1, border="mirrored")
    with pytest.raises(TypeError, match="GaussianBlurParams.radius is 'five'"):
        luxel.gaussian_blur(np.zeros((4, 4)), 1, radius="five")
    with pytest.raises(ValueError, match=r"src has 48 values; expected at least 64 \(f32x4\)"):
        luxel.run(luxel.GaussianBlurParams(width=4, height=4), src=np.zeros((4, 4, 3)))
    with pytest.raises(ValueError, match=r"gaussian_blur needs src: 64 values"):
        luxel.run(luxel.GaussianBlurParams(width=4, height=4))
    with pytest.raises(ValueError, match="gaussian_blur takes no source; expected src, dst"):
        luxel.run(luxel.GaussianBlurParams(width=4, height=4), source=np.zeros(64))
    with pytest.raises(TypeError, match="src holds complex128; expected float32"):
        luxel.run(luxel.GaussianBlurParams(width=4, height=4), src=np.zeros(64, complex))
    with pytest.raises(TypeError, match="image is object; expected an array of numbers"):
        luxel.gaussian_blur(object(), 1)
    with pytest.raises(luxel.Error, match="abacus"):
        luxel.gaussian_blur(np.zeros((4, 4)), 1, device="abacus")
    with pytest.raises(ValueError, match="one of max_error and max_ms"):
        luxel.tune("gaussian_blur")


def test_parameters_show_their_fields_and_help():
    params = luxel.GaussianBlurParams(width=8, height=4, border="mirror")
    assert "width=8" in repr(params) and "border=mirror" in repr(params)
    params.variant = "box"
    assert params.variant is luxel.GaussianVariant.box
    assert "standard deviation" in luxel.GaussianBlurParams.sigma.__doc__


def test_the_program_is_found_or_asked_for(monkeypatch):
    monkeypatch.setenv("LUXEL_PROGRAM", "/no/such/program")
    with pytest.raises(luxel.Error, match="set LUXEL_PROGRAM"):
        luxel.report()


@pytest.mark.parametrize("path", sorted((pathlib.Path(__file__).resolve().parents[2] / "examples/notebooks").glob("*.ipynb")), ids=lambda p: p.stem)
def test_notebooks_run(path, capsys):
    names = {}
    for cell in json.loads(path.read_text())["cells"]:
        if cell["cell_type"] == "code":
            exec("".join(cell["source"]), names)  # pylint: disable=exec-used
    printed = capsys.readouterr().out
    assert "expected 0..10000" in printed and " ms" in printed
