// The Python module: devices, plans, and runs of plans on arrays of bytes. What is written in Python stands in luxel/.
#include "core.h"

#include <nanobind/ndarray.h>

#include <algorithm>
#include <optional>

#include <luxel/device.h>
#include <luxel/voxelize.h>

namespace luxel::python {

namespace {

nb::object& error_type() {
  static nb::object* type = new nb::object();
  return *type;
}

}  // namespace

void check(const Status& status) {
  if (status.ok()) return;
  PyErr_SetString(status.code() == Code::invalid_argument ? PyExc_ValueError : error_type().ptr(), status.message().c_str());
  throw nb::python_error();
}

namespace {

using Bytes = nb::ndarray<nb::numpy, const std::uint8_t, nb::ndim<1>, nb::c_contig>;
using Made = nb::ndarray<nb::numpy, std::uint8_t, nb::ndim<1>>;

Made array_of(std::vector<std::uint8_t>&& bytes) {
  auto* kept = new std::vector<std::uint8_t>(std::move(bytes));
  const nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<std::vector<std::uint8_t>*>(p); });
  const std::size_t shape[] = {kept->size()};
  return Made(kept->data(), 1, shape, owner);
}

// Bytes of a resource on a device: the execution in double keeps a double a channel.
std::size_t bytes_on(const Context& context, const Resource& r) {
  std::size_t bytes = r.bytes;
  if (r.kind != ResourceKind::buffer)
    bytes = static_cast<std::size_t>(r.extent[0]) * static_cast<std::size_t>(r.extent[1]) * static_cast<std::size_t>(r.extent[2]) *
            bytes_per_pixel(r.format);
  if (context.real64() && r.format != Format::u32)
    bytes = bytes / bytes_per_pixel(r.format) * static_cast<std::size_t>(channels(r.format)) * sizeof(double);
  return bytes;
}

// Runs a plan: `given` holds the bytes of resources by name, others begin as zeros; what the plan writes comes back.
nb::dict run(Context& context, const Plan& plan, const std::map<std::string, Bytes>& given, int repeat, bool texts) {
  std::vector<Named> named;
  std::vector<std::pair<std::string, std::vector<std::uint8_t>>> results;
  Times times;
  {
    std::vector<std::pair<const std::uint8_t*, std::size_t>> sources;
    for (const Resource& r : plan.resources) {
      const auto found = given.find(r.name);
      sources.emplace_back(found == given.end() ? nullptr : found->second.data(), found == given.end() ? 0 : found->second.size());
    }
    nb::gil_scoped_release free;
    const auto work = [&]() -> Status {
      auto program = context.compile(plan);
      if (!program) return program.status();
      for (std::size_t i = 0; i < plan.resources.size(); ++i) {
        const Resource& r = plan.resources[i];
        const std::size_t bytes = bytes_on(context, r);
        auto memory = context.make(r, r.kind == ResourceKind::buffer && !context.real64() ? std::max(r.bytes, sources[i].second) : 0);
        if (!memory) return memory.status();
        std::vector<std::uint8_t> zeros;
        if (sources[i].first == nullptr) zeros.resize(bytes);
        const std::uint8_t* data = sources[i].first != nullptr ? sources[i].first : zeros.data();
        if (bytes > 0)
          if (Status s = context.upload(*memory.value(), data, sources[i].first != nullptr ? std::min(bytes, sources[i].second) : bytes); !s)
            return s;
        named.push_back({r.name, memory.value()});
      }
      const Status ran = repeat > 1 ? context.run_many(*program.value(), named, repeat, &times) : context.run(*program.value(), named, &times);
      if (!ran) return ran;
      for (std::size_t i = 0; i < plan.resources.size(); ++i) {
        const Resource& r = plan.resources[i];
        if (!r.written) continue;
        std::vector<std::uint8_t> bytes(bytes_on(context, r));
        if (Status s = context.download(*named[i].memory, bytes.data(), bytes.size()); !s) return s;
        results.emplace_back(r.name, std::move(bytes));
      }
      return {};
    };
    const Status status = work();
    nb::gil_scoped_acquire held;
    check(status);
  }
  nb::dict made;
  for (auto& [name, bytes] : results) made[name.c_str()] = array_of(std::move(bytes));
  if (texts) {
    nb::list passes;
    for (const double ms : times.passes) passes.append(ms);
    made["times"] = nb::make_tuple(times.total, passes);
  }
  return made;
}

using Vertices = nb::ndarray<nb::numpy, const double, nb::shape<-1, 3>, nb::c_contig>;
using Triangles = nb::ndarray<nb::numpy, const std::uint32_t, nb::shape<-1, 3>, nb::c_contig>;

VoxelTriangles triangles_of(Vertices positions, Triangles indices, std::optional<std::vector<std::uint32_t>> materials, const VoxelGrid& grid) {
  VoxelMesh mesh;
  mesh.positions = positions.data();
  mesh.vertices = positions.shape(0);
  mesh.indices = indices.data();
  mesh.triangles = indices.shape(0);
  if (materials) {
    if (materials->size() != mesh.triangles) throw nb::value_error("materials: one a triangle is expected");
    mesh.materials = materials->data();
  }
  return value_of(voxel_triangles(mesh, grid));
}

}  // namespace

NB_MODULE(_luxel, m) {
  m.doc() = "luxel's kernels on bytes; the package luxel has them on arrays";
  error_type() = nb::exception<std::runtime_error>(m, "Error");
  nb::enum_<Format>(m, "Format")
      .value("f32x1", Format::f32x1).value("f32x2", Format::f32x2).value("f32x4", Format::f32x4)
      .value("f16x2", Format::f16x2).value("f16x4", Format::f16x4).value("unorm8x4", Format::unorm8x4)
      .value("u32", Format::u32);
  nb::enum_<Input>(m, "Input").value("buffer", Input::buffer).value("image", Input::image).value("storage_image", Input::storage_image);
  m.def("channels", [](Format f) { return channels(f); }, "Channels of a pixel.");
  nb::class_<Resource>(m, "Resource")
      .def_ro("name", &Resource::name).def_ro("format", &Resource::format, "how elements are stored")
      .def_ro("bytes", &Resource::bytes, "of a buffer, least size").def_ro("extent", &Resource::extent, "of an image, texels")
      .def_ro("written", &Resource::written)
      .def_prop_ro("is_buffer", [](const Resource& r) { return r.kind == ResourceKind::buffer; });
  nb::class_<Plan>(m, "Plan", "The passes of one call of a kernel, and the resources that the caller brings.")
      .def_ro("kernel", &Plan::kernel).def_ro("resources", &Plan::resources).def_ro("scratch_bytes", &Plan::scratch_bytes)
      .def_ro("flops", &Plan::flops).def_ro("bytes", &Plan::bytes, "least memory traffic")
      .def_prop_ro("passes", [](const Plan& p) {
        std::vector<std::string> labels;
        for (const Pass& pass : p.passes) labels.push_back(pass.label);
        return labels;
      });
  nb::class_<DeviceInfo>(m, "DeviceInfo")
      .def_ro("index", &DeviceInfo::index).def_ro("name", &DeviceInfo::name).def_ro("driver", &DeviceInfo::driver)
      .def_ro("profile", &DeviceInfo::profile).def_ro("id", &DeviceInfo::id)
      .def("__repr__", [](const DeviceInfo& d) { return "<DeviceInfo " + d.id + ">"; });
  m.def("devices", [] { return devices(); }, "Every device of this machine: OpenCL, Vulkan, then C++ float and C++ double.");
  nb::class_<Context>(m, "Context")
      .def_prop_ro("info", [](const Context& c) { return c.info(); })
      .def_prop_ro("profile", [](const Context& c) { return c.profile().name; })
      .def_prop_ro("real64", [](const Context& c) { return c.real64(); })
      .def("run", &run, nb::arg("plan"), nb::arg("given"), nb::arg("repeat") = 1, nb::arg("times") = false);
  m.def("open", [](const std::string& which) { return value_of(Context::open(which)); }, nb::arg("which"));
  bind_kernels(m);
  m.def("voxel_triangles", &triangles_of, nb::arg("positions"), nb::arg("indices"), nb::arg("materials").none(), nb::arg("grid"),
        "Triangle records for `voxelize`.");
}

}  // namespace luxel::python
