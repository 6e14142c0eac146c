"""luxel: GPU compute kernels for real-time global illumination, on NumPy arrays.

    import luxel
    blurred = luxel.gaussian_blur(image, sigma=4, device="vulkan")

`devices()` lists what there is. Kernels on images, volumes and meshes are functions of their own; every call of every kernel is
`run(Params(...), resource=array, ...)`, with the parameters and resources of its header in include/luxel. `report` and `tune` run
the program `luxel`.
"""
from . import _luxel
from ._kernels import bilateral, cone_trace, gaussian_blur, mip_build, voxelize
from ._luxel import *  # noqa: F401,F403
from ._luxel import Error, devices
from ._program import report, tune
from ._run import device, run

__all__ = ["Error", "bilateral", "cone_trace", "device", "devices", "gaussian_blur", "mip_build", "report", "run", "tune", "voxelize",
           *(name for name in dir(_luxel) if not name.startswith("_"))]
