// OpenCV's filters in turn with bilateral.
#include <fmt/format.h>

#include "bench/report/filters.h"
#include "bench/report/filters_opencv.h"
#include "bench/truth/bilateral_truth.h"
#include "tests/cases/bilateral_support.h"
#include "tests/cases/compare.h"

namespace luxel::report {

using cases::Run;
using cases::Values;

std::vector<Job> filter_peers(Session& session) {
  if (session.is_cpu()) return {};
  const std::string profile = session.context().profile().name;
  std::vector<Job> jobs;
  enum class Peer { self, joint, bits8, bits8_opencl };
  const bool opencl = session.context().info().api == Api::opencl;
  for (const Peer which : {Peer::self, Peer::joint, Peer::bits8, Peer::bits8_opencl}) {
    const bool joint = which == Peer::joint, bits8 = which == Peer::bits8 || which == Peer::bits8_opencl;
    if (which == Peer::bits8_opencl && !opencl) continue;
    if (bits8 && session.settings().quick) continue;  // ten times as long as ours: whole reports have it
    Cell goal;
    if (profile == "pocl" && !bits8) goal = joint ? 5.0 : 3.5;
    if (profile == "lavapipe" && !bits8) goal = joint ? 2.0 : 1.2;
    jobs.push_back(
        {fmt::format("bilateral peer OpenCV {}", joint ? "jointBilateralFilter"
                                                 : which == Peer::bits8        ? "bilateralFilter 8 bits"
                                                 : which == Peer::bits8_opencl ? "bilateralFilter 8 bits OpenCL"
                                                                               : "bilateralFilter"),
         [&session, which, joint, bits8, goal]() -> Status {
           BilateralParams p;
           p.width = 1920;
           p.height = 1080;
           p.radius = 4;
           p.sigma_space = 3;
           p.sigma_range = 0.2;
           p.window = FilterWindow::circle;
           p.range_norm = RangeNorm::l1;
           p.range = joint ? RangeTerm::guide : RangeTerm::self;
           if (bits8) p.format = Format::unorm8x4;
           cases::BilateralImages images = cases::bilateral_images(p, 1);
           for (std::size_t i = 3; i < images.src.size(); i += 4) images.src[i] = 0;
           Result<Run> made = Run::make(session.context(), plan(p, session.context().profile()));
           if (!made) return made.status();
           const auto run = std::make_shared<Run>(std::move(made).value());
           if (Status s = run->write("src", images.src); !s) return s;
           if (joint)
             if (Status s = run->write("guide", images.guide); !s) return s;
           if (Status s = run->go(); !s) return s;
           const Session::Timed own = timed(run);
           const Result<OpenCvFilter> peer =
               bits8 ? opencv_filter8(p, images.src, which == Peer::bits8_opencl ? session.device() : std::string())
                     : opencv_filter(p, images.src, joint ? images.guide : Values());
           if (!peer) return peer.status();
           const auto pair = session.interleave(own, peer.value().run, "peer " + peer.value().name);
           if (!pair) return pair.status();
           const Sample ratio = summarise(ratios(pair.value().b, pair.value().a));
           const auto out = run->read("dst");
           if (!out) return out.status();
           // Against the formula in double, on the middle, where no border shows.
           constexpr int left = 900, top = 500, side = 64;
           BilateralParams part = p;
           part.width = part.height = side + 8;
           cases::BilateralImages cut;
           const auto crop = [&](const Values& v, int x0, int y0, int n) {
             Values values;
             for (int y = 0; y < n; ++y)
               for (int i = 0; i < 4 * n; ++i)
                 values.push_back(v[(static_cast<std::size_t>(y0 + y) * 1920 + x0) * 4 + i]);
             return values;
           };
           cut.src = crop(images.src, left - 4, top - 4, side + 8);
           cut.guide = crop(images.guide, left - 4, top - 4, side + 8);
           const Values truth = truth::bilateral(part, cut).src;
           Values inner;
           for (int y = 4; y < side + 4; ++y)
             for (int i = 16; i < 4 * (side + 4); ++i)
               inner.push_back(truth[static_cast<std::size_t>(y) * 4 * (side + 8) + i]);
           session.row(
               "peers",
               {{"peer", peer.value().name},
                {"version", peer.value().version},
                {"kernel", "bilateral"},
                {"size", "1920x1080"},
                {"time_ms", cell_of(summarise(pair.value().b))},
                {"error", cases::max_difference(crop(peer.value().result(), left, top, side), inner)},
                {"ratio", ratio.median},
                {"q1", ratio.q1},
                {"q3", ratio.q3},
                {"device", session.device()},
                {"options",
                 {{"format", bits8 ? "unorm8, 3 channels" : "f32, 3 channels"}, {"diameter", 9}, {"window", "circle"}, {"norm", "l1"}}},
                {"own_ms", cell_of(summarise(pair.value().a))},
                {"own_error", cases::max_difference(crop(out.value(), left, top, side), inner)},
                {"goal", goal}});
           return {};
         }});
  }
  return jobs;
}

}  // namespace luxel::report
