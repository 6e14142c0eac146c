// scipy's gaussian_filter beside ours: the same image, the same taps, in turn. Each of its runs is a process that warms up first.
#include <cstdlib>
#include <fstream>

#include <fmt/format.h>

#include "bench/io/temporary_folder.h"
#include "bench/report/child.h"
#include "bench/report/gaussian.h"

namespace luxel::report {
namespace {

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

Status beside(Session& session, const BlurSetting& s) {
  const io::TemporaryFolder made("luxel-scipy");
  const std::string& folder = made.path();
  if (folder.empty()) return Status(Code::io, "no temporary folder can be made");
  const std::vector<double> source = in_format(*s.scene, s.params.format);
  const std::vector<float> floats(source.begin(), source.end());
  std::ofstream(folder + "/src", std::ios::binary)
      .write(reinterpret_cast<const char*>(floats.data()), static_cast<std::streamsize>(floats.size() * sizeof(float)));
  std::string version;
  const Session::Timed theirs = [&]() -> Result<double> {
    double ms = 0;
    const Ended ended = run_child({"/usr/bin/env", "python3", "-c", script, folder, std::to_string(s.params.height),
                                   std::to_string(s.params.width), fmt::format("{}", s.params.sigma), std::to_string(s.params.radius)},
                                  {}, folder + "/log", 120, [&](const std::string& line) {
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
  return beside_peer(session, s,
                     {"scipy gaussian_filter, one thread", version, s.params.radius, theirs,
                      [&] {
                        std::vector<float> result(floats.size());
                        std::ifstream(folder + "/dst", std::ios::binary)
                            .read(reinterpret_cast<char*>(result.data()), static_cast<std::streamsize>(result.size() * sizeof(float)));
                        return std::vector<double>(result.begin(), result.end());
                      }},
                     nullptr);
}

}  // namespace

std::vector<Job> gaussian_scipy(Session& session) {
  if (session.is_cpu() || session.settings().quick) return {};
  const auto scene = std::make_shared<Scene>(landscape(1920, 1080));
  const BlurSetting s{scene, params_for(*scene, 4, 3), 3};
  return {{"gaussian_blur peer scipy", [&session, s] { return beside(session, s); }}};
}

}  // namespace luxel::report
