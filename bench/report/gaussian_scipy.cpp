// scipy's gaussian_filter beside ours: the same image, the same taps, in turn. Each of its runs is a process that warms up first.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "bench/report/child.h"
#include "bench/report/gaussian.h"
#include "tests/cases/gaussian_blur_support.h"

namespace luxel::report {
namespace {

namespace fs = std::filesystem;

// Arguments: folder, height, width, sigma, radius. Writes "milliseconds version" to descriptor 3, and the result to the folder.
constexpr const char* script = R"(
import os, sys, time
try:
    import numpy, scipy
    from scipy.ndimage import gaussian_filter
except ImportError:
    sys.exit(9)
folder, height, width, sigma, radius = sys.argv[1], *map(int, sys.argv[2:4]), float(sys.argv[4]), int(sys.argv[5])
image = numpy.fromfile(folder + "/src", numpy.float32).reshape(height, width, -1)
out = numpy.empty_like(image)
def run():
    gaussian_filter(image, (sigma, sigma, 0), mode="nearest", truncate=(radius + 0.25) / sigma, output=out)
run()
begin = time.perf_counter()
run()
took = 1000 * (time.perf_counter() - begin)
out.tofile(folder + "/dst")
os.write(3, f"{took} {scipy.__version__}\n".encode())
)";

struct Folder {
  std::string path;
  Folder() {
    path = (fs::temp_directory_path() / "luxel-scipy-XXXXXX").string();
    if (mkdtemp(path.data()) == nullptr) path.clear();
  }
  ~Folder() {
    std::error_code ignored;
    if (!path.empty()) fs::remove_all(path, ignored);
  }
};

Status beside(Session& session, const BlurSetting& s) {
  const Folder folder;
  if (folder.path.empty()) return Status(Code::io, "no temporary folder can be made");
  const std::vector<double> source = in_format(*s.scene, s.params.format);
  const std::vector<float> floats(source.begin(), source.end());
  std::ofstream(folder.path + "/src", std::ios::binary)
      .write(reinterpret_cast<const char*>(floats.data()), static_cast<std::streamsize>(floats.size() * sizeof(float)));
  std::string version;
  const Session::Timed theirs = [&]() -> Result<double> {
    double ms = 0;
    const Ended ended = run_child({"/usr/bin/env", "python3", "-c", script, folder.path, std::to_string(s.params.height),
                                   std::to_string(s.params.width), fmt::format("{}", s.params.sigma), std::to_string(s.params.radius)},
                                  {}, folder.path + "/log", 120, [&](const std::string& line) {
                                    const std::size_t space = line.find(' ');
                                    ms = std::strtod(line.c_str(), nullptr);
                                    version = line.substr(space + 1);
                                  });
    if (ended.status == 9 || !ended.started)
      return Status(Code::unsupported, "peers: python3 has no scipy here (Debian: apt-get install python3-scipy)");
    if (ended.died() || ended.status != 0 || !(ms > 0)) return Status(Code::io, "scipy's gaussian_filter did not run");
    return ms;
  };
  const auto first = theirs();
  if (!first) return first.status();
  const auto own = timed_blur(session, s);
  if (!own) return own.status();
  const auto pair = session.interleave(own.value(), theirs, "peer scipy");
  if (!pair) return pair.status();
  std::vector<float> made(floats.size());
  std::ifstream(folder.path + "/dst", std::ios::binary)
      .read(reinterpret_cast<char*>(made.data()), static_cast<std::streamsize>(made.size() * sizeof(float)));
  const auto result = cases::blur(session.context(), s.params, source);
  if (!result) return result.status();
  const Sample ratio = summarise(ratios(pair.value().b, pair.value().a));
  session.row("peers", {{"peer", "scipy gaussian_filter, one thread"},
                        {"version", version},
                        {"kernel", "gaussian_blur"},
                        {"size", size_text(s.params.width, s.params.height)},
                        {"time_ms", to_json(summarise(pair.value().b))},
                        {"error", blur_error(s, source, {made.begin(), made.end()})},
                        {"ratio", ratio.median},
                        {"q1", ratio.q1},
                        {"q3", ratio.q3},
                        {"device", session.device()},
                        {"options",
                         {{"format", name(s.params.format)},
                          {"border", "clamp"},
                          {"sigma", s.params.sigma},
                          {"variant", cases::name(s.params.variant)},
                          {"taps", 2 * s.params.radius + 1}}},
                        {"own_ms", to_json(summarise(pair.value().a))},
                        {"own_error", blur_error(s, source, result.value())},
                        {"goal", nullptr}});
  return {};
}

}  // namespace

std::vector<Job> gaussian_scipy(Session& session) {
  if (session.is_cpu() || session.settings().quick) return {};
  const auto scene = std::make_shared<Scene>(landscape(1920, 1080));
  const BlurSetting s{scene, params_for(*scene, 4, 3), 3};
  return {{"gaussian_blur peer scipy", [&session, s] { return beside(session, s); }}};
}

}  // namespace luxel::report
