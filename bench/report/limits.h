// What the device's driver can do at most, through kernels of the same dialect: copy, triad, arithmetic.
#pragma once
#include <array>

#include "bench/report/session.h"

namespace luxel::report {

/// The arithmetic and triad jobs of a device. Adds to `devices[].limits`.
std::vector<Job> limit_jobs(Session& session);

/// Adds copies of an image or volume of 4, 8 and 16 bytes a pixel, by the fastest of the forms that read a buffer,
/// unless the session has them already. `size` is how rows of that size are written.
void add_copies(Session& session, std::vector<Job>& jobs, const std::string& size, int width, int rows);

/// A way to copy: through a texel buffer or not, and how many pieces an invocation moves.
struct CopyForm {
  const char* name;
  bool texels;
  int block;
};

/// The ways that can differ on a device: the best of them is its limit.
std::vector<CopyForm> copy_forms(Session& session);

/// Plan of a copy. Resources src and dst. Errors: invalid_argument.
Result<Plan> copy_plan(int width, int height, int bytes, const CopyForm& form, const Profile& profile);

/// Plan of a = b + s c over width x height pixels f32x4; width a multiple of 4. Resources b, c, a.
Result<Plan> triad_plan(int width, int height, const Profile& profile);

/// Plan of `looks` trilinear look-ups by each of width x height invocations along lines through a volume of side^3:
/// resources volume (a buffer, or with `sampled` a 3-D image) and dst. `step`: voxels from look-up to look-up.
struct SampleForm {
  Format format = Format::f32x4;
  bool sampled = false;
  bool texels = false;
};
Result<Plan> sample_plan(int width, int height, int side, int looks, std::array<double, 3> step, const SampleForm& form,
                         const Profile& profile);

/// Plan of a march: `invocations`, each a random number of steps up to `steps`, whose reads' addresses are the values that the
/// reads before gave. Resources links (f32x1: a cycle through all its entries, below 2^24) and dst. And the steps of all.
Result<Plan> march_plan(int invocations, int entries, int steps, const Profile& profile);
double march_steps(int invocations, int steps);

/// Plan of the reads of width x height receivers, each of eight probes around it: a texel of irradiance and one of moments
/// (maps with a border), or with corners = 4 the four of a bilinear look-up. Resources receivers, dst, light, moments.
struct ProbeReads {
  int width = 0, height = 0;
  std::array<int, 3> count{1, 1, 1};
  int light_size = 8, moments_size = 16;
  bool half = true;
  int corners = 1;
};
Result<Plan> probe_reads_plan(const ProbeReads& reads, const Profile& profile);

/// Copy, triad and fused multiply-adds by plain C++ on two threads: entries like those of `devices[].limits`.
std::vector<Cell> machine_limits(bool quick);

}  // namespace luxel::report
